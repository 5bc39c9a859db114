# SPDX-License-Identifier: Apache-2.0
"""Files and numbers that go wrong: a full disk, folders that cannot be written, runs that blow up."""
import json
import math
import os
import re
import subprocess
import unittest

from program import CASE, PROGRAM, PROJECT, ProgramTest, bits, checkpoints, rows, state, tree

# Snapshots of 15 kB after every step, 160 of them.
FILLING = ("--set", "output.snapshots=1 ns", "--set", "run.end=0.1 ms", "--set",
           "integration.max_step=0.005")


class Disk(ProgramTest):
    """`disk` is a file system of its own, where the user may mount one."""

    def mount(self, options):
        disk = self.folder / "disk"
        disk.mkdir()
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", options, "tmpfs", disk], capture_output=True, text=True,
                              check=False)
        if done.returncode != 0:
            if os.geteuid() == 0 and "permission" not in done.stderr:
                self.fail(done.stderr)
            self.skipTest(f"no file system can be mounted for this test: {done.stderr.strip()}")
        self.addCleanup(subprocess.run, ["umount", "-l", disk], check=True)
        return disk

    def test_full_disk(self):
        disk = self.mount("size=1m")
        said = self.talus("run", "case.toml", "--out", "disk/r", *FILLING,
                          status=4).stderr
        self.assertRegex(said.splitlines()[-1], r"^talus: disk/r/\S+: .*No space left on device$")
        # What was written before is whole; what did not fit left nothing behind.
        self.assertEqual([name for name in tree(disk) if name.endswith(".part")], [])
        self.assertTrue(checkpoints(disk / "r"))
        snapshots = sorted((disk / "r/snapshots").glob("*.vtkhdf"))
        self.assertGreater(len(snapshots), 10)
        table = (disk / "r/series.csv").read_bytes()
        self.assertTrue(table.endswith(b"\n"))
        self.talus("run", "case.toml", "--out", "whole", *FILLING)
        whole = bits(self.folder / "whole")
        self.assertTrue(whole["series.csv"].startswith(table))
        for path in snapshots:
            self.assertEqual(path.read_bytes(), whole[path.name], path)
        # With room it goes on.
        subprocess.run(["mount", "-o", "remount,size=200m", disk], check=True)
        self.talus("run", "case.toml", "--out", "disk/r", "--resume", *FILLING)
        self.assertEqual(bits(disk / "r"), whole)
        self.assertEqual(json.loads((disk / "r/summary.json").read_text())["status"], "done")

    def test_memory_without_room(self):
        """Files are built in /dev/shm."""
        alone = ["unshare", "-m", "bash", "-c", 'mount -t tmpfs -o size=4k tmpfs /dev/shm || exit 77; exec "$@"', "bash"]
        done = subprocess.run([*alone, PROGRAM, "run", "case.toml", "--out", "r"], cwd=self.folder, capture_output=True,
                              text=True, check=False)
        if done.returncode in (1, 77):
            self.skipTest(f"no file system can be mounted for this test: {done.stderr.strip()}")
        self.assertEqual(done.returncode, 4, done.stderr)
        self.assertRegex(done.stderr, r"talus: r/\S+: cannot be built in memory: .*No space left on device")

    def test_disk_that_is_full_from_the_start(self):
        disk = self.mount("size=1m")
        self.talus("run", "case.toml", "--out", "disk/r", "--set", "run.end=0.1 ms")
        (disk / "filler").write_bytes(b"x" * (os.statvfs(disk).f_bavail * os.statvfs(disk).f_frsize))
        before = tree(disk / "r")
        said = self.talus("run", "case.toml", "--out", "disk/s", status=4).stderr
        self.assertIn("disk/s/files.txt: cannot write: No space left on device", said)
        self.assertEqual(tree(disk / "r"), before)
        self.assertEqual(tree(disk / "s"), {})

    def test_folder_that_cannot_be_written(self):
        if os.geteuid() == 0:
            self.mount("ro")
            reason = "Read-only file system"
        else:
            (self.folder / "disk").mkdir(0o555)
            reason = "Permission denied"
        for command in (["run"], ["ensemble", "--jobs", "1"]):
            said = self.talus(*command, "case.toml", "--out", "disk/r", status=4).stderr
            self.assertIn("disk/r", said)
            self.assertIn(reason, said)
        self.assertEqual(tree(self.folder), {"case.toml": CASE.encode()})

    def test_folder_that_is_a_file(self):
        (self.folder / "r").write_text("mine")
        self.talus("run", "case.toml", "--out", "r", status=2)
        self.assertIn("r/s", self.talus("run", "case.toml", "--out", "r/s", status=4).stderr)
        self.assertEqual((self.folder / "r").read_text(), "mine")

    def test_two_runs_do_not_share_a_folder(self):
        many = ("--set", "integration.max_step=0.00001")
        process = self.start("run", "case.toml", "--out", "r", *many)
        self.wait_for_rows(process, "r", 1)
        said = self.talus("run", "case.toml", "--out", "r", "--overwrite", *many, status=2).stderr
        self.assertIn("r: another run is writing into this folder", said)
        self.assertIsNone(process.poll())


