# SPDX-License-Identifier: Apache-2.0
"""What validation/dem-hopper/coarse_grain.py and its modules make of beads at known places, with known velocities and
forces.

Usage: test_dem_hopper.py TALUS
"""
import csv
import json
import shutil
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROGRAM = Path(sys.argv.pop()).resolve()
ROOT = Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "validation" / "dem-hopper"
sys.path[:0] = [str(SCRIPTS), str(ROOT / "python")]

import fields  # noqa: E402
import flanks  # noqa: E402
import frames as referee  # noqa: E402
import numpy as np  # noqa: E402
import paper_rows  # noqa: E402
import rows  # noqa: E402
import slit  # noqa: E402
import surfaces  # noqa: E402
import talus  # noqa: E402
import trend  # noqa: E402

RADIUS, APART, DEPTH = 0.5e-3, 1e-3, 4e-3
PACKING = np.pi / 6  # of a simple cubic lattice of touching beads


def lattice(heights, bottom=0.0, time=0.0):
    """Beads of a simple cubic lattice between `bottom` and heights(x), at rest, without contacts."""
    x, z = np.meshgrid(np.arange(0.5, 100) * APART, np.arange(0.5, 210) * APART, indexing="ij")
    there = (z > bottom) & (z < heights(x))
    x, z = (np.repeat(values[there], 4) for values in (x, z))  # four layers deep
    return referee.Frame(time, np.full(len(x), RADIUS), x, z, np.zeros((len(x), 3)), np.zeros((len(x), 4)))


def write(folder, frames, walls={}, first=0, **parameters):
    """A run's folder as hopper.in leaves it, a frame every 100 steps. \\param first number of the first frame"""
    (folder / "frames").mkdir(parents=True)
    parameters = {"diameter": 2 * RADIUS, "depth": DEPTH, "seed": 1, "rolling": 0.0, "stiffness": 1.0, **parameters}
    (folder / "parameters.json").write_text(json.dumps(parameters))
    for n, f in enumerate(frames, first):
        head = (f"ITEM: TIMESTEP\n{100 * n}\nITEM: NUMBER OF ATOMS\n{len(f.x)}\nITEM: BOX BOUNDS ff pp ff\n0 0.1\n0 0.004\n"
                "-0.002 0.26\nITEM: ATOMS radius x z vx vy vz c_stress[1] c_stress[2] c_stress[3] c_stress[5]\n")
        with open(folder / "frames" / f"{100 * n}.txt", "w") as file:
            file.write(head)
            np.savetxt(file, np.column_stack([f.radius, f.x, f.z, f.velocity, -f.stress]), "%.9g")
    for begun, rows in walls.items():
        np.savetxt(folder / f"walls.{begun}.txt", rows, "%.9g", header="of fix ave/time")


