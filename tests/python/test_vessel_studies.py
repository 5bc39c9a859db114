# SPDX-License-Identifier: Apache-2.0
"""The studies of vessels measure what they say, on numbers made up for it.

Usage: test_vessel_studies.py TALUS
"""
import contextlib
import io
import pathlib
import shutil
import sys
import tempfile
import unittest
from unittest import mock

PROGRAM = sys.argv.pop()

import numpy as np  # noqa: E402

VALIDATION = pathlib.Path(__file__).resolve().parents[2] / "validation"
sys.path[:0] = [str(VALIDATION), *(str(VALIDATION / name) for name in ("orifice", "drum", "long-runs", "materials"))]
import beads  # noqa: E402
import drum  # noqa: E402
import long_runs  # noqa: E402
import materials  # noqa: E402
import orifice  # noqa: E402
import study  # noqa: E402
import talus  # noqa: E402


class Page(unittest.TestCase):
    def test_rows_of_cases_without_a_run_are_left_out_and_named(self):
        def row(case, verdict):
            return {"number": 1, "case": case, "variants": ["vacuum"], "quantity": "rate", "statistic": "", "printed": "2",
                    "source": "text", "criterion": "2 +- 1", "values": [2.0], "verdicts": [verdict], "verdict": verdict}

        run = mock.MagicMock()
        run.manifest = {"version": "1", "revision": "2", "machine": {"processor": "3"}}
        run.summary = {"steps": 1, "cpu_seconds": 1.0, "wall_seconds": 1.0}
        run.series = {"time": [1.0]}
        run.air = []
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            found = study.Study(pathlib.Path(folder), "name", "Title", "Source",
                                [row("hopper", "met"), row("section", "not evaluated")],
                                [study.Ensemble("hopper", "vacuum", [run])])
            study.write_page(found, study.Album(pathlib.Path(folder)), page, VALIDATION / "study.py")
            text = page.read_text(encoding="utf-8")
        self.assertIn("1 met, 0 not met, 0 reported, 1 not evaluated", text)
        self.assertIn("| hopper (vacuum) |", text)
        self.assertNotIn("| section (vacuum) |", text)
        self.assertIn("Left out: rows of `section`", text)


class Drum(unittest.TestCase):
    def test_the_surface_of_a_lattice_has_the_angle_and_the_level_that_it_was_cut_at(self):
        spacing = 2e-3
        for degrees in (-31.0, 27.0):
            n = np.arange(-60, 61) * spacing
            along, across = (0.5 * spacing + part.ravel() for part in np.meshgrid(n, n))
            keep = across < -0.03
            lattice = np.stack([along[keep], across[keep]], axis=1)
            x = drum.turned(lattice, -np.radians(degrees))
            angle, level = drum.surface_of(x, spacing, np.radians(degrees + 5))
            self.assertAlmostEqual(np.degrees(angle), degrees, delta=0.1)
            self.assertAlmostEqual(level, -0.03, delta=0.5 * spacing)


class Orifice(unittest.TestCase):
    def test_beverloos_law_has_its_exponent_and_its_constant(self):
        diameter = np.array([0.03, 0.034, 0.039, 0.045])
        rate = 0.6 * orifice.DENSITY * orifice.GRAVITY ** 0.5 * (diameter - orifice.K * orifice.GRAIN) ** 2.5
        self.assertAlmostEqual(orifice.exponent(rate, diameter), 2.5)
        np.testing.assert_allclose(orifice.constants(rate, diameter), 0.6)
        self.assertAlmostEqual(orifice.lost(rate, diameter), orifice.K * orifice.GRAIN)


