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
        self.assertTrue((run / "pictures/fields.png").exists())
        summary = json.loads((run / "summary.json").read_text())["quantities"]
        self.assertIn("discharge_steady", summary)
        self.assertIn("share_that_moves", summary)

    def test_of_a_faulty_one_every_triangle_is_named(self):
        triangles = round_wall()
        triangles[7] = (triangles[7][0], triangles[7][2], triangles[7][1])
        triangles[11] = (triangles[11][0], triangles[11][0], triangles[11][2])
        (self.folder / "wall.stl").write_text(ascii_stl(triangles))
        said = self.talus("run", "case.toml", "--set", "vessel.1.closed=true", "--out", "run", status=2).stderr
        self.assertRegex(said, r"case\.toml:\d+: vessel\.1\.file: wall\.stl: triangle 1 at .* mm: no triangle joins it")
        self.assertIn("more such faults", said)
        self.assertFalse((self.folder / "run").exists())

    def test_what_is_harmless_is_mended(self):
        triangles = round_wall()
        triangles[7] = (triangles[7][0], triangles[7][2], triangles[7][1])
        triangles.append(triangles[3])
        (self.folder / "wall.stl").write_text(ascii_stl(triangles))
        said = " ".join(self.talus("check", "case.toml").stdout.split())
        self.assertIn("vessel.1.file: wall.stl: 1 of 49 triangles turned over, triangle 8 the first", said)
        self.assertIn("vessel.1.file: wall.stl: 1 of 49 triangles that are there twice left out, triangle 49 the first", said)
        self.talus("run", "case.toml", "--out", "run")
        self.assertIn("vessel.1.file: wall.stl: 1 of 49", (self.folder / "run/log.txt").read_text())
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        self.talus("run", "case.toml", "--out", "sound")
        self.assertEqual(*((self.folder / name / "series.csv").read_bytes() for name in ("run", "sound")))

    def test_one_drawn_elsewhere_is_placed_by_keys(self):
        """About its origin, in m, y upwards: as it is it is refused; with four keys it is the same wall."""
        drawn = [tuple((1e-3 * (x - 30), 1e-3 * z, -1e-3 * (y - 30)) for x, y, z in triangle) for triangle in round_wall()]
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        expected = self.talus("check", "case.toml").stdout
        (self.folder / "wall.stl").write_text(ascii_stl(drawn))
        said = self.talus("run", "case.toml", "--out", "run", status=2).stderr
        self.assertIn("drawn spans", said)
        self.assertIn('allowed: unit = "m" and move = ["30 mm", ', said)
        self.assertEqual(said.count("case.toml:"), 1, "one problem, and nothing of what follows from it")
        found = self.talus("check", "case.toml", "--set", "vessel.1.unit=m", "--set", "vessel.1.up=y", "--set",
                           'vessel.1.move=["30 mm", "30 mm", "0 mm"]').stdout
        for name in ("particles", "mass"):
            line = next(line for line in expected.splitlines() if line.startswith(f"  {name} "))
            self.assertIn(line, found)

    def test_a_hole_is_found_before_the_run(self):
        triangles = round_wall()
        del triangles[12:16]
        (self.folder / "wall.stl").write_text(ascii_stl(triangles))
        said = " ".join(self.talus("check", "case.toml", "--set", "bed.spacing=2.5 mm").stdout.split())
        self.assertRegex(said, r"! rim of drawn below the top of the bed = [0-9.]+ x [0-9.]+ mm at \([0-9., ]+\) mm:")
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        self.assertNotIn("rim of", self.talus("check", "case.toml", "--set", "bed.spacing=2.5 mm").stdout)

    def test_several_outlets_have_a_row_each(self):
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        case = CASE.replace("[gate]", """[[vessel]]
name = "second"
shape = "plate"
corner = ["52 mm", "20 mm", "12 mm"]
first_edge = ["6 mm", "0 mm", "0 mm"]
second_edge = ["0 mm", "20 mm", "0 mm"]
gate = true
[gate]""", 1)
        (self.folder / "case.toml").write_text(case)
        said = " ".join(self.talus("check", "case.toml").stdout.split())
        for text in ("particles across the outlet second = 1.2", "particles across the outlet lid = 7.95",
                     "discharge_by_hand_second", "slit_over_spacing_second 1.2"):
            self.assertIn(text, said)
        self.talus("run", "case.toml", "--out", "run")
        self.assertIn("discharge_rate_second [kg/s]", (self.folder / "run/series.csv").read_text().splitlines()[0])
        quantities = json.loads((self.folder / "run/summary.json").read_text())["quantities"]
        for name in ("discharged_mass_lid", "discharge_rate_beverloo_second", "particles_across_second", "grains_across_lid"):
            self.assertIn(name, quantities)

    def test_a_gate_that_closes_ends_the_flow_and_says_so(self):
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        closing = CASE.replace('gate = true', 'gate = true\ncloses_after = "30 ms"')
        (self.folder / "case.toml").write_text(closing)
        self.talus("run", "case.toml", "--out", "run", "--set", 'run.end="70 ms"', "--set", 'output.series="1 ms"')
        summary = json.loads((self.folder / "run/summary.json").read_text())
        flow = next(result["value"] for result in summary["key_results"] if result["title"] == "Flow")
        self.assertTrue(flow.startswith("was shut after 30 ms: "), flow)
        (self.folder / "case.toml").write_text(CASE.replace("gate = true", 'gate = true\nopens_after = "5 s"'))
        said = self.talus("check", "case.toml", "--set", 'run.end="70 ms"').stdout
        self.assertIn("! opening of the first gate = 5 s: none opens before run.end, 0.07 s", " ".join(said.split()))
        for keys, text in (('opens_after = "40 ms"\ncloses_after = "30 ms"',
                            "vessel.2.closes_after: 0.03 s is not after opens_after; allowed: above 0.04 s"),
                           ('repeats_every = "30 ms"', "vessel.2.repeats_every: given, but the gate does not close"),
                           ('closes_after = "30 ms"\nrepeats_every = "30 ms"', "vessel.2.repeats_every: is not longer")):
            (self.folder / "case.toml").write_text(CASE.replace("gate = true", "gate = true\n" + keys))
            self.assertIn(text, self.talus("run", "case.toml", "--out", "other", status=2).stderr)

    def test_a_changed_file_is_not_resumed(self):
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()))
        given = ("run", "case.toml", "--out", "run", "--set", "sph.viscosity_alpha=0.05")  # left out, it follows from the bed
        self.talus(*given)
        (self.folder / "wall.stl").write_text(ascii_stl(round_wall()[::-1]))
        self.assertIn("vessel.1.file: its points are not those that the run there began with",
                      self.talus(*given, "--resume", status=2).stderr)

    def test_a_file_that_is_none_is_refused(self):
        (self.folder / "wall.stl").write_bytes(b"solid wall\nfacet normal 0 0 0\nouter loop\nvertex 1 2\n")
        said = self.talus("check", "case.toml", status=2).stderr
        self.assertIn("wall.stl", said)


if __name__ == "__main__":
    unittest.main()