class Surfaces(unittest.TestCase):
    def test_a_level_bed_has_its_packing_and_its_surface(self):
        section = fields.Section(lattice(lambda x: 0.05 + 0 * x), DEPTH)
        self.assertAlmostEqual(section.packing[100, 40:60].mean(), PACKING, delta=1e-3)
        self.assertAlmostEqual(section.packing[:2, 40:60].mean(), PACKING, delta=0.01)  # at the wall too
        _, bin_ = surfaces.surface_heights(section)
        # The packing passes 0.3 of 0.524 a little below its half.
        self.assertLess(abs(bin_ - 0.05).max(), 0.7e-3)

    def test_slopes_are_found_with_their_angles(self):
        slope = np.tan(np.radians(25))
        section = fields.Section(lattice(lambda x: 0.06 - slope * abs(x - 0.05)), DEPTH)
        _, bin_ = surfaces.surface_heights(section)
        self.assertAlmostEqual(surfaces.repose_angle(section, bin_), 25, delta=0.7)
        self.assertAlmostEqual(surfaces.outward_angle(section.x, bin_, 0.01, 0.045), 25, delta=0.7)
        self.assertAlmostEqual(surfaces.band(section.x, bin_, 0.02, 0.03), 0.06 - 0.025 * slope, delta=0.7e-3)
        rising = fields.Section(lattice(lambda x: 0.03 + slope * abs(x - 0.05)), DEPTH)
        self.assertAlmostEqual(surfaces.outward_angle(rising.x, surfaces.surface_heights(rising)[1], 0.01, 0.045), -25, delta=0.7)

    def test_hopper_and_bin_have_their_own_surface_and_a_stream_hides_the_bins(self):
        hopper, bin_ = lattice(lambda x: 0.16 + 0 * x, bottom=0.1), lattice(lambda x: np.where(abs(x - 0.05) < 0.01, 0.1, 0.02))
        both = referee.Frame(0, *(np.concatenate([getattr(hopper, n), getattr(bin_, n)])
                             for n in ("radius", "x", "z", "velocity", "stress")))
        above, below = surfaces.surface_heights(fields.Section(both, DEPTH))
        self.assertLess(abs(above - 0.16).max(), 0.7e-3)
        self.assertTrue(np.isnan(below[95:105]).all())
        self.assertLess(abs(below[:60] - 0.02).max(), 0.7e-3)
        nothing = surfaces.surface_heights(fields.Section(lattice(lambda x: 0 * x), DEPTH))
        self.assertTrue(np.isnan(nothing).all())

    def test_a_short_slope_is_none(self):
        x = np.arange(60) * 1.0
        self.assertEqual(surfaces.heap_slopes(x, np.tile([0.0, 1.0, 0.5, 1.5], 15), 10), [])
        (start, stop, angle), = surfaces.heap_slopes(x, np.where(x < 20, np.nan, 2 * x), 10)
        self.assertEqual((start, stop), (20, 59))
        self.assertAlmostEqual(angle, np.degrees(np.arctan(2)))


class Foot(unittest.TestCase):
    def test_its_speed_is_that_of_the_layer(self):
        times = 0.15 + 2e-3 * np.arange(20)
        reach = np.array([surfaces.foot_reach(fields.Section(lattice(
            lambda x: np.where((x > 0.05 - (0.02 + 0.8 * (t - 0.15))) & (x < 0.05 + (0.02 + 1.2 * (t - 0.15))), 0.006, 0)),
            DEPTH)) for t in times])
        self.assertAlmostEqual(surfaces.foot_speed(times, reach[:, 0]), 0.8, delta=0.03)
        self.assertAlmostEqual(surfaces.foot_speed(times, reach[:, 1]), 1.2, delta=0.05)
        self.assertTrue(np.isnan(surfaces.foot_speed(times[:2], reach[:2, 0])))

    def test_a_full_floor_reaches_the_walls_and_an_empty_one_nowhere(self):
        self.assertEqual(surfaces.foot_reach(fields.Section(lattice(lambda x: 0.01 + 0 * x), DEPTH)), [0.05, 0.05])
        self.assertTrue(np.isnan(surfaces.foot_reach(fields.Section(lattice(lambda x: 0.2 + 0 * x, bottom=0.1), DEPTH))).all())


