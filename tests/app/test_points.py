# SPDX-License-Identifier: Apache-2.0
"""What the file of a cloud's places may say."""
import unittest

from program import CASE, ProgramTest, tree

POINTS = CASE.replace("seed = 3\n", "").replace(
    'shape = "circle"\ncount = 60\nsize = "60 mm"', 'shape = "file"\nfile = "points.csv"')


class Points(ProgramTest):
    def test_a_cloud_takes_no_velocities(self):
        (self.folder / "case.toml").write_text(POINTS)
        (self.folder / "points.csv").write_text("x [m],y [m],vx [m/s],velocity_y [m/s]\n0,0,1,0\n0.02,0,1,0\n")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("has a column vx: a cloud has no inertia", said)
        self.assertIn("has a column velocity_y: a cloud has no inertia", said)
        self.assertEqual(tree(self.folder), before)


if __name__ == "__main__":
    unittest.main()
