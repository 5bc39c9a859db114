# SPDX-License-Identifier: Apache-2.0
"""A vessel from an STL file, as a user gives it: a sound one runs, of a faulty one every triangle is named."""
import csv
import json
import math
import unittest

import h5py

from program import ProgramTest

CASE = """
model = "continuum"
[box]
width = "60 mm"
depth = "60 mm"
height = "60 mm"
[[vessel]]
name = "drawn"
shape = "stl"
file = "wall.stl"
unit = "mm"
[[vessel]]
name = "lid"
shape = "disc"
radius = "20 mm"
height = "10 mm"
centre = ["30 mm", "30 mm"]
gate = true
[gate]
opens = "from-the-start"
[grains]
density = "2500 kg/m3"
diameter = "200 um"
[bed]
packing = 0.6
spacing = "5 mm"
height = "20 mm"
[law]
name = "critical-state"
[collisions]
form = "none"
[run]
end = "0.2 ms"
[output]
report = false
"""


def round_wall(sides=24):
    """An upright cylinder, as triangles. mm."""
    def corner(k, z):
        return 30 + 20 * math.cos(2 * math.pi * k / sides), 30 + 20 * math.sin(2 * math.pi * k / sides), z

    triangles = []
    for k in range(sides):
        a, b, c, d = corner(k, 10), corner(k + 1, 10), corner(k + 1, 50), corner(k, 50)
        triangles += [(a, c, b), (a, d, c)]
    return triangles


def ascii_stl(triangles):
    facets = "".join("facet normal 0 0 0\nouter loop\n" + "".join("vertex %.6f %.6f %.6f\n" % corner for corner in triangle)
                     + "endloop\nendfacet\n" for triangle in triangles)
    return f"solid wall\n{facets}endsolid wall\n"


class DrawnVessel(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(CASE)

    def test_a_sound_one_runs(self):
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        self.talus("run", "case.toml", "--out", "run")
        columns = (self.folder / "run/series.csv").read_text().splitlines()[0]
        for name in ("impulse_drawn_x", "impulse_drawn_y", "impulse_drawn_z", "impulse_lid_z"):
            self.assertIn(name, columns)

    def test_loads_and_fields_are_files(self):
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        self.talus("run", "case.toml", "--set", "gate.opens=at-time", "--set", "gate.time=25 ms", "--set", "run.end=30 ms",
                   "--set", "output.snapshots=5 ms", "--set", "output.pictures=true", "--out", "run")
        run = self.folder / "run"
        with open(run / "analysis/wall_loads.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual([float(row["patch [1]"]) for row in rows], [1, 1, 2], "40 mm of wall are two bands of four spacings")
        self.assertAlmostEqual(sum(float(row["area [m2]"]) for row in rows[:2]), 24 * 0.04 * 0.04 * math.sin(math.pi / 24), 9)
        series = (run / "series.csv").read_text().splitlines()
        self.assertIn("shear_impulse_drawn.2 [N s]", series[0])
        self.assertNotIn("shear_impulse_lid", series[0], "it is level")
        with h5py.File(sorted((run / "snapshots").glob("walls_*.vtkhdf"))[-1]) as file:
            cells = file["VTKHDF/CellData"]
            self.assertEqual(len(cells["pressure_largest"]), int(file["VTKHDF/NumberOfCells"][0]))
            lid = cells["patch"][()] == 1
            weight = 0.6 * 2500 * 9.81 * 0.02
            self.assertAlmostEqual(cells["pressure_at_rest"][()][lid].mean() / weight, 1, delta=0.5)
            self.assertEqual(cells["pressure"][()][lid].max(), 0, "it is open")
        with h5py.File(run / "analysis/fields.vtkhdf") as file:
            self.assertGreater(file["VTKHDF/PointData/packing"][()].max(), 0.3)
        for picture in ("wall_loads", "fields"):
            self.assertTrue((run / f"pictures/{picture}.png").exists(), picture)
        summary = json.loads((run / "summary.json").read_text())["quantities"]
        self.assertIn("discharge_steady", summary)
        self.assertIn("share_that_moves", summary)

    def test_of_a_faulty_one_every_triangle_is_named(self):
        triangles = round_wall()
        triangles[7] = (triangles[7][0], triangles[7][2], triangles[7][1])
        triangles[11] = (triangles[11][0], triangles[11][0], triangles[11][2])
        (self.folder / "wall.stl").write_text(ascii_stl(triangles))
        said = self.talus("run", "case.toml", "--out", "run", status=2).stderr
        self.assertRegex(said, r"case\.toml:\d+: vessel\.1\.file: wall\.stl: triangle 12 at .* mm: has no area")
        self.assertRegex(said, r"triangle 7 and triangle 8 at .* mm: their normals are on different sides")
        self.assertFalse((self.folder / "run").exists())

    def test_a_file_that_is_none_is_refused(self):
        (self.folder / "wall.stl").write_bytes(b"solid wall\nfacet normal 0 0 0\nouter loop\nvertex 1 2\n")
        said = self.talus("check", "case.toml", status=2).stderr
        self.assertIn("wall.stl", said)


if __name__ == "__main__":
    unittest.main()
