# SPDX-License-Identifier: Apache-2.0
"""The same bits on any number of threads, and from any interruption on: kills, signals, the stop file, the wall time."""
import json
import resource
import shutil
import signal
import unittest

from program import SLOW, ProgramTest, bits, checkpoints, rows, state

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


class Interrupted(ProgramTest):
    """Every way to end a run early; `whole` is the same run undisturbed."""

    def setUp(self):
        super().setUp()
        self.talus("run", "case.toml", "--out", "whole", *SLOW)
        self.whole = bits(self.folder / "whole")
        self.steps = len(rows(self.folder / "whole/series.csv")) - 1
        self.assertGreater(self.steps, 500)

    def begin(self, *arguments):
        return self.start("run", "case.toml", "--out", "r", *SLOW, *arguments)

    def assert_goes_on_to_the_same_bits(self, threads=1):
        self.talus("run", "case.toml", "--out", "r", "--resume", "--threads", threads, *SLOW)
        self.assertEqual(bits(self.folder / "r"), self.whole)
        self.assertEqual(state(self.folder / "r"), state(self.folder / "whole"))
        self.assertEqual((self.folder / "r/analysis/snapshots.csv").read_bytes(),
                         (self.folder / "whole/analysis/snapshots.csv").read_bytes())

    def assert_resumes_from_newest_checkpoint(self):
        """A session without time for a step leaves a checkpoint where it began."""
        newest = max(checkpoints(self.folder / "r").values())
        self.talus("run", "case.toml", "--out", "r", "--resume", "--walltime", "1e-9", *SLOW, status=130)
        self.assertEqual(max(checkpoints(self.folder / "r").values()), newest)
        self.assertEqual(len(rows(self.folder / "r/series.csv")), newest + 1)
        return newest

    def test_killed_at_several_moments(self):
        moments = [0, 1, self.steps // 7, self.steps // 3, self.steps // 2, self.steps - 60]
        resumed_at = []
        for n, moment in enumerate(moments):
            process = self.begin("--threads", 1 + n % 3, *(("--resume",) if n else ()))
            if moment:
                self.wait_for_rows(process, "r", moment)
            else:
                self.wait_until((self.folder / "r/manifest.json").exists, process)
            self.kill(process)
            if checkpoints(self.folder / "r"):
                resumed_at.append(self.assert_resumes_from_newest_checkpoint())
        self.assertEqual(resumed_at, sorted(resumed_at))
        self.assertGreater(resumed_at[-1], 0)
        self.assert_goes_on_to_the_same_bits()

    def killed_by_a_file_size_limit(self, limit, checkpoint_interval):
        """The system kills the run, in the middle of the write that makes a file larger than this."""
        process = self.begin("--set", "output.snapshots=1 s", "--set",
                             f"output.checkpoint_interval={checkpoint_interval}")
        self.wait_for_rows(process, "r", 2)
        resource.prlimit(process.pid, resource.RLIMIT_FSIZE, (limit, limit))
        self.assertEqual(process.wait(), -signal.SIGXFSZ)

    def test_killed_in_the_middle_of_a_checkpoint(self):
        self.talus("run", "case.toml", "--out", "whole", "--overwrite", *SLOW, "--set", "output.snapshots=1 s")
        self.whole = bits(self.folder / "whole")
        size = (self.folder / "whole/checkpoint_a.h5").stat().st_size
        self.killed_by_a_file_size_limit(size - 1000, "10 us")
        parts = list((self.folder / "r").glob("checkpoint_?.h5.part"))
        self.assertEqual([part.stat().st_size for part in parts], [size - 1000])
        self.assertTrue(checkpoints(self.folder / "r"))
        self.talus("run", "case.toml", "--out", "r", "--resume", *SLOW, "--set", "output.snapshots=1 s")
        self.assertEqual(bits(self.folder / "r"), self.whole)
        self.assertEqual(list((self.folder / "r").glob("*.part")), [])

    def test_killed_in_the_middle_of_a_row(self):
        whole = (self.folder / "whole/series.csv").read_bytes()
        limit = whole.index(b"\n", len(whole) // 2) + 30
        self.killed_by_a_file_size_limit(limit, "1 h")
        self.assertEqual((self.folder / "r/series.csv").read_bytes(), whole[:limit])
        self.assertEqual(checkpoints(self.folder / "r"), {"checkpoint_a.h5": 0})
        self.talus("run", "case.toml", "--out", "r", "--resume", *SLOW, "--set", "output.snapshots=1 s")
        self.assertEqual((self.folder / "r/series.csv").read_bytes(), whole)

    def test_damaged_newest_checkpoint_is_passed_over(self):
        process = self.begin()
        self.wait_for_rows(process, "r", self.steps // 2)
        self.wait_until(lambda: len(checkpoints(self.folder / "r")) == 2, process)
        self.kill(process)
        steps = checkpoints(self.folder / "r")
        newest = max(steps, key=steps.get)
        content = bytearray((self.folder / "r" / newest).read_bytes())
        content[-100] ^= 1
        (self.folder / "r" / newest).write_bytes(content)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", *SLOW).stderr
        self.assertRegex(said, f"passed over: r/{newest}: does not have the checksum")
        self.assertEqual(bits(self.folder / "r"), self.whole)

    def assert_left_with_a_checkpoint(self, reason):
        summary = json.loads((self.folder / "r/summary.json").read_text())
        self.assertEqual(summary["status"], "interrupted")
        step = summary["quantities"]["steps"]["value"]
        self.assertTrue(0 < step < self.steps, step)
        self.assertEqual(max(checkpoints(self.folder / "r").values()), step)
        self.assertEqual(len(rows(self.folder / "r/series.csv")), step + 1)
        self.assertIn(f"interrupted by {reason}", (self.folder / "r/log.txt").read_text())

    def test_signals(self):
        for number, name in ((signal.SIGINT, "SIGINT"), (signal.SIGTERM, "SIGTERM")):
            with self.subTest(name):
                process = self.begin()
                self.wait_for_rows(process, "r", self.steps // 4)
                process.send_signal(number)
                self.assertEqual(process.wait(), 130)
                self.assert_left_with_a_checkpoint(name)
                self.assert_goes_on_to_the_same_bits(threads=2)
            shutil.rmtree(self.folder / "r")

    def test_stop_file(self):
        # It is looked for every half second; so many steps last longer.
        many = ("--set", "integration.largest_step=0.0002", "--set", "output.checkpoint_interval=1 h")
        self.talus("run", "case.toml", "--out", "whole", "--overwrite", *many)
        self.steps = len(rows(self.folder / "whole/series.csv")) - 1
        process = self.start("run", "case.toml", "--out", "r", *many)
        self.wait_for_rows(process, "r", 10)
        (self.folder / "r/stop").touch()
        self.assertEqual(process.wait(), 130)
        self.assert_left_with_a_checkpoint("the file r/stop")
        self.talus("run", "case.toml", "--out", "r", "--resume", *many)
        self.assertFalse((self.folder / "r/stop").exists())
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "whole"))

    def test_walltime(self):
        self.talus("run", "case.toml", "--out", "r", "--walltime", "0.02", *SLOW, status=130)
        self.assert_left_with_a_checkpoint("the wall-time limit")
        seconds = json.loads((self.folder / "r/summary.json").read_text())["wall_seconds"]
        self.talus("run", "case.toml", "--out", "r", "--resume", "--walltime", "0.01", *SLOW, status=130)
        self.assertGreater(json.loads((self.folder / "r/summary.json").read_text())["wall_seconds"], seconds)
        self.assert_goes_on_to_the_same_bits(threads=3)


if __name__ == "__main__":
    unittest.main()
