# SPDX-License-Identifier: Apache-2.0
"""Bitwise identical on any number of threads, and from any interruption on: kills, signals, the stop file, the wall time."""
import json
import re
import resource
import shutil
import signal
import subprocess
import time
import unittest

from program import CASE, PROGRAM, PROJECT, ProgramTest, bits, checkpoints, rows, scratch_folder, state, tree

# 700 grains are three chunks of work, one for each of three threads.
LARGE = ("--set", "particles.count=700", "--set", "particles.size=206 mm", "--set", "run.end=0.2 ms")


class Threads(ProgramTest):
    def assert_same_on_1_2_3_threads(self, *settings):
        self.talus("run", "case.toml", "--out", "1", "--threads", 1, *LARGE, *settings)
        self.assertGreater(len(rows(self.folder / "1/series.csv")), 15)
        for threads in (2, 3):
            out = self.folder / str(threads)
            self.talus("run", "case.toml", "--out", out, "--threads", threads, *LARGE, *settings)
            self.assertEqual(json.loads((out / "manifest.json").read_text())["threads"], threads)
            self.assertEqual(bits(out), bits(self.folder / "1"))
            self.assertEqual(state(out), state(self.folder / "1"))

    def test_in_the_plane(self):
        self.assert_same_on_1_2_3_threads()

    def test_in_space_in_single_precision(self):
        self.assert_same_on_1_2_3_threads("--set", "motion=xyz", "--set", "particles.shape=ball", "--set",
                                          "particles.size=90 mm", "--set", "fluid.precision=single")

    def test_another_seed_has_other_bits(self):
        self.talus("run", "case.toml", "--out", "a")
        self.talus("run", "case.toml", "--out", "b", "--set", "seed=4")
        differing = [name for name, content in bits(self.folder / "a").items()
                     if bits(self.folder / "b").get(name) == content]
        self.assertEqual(differing, [])


# More than a second: long enough to be stopped within, also by a test that has to wait for a processor.
LONG = ("--set", "integration.max_step=0.0002", "--set", "output.checkpoint_interval=20 ms")


class Resumed(ProgramTest):
    settings = ()  # of every run

    @classmethod
    def setUpClass(cls):
        """The same run undisturbed, for all tests of the class."""
        folder = scratch_folder()
        cls.addClassCleanup(shutil.rmtree, folder)
        (folder / "case.toml").write_text(CASE)
        cls.whole = folder / "whole"
        subprocess.run([PROGRAM, "run", "case.toml", "--out", "whole", *cls.settings], cwd=folder, check=True,
                       capture_output=True)
        cls.steps = len(rows(cls.whole / "series.csv")) - 1

    def assert_goes_on_to_the_same_bits(self, threads=1):
        self.talus("run", "case.toml", "--out", "r", "--resume", "--threads", threads, *self.settings)
        self.assertEqual(bits(self.folder / "r"), bits(self.whole))
        self.assertEqual(state(self.folder / "r"), state(self.whole))
        for table in sorted((self.whole / "analysis").iterdir()):
            self.assertEqual((self.folder / "r/analysis" / table.name).read_bytes(), table.read_bytes())
        self.assertEqual(list((self.folder / "r").rglob("*.part")), [])

    def assert_resumes_from_newest_checkpoint(self):
        """A session without time for a step leaves a checkpoint where it began."""
        newest = max(checkpoints(self.folder / "r").values())
        self.talus("run", "case.toml", "--out", "r", "--resume", "--walltime", "1e-9", *self.settings, status=130)
        self.assertEqual(max(checkpoints(self.folder / "r").values()), newest)
        self.assertEqual(len(rows(self.folder / "r/series.csv")), newest + 1)
        return newest


