# SPDX-License-Identifier: Apache-2.0
"""Two runs beside each other: what is said, and that nothing is written that nobody asked for."""
import unittest

from program import ProgramTest, tree


class Compare(ProgramTest):
    def test_two_runs(self):
        self.talus("run", "case.toml", "--out", "a")
        self.talus("run", "case.toml", "--out", "b", "--set", "slope.angle=50 deg")
        before = tree(self.folder)
        said = self.talus("compare", "a", "b").stdout
        self.assertEqual(tree(self.folder), before)
        self.assertIn('slope.angle: "45 deg"   |   "50 deg"', said)
        self.assertIn("front_speed_max", said)
        self.assertNotIn("Picture", said)
        self.assertIn("Picture: both.png", self.talus("compare", "a", "b", "--picture", "both.png").stdout)
        self.assertEqual((self.folder / "both.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(set(tree(self.folder)) - set(before), {"both.png"})


if __name__ == "__main__":
    unittest.main()
