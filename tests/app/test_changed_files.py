# SPDX-License-Identifier: Apache-2.0
"""Results that have changed since they were written are found: by --resume before anything is written, by check."""
import re
import unittest

from program import ProgramTest, bits, tree

QUICK = ("--set", "run.end=0.25 ms", "--threads", "1")


class ChangedFiles(ProgramTest):
    def setUp(self):
        super().setUp()
        self.talus("run", "case.toml", "--out", "r", *QUICK)

    def change_digit(self, name="r/series.csv", row=2):
        """Another digit in a row: still a number, and the file still of the same length."""
        path = self.folder / name
        lines = path.read_text().split("\n")
        digit = re.search(r"[1-8](?=[^,]*$)", lines[row])
        lines[row] = lines[row][:digit.start()] + "9" + lines[row][digit.end():]
        path.write_text("\n".join(lines))

    def turn_bit(self, name):
        content = bytearray((self.folder / name).read_bytes())
        content[-20] ^= 1  # of a double
        (self.folder / name).write_bytes(content)

    def assert_refused(self, name, *settings):
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", *QUICK, *settings, status=4).stderr
        self.assertRegex(said, f"talus: r: cannot be resumed, 1 of its files changed since .*{name}: its checksum is")
        self.assertEqual(tree(self.folder), before)
        self.assertIn(name, self.talus("analyze", "r", status=4).stderr)
        self.assertEqual(tree(self.folder), before, "nothing is measured of it")
        said = self.talus("check", "r", status=4)
        self.assertRegex(said.stdout, f"  ! r/{name}: its checksum is")
        self.assertIn("1 of 1 run folders has been modified", said.stderr)

    def test_none_has(self):
        self.assertRegex(self.talus("check", "r").stdout, r"^r: 5 files compared with the checksums in checkpoint_.\.h5$")
        self.talus("run", "case.toml", "--out", "r", "--resume", *QUICK)
        self.talus("check", "r")

    def test_a_digit_of_the_series(self):
        self.change_digit()
        self.assert_refused("series.csv")
        self.assert_refused("series.csv", "--set", "run.end=0.3 ms")

    def test_a_bit_of_a_snapshot(self):
        self.turn_bit("r/snapshots/particles_0001.vtkhdf")
        self.assert_refused("snapshots/particles_0001.vtkhdf")

    def test_a_removed_snapshot_is_left_out_and_told(self):
        (self.folder / "r/snapshots/particles_0001.vtkhdf").unlink()
        self.assertIn("particles_0001.vtkhdf: is missing", self.talus("check", "r", status=4).stdout)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", *QUICK).stderr
        self.assertIn("particles_0001.vtkhdf is missing and is left out", said)
        self.assertNotIn("particles_0001.vtkhdf", (self.folder / "r/snapshots/particles.hdf.series").read_text())

    def test_the_times_of_the_index_are_made_anew(self):
        whole = tree(self.folder / "r/snapshots")
        index = self.folder / "r/snapshots/particles.hdf.series"
        index.write_text(index.read_text().replace("e-", "e-1", 1))
        self.assertNotEqual(tree(self.folder / "r/snapshots"), whole)
        self.talus("run", "case.toml", "--out", "r", "--resume", *QUICK)
        self.assertEqual(tree(self.folder / "r/snapshots"), whole)

    def test_a_later_end(self):
        """The snapshot of the last state is replaced, and its checksum with it."""
        self.talus("run", "case.toml", "--out", "whole", "--set", "run.end=0.5 ms", "--threads", "1")
        self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "run.end=0.5 ms", "--threads", "1")
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "whole"))
        self.talus("check", "r")

    def test_every_run_of_an_ensemble_is_looked_at(self):
        self.talus("ensemble", "case.toml", "--out", "e", "--members", 2, "--jobs", 1, "--set", "run.end=0.2 ms")
        runs = sorted(path.parent for path in (self.folder / "e").rglob("series.csv"))
        self.assertEqual(self.talus("check", "e").stdout.count("files compared"), len(runs))
        self.change_digit(runs[1].relative_to(self.folder) / "series.csv")
        said = self.talus("check", "e", status=4)
        self.assertIn("1 of 2 run folders has been modified", said.stderr)

    def test_a_folder_without_a_run(self):
        (self.folder / "empty").mkdir()
        self.assertIn("holds no Talus run folder", self.talus("check", "empty", status=2).stderr)


if __name__ == "__main__":
    unittest.main()
