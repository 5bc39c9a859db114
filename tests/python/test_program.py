# SPDX-License-Identifier: Apache-2.0
"""What python/talus does with the program: runs, sweeps, comparisons, pandas and xarray, and the examples.

Usage: test_program.py TALUS
"""
import importlib.util
import math
import os
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop()).resolve()
PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "python"))
os.environ["TALUS"] = str(PROGRAM)

import numpy as np  # noqa: E402
import talus  # noqa: E402

HAS_TABLES = all(importlib.util.find_spec(name) for name in ("pandas", "xarray"))
SHORT = {"run.end": "0.2 ms", "output.pictures": False, "output.report": False}


class Scratch(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="talus-program-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder, ignore_errors=True)
        cls.case = talus.new("avalanche", cls.folder / "case.toml", grains=60)


class Simulate(Scratch):
    def test_a_run_with_settings(self):
        run = talus.simulate(self.case, self.folder / "a", SHORT | {"slope.angle": talus.Value(30, "deg")}, threads=1)
        self.assertEqual(run.status, "done")
        self.assertEqual((float(run.case["slope"]["angle"]), run.case["slope"]["angle"].units), (30, "deg"))
        self.assertAlmostEqual(float(run.series["time"][-1]), 2e-4, delta=2e-5)
        with self.assertRaisesRegex(talus.ProgramError, "holds a run already") as caught:
            talus.simulate(self.case, self.folder / "a", SHORT)
        self.assertEqual(caught.exception.status, 2)
        rows = len(run.series)
        with self.assertRaisesRegex(talus.ProgramError, "in the run there"):
            talus.simulate(self.case, self.folder / "a", SHORT, existing="resume")
        same = SHORT | {"slope.angle": "30 deg"}
        self.assertEqual(len(talus.simulate(self.case, self.folder / "a", same, existing="resume").series), rows)
        longer = talus.simulate(self.case, self.folder / "a", same | {"run.end": "0.4 ms"}, existing="resume")
        self.assertGreater(len(longer.series), rows)
        again = talus.simulate(self.case, self.folder / "a", SHORT, existing="overwrite")
        self.assertEqual(float(again.case["slope"]["angle"]), 45)
        self.assertEqual(talus.simulate(self.case, self.folder / "new", SHORT, existing="resume").status, "done")
        with self.assertRaises(ValueError):
            talus.simulate(self.case, self.folder / "a", existing="replace")

    def test_what_is_wrong_is_raised_with_the_programs_words(self):
        with self.assertRaisesRegex(talus.ProgramError, "did you mean 'slope.angle'"):
            talus.simulate(self.case, self.folder / "b", {"slope.angel": "30 deg"})
        self.assertFalse((self.folder / "b").exists())
        with self.assertRaisesRegex(talus.ProgramError, "--grains"):
            talus.new("avalanche", self.folder / "c.toml", grains="many")
        with self.assertRaisesRegex(talus.ProgramError, "already"):
            talus.new("avalanche", self.case)

    def test_comparison(self):
        a = talus.simulate(self.case, self.folder / "x", SHORT)
        b = talus.simulate(self.case, self.folder / "y", SHORT | {"slope.angle": "30 deg"})
        self.assertEqual(set(talus.changed_keys(a, b)), {"slope.angle"})
        rows = {row.name: row for row in talus.compare(a, b)}
        self.assertNotIn("wall_seconds", rows)
        row = rows["front_speed_max"]
        self.assertEqual((row.first, row.second), (float(a.summary["front_speed_max"]), float(b.summary["front_speed_max"])))
        self.assertEqual(row.difference, row.second - row.first)
        self.assertEqual({row.difference for row in talus.compare(a, a) if not math.isnan(row.difference)}, {0})

    def test_a_program_that_is_not_there(self):
        self.assertEqual(talus.find_program(), PROGRAM)
        self.assertEqual(talus.find_program(PROGRAM), PROGRAM)


class Sweeps(Scratch):
    @classmethod
    def setUpClass(cls):
        super().setUpClass()
        cls.sweep = talus.sweep(cls.case, cls.folder / "s", {"slope.angle": ["30 deg", "50 deg"], "fluid.mobility":
                                                             ["none", "zuk-2014"]}, SHORT, members=2, jobs=1)

    def test_keys_and_quantities_are_columns(self):
        sweep = self.sweep
        self.assertEqual(len(sweep.groups), 4)
        np.testing.assert_allclose(sweep["slope.angle"], [30, 30, 50, 50])
        self.assertEqual(sweep["slope.angle"].units, "deg")
        self.assertEqual(sweep["fluid.mobility"], ["none", "zuk-2014"] * 2)
        for n, group in enumerate(sweep.groups):
            values = [float(run.summary["front_speed_max"]) for run in sweep.runs(group)]
            self.assertEqual(len(values), 2)
            self.assertAlmostEqual(sweep["front_speed_max"][n], np.mean(values), delta=1e-12)
            self.assertAlmostEqual(sweep.deviation("front_speed_max")[n], np.std(values, ddof=1), delta=1e-9)
        with self.assertRaisesRegex(talus.RunError, 'did you mean "front_speed_max"'):
            sweep["front_speedmax"]
        with self.assertRaisesRegex(talus.RunError, "group"):
            sweep.runs("angle=40deg")
        with self.assertRaisesRegex(talus.RunError, "sweep.json"):
            talus.Sweep(self.folder)

    @unittest.skipUnless(HAS_TABLES, "pandas and xarray are not installed (tools/install_packages tables)")
    def test_pandas_and_xarray(self):
        frame = self.sweep.to_pandas()
        self.assertEqual(list(frame.index), self.sweep.groups)
        np.testing.assert_array_equal(frame["front_speed_max"], self.sweep["front_speed_max"])
        self.assertEqual(frame.attrs["units"]["slope.angle"], "deg")
        run = self.sweep.runs(self.sweep.groups[0])[0]
        table = run.series.to_pandas(index="time")
        np.testing.assert_array_equal(table.index, run.series["time"])
        self.assertEqual(table.attrs["units"]["time"], "s")
        data = run.series.to_xarray()
        np.testing.assert_array_equal(data["step"], run.series["step"])
        self.assertEqual(data["time"].attrs["units"], "s")
        last = run.snapshots[-1]
        frame = last.to_xarray(["velocity"])
        np.testing.assert_array_equal(frame["position"], last.positions)
        self.assertEqual(frame["velocity"].attrs["units"], "m/s")
        frames = run.snapshots.to_xarray(["velocity"])
        self.assertEqual(dict(frames.sizes), {"time": len(run.snapshots), "particle": 60, "axis": 3})
        np.testing.assert_array_equal(frames["velocity"].isel(time=-1), frame["velocity"])


class Examples(Scratch):
    def example(self, name, *pictures):
        done = subprocess.run([sys.executable, PROJECT / "python/examples" / f"{name}.py", self.folder / name], text=True,
                              capture_output=True, check=False, env={**os.environ, "PYTHONPATH": str(PROJECT / "python")})
        self.assertEqual(done.returncode, 0, done.stderr)
        for picture in pictures:
            self.assertGreater((self.folder / name / picture).stat().st_size, 2000)
        return done.stdout

    def test_hopper(self):
        self.assertIn("'law.critical-state.static_friction': (0.3, 0.6)", self.example("hopper", "hopper.png"))

    def test_avalanche(self):
        said = self.example("avalanche", "avalanche.png")
        self.assertGreater(float(said.split("faster by ")[1].split()[0]), 2)

    def test_air(self):
        said = self.example("air", "air.png")
        self.assertLess(abs(float(said.split(": ")[1].split(" %")[0])), 1)


if __name__ == "__main__":
    unittest.main()