class Stress(unittest.TestCase):
    def test_contact_stress_is_force_times_branch_over_volume(self):
        # Columns of beads in a bed 20 mm high, each bearing F: szz = F / area of a column, wherever the box.
        frame = lattice(lambda x: 0.02 + 0 * x)
        force, area = 3e-4, APART**2
        frame.stress[:, 2] = force * 2 * RADIUS
        _, contact, kinetic = fields.box_state(frame, fields.Section(frame, DEPTH), (0.01, 0.05), (0.005, 0.015))
        np.testing.assert_allclose(contact, [0, 0, force / area, 0], atol=1e-12)
        np.testing.assert_allclose(kinetic, 0, atol=1e-12)

    def test_kinetic_stress_is_of_the_fluctuation_alone(self):
        frame = lattice(lambda x: 0.08 + 0 * x)
        random = np.random.default_rng(1).normal(0, [0.1, 0.2, 0.3], (len(frame.x), 3))
        frame.velocity[:] = [0, 0, -1]
        frame.velocity += random
        packing, _, kinetic = fields.box_state(frame, fields.Section(frame, DEPTH), (0.01, 0.05), (0.01, 0.07))
        self.assertAlmostEqual(packing, PACKING, delta=1e-9)
        expected = referee.DENSITY * PACKING * np.array([0.01, 0.04, 0.09])
        np.testing.assert_allclose(kinetic[:3], expected, rtol=0.06)

    def test_shear_stress_of_the_mirror_image_adds(self):
        frame = lattice(lambda x: 0.02 + 0 * x)
        frame.stress[:, 3] = np.where(frame.x < 0.05, 2e-7, -2e-7)
        _, contact, _ = fields.box_state(frame, fields.Section(frame, DEPTH), (0.01, 0.05), (0.005, 0.015))
        self.assertAlmostEqual(contact[3], 2e-7 / APART**3, delta=1e-9)


class Trend(unittest.TestCase):
    def test_a_line_in_the_diameter_is_followed_to_fine_grains(self):
        value, off = trend.line_at([1.0, 1.5, 2.0], [9.0, 8.5, 8.0])
        self.assertAlmostEqual(value, 9.8)
        self.assertAlmostEqual(off, 0)
        self.assertTrue(np.isnan(trend.line_at([1.0], [9.0])).all())
        self.assertAlmostEqual(trend.line_at([1.0, 2.0, 3.0], [1.0, 2.0, 4.0])[1], 1 / 3)

    def test_beverloos_own_discharge_has_its_k(self):
        diameter = np.array([1.0, 1.6, 2.8])
        k, rate = trend.beverloo(diameter, 2e-3 * (40 - 1.4 * diameter)**1.5)
        self.assertAlmostEqual(k, 1.4)
        self.assertAlmostEqual(rate, 2e-3 * (40 - 1.4 * 0.2)**1.5)

    def test_a_slope_has_the_error_that_the_seeds_give_it(self):
        slope, error = trend.slope_and_error({1.0: [0.0, 2.0], 3.0: [4.0, 6.0]})
        self.assertAlmostEqual(slope, 2)
        self.assertAlmostEqual(error, 0.5**0.5)
        self.assertTrue(np.isnan(trend.slope_and_error({1.0: [0.0], 3.0: [4.0]})[1]))


class Rows(unittest.TestCase):
    REFERENCE = """title = "stays"
[[row]]
id = "rolling-bin-surface-200ms-22-36mm"
quantity = "surface_height_bin"
window = { at = 0.2 }
place = { from = "22 mm", to = "36 mm" }
printed = "19 mm"
criterion = { value = 0.019, within = 0.005 } # why
"""

    def written(self, values):
        numbers = {("surface_height_bin", "22-36 mm from the middle", "0.2", "mm"): values}
        return rows.rewritten(self.REFERENCE, {"rolling": numbers, "round": {}})

    def test_a_row_has_the_value_on_the_line_and_keeps_its_width(self):
        written = self.written({2.0: [19.0], 1.0: [23.0, 23.1]})
        self.assertIn('printed = "19.0 (2 mm), 23.1 (1 mm); at 0.2 mm: 26.3 mm"', written)
        self.assertIn("criterion = { value = 0.02629, within = 0.005 } # why", written)
        self.assertTrue(written.startswith('title = "stays"'))

    def test_without_a_trend_it_has_the_mean_and_of_one_size_it_stays(self):
        self.assertIn("value = 0.0215,", self.written({2.0: [19.0, 23.0], 1.0: [20.0, 24.0]}))
        self.assertEqual(self.written({2.0: [19.0]}), self.REFERENCE)

    def test_the_rows_are_those_of_the_tables(self):
        text = (SCRIPTS / "reference.toml").read_text(encoding="utf-8")
        self.assertEqual(text, rows.rewritten(text, rows.of_tables()))


