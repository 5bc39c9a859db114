# SPDX-License-Identifier: Apache-2.0
"""Curves as files: those that commands of the program draw with talus.charts, and what they show.

Usage: test_charts.py TALUS
"""
import json
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop()).resolve()
PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]

import matplotlib  # noqa: E402
matplotlib.use("Agg")
import numpy as np  # noqa: E402
from matplotlib import pyplot  # noqa: E402

from talus import Table, charts  # noqa: E402
from talus.program import Sweep  # noqa: E402

CLOUD = (PROJECT / "cases/niiya2020-circle.toml", "--set", "particles.count=40", "--set", 'particles.size="50 mm"', "--set",
         'run.end="0.6 ms"')


class ChartTest(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="talus-charts-"))
        self.addCleanup(shutil.rmtree, self.folder)
        self.addCleanup(pyplot.close, "all")

    def talus(self, *arguments, **options):
        done = subprocess.run([PROGRAM, *map(str, arguments)], cwd=self.folder, capture_output=True, text=True, check=True,
                              **options)
        return done.stdout

    def assert_png(self, path):
        self.assertEqual((self.folder / path).read_bytes()[:4], b"\x89PNG", path)


class OfCommands(ChartTest):
    def test_an_ensemble(self):
        command = ("ensemble", *CLOUD, "--members", 5, "--vary", "slope.angle=30 deg,50 deg", "--out", "e")
        said = self.talus(*command)
        self.assertIn("Picture: e/sweep.png", said)
        for group in ("angle=30deg", "angle=50deg"):
            for name in ("bands_front_speed", "histograms"):
                self.assert_png(f"e/{group}/pictures/{name}.png")
        samples = charts._samples(self.folder / "e/angle=30deg")
        self.assertEqual(len(samples["front speed max"]), 5)
        self.assertNotIn("step size (s)", samples)
        before = (self.folder / "e/sweep.png").read_bytes()
        self.talus(*command, "--gather", "--plot", "front_speed_max")
        self.assertNotEqual((self.folder / "e/sweep.png").read_bytes(), before)
        self.assertNotIn("Picture", self.talus(*command, "--gather", "--set", "output.pictures=false"))
        (self.folder / "sitecustomize.py").write_text("import sys\nsys.modules['matplotlib'] = None\n")
        said = self.talus(*command, "--gather", env={**os.environ, "PYTHONPATH": str(self.folder)})
        self.assertIn("python3-matplotlib", said)

    def test_two_runs_and_one(self):
        for name, seed in (("a", 1), ("b", 2)):
            self.talus("run", *CLOUD, "--set", f"seed={seed}", "--set", "output.pictures=false", "--out", name)
        self.assertIn("Picture: both.png", self.talus("compare", "a", "b", "--picture", "both.png"))
        self.assert_png("both.png")
        drawn = charts.run(self.folder / "a", self.folder / "curves")
        self.assertEqual([path.name for path in drawn], ["front_speed.png"])

    def test_a_law_and_its_functions(self):
        said = self.talus("law", PROJECT / "cases/law/yuu2011.toml", "--path", PROJECT / "cases/law/shear.csv", "--set",
                          "law.yuu-umekage.tables=repaired", "--out", "l")
        self.assertIn("path.csv, functions.csv, path.png, functions.png", said)
        self.assert_png("l/path.png")
        self.assert_png("l/functions.png")
        functions = Table(self.folder / "l/functions.csv")
        self.assertEqual(len(functions), 501)
        strain = functions["strain"]
        self.assertAlmostEqual(strain[0], 1e-6, delta=1e-18)
        np.testing.assert_allclose(functions["friction_printed"], functions["A4_printed"] * strain / np.sqrt(2), rtol=1e-12)
        self.assertTrue((functions["pressure_repaired"] != functions["pressure_printed"]).any())


