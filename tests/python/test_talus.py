# SPDX-License-Identifier: Apache-2.0
"""The package python/talus: what it reads, on runs of the program, and what it says of what it cannot read;
longer than 400 lines because all its classes read the same two runs.

Usage: test_talus.py TALUS
"""
import importlib.util
import json
import pickle
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop()).resolve()
PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "python"))

import h5py  # noqa: E402
import matplotlib  # noqa: E402
matplotlib.use("Agg")
import numpy as np  # noqa: E402
import talus  # noqa: E402
import talus.draw  # noqa: E402
import talus.element_loads  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402
from talus.case import walls  # noqa: E402
from vtkmodules.util.numpy_support import vtk_to_numpy  # noqa: E402
from vtkmodules.vtkIOLegacy import vtkPolyDataReader  # noqa: E402

BOX = """model = "continuum"
[box]
width = "20 mm"
depth = "2.5 mm"
height = "60 mm"
[plate]
height = "30 mm"
slit_left = "5 mm"
slit_right = "15 mm"
[gate]
opens = "at-time"
time = "1 ms"
[grains]
density = "2500 kg/m3"
diameter = "200 um"
[bed]
packing = 0.6
spacing = "2.5 mm"
height = "10 mm"
[air]
enabled = true
cell = "2.5 mm"
[run]
end = "3 ms"
[output]
snapshots = "1 ms"
series = "0.1 ms"
pictures = false
"""