class Hopper(ProgramTest):
    """Grains that have just begun to leave a hopper: particles of 5 mm, settled, 200 ms after the opening."""
    settings = ("--set", "bed.spacing=5 mm", "--set", "run.end=200 ms", "--set", "output.snapshots=50 ms", "--set",
                "output.pictures=false")
    case = PROJECT / "cases/yuu2011-hopper-vacuum.toml"

    def test_same_on_1_and_2_threads_and_after_interruptions(self):
        start = time.monotonic()
        self.talus("run", self.case, "--out", "1", "--threads", 1, *self.settings)
        eighth = (time.monotonic() - start) / 8
        self.talus("run", self.case, "--out", "2", "--threads", 2, *self.settings)
        self.assertEqual(bits(self.folder / "2"), bits(self.folder / "1"))
        self.assertEqual(state(self.folder / "2"), state(self.folder / "1"))
        for _ in range(3):
            eighth = self.interrupt(eighth)
        self.talus("run", self.case, "--out", "r", "--threads", 2, "--resume", *self.settings)
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "1"))
        self.assertEqual(state(self.folder / "r"), state(self.folder / "1"))
        # A run that was killed behind its last checkpoint writes its last snapshot without a step.
        tables = tree(self.folder / "1/analysis")
        self.assertTrue(tables)
        self.assertEqual(tree(self.folder / "r/analysis"), tables)
        last = max((self.folder / "r/snapshots").glob("particles_*.vtkhdf"))
        last.unlink()
        shutil.rmtree(self.folder / "r/analysis")
        self.talus("run", self.case, "--out", "r", "--resume", *self.settings)
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "1"))
        self.assertEqual(tree(self.folder / "r/analysis"), tables)
        self.assertEqual(self.slow_flow("r"), self.slow_flow("1"))

    def interrupt(self, seconds):
        """Begins or resumes the run and lets the wall time stop it; returns the time that it got. A machine that has
        become faster reaches the end within that time: the same session then has a half of it."""
        run, before = self.folder / "r", self.folder / "before"
        if run.exists():
            shutil.copytree(run, before)
        command = ("run", self.case, "--out", "r", *(("--resume",) if before.exists() else ()), *self.settings)
        while (done := self.run_talus(*command, "--walltime", seconds)).returncode == 0:
            seconds /= 2
            shutil.rmtree(run)
            if before.exists():
                shutil.copytree(before, run)
        self.assertEqual(done.returncode, 130, done.stderr)
        shutil.rmtree(before, ignore_errors=True)
        return seconds

    def slow_flow(self, folder):
        """What the card said at each end of the run."""
        return set(re.findall("share of slow flow = (\\S+):", (self.folder / folder / "log.txt").read_text()))


class HopperInAir(Hopper):
    """The same with air in cells of 5 mm."""
    settings = (*Hopper.settings, "--set", "box.depth=5 mm", "--set", "air.cell=5 mm")
    case = PROJECT / "cases/yuu2011-section-air.toml"


class Extended(ProgramTest):
    """A run that is done and goes on to a later end: the commonest resume."""

    def snapshots(self, folder):
        return json.loads((self.folder / folder / "snapshots/particles.hdf.series").read_text())["files"]

    def test_with_snapshots_left_to_their_default(self):
        (self.folder / "case.toml").write_text(CASE.replace('snapshots = "0.1 ms"\n', ""))
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=0.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "run.end=1 ms")
        self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "run.end=1.1 ms")
        self.talus("run", "case.toml", "--out", "whole", "--set", "run.end=1.1 ms", "--set",
                   "output.snapshots=0.025 ms")
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "whole"))
        self.assertEqual(tree(self.folder / "r/analysis"), tree(self.folder / "whole/analysis"))
        self.assertEqual(len(self.snapshots("r")), 45)
        # Another interval is another run, and so is an earlier end.
        said = self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "run.end=2 ms", "--set",
                          "output.snapshots=0.1 ms", status=2).stderr
        self.assertIn("output.snapshots", said)
        self.talus("run", "case.toml", "--out", "r", "--resume", status=2)

    def test_of_an_ensemble(self):
        (self.folder / "case.toml").write_text(CASE.replace('snapshots = "0.1 ms"\n', ""))
        command = ("ensemble", "case.toml", "--members", 2, "--jobs", 1, "--out")
        self.talus(*command, "e", "--set", "run.end=0.4 ms")
        self.talus(*command, "e", "--resume", "--set", "run.end=0.6 ms")
        self.talus(*command, "whole", "--set", "run.end=0.6 ms", "--set", "output.snapshots=0.02 ms")
        for member in ("all/seed_0003", "all/seed_0004"):
            self.assertEqual(bits(self.folder / "e" / member), bits(self.folder / "whole" / member))
        said = self.talus(*command, "e", "--resume", "--set", "run.end=0.6 ms").stdout
        self.assertIn("2 of 2 runs done", said)