class Materials(unittest.TestCase):
    SPACING = 3e-3

    def cone(self, degrees, height=0.036):
        n = np.arange(-60, 60) * self.SPACING
        x = np.stack([part.ravel() + 0.5 * self.SPACING for part in np.meshgrid(n, n, n[60:])], axis=1)
        return x[x[:, 2] + 0.5 * self.SPACING < height - np.hypot(x[:, 0], x[:, 1]) * np.tan(np.radians(degrees))]

    def test_a_heap_has_the_slope_that_it_was_cut_at(self):
        for degrees in (21.0, 34.0):
            angle, by_foot, on = materials.slope_of_heap(self.cone(degrees), self.SPACING)
            self.assertAlmostEqual(angle, degrees, delta=1.5)
            self.assertAlmostEqual(by_foot, degrees, delta=2.5)
            self.assertAlmostEqual(materials.slope_of_mean(self.cone(degrees)), degrees, delta=0.4)
            self.assertTrue(on.all())

    def test_what_has_left_the_deposit_is_stray_and_does_not_count_for_its_foot(self):
        cone = self.cone(25, 0.03)
        foot, height, on = materials.round_deposit(np.vstack([cone, [[0.2, 0, 0.001], [0, -0.3, 0.001]]]), self.SPACING, 0.06)
        self.assertEqual((~on).sum(), 2)
        x = np.vstack([cone, [[0.2, 0, 0.001], [0, -0.3, 0.001]]])
        velocity = np.zeros_like(x)
        velocity[0] = [0, 0.02, 0]
        self.assertAlmostEqual(materials.stray_share(x, velocity, on, self.SPACING), 3 / len(x))
        self.assertAlmostEqual(foot, 0.03 / np.tan(np.radians(25)), delta=2 * self.SPACING)  # the lattice's last layer
        self.assertAlmostEqual(height, 0.03, delta=self.SPACING)

    def test_a_column_of_beads_is_measured_as_one_of_the_law(self):
        n = np.arange(-40, 40) * beads.DIAMETER
        x = np.stack([part.ravel() + 0.5 * beads.DIAMETER for part in np.meshgrid(n, n, n[40:])], axis=1)
        radius, distance = 18 * beads.DIAMETER, np.hypot(x[:, 0], x[:, 1])

        def frame(x):
            return np.full(len(x), 0.5 * beads.DIAMETER), x, np.zeros_like(x)

        first = frame(x[(distance < radius) & (x[:, 2] < radius)])
        cone = x[x[:, 2] + 0.5 * beads.DIAMETER < 0.7 * radius - distance * np.tan(np.radians(20))]
        numbers = beads.measure(first, frame(np.vstack([cone, [[1.5 * radius + 0.1, 0, 0.0006]]])), radius)
        self.assertEqual(numbers["beads"], len(first[0]))
        self.assertAlmostEqual(numbers["aspect"], 1, delta=1e-9)
        self.assertAlmostEqual(numbers["packing"], np.pi / 6, delta=0.01)
        self.assertAlmostEqual(numbers["height"], 0.7, delta=1 / 18)
        self.assertAlmostEqual(numbers["runout"], 0.7 / np.tan(np.radians(20)) - 1, delta=3 / 18)
        self.assertLess(numbers["runout_99"], numbers["runout"])
        self.assertAlmostEqual(numbers["stray"], 1 / (len(cone) + 1))

    def test_numbers_of_small_beads_are_where_a_line_leads(self):
        rows = [{"radius": str(radius), "height": str(0.7 + 0.9 / radius + off)}
                for radius, off in ((9, 0.01), (9, -0.01), (12, 0.01), (12, -0.01), (18, 0))]
        value, error = beads.for_small_beads(rows, "height")
        self.assertAlmostEqual(value, 0.7, delta=1e-9)
        self.assertTrue(0.01 < error < 0.04, error)

    @unittest.skipUnless(shutil.which("lmp"), "LAMMPS is not installed")
    def test_a_small_column_of_beads_runs_and_is_measured(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.object(beads, "TABLE", pathlib.Path(folder) / "beads.csv"):
            options = mock.MagicMock(folder=pathlib.Path(folder), rolling=[0.1], radius=5, floor="bumps", settled_with=0.15,
                                     seed=1)
            beads.run(options)
            beads.measure_all(options)
            told = io.StringIO()
            with contextlib.redirect_stdout(told):
                beads.table(options)
        row = dict(zip(beads.COLUMNS, told.getvalue().splitlines()[2].strip("| ").split(" | ")))
        self.assertEqual(row["floor"], "bumps")
        self.assertAlmostEqual(float(row["aspect"]), 1, delta=0.1)
        self.assertTrue(0.5 < float(row["packing"]) < 0.65, row["packing"])
        self.assertTrue(0.4 < float(row["height"].strip("*")) < 0.9, row["height"])

    def test_every_material_that_does_not_stick_has_its_bands(self):
        files = {path.stem for path in (VALIDATION.parent / "materials").glob("*.toml")
                 if "consolidation_strength]" not in path.read_text(encoding="utf-8")}
        self.assertEqual(set(materials.MATERIALS), files)
        for material in files:
            for kind, ratio, _, settings in materials.runs_of(material):
                self.assertEqual(settings["grains.material"], material)
                if kind in ("column", "channel"):
                    self.assertIn(f"{material} {kind}-runout-{ratio:g}", materials.ROWS)
                    self.assertIn(f"{material} {kind}-height-{ratio:g}", materials.ROWS)
            self.assertIn(f"{material} heap", materials.ROWS)
        row = materials.ROWS["sand heap"]
        self.assertTrue(study.is_met(row, 31.1) and study.is_met(row, 35.9))
        self.assertFalse(study.is_met(row, 30.9) or study.is_met(row, 36.1))

    def test_a_small_column_runs_and_is_measured(self):
        with tempfile.TemporaryDirectory() as folder, mock.patch.dict(materials.SETUP["spacing"]["column"], {"0.55": 12}):
            kind, ratio, name, settings = next(r for r in materials.runs_of("sand") if r[:2] == ("column", 0.55))
            run = talus.simulate(VALIDATION / "materials" / f"{kind}.toml", pathlib.Path(folder) / name,
                                 settings | {"run.end": "20 ms", "output.snapshots": "20 ms"}, threads=1, program=PROGRAM)
            numbers, (of, distance, height) = materials.measure_run(run, kind, ratio)
        self.assertEqual(set(numbers), {"column-runout-0.55", "column-height-0.55", "stray"})
        self.assertAlmostEqual(numbers["column-height-0.55"], 0.6, delta=0.05)  # three layers of 12 mm
        self.assertAlmostEqual(numbers["column-runout-0.55"], 0, delta=0.25)
        self.assertGreater(numbers["stray"], 0.3)  # it still falls
        self.assertEqual(of, 0.55)


class LongRuns(unittest.TestCase):
    # Places in mm: one that a particle may have, and one behind a wall.
    PLACES = {"silo-cone": ((50, 50, 61), (50, 66, 61)), "silo-square": ((74, 46, 120), (45, 76, 120)),
              "hourglass": ((50, 50, 65), (67, 50, 65)), "drum": ((55, 17, 6), (55, 4, 20)),
              "chute-bend": ((80, 5, 181), (200, 5, 80)), "wedge-hopper": ((59, 1, 60.5), (62, 1, 61))}

    def test_what_is_behind_a_wall_is_outside(self):
        self.assertEqual(set(self.PLACES), set(long_runs.CASES))
        for case, places in self.PLACES.items():
            with self.subTest(case):
                self.assertEqual(long_runs.outside(case, np.array(places, dtype=float), 0.1).tolist(), [False, True])

    def test_what_has_fallen_out_is_not(self):
        for case in ("silo-cone", "silo-square", "wedge-hopper"):
            self.assertFalse(long_runs.outside(case, np.array([[95.0, 1, 5]]), 0.1).any())


class Comparison(unittest.TestCase):
    REFERENCE = {"row": {"says": "what", "value": 1.0, "tolerance": 0.1}}

    def compared(self, value):
        with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()) as said:
            told = pathlib.Path(folder) / "table.md"
            with mock.patch("sys.argv", ["study.py", "--markdown", str(told)]):
                status = study.compare("study.py", "", folder, self.REFERENCE, lambda options: [],
                                       lambda options: ({"row": value}, None),
                                       lambda numbers, found: study.table_of_numbers(self.REFERENCE, numbers), None)
            self.assertEqual(told.read_text(encoding="utf-8"), said.getvalue())
        return status, said.getvalue()

    def test_a_row_within_its_tolerance_is_met(self):
        status, said = self.compared(1.09)
        self.assertEqual(status, 0)
        self.assertIn("| what | 1.090 | 1 ± 0.1 | met |", said)

    def test_a_row_outside_of_it_fails_the_study(self):
        status, said = self.compared(1.11)
        self.assertEqual(status, 1)
        self.assertIn("**not met**", said)


if __name__ == "__main__":
    unittest.main()