class Flanks(unittest.TestCase):
    def test_speeds_are_those_of_the_depth_below_the_surface_beside_the_walls(self):
        frame = lattice(lambda x: 0.14 + 0 * x, bottom=0.1)
        frame.velocity[:, 2] = frame.z - 0.14  # as fast as deep
        frame.velocity[abs(frame.x - 0.05) < 0.03, 0] = 9  # what lies farther from the walls does not count
        slope, height, speed = flanks.speeds(frame, DEPTH)
        self.assertTrue(np.isnan(slope))
        self.assertAlmostEqual(height, 0.14, delta=1e-3)
        np.testing.assert_allclose(speed, (flanks.DEPTHS[:-1] + flanks.DEPTHS[1:]) / 2, atol=1.2e-3)

    def test_the_slip_is_that_of_the_lowest_grains_towards_the_slit(self):
        frame = lattice(lambda x: 0.14 + 0 * x, bottom=0.1)
        frame.velocity[:, 0] = np.where(frame.z < 0.101, 0.01, 9) * np.sign(0.05 - frame.x)
        self.assertAlmostEqual(flanks.slip(frame), 0.01)
        self.assertTrue(np.isnan(flanks.slip(lattice(lambda x: 0.09 + 0 * x))))

    def test_the_slope_is_that_of_the_heap(self):
        slope, _, _ = flanks.speeds(lattice(lambda x: 0.1 + 0.5 * (abs(x - 0.05) - 0.02), bottom=0.1), DEPTH)
        self.assertAlmostEqual(slope, np.degrees(np.arctan(0.5)), delta=1)


class PaperRows(unittest.TestCase):
    def test_a_swelling_on_a_valley_is_measured_above_its_flanks(self):
        x = np.arange(0.001, 0.1, 0.002)
        valley = 0.1 + 0.4 * abs(x - 0.05) + np.where(abs(x - 0.05) < 0.003, 0.002, 0)
        above, middle = paper_rows.swelling(x, valley)
        self.assertAlmostEqual(above, 0.002 + 0.4 * 0.001, delta=1e-9)
        self.assertLess(middle, above)

    def test_beads_that_come_to_rest_in_the_hopper_alone_belong_to_their_run(self):
        surface = paper_rows.hopper_surfaces()
        self.assertIn(("d050-r20", "1"), surface)
        self.assertEqual({run for run, _ in surface if run.endswith("-rest")}, set())

    def test_a_stream_has_the_width_between_its_twentieths(self):
        x, z = (axis.ravel() for axis in np.meshgrid(np.arange(1.0, 100, 2), np.arange(41.0, 60, 2)))
        packing = np.where(abs(x - 50) < 20, 0.5, 0)  # twenty columns of cells
        self.assertAlmostEqual(paper_rows.stream_width(x, z, packing, 40, 60), 36, delta=1e-9)

    def test_a_pictures_packing_is_not_its_speed(self):
        with tempfile.TemporaryDirectory() as folder:
            path = Path(folder) / "picture-d100-s1.csv"
            path.write_text("time_s,x_mm,z_mm,packing,speed_m_per_s\n0.16,1,41,0.5,1.2\n0.16,3,43,0.25,1.1\n0.2,5,45,0.1,1\n")
            pictures = paper_rows.packings(path)
        self.assertEqual(sorted(pictures), [0.16, 0.2])
        np.testing.assert_array_equal(pictures[0.16], [[1, 3], [41, 43], [0.5, 0.25]])