class Interrupted(Resumed):
    """A run that is stopped from outside while it goes on."""

    settings = LONG

    def begin(self, part, *arguments):
        """Starts the run and waits until it has written this part of the series."""
        process = self.start("run", "case.toml", "--out", "r", *self.settings, *arguments)
        series, whole = self.folder / "r/series.csv", self.whole / "series.csv"
        self.wait_until(lambda: series.exists() and series.stat().st_size > part * whole.stat().st_size, process)
        return process

    def assert_left_with_a_checkpoint(self, reason):
        summary = json.loads((self.folder / "r/summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        step = summary["quantities"]["steps"]["value"]
        self.assertTrue(0 < step < self.steps, step)
        self.assertEqual(max(checkpoints(self.folder / "r").values()), step)
        self.assertEqual(len(rows(self.folder / "r/series.csv")), step + 1)
        self.assertIn(f"interrupted by {reason}", (self.folder / "r/log.txt").read_text())

    def test_killed_twice(self):
        self.kill(self.begin(0.1))
        first = self.assert_resumes_from_newest_checkpoint()
        self.kill(self.begin(0.4, "--resume", "--threads", 3))
        self.assertGreater(self.assert_resumes_from_newest_checkpoint(), first)
        self.assert_goes_on_to_the_same_bits()

    def test_signals(self):
        for number, name in ((signal.SIGINT, "SIGINT"), (signal.SIGTERM, "SIGTERM")):
            with self.subTest(name):
                process = self.begin(0.2)
                process.send_signal(number)
                self.assertEqual(process.wait(), 130)
                self.assert_left_with_a_checkpoint(name)
                self.assert_goes_on_to_the_same_bits(threads=2)
            shutil.rmtree(self.folder / "r")

    def test_stop_file(self):
        process = self.begin(0.01)  # it is looked for ten times a second
        (self.folder / "r/stop").touch()
        self.assertEqual(process.wait(), 130)
        self.assert_left_with_a_checkpoint("the file r/stop")
        self.assert_goes_on_to_the_same_bits()
        self.assertFalse((self.folder / "r/stop").exists())

    def test_walltime(self):
        self.talus("run", "case.toml", "--out", "r", "--walltime", "0.1", *LONG, status=130)
        self.assert_left_with_a_checkpoint("the wall-time limit")
        seconds = lambda: json.loads((self.folder / "r/summary.json").read_text())["wall_seconds"]
        self.assertGreaterEqual(seconds(), 0.1)
        self.talus("run", "case.toml", "--out", "r", "--resume", "--walltime", "0.1", *LONG, status=130)
        self.assertGreaterEqual(seconds(), 0.2)
        self.assert_goes_on_to_the_same_bits(threads=3)

    def test_damaged_newest_checkpoint_is_passed_over(self):
        process = self.begin(0.3)
        self.wait_until(lambda: len(list((self.folder / "r").glob("checkpoint_?.h5"))) == 2, process)
        self.kill(process)
        steps = checkpoints(self.folder / "r")
        newest = max(steps, key=steps.get)
        content = bytearray((self.folder / "r" / newest).read_bytes())
        content[-100] ^= 1
        (self.folder / "r" / newest).write_bytes(content)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", *LONG).stderr
        self.assertRegex(said, f"passed over: r/{newest}: does not have the checksum")
        self.assertEqual(bits(self.folder / "r"), bits(self.whole))


class KilledWhileItWrites(Resumed):
    """A limit on the size of files makes the system kill the run in the middle of the write that would pass it."""

    settings = ("--set", "output.checkpoint_interval=1 us", "--set", "output.snapshots=1 s", "--set",
                "integration.max_step=0.02")

    def setUp(self):
        super().setUp()
        self.size = (self.whole / "checkpoint_a.h5").stat().st_size
        self.series = (self.whole / "series.csv").read_bytes()

    def killed_by(self, limit, *arguments):
        def limits():
            resource.setrlimit(resource.RLIMIT_FSIZE, (limit, limit))
            resource.setrlimit(resource.RLIMIT_CORE, (0, 0))

        process = self.start("run", "case.toml", "--out", "r", *self.settings, *arguments, preexec_fn=limits)
        self.assertEqual(process.wait(), -signal.SIGXFSZ)

    def leave_at_start(self):
        self.talus("run", "case.toml", "--out", "r", "--walltime", "1e-9", *self.settings, status=130)
        self.assertEqual(set(checkpoints(self.folder / "r").values()), {0})

    def test_manifest(self):
        self.killed_by(500)
        self.assertEqual(len((self.folder / "r/manifest.json.part").read_bytes()), 500)
        self.assert_goes_on_to_the_same_bits()

    def test_first_snapshot(self):
        self.killed_by(10000)
        self.assertEqual(list((self.folder / "r/snapshots").glob("*.vtkhdf")), [])
        self.assertTrue((self.folder / "r/snapshots/particles_0000.vtkhdf.part").exists())
        self.assert_goes_on_to_the_same_bits()

    def test_checkpoint(self):
        self.leave_at_start()
        self.killed_by(self.size - 1000, "--resume")  # where what surrounds the columns is built, in a file of that size
        self.assertEqual(self.assert_resumes_from_newest_checkpoint(), 0)
        self.assert_goes_on_to_the_same_bits()

    def test_row(self):
        limit = self.series.index(b"\n", self.size + 10000) + 30
        self.killed_by(limit)
        self.assertEqual((self.folder / "r/series.csv").read_bytes(), self.series[:limit])
        self.assertEqual(self.assert_resumes_from_newest_checkpoint(), self.series[:limit].count(b"\n") - 2)
        self.assert_goes_on_to_the_same_bits()


if __name__ == "__main__":
    unittest.main()
