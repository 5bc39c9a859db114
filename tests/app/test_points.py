# SPDX-License-Identifier: Apache-2.0
"""What the file of a cloud's places may say."""
import unittest

import h5py

from program import CASE, ProgramTest, tree

POINTS = CASE.replace("seed = 3\n", "").replace(
    'shape = "circle"\ncount = 60\nsize = "60 mm"', 'shape = "file"\nfile = "points.csv"')


class Points(ProgramTest):
    def test_a_cloud_takes_no_velocities(self):
        (self.folder / "case.toml").write_text(POINTS)
        (self.folder / "points.csv").write_text("x [m],y [m],vx [m/s],velocity_y [m/s]\n0,0,1,0\n0.02,0,1,0\n")
        before = tree(self.folder)
        said = self.talus("run", "case.toml", "--out", "r", status=2).stderr
        self.assertIn("points.csv:1: vx: a cloud has no inertia", said)
        self.assertIn("points.csv:1: velocity_y: a cloud has no inertia", said)
        self.assertEqual(tree(self.folder), before)

    def write(self, points):
        (self.folder / "case.toml").write_text(POINTS.replace('"xy"', '"xyz"').replace(
            "[slope]\nangle = \"45 deg\"", "[slope]\nenabled = false"))
        (self.folder / "points.csv").write_text(points)

    def test_an_angle_beside_a_direction_of_gravity_is_not_used(self):
        said = self.talus("check", "case.toml", "--set", "slope.angle=30 deg", "--set", "gravity.direction=[1, 0, -1]").stdout
        self.assertIn("slope.angle: is not used", said)

    def test_radii_by_their_usual_names(self):
        """From a file of another program: columns id and r, no units."""
        for points, radii in (("id,x,y,z,r\n1,0,0,0,0.002\n2,0.008,0,0,0.003\n", [0.002, 0.003]),
                              ("x [mm],diameter [mm]\n0,4\n8,6\n", [0.002, 0.003]),
                              ("x,y\n0,0\n0.012,0\n", [0.005, 0.005])):
            self.write(points)
            said = self.talus("check", "case.toml").stdout
            self.assertIn("particles.file: 2 grains; " + ("radii from 2 to 3 mm" if "2" in str(radii) else
                                                         "no column radius: all have particles.radius, 5 mm"), said)
            self.assertEqual("the column id is not used" in said, points.startswith("id"))
            self.talus("run", "case.toml", "--out", "r", "--overwrite")
            with h5py.File(self.folder / "r/snapshots/particles_0000.vtkhdf") as file:
                self.assertEqual(list(file["VTKHDF/PointData/radius"][:]), radii)

    def test_nothing_is_ignored(self):
        self.write("id,x,y,z,rad,colour\n1,0,0,0,1,1\n")
        said = self.talus("check", "case.toml", status=2).stderr
        self.assertIn("points.csv:1: rad: unknown column; allowed: x, y, z, radius, id, r, diameter; did you mean "
                      "'radius'?", said)
        self.assertIn("points.csv:1: colour: unknown column", said)

    def test_numbers_without_a_unit_that_are_of_another(self):
        for points, what in (("x,r\n0,2\n8,3\n", "radius without a unit: as metres, a mean of 500 times particles.radius"),
                             ("x,y\n0,0\n12,0\n0,12\n", "coordinates without a unit: as metres, some 1.39e+03 radii")):
            self.write(points)
            said = self.talus("check", "case.toml", status=2).stderr
            self.assertIn("case.toml:5: particles.file: " + what, said)
            self.assertIn("[mm]", said)
        self.write("x [m],y [m]\n0,0\n12,0\n0,12\n")
        self.talus("check", "case.toml")


if __name__ == "__main__":
    unittest.main()