class Slit(unittest.TestCase):
    def test_a_stream_has_its_packing_velocity_stress_and_discharge(self):
        bed = lattice(lambda x: np.where(abs(x - 0.05) < 0.016, 0.12, 0.0))
        away, ones = bed.x - 0.05, np.ones(len(bed.x))
        one = (bed.x, bed.z, -0.5 * away, -2.0 * ones, bed.volume, 30 * APART**3 * ones, 60 * APART**3 * ones)
        profile = slit.means([one, one], DEPTH)
        packing, downwards, inwards, xx, zz = profile[3].T  # in the slit
        np.testing.assert_allclose(packing, [PACKING] * 5 + [0, 0], rtol=1e-6)
        np.testing.assert_allclose(downwards[:5], 2)
        np.testing.assert_allclose(inwards[:5], 0.5 * (slit.EDGES[:5] + slit.EDGES[1:6]) / 2, rtol=1e-6)
        np.testing.assert_allclose((xx[:5], zz[:5]), [[30] * 5, [60] * 5], rtol=1e-6)
        self.assertAlmostEqual(slit.discharge(profile, 3), 2500 * PACKING * 2 * 0.032 * 5e-3, delta=1e-6)

    def test_a_run_that_ends_before_has_none(self):
        with self.assertRaises(ValueError):
            slit.means([], DEPTH)