class OfTables(ChartTest):
    def sweep(self, groups):
        """Of (settings by key as (text, value or None, unit), quantities by name) of each group."""
        entries = []
        for n, (settings, quantities) in enumerate(groups):
            entry = {"group": f"g{n}", "settings": {}, "quantities": {}}
            for key, (text, value, unit) in settings.items():
                entry["settings"][key] = {"text": text} | ({} if value is None else {"value": value, "unit": unit})
            for name, mean in quantities.items():
                entry["quantities"][name] = {"mean": mean, "members": 1, "unit": "1"}
            entries.append(entry)
        (self.folder / "sweep.json").write_text(json.dumps(entries))
        return Sweep(self.folder)

    def test_a_sweep_is_drawn_in_the_unit_of_its_first_value(self):
        of = self.sweep([({"particles.radius": ("5 mm", 5e-3, "m"), "motion": ("xy", None, "")}, {"q": 1.0}),
                         ({"particles.radius": ("1 cm", 1e-2, "m"), "motion": ("xz", None, "")}, {"q": 2.0})])
        values, label, lines = charts._across(of)
        np.testing.assert_allclose(values, [5, 10], rtol=1e-14)
        self.assertEqual(label, "particles.radius (mm)")
        self.assertEqual(lines, ["motion = xy", "motion = xz"])

    def test_keys_without_numbers_are_drawn_by_the_numbers_of_the_groups(self):
        of = self.sweep([({"method": ("euler", None, "")}, {"q": 1.0}), ({"method": ("chebyshev", None, "")}, {"q": 2.0})])
        values, label, lines = charts._across(of)
        self.assertEqual((values.tolist(), label, lines), ([1, 2], "1: g0, 2: g1", ["", ""]))

    def test_only_what_differs_is_drawn(self):
        self.sweep([({"k": ("1", 1.0, "")}, {"same": 3.0}), ({"k": ("2", 2.0, "")}, {"same": 3.0 * (1 + 1e-14)})])
        self.assertEqual(charts.sweep(self.folder), [])
        self.assertEqual(charts.sweep(self.folder, ["same"]), [self.folder / "sweep.png"], "unless it is asked for")

    def test_wall_loads_by_patch_against_height(self):
        columns = ("patch [1]", "low [m]", "high [m]", "pressure_at_rest [Pa]", "pressure_at_rest_by_hand [Pa]",
                   "pressure_in_flow [Pa]", "pressure_in_flow_by_hand [Pa]", "pressure_largest [Pa]",
                   "en_pressure_filling [Pa]")
        rows = ((1, 0.1, 0.2, 20, 21, 10, 11, 30, 25), (1, 0, 0.1, 40, 41, 30, 31, 50, 55),
                (2, 0.2, 0.3, 5, 6, 4, "nan", 7, "nan"), (3, 0, 0, 90, 91, 92, 93, 94, 95))
        path = self.folder / "wall_loads.csv"
        path.write_text("".join(",".join(map(str, row)) + "\n" for row in (columns, *rows)))
        _, ax = pyplot.subplots()
        charts.wall_loads(ax, Table(path))
        at_rest = [line for line in ax.lines if line.get_marker() == "o" and line.get_color() == "C0"]
        self.assertEqual([line.get_xdata().tolist() for line in at_rest], [[40, 20], [5]], "floors have no height")
        np.testing.assert_allclose(at_rest[0].get_ydata(), [50, 150], rtol=1e-14)
        self.assertEqual([text.get_text() for text in ax.get_legend().get_texts()].count("at rest"), 1)
        of_code = [line for line in ax.lines if line.get_label() == "EN 1991-4, filling"]
        self.assertEqual([line.get_xdata().tolist() for line in of_code], [[55, 25]], "where the code has a formula")

    def test_a_histogram_has_unit_area(self):
        _, ax = pyplot.subplots()
        charts.histogram(ax, np.array([1.0, 2, 2, 3, 5]), "x")
        self.assertAlmostEqual(sum(bar.get_width() * bar.get_height() for bar in ax.patches), 1, places=12)
        self.assertAlmostEqual(ax.lines[0].get_xdata().mean(), 2.6, places=12)


if __name__ == "__main__":
    unittest.main()
