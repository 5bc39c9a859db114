# SPDX-License-Identifier: Apache-2.0
"""A folder that is there already: refused, gone on with, or overwritten; what others put there stays."""
import json
import unittest

from program import CASE, PROGRAM, PROJECT, ProgramTest, bits, tree
from test_points import POINTS


class ExistingFolder(ProgramTest):
    def test_is_refused_without_resume_or_overwrite(self):
        self.talus("run", "case.toml", "--out", "r")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("r: holds a run already; allowed: --resume to go on with it, --overwrite to replace it", said)
        self.assertEqual(tree(self.folder), before)
        self.talus("run", "case.toml", "--out", "none", "--resume", status=2)
        self.assertEqual(tree(self.folder), before)

    def test_changed_case_is_not_resumed(self):
        self.talus("run", "case.toml", "--out", "r")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "slope.angle=40 deg", "--set",
                          "seed=4", "--set", "run.end=0.5 ms", "--set", "gravity.direction=[1, 0, -1]", "--set",
                          "output.snapshots=0.2 ms", status=2).stderr
        for text in ('slope.angle: "45 deg" in the run there, "40 deg" now', "seed: 3 in the run there, 4 now",
                     "gravity.direction: not given in the run there, [1.0, 0.0, -1.0] now",
                     'output.snapshots: "0.0001 s" in the run there, "0.0002 s" now',
                     "run.end: 0.0005 s, before the end of the run there, 0.001 s"):
            self.assertIn(text, said)
        self.assertEqual(len(said.splitlines()), 6, said)
        self.assertEqual(tree(self.folder), before)

    def test_other_instruction_set_is_not_resumed(self):
        portable = ("--set", "integration.instruction_set=portable")
        self.talus("run", "case.toml", "--out", "r", *portable)
        self.talus("run", "case.toml", "--out", "r", "--resume", *portable)
        self.talus("run", "case.toml", "--out", "automatic")
        if '"instruction_set": "portable"' in (self.folder / "automatic/manifest.json").read_text():
            self.skipTest("this processor has no other instruction set")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", "--resume", status=2).stderr
        self.assertRegex(said, r"integration\.instruction_set: portable in the run there, \w+ now")
        self.assertEqual(tree(self.folder), before)

    def test_changed_points_are_not_resumed(self):
        (self.folder / "case.toml").write_text(POINTS)
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n0.02,0\n0,0.03\n")
        self.talus("run", "case.toml", "--out", "r")
        self.talus("run", "case.toml", "--out", "r", "--resume")
        (self.folder / "points.csv").write_text("x [m],y [m]\n0,0\n0.02,0\n0,0.04\n")
        before = tree(self.folder)
        self.assertIn("particles.file: its points are not those",
                      self.talus("run", "case.toml", "--out", "r", "--resume", status=2).stderr)
        self.assertEqual(tree(self.folder), before)

    def test_later_end_gives_the_bits_of_the_later_end_at_once(self):
        self.talus("run", "case.toml", "--out", "at-once", "--set", "run.end=1.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=0.77 ms")
        self.talus("run", "case.toml", "--out", "r", "--set", "run.end=1.5 ms", "--resume")
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "at-once"))
        self.assertIn(r'end = \"0.0015 s\"', (self.folder / "r/manifest.json").read_text())

    def test_overwriting_leaves_nothing_of_the_old_run_but_what_others_put_there(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "output.pictures=true")
        for name in ("analysis/head_widths.csv", "pictures/frames.png", "pictures/front.png",
                     "pictures/front_speed.png", "snapshots/particles_0010.vtkhdf"):
            self.assertTrue((self.folder / "r" / name).exists(), name)
        (self.folder / "r/snapshots/particles_0077.vtkhdf.part").touch()
        for name in ("notes.txt", "analysis/mine.txt", "pictures/mine.svg"):
            (self.folder / "r" / name).write_text("mine")
        # Without a slope there is neither a head nor a front.
        other = ("--set", "slope.enabled=false", "--set", "gravity.direction=[1, 0, 0]", "--set",
                 "output.snapshots=0.5 ms")
        self.talus("run", "case.toml", "--out", "r", "--overwrite", *other)
        self.talus("run", "case.toml", "--out", "fresh", *other)
        self.assertEqual(set(tree(self.folder / "r")) - set(tree(self.folder / "fresh")),
                         {"notes.txt", "analysis/mine.txt", "pictures/mine.svg",
                          "snapshots/particles_0077.vtkhdf.part"})
        (self.folder / "r/snapshots/particles_0077.vtkhdf.part").unlink()
        self.assertEqual(bits(self.folder / "r"), bits(self.folder / "fresh"))


if __name__ == "__main__":
    unittest.main()