class OnARun(unittest.TestCase):
    """A small box of grains in air."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="talus-python-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "case.toml").write_text(BOX)
        subprocess.run([PROGRAM, "run", "case.toml", "--out", "run"], cwd=cls.folder, check=True, capture_output=True)
        cls.run_folder = cls.folder / "run"
        cls.read = talus.Run(cls.run_folder)

    def copy(self):
        """The run once more, to be damaged."""
        copy = Path(tempfile.mkdtemp(dir=self.folder)) / "run"
        shutil.copytree(self.run_folder, copy)
        return copy


SECTOR = """model = "continuum"
[box]
width = "60 mm"
depth = "60 mm"
height = "60 mm"
sector = "20 deg"
floor = "open"
[removal]
below = "1 mm"
[[vessel]]
name = "wall"
shape = "cylinder"
radius = "20 mm"
bottom = "10 mm"
top = "55 mm"
[[vessel]]
name = "gate"
shape = "disc"
radius = "20 mm"
height = "10 mm"
gate = true
[gate]
opens = "at-time"
time = "1 ms"
[grains]
density = "2500 kg/m3"
diameter = "200 um"
[bed]
packing = 0.6
spacing = "4 mm"
height = "12 mm"
[law]
name = "critical-state"
[collisions]
form = "none"
[run]
end = "2 ms"
[output]
snapshots = "1 ms"
series = "0.1 ms"
pictures = false
report = false
"""


class OfASector(unittest.TestCase):
    """A file holds the sector once; what is read is the whole, as the program counts it."""

    @classmethod
    def setUpClass(cls):
        cls.folder = Path(tempfile.mkdtemp(prefix="talus-python-"))
        cls.addClassCleanup(shutil.rmtree, cls.folder)
        (cls.folder / "case.toml").write_text(SECTOR)
        subprocess.run([PROGRAM, "run", "case.toml", "--out", "run"], cwd=cls.folder, check=True, capture_output=True)
        cls.read = talus.Run(cls.folder / "run")
        cls.last = cls.read.snapshots[-1]

    def test_the_file_holds_it_once(self):
        with h5py.File(self.last.path) as file:
            own = len(file["VTKHDF/Points"])
        self.assertEqual(self.last.copies, 18)
        self.assertEqual(len(self.last.positions), 18 * own)
        for name in self.last:
            self.assertEqual(len(self.last[name]), 18 * own, name)
        self.assertEqual(len(np.unique(self.last["identity"])), 18 * own)

    def test_the_whole_is_round(self):
        from_axis = np.asarray(self.last.positions) - [0.03, 0.03, 0]
        self.assertLess(abs(from_axis[:, :2].sum(axis=0)).max(), 1e-12)
        outwards = (np.asarray(self.last["velocity"]) * from_axis * [1, 1, 0]).sum(axis=1).reshape(18, -1)
        np.testing.assert_allclose(outwards, np.broadcast_to(outwards[0], outwards.shape), atol=1e-15)
        trace = (self.last["stress_xx"] + self.last["stress_yy"]).reshape(18, -1)
        scale = abs(np.asarray(trace)).max() + 1e-30
        np.testing.assert_allclose(trace / scale, np.broadcast_to(trace[0] / scale, trace.shape), atol=1e-12)
        xx, xy = np.asarray(self.last["stress_xx"]).reshape(18, -1), np.asarray(self.last["stress_xy"]).reshape(18, -1)
        yy = np.asarray(self.last["stress_yy"]).reshape(18, -1)
        size = xx**2 + 2 * xy**2 + yy**2
        np.testing.assert_allclose(size, np.broadcast_to(size[0], size.shape), rtol=1e-9, atol=1e-9 * size.max())

    def test_totals_and_measures_are_of_the_whole(self):
        self.assertLess(abs(self.read.summary["mass_error"]), 1e-12)
        self.assertAlmostEqual(self.read.summary["residual_mass"] / (0.6 * 2500 * np.pi * 0.02**2 * 0.012), 1, delta=0.1)
        value, _ = self.read.key_results["Flow"]
        self.assertRegex(value, r"has not started|still flows")


    def test_loads_of_walls_are_written_by_element(self):
        walls = self.read.walls[-1]
        self.assertAlmostEqual(walls.areas.sum() / (np.pi * 0.02**2 + 2 * np.pi * 0.02 * 0.045), 1, delta=0.02)
        floor = walls["patch"] == 1
        np.testing.assert_allclose(abs(np.asarray(walls.normals)[floor]), [[0, 0, 1]] * floor.sum(), atol=1e-12)
        self.read.write_element_loads(self.folder / "loads.csv")
        header, *rows = (self.folder / "loads.csv").read_text(encoding="utf-8").splitlines()
        self.assertEqual(len(rows), len(walls.corners))
        names = header.split(",")
        self.assertIn("pressure_at_rest [Pa]", names)
        self.assertIn("shear_in_flow_z [Pa]", names)
        last = dict(zip(names, map(float, rows[-1].split(","))))
        self.assertAlmostEqual(last["z [m]"], walls.middles[-1, 2], places=8)
        self.assertAlmostEqual(last["pressure_largest [Pa]"], walls["pressure_largest"][-1], delta=1e-6 * abs(walls["pressure_largest"]).max())


    def test_loads_by_element_have_the_run_and_the_code(self):
        self.read.write_element_loads(self.folder / "elements.csv")
        header, *rows = (self.folder / "elements.csv").read_text(encoding="utf-8").splitlines()
        of = dict(zip((name.split(" ")[0] for name in header.split(",")), np.array([row.split(",") for row in rows], dtype=float).T))
        self.assertIn("en_pressure_discharge [Pa]", header.split(","))
        # Normals point into the bed.
        wall, floor = of["patch"] == 0, of["patch"] == 1
        middle = [of[name][wall].mean() for name in "xy"]
        inwards = sum((middle[n] - of[name]) * of[f"normal_{name}"] for n, name in enumerate("xy"))
        self.assertGreater(inwards[wall].min(), 0)
        self.assertGreater(of["normal_z"][floor].min(), 0)
        # What elements carry in flow is what the series has of the wall in that time.
        begin, end = talus.element_loads.window(self.read)
        time, wall = np.asarray(self.read.series["time"]), of["patch"] == 0
        impulse = sum(np.asarray(self.read.series[name]) for name in self.read.series if name.startswith("normal_impulse_wall."))
        push = (np.interp(end, time, impulse) - np.interp(begin, time, impulse)) / (end - begin)
        self.assertGreater(push, 0)
        # All of it lies on one ring of fields, which the triangles of so small a wall cut; a silo of metres has 0.1 %.
        self.assertAlmostEqual((of["pressure_in_flow"] * of["area"])[wall].sum() / push, 1, delta=0.25)
        # At the middle of a band EN's load is the band's.
        loads = self.read.table("wall_loads")
        code = np.asarray(loads["en_pressure_discharge"])
        row = int(np.nanargmax(code))
        middle, number = 0.5 * float(loads["low"][row] + loads["high"][row]), float(loads["patch"][row]) - 1
        nearest = np.where(of["patch"] == number, abs(of["z"] - middle), np.inf).argmin()
        self.assertAlmostEqual(of["en_pressure_discharge"][nearest] / code[row], 1, delta=0.2)
        high = wall & (of["z"] > 0.04)
        self.assertTrue(np.isnan(of["en_pressure_discharge"][high]).all(), "above the bed")

    def test_loads_by_element_are_read_by_vtk(self):
        self.read.write_element_loads(self.folder / "elements.vtk")
        reader = vtkPolyDataReader()
        reader.SetFileName(str(self.folder / "elements.vtk"))
        reader.ReadAllScalarsOn()
        reader.ReadAllVectorsOn()
        reader.Update()
        cells, walls = reader.GetOutput().GetCellData(), self.read.walls[-1]
        np.testing.assert_array_equal(vtk_to_numpy(cells.GetArray("pressure_largest")), np.asarray(walls["pressure_largest"]))
        np.testing.assert_array_equal(vtk_to_numpy(cells.GetArray("shear_at_rest")), np.asarray(walls["shear_at_rest"]))
        self.assertTrue(np.isnan(vtk_to_numpy(cells.GetArray("en_pressure_discharge"))).any())
        with self.assertRaises(talus.RunError):
            self.read.write_element_loads(self.folder / "elements.xyz")


class Reading(OnARun):
    def test_case_has_units(self):
        case = self.read.case
        self.assertEqual(case["model"], "continuum")
        self.assertAlmostEqual(case["box"]["width"], 0.02)
        self.assertEqual(case["box"]["width"].units, "m")
        self.assertEqual(str(case["grains"]["density"]), "2500.0 kg/m3")
        self.assertEqual(case["bed"]["packing"], 0.6)

    def test_series_are_arrays_with_units(self):
        lines = (self.run_folder / "series.csv").read_text(encoding="utf-8").splitlines()
        series = self.read.series
        self.assertEqual(len(series), len(lines) - 1)
        self.assertEqual([f"{n} [{series.units[n]}]" for n in series], lines[0].split(","))
        for n, name in enumerate(series):
            np.testing.assert_array_equal(series[name], [float(line.split(",")[n]) for line in lines[1:]], name)
        time = series["time"]
        self.assertEqual((time.units, time[3:].units), ("s", "s"))
        self.assertNotIsInstance(time * time, talus.Column, "nobody has worked out the unit")
        self.assertIsInstance(pickle.loads(pickle.dumps(time)), talus.Column)
        with self.assertRaisesRegex(talus.RunError, 'no column "tme"; did you mean "time"'):
            series["tme"]

    def test_summary_and_status(self):
        written = json.loads((self.run_folder / "summary.json").read_text(encoding="utf-8"))
        self.assertEqual(self.read.status, "done")
        self.assertEqual(set(self.read.summary), set(written["quantities"]))
        for name, value in self.read.summary.items():
            expected = written["quantities"][name]
            self.assertEqual(value.units, expected["unit"])
            self.assertTrue(value == expected["value"] or (np.isnan(value) and expected["value"] is None), name)
        with self.assertRaisesRegex(talus.RunError, 'no quantity "wall_second"; did you mean "wall_seconds"'):
            self.read.summary["wall_second"]

    def test_snapshots_by_number_and_time(self):
        snapshots = self.read.snapshots
        self.assertEqual(snapshots.numbers, [0, 1, 2, 3, 4])
        self.assertEqual([s.number for s in snapshots], snapshots.numbers)
        self.assertEqual(snapshots[-1].number, 4)
        self.assertEqual(snapshots.at(1.4e-3).number, 1)
        self.assertEqual(snapshots.at(99).number, 4)
        self.assertEqual(snapshots.times.units, "s")
        last = snapshots[4]
        with h5py.File(last.path) as file:
            np.testing.assert_array_equal(last.positions, file["VTKHDF/Points"])
            self.assertEqual(set(last), set(file["VTKHDF/PointData"]))
            for name in last:
                np.testing.assert_array_equal(last[name], file["VTKHDF/PointData"][name])
                self.assertEqual(last[name].units, file["VTKHDF/PointData"][name].attrs["units"].decode())
        self.assertAlmostEqual(last.time, 4e-3, delta=1e-4)
        with self.assertRaisesRegex(talus.RunError, "no snapshot 17 of the particles; there are 0 to 4"):
            snapshots[17]
        with self.assertRaisesRegex(talus.RunError, 'no column "velocty"; did you mean "velocity"'):
            last["velocty"]
        with self.assertRaises(TypeError):
            snapshots[0.2]

    def test_columns_are_read_when_asked_for(self):
        copy = self.copy()
        snapshot = talus.Run(copy).snapshots[2]
        density = snapshot["density"]
        snapshot.path.unlink()
        np.testing.assert_array_equal(snapshot["density"], density)
        with self.assertRaisesRegex(talus.RunError, "particles_0002.vtkhdf"):
            snapshot["velocity"]

    @unittest.skipUnless(importlib.util.find_spec("xarray"), "xarray is not installed (tools/install_packages tables)")
    def test_xarray_puts_particles_and_cells_in_their_places(self):
        snapshot, air = self.read.snapshots[-1], self.read.air[-1]
        data = snapshot.to_xarray(["velocity"])
        identity = np.asarray(snapshot["identity"])
        for n in (0, len(identity) // 2, len(identity) - 1):
            np.testing.assert_array_equal(data["velocity"].sel(particle=identity[n]), snapshot["velocity"][n])
            np.testing.assert_array_equal(data["position"].sel(particle=identity[n]), snapshot.positions[n])
        cells = air.to_xarray(["pressure", "velocity"])
        np.testing.assert_array_equal(cells["pressure"].sel(x=air.x[1], z=air.z[2])[0], air["pressure"][1, 0, 2])
        self.assertEqual(cells["pressure"].attrs["units"], "Pa")

    def test_air_lies_on_its_grid(self):
        air = self.read.air[-1]
        self.assertEqual(air.shape, (8, 1, 24))
        self.assertAlmostEqual(air.x[0], 1.25e-3)
        self.assertAlmostEqual(air.z[-1], 60e-3 - 1.25e-3)
        self.assertEqual(air["velocity"].shape, (8, 1, 24, 3))
        with h5py.File(air.path) as file:
            raw = file["VTKHDF/PointData/velocity"][()]
        self.assertEqual(tuple(air["velocity"][5, 0, 11]), tuple(raw[11, 0, 5]))
        solid = air.layer("solid_fraction")
        self.assertEqual(solid.shape, (8, 24))
        self.assertGreater(solid[4, 14], 0.3, "the bed stands on the plate")
        self.assertEqual(solid[4, 2], 0, "and nothing has fallen so far yet")

    def test_the_gate_and_a_table(self):
        self.assertAlmostEqual(self.read.gate_time, 1e-3, delta=1e-4)
        self.assertEqual(self.read.table("snapshots").units["time"], "s")
        with self.assertRaisesRegex(talus.RunError, 'no table "snapshot"; did you mean "snapshots"'):
            self.read.table("snapshot")

    def test_walls_leave_the_slit_open(self):
        level = [line for line in walls(self.read.case) if line[0][1] == line[1][1]]
        np.testing.assert_allclose(level, [[(0, 0), (0.02, 0)], [(0, 0.03), (0.005, 0.03)], [(0.015, 0.03), (0.02, 0.03)]])
        self.assertIn(((0, 0.03), (0.02, 0.03)), walls(self.read.case, shut=True))
        inclined = {"box": {"width": 1.0, "height": 1.0, "floor": "open", "left": "open", "right": "open", "top": "open"},
                    "plates": {"1": {"from": [0.0, 0.0], "to": [0.6, 0.8], "openings": [0.25, 0.5]}}}
        np.testing.assert_allclose(walls(inclined), [[(0, 0), (0.15, 0.2)], [(0.3, 0.4), (0.6, 0.8)]])
        wedge = {"box": {"width": 1.0, "height": 2.0, "left": "open", "right": "open", "floor": "open", "top": "open"},
                 "wedge": {"half_angle": 45.0, "outlet": 0.2, "height": 0.5}}
        np.testing.assert_allclose(walls(wedge), [[(0, 0.9), (0.4, 0.5)], [(1, 0.9), (0.6, 0.5)]])

    def test_what_is_no_run(self):
        with self.assertRaisesRegex(talus.RunError, "no such folder"):
            talus.Run(self.folder / "none")
        with self.assertRaisesRegex(talus.RunError, "no manifest.json"):
            talus.Run(self.folder)
        self.assertEqual([run.folder for run in talus.find_runs(self.run_folder)], [self.run_folder])

    def test_damaged_files_are_named(self):
        copy = self.copy()
        (copy / "summary.json").write_text("{")
        with self.assertRaisesRegex(talus.RunError, "summary.json:1: is no JSON"):
            talus.Run(copy).summary
        (copy / "series.csv").write_text("time,speed\n1,2\n")
        with self.assertRaisesRegex(talus.RunError, "is no table of Talus"):
            talus.Run(copy).series
        (copy / "snapshots/particles_0001.vtkhdf").write_bytes(b"none")
        with self.assertRaisesRegex(talus.RunError, "particles_0001.vtkhdf: is no HDF5 file"):
            talus.Run(copy).snapshots[1]
        shutil.copy(copy / "snapshots/air_0000.vtkhdf", copy / "snapshots/particles_0002.vtkhdf")
        with self.assertRaisesRegex(talus.RunError, "of the type UnstructuredGrid"):
            talus.Run(copy).snapshots[2]
        shutil.rmtree(copy / "snapshots")
        with self.assertRaisesRegex(talus.RunError, "holds no snapshots of the particles"):
            talus.Run(copy).snapshots.at(0)

    def test_a_line_that_is_being_written_is_left_out(self):
        copy = self.copy()
        with open(copy / "series.csv", "a", encoding="utf-8") as file:
            file.write("0.5,12")
        self.assertEqual(len(talus.Run(copy).series), len(self.read.series))
        with open(copy / "series.csv", "a", encoding="utf-8") as file:
            file.write("\n")
        with self.assertRaisesRegex(talus.RunError, rf"series.csv:{len(self.read.series) + 2}: has 2 numbers"):
            talus.Run(copy).series


class Drawing(OnARun):
    """What is drawn is where it is."""

    def setUp(self):
        self.figure, self.ax = plt.subplots()
        self.addCleanup(plt.close, self.figure)

    def test_particles_have_their_places_sizes_and_colours(self):
        snapshot = self.read.snapshots[-1]
        discs = talus.draw.particles(self.ax, snapshot, "density", radius=1.25e-3, unit=1e-3)
        places = discs.get_offsets()
        order = np.argsort(-snapshot.positions[:, 1], kind="stable")
        np.testing.assert_allclose(places, snapshot.positions[order][:, [0, 2]] * 1e3)
        np.testing.assert_allclose(discs.get_array(), snapshot["density"][order])
        self.assertTrue((discs._widths == discs._heights).all())
        np.testing.assert_allclose(2 * discs._widths, 2.5)  # matplotlib keeps half of what it is given
        velocity = np.asarray(snapshot["velocity"])
        discs = talus.draw.particles(self.ax, snapshot, "velocity", radius=1e-3)
        np.testing.assert_allclose(discs.get_array(), np.linalg.norm(velocity, axis=1)[order])
        discs = talus.draw.particles(self.ax, snapshot, 2 * velocity, component="z", radius=1e-3)
        np.testing.assert_allclose(discs.get_array(), 2 * velocity[order][:, 2])
        with self.assertRaisesRegex(ValueError, "no vector"):
            talus.draw.particles(self.ax, snapshot, "density", component="z", radius=1e-3)
        downhill = talus.draw.particles(self.ax, snapshot, view="y-x", radius=1e-3)
        self.assertAlmostEqual(downhill.get_offsets()[:, 1].min(), -snapshot.positions[:, 0].max())
        for view in ("xx", "x", "xyz", "up"):
            with self.assertRaises(ValueError):
                talus.draw.particles(self.ax, snapshot, view=view, radius=1e-3)
        with self.assertRaisesRegex(talus.RunError, "give the radius"):
            talus.draw.particles(self.ax, snapshot)

    def test_fields_arrows_walls_and_curves(self):
        air = self.read.air[-1]
        mesh = talus.draw.field(self.ax, air, "velocity", component="z", unit=1e-3)
        np.testing.assert_array_equal(mesh.get_array().reshape(24, 8), air.layer("velocity")[:, :, 2].T)
        np.testing.assert_allclose(self.ax.get_xlim(), (0, 20), atol=1e-12)
        arrows = talus.draw.arrows(self.ax, air, apart=5e-3, unit=1e-3)
        self.assertEqual(arrows.N, 4 * 12)
        lines = talus.draw.walls(self.ax, self.read, top=0.05, unit=1e-3)
        self.assertEqual(len(lines.get_segments()), 5)
        line = talus.draw.curve(self.ax, self.read.series, "speed_max", start=1e-3)
        np.testing.assert_allclose(line.get_xdata(), self.read.series["time"] - 1e-3)
        self.assertEqual((self.ax.get_xlabel(), self.ax.get_ylabel()), ("time (s)", "speed max (m/s)"))

    def test_pictures_are_small_files_of_a_palette(self):
        talus.draw.particles(self.ax, self.read.snapshots[-1], "density", radius=1.25e-3)
        path = self.folder / "picture.png"
        talus.draw.save(self.figure, path)
        content = path.read_bytes()
        self.assertEqual(content[:4], b"\x89PNG")
        self.assertEqual(content[25], 3, "colours from a palette")


class Installing(unittest.TestCase):
    def test_pip_installs_it_from_the_checkout(self):
        folder = Path(tempfile.mkdtemp(prefix="talus-pip-"))
        self.addCleanup(shutil.rmtree, folder)
        shutil.copytree(PROJECT / "python", folder / "source", ignore=shutil.ignore_patterns("__pycache__"))
        offline = ["--no-build-isolation", "--no-deps"]
        self.assertIn(f"pip install {' '.join(offline)} ./python", (PROJECT / "docs/install.md").read_text(encoding="utf-8"))
        subprocess.run([sys.executable, "-m", "pip", "install", "--quiet", "--no-index", *offline, "--target", folder / "installed", folder / "source"], check=True, capture_output=True)
        names = {path.name for path in (folder / "installed" / "talus").glob("*.py")}
        self.assertEqual(names, {path.name for path in (PROJECT / "python" / "talus").glob("*.py")})
        [metadata] = (folder / "installed").glob("talus-*.dist-info")
        self.assertEqual(metadata.name, f"talus-{talus.__version__}.dist-info")
        version = subprocess.run([PROGRAM, "--version"], check=True, capture_output=True, text=True).stdout
        self.assertEqual(version.split()[1], talus.__version__)
        said = subprocess.run([sys.executable, "-c", "import talus, talus.draw; print(talus.__file__)"], cwd=folder,
                              env={"PYTHONPATH": str(folder / "installed")}, check=True, capture_output=True, text=True)
        self.assertTrue(said.stdout.startswith(str(folder / "installed")), said.stdout)


if __name__ == "__main__":
    unittest.main()