class Numbers(ProgramTest):
    def blow_up(self, *arguments):
        """What the program says, taken apart; all that it leaves is whole and finite."""
        said = self.talus("run", "case.toml", "--out", "r", "--set", "output.checkpoint_interval=1 us", *arguments,
                          status=3).stderr.splitlines()[-1]
        found = re.fullmatch(r"talus: (?P<what>.+) \((?P<term>.+)\) at (?P<place>.+), step (?P<step>\d+), "
                             r"t = (?P<time>\S+) s; try: (?P<advice>.+)", said)
        self.assertTrue(found, said)
        self.assertIn(said.removeprefix("talus: "), (self.folder / "r/log.txt").read_text())
        self.assertEqual(json.loads((self.folder / "r/summary.json").read_text())["status"], "failed")
        return found

    def test_soft_spring(self):
        found = self.blow_up("--set", "contact.stiffness=1 mN/m")
        self.assertRegex(found["what"], r"the largest overlap is 0\.5\d* radii")
        self.assertIn("contact force, Eq. 2", found["term"])
        self.assertRegex(found["place"], r"grain \d+ at \(\S+, \S+, 0\) m")
        self.assertGreater(int(found["step"]), 5)
        self.assertIn("larger contact.stiffness", found["advice"])
        # The last good checkpoint is that of the step before.
        table = rows(self.folder / "r/series.csv")
        self.assertEqual(len(table), int(found["step"]) + 1)
        self.assertTrue(all(math.isfinite(float(value)) for row in table for value in row.values()))
        self.assertLess(float(table[-1]["overlap_max [m]"]), 0.5 * 5e-3)
        self.assertEqual(max(checkpoints(self.folder / "r").values()), int(found["step"]))
        before = state(self.folder / "r")
        again = self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "contact.stiffness=1 mN/m",
                           status=3).stderr
        self.assertIn(found.group(0), again)
        self.assertEqual(state(self.folder / "r"), before)

    def test_pressure_of_the_air_that_does_not_converge(self):
        case = [PROJECT / "cases/yuu2011-section-air.toml", "--set", "bed.spacing=5 mm", "--set", "box.depth=5 mm",
                "--set", "air.cell=5 mm", "--set", "air.max_iterations=1", "--set", "air.tolerance=1e-12"]
        self.assertIn("No forecast: the first steps of this case fail", self.talus("check", *case).stdout)
        said = self.talus("run", *case, "--out", "r", status=3).stderr.splitlines()[-1]
        self.assertRegex(said, r"the pressure equation has not converged \(largest residual of a cell \S+\) at cell "
                               r"\(\d+, \d+, \d+\) at \(.+\) m, step \d+, t = \S+ s; try: ")
        self.assertTrue(checkpoints(self.folder / "r"))

    def test_hard_spring(self):
        found = self.blow_up("--set", "contact.stiffness=1e12 N/m")
        self.assertRegex(found["what"], r"the longest stable step is \S+ of the largest")
        self.assertIn("smaller contact.stiffness", found["advice"])
        self.assertEqual(int(found["step"]), 0)

    def test_shape_that_random_packing_cannot_fill(self):
        # A strip of one and a half diameters, filled to 0.52: two rows, which are not met with by chance.
        (self.folder / "case.toml").write_text(CASE.replace(
            'shape = "circle"\ncount = 60\nsize = "60 mm"',
            'shape = "rectangle"\ncount = 30\nlength = "300 mm"\nwidth = "15 mm"\nboundary = "whole"'))
        found = self.blow_up()
        self.assertRegex(found["place"], r"^grain \d+ of 30$")

    def test_run_shorter_than_a_window(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=10 us")
        quantities = json.loads((self.folder / "r/summary.json").read_text())["quantities"]
        self.assertEqual(quantities["front_speed_end"], {"value": None, "unit": "1", "reason": "not a number"})
        self.assertGreaterEqual(quantities["overlap_max"]["value"], 0)


if __name__ == "__main__":
    unittest.main()