class Folder(unittest.TestCase):
    def setUp(self):
        self.folder = Path(tempfile.mkdtemp(prefix="talus-referee-"))
        self.addCleanup(shutil.rmtree, self.folder)

    def falling(self, count):
        """A bed on the plate whose lowest layers are, one a frame, moved to the floor, and which sinks at 0.5 m/s."""
        frames = []
        for n in range(count):
            frame = lattice(lambda x: 0.18 + 0 * x, bottom=0.1)
            frame.z[frame.z < 0.1 + n * APART] -= 0.1
            frame.velocity[:, 2] = -0.5
            frames.append(frame)
        return frames

    def test_discharge_and_profiles(self):
        write(self.folder / "run", self.falling(12))
        run = referee.Run(self.folder / "run")
        layer = 100 * 4 * referee.DENSITY * 4 / 3 * np.pi * RADIUS**3 * referee.DEPTH / DEPTH  # kg, in 5 mm
        mass = referee.discharge(run)
        np.testing.assert_allclose(mass[:, 1], layer * np.arange(12), rtol=1e-6)
        self.assertAlmostEqual(referee.rate(mass, 0.004, 0.02), layer / referee.FRAME, delta=1e-6)
        self.assertTrue(np.isnan(referee.rate(mass, 0.0, 0.04)))
        x, velocity, packing = fields.profile(run, 0.01, 0.16)
        np.testing.assert_allclose(velocity, -0.5)
        np.testing.assert_allclose(packing, PACKING, rtol=1e-6)

    def test_wall_loads_are_means_of_20_ms_and_a_resumed_run_counts(self):
        rows = [[100 * n, *np.full(8, 1.0 * n)] for n in range(1, 21)]
        write(self.folder / "run", self.falling(3), {0: rows[:12], 1100: [[1200, *np.full(8, 99.0)]] + rows[12:]})
        loads = referee.wall_loads(referee.Run(self.folder / "run"))
        np.testing.assert_allclose(loads[:, 0], [0.01, 0.03])
        np.testing.assert_allclose(loads[0, 1:], 5.5 * referee.DEPTH / DEPTH)
        np.testing.assert_allclose(loads[1, 1:], (15.5 + 8.7) * referee.DEPTH / DEPTH)

    def test_a_frame_that_is_being_written_is_left_out_and_others_must_be_whole(self):
        write(self.folder / "run", self.falling(4))
        last = self.folder / "run" / "frames" / "300.txt"
        last.write_text(last.read_text()[:5000])
        run = referee.Run(self.folder / "run")
        self.assertAlmostEqual(run.end, 2 * referee.FRAME)
        with self.assertRaises(ValueError):
            referee.read_frame(last, 0.006)

    def test_beads_are_drawn_and_read_as_a_run(self):
        frames = self.falling(5)
        write(self.folder / "run", frames)
        beads = self.folder / "beads"
        convert = [sys.executable, SCRIPTS / "as_run.py", self.folder / "run", beads, "--every", "2"]
        subprocess.run(convert, check=True)
        run = talus.Run(beads)
        np.testing.assert_allclose([snapshot.time for snapshot in run.snapshots], [0, 0.004, 0.008])
        self.assertEqual((float(run.case["plate"]["height"]), run.case["plate"]["height"].units), (0.1, "m"))
        snapshot = run.snapshots[1]
        np.testing.assert_allclose(snapshot.positions[:, [0, 2]], np.column_stack([frames[2].x, frames[2].z]), rtol=1e-6)
        np.testing.assert_allclose(snapshot["radius"], RADIUS, rtol=1e-6)
        np.testing.assert_allclose(snapshot["velocity"][:, 2], -0.5)
        picture = self.folder / "beads.png"
        subprocess.run([PROGRAM, "picture", beads, "--times", "0,0.004", "--color", "velocity", "-o", picture], check=True)
        self.assertEqual(picture.read_bytes()[:4], b"\x89PNG")
        self.assertNotEqual(subprocess.run(convert, capture_output=True).returncode, 0, "an existing folder is left alone")

    def test_the_tables_have_their_units_and_every_run(self):
        for name in ("one", "two"):
            write(self.folder / name, self.falling(11))
        subprocess.run([sys.executable, SCRIPTS / "coarse_grain.py", self.folder / "one", self.folder / "two", "--out",
                        self.folder / "data"], check=True)
        with open(self.folder / "data" / "surfaces.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["run"] for row in rows}, {"one", "two"})
        first = [float(row["hopper_mm"]) for row in rows if row["run"] == "one" and float(row["time_s"]) == 0]
        self.assertEqual(len(first), 50)
        self.assertLess(max(abs(height - 180) for height in first), 0.7)
        before = (self.folder / "data" / "surfaces.csv").read_text()
        subprocess.run([sys.executable, SCRIPTS / "coarse_grain.py", self.folder / "two", "--out", self.folder / "data"],
                       check=True)
        self.assertEqual((self.folder / "data" / "surfaces.csv").read_text(), before, "run one is kept, run two replaced")
        wrong = subprocess.run([sys.executable, SCRIPTS / "coarse_grain.py", self.folder / "three"], capture_output=True,
                               text=True)
        self.assertNotEqual(wrong.returncode, 0)
        self.assertIn("three", wrong.stderr)

    def test_a_hopper_alone_has_its_surface_and_its_heap_and_nothing_of_the_bin(self):
        heap = lattice(lambda x: 0.1 + 0.5 * (abs(x - 0.05) - 0.02), bottom=0.1, time=0.44)
        write(self.folder / "rest", [heap] * 21, first=220, **{"hopper-of": "one"})
        run = referee.Run(self.folder / "rest")
        self.assertEqual((min(run.steps), max(run.steps)), (220, 240))
        subprocess.run([sys.executable, SCRIPTS / "coarse_grain.py", self.folder / "rest", "--out", self.folder / "data"],
                       check=True)
        with open(self.folder / "data" / "numbers.csv", encoding="utf-8") as file:
            (number,) = csv.DictReader(file)
        self.assertEqual((number["quantity"], number["time_s"]), ("repose_angle_hopper", "0.48"))
        self.assertAlmostEqual(float(number["value"]), np.degrees(np.arctan(0.5)), delta=1)
        with open(self.folder / "data" / "surfaces.csv", encoding="utf-8") as file:
            rows = list(csv.DictReader(file))
        self.assertEqual({row["time_s"] for row in rows}, {"0.44", "0.46", "0.48"})
        self.assertEqual({row["bin_mm"] for row in rows}, {"nan"})


unittest.main()
