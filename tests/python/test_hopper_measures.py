# SPDX-License-Identifier: Apache-2.0
"""The quantities of validation/yuu2011/measures.py on runs of a hopper with known numbers.

Usage: test_hopper_measures.py TALUS
"""
import sys
import unittest
from math import erf
from pathlib import Path

sys.argv.pop()
sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "python")]

import numpy as np  # noqa: E402
from paper_hopper import DEPTH, GATE, H, HEIGHT, MASS, MEASURES, PLATE, WIDTH, measure, paper_case, snapshot  # noqa: E402
from runs_in_memory import Frame, RunInMemory, Series, case, lattice  # noqa: E402
from talus import curves, surfaces  # noqa: E402
from talus.continuum import continuum  # noqa: E402
from talus.measures import NotEvaluated, Window  # noqa: E402

M, NUMBERS = MEASURES.module, MEASURES.module.grains
PI = np.pi


def steady_flow(factor=1.0, empty_from=np.inf):
    """Mass leaves at 0.2 kg/s times the factor, which fluctuates with a period of 6 ms, from 0.02 s after the opening to
    0.3 s; at 0.04 s a bump. \\param empty_from when there are no grains left at the probe, s"""
    time = 2e-5 * np.arange(62501)
    t, bump, bump_width = time - GATE, 0.05, 3e-3
    flowing = t - 0.02
    passed = flowing.clip(0, 0.28)
    passed = (0.2 * passed + 0.02 * 0.006 / (2 * PI) * (1 - np.cos(2 * PI * passed / 0.006)) +
              bump * bump_width * np.sqrt(PI) / 2 * (1 + np.vectorize(erf)((passed - 0.02) / bump_width)))
    rate = np.where((flowing < 0) | (flowing > 0.28), 0, 0.2 + 0.02 * np.sin(2 * PI * flowing / 0.006) +
                    bump * np.exp(-((flowing - 0.02) / bump_width)**2))
    series = Series(time=time, gate_time=np.where(t < 0, -1, GATE), discharged_mass=factor * passed,
                    discharge_rate=factor * rate, lowest_z=0.1 - 4.9 * t.clip(0)**2,
                    slit_velocity=-0.5 - 0.3 * np.sin(2 * PI * t / 0.01),
                    probe_density=np.where(t > empty_from, np.nan, 1400 + np.sin(2 * PI * time / 0.0066)))
    n = np.arange(21)
    angle = np.where(n < 2, 0.5, np.where(n == 10, 12, np.minimum(30, 3 * n)))
    table = {"time": 0.05 * n, "surface_angle_hopper": angle, "repose_angle_bin": np.full(21, 28.0),
             "repose_angle_hopper": np.full(21, 33.0)}
    frames = [Frame(np.zeros((9000, 3)), GATE)]
    return RunInMemory(paper_case(), frames, series, GATE, snapshots=table)


class Discharge(unittest.TestCase):
    run_ = steady_flow()

    def of(self, name, begin=0.0, end=np.inf, **options):
        return measure(name, self.run_, begin, end, **options)

    def test_the_mass_is_that_of_the_lattice(self):
        self.assertAlmostEqual(continuum(self.run_).mass, MASS, places=12)
        self.assertAlmostEqual(continuum(self.run_).particle_mass, 1500 * H**3, places=15)

    def test_rates(self):
        self.assertAlmostEqual(self.of("discharge_rate_drift", 0.05, 0.2), 0, delta=0.01)
        self.assertAlmostEqual(self.of("discharge_rate_fall", 0.3, 0.4), -0.2, delta=2e-3)
        largest = 0.2 + 0.05 * 3e-3 * np.sqrt(PI) / 0.02
        self.assertAlmostEqual(self.of("discharge_rate_share_of_largest", 0.1, 0.12), 0.2 / largest, delta=0.02)
        self.assertTrue(np.isnan(self.of("discharge_rate_fall", 1.5, 1.6)), "after the end")

    def test_periods(self):
        self.assertAlmostEqual(self.of("crossing_period_density", 0.05, 0.3), 6.6e-3, delta=5e-5)
        self.assertAlmostEqual(self.of("period_density", 0.05, 0.3), 6.6e-3, delta=5e-5)
        for name in ("period_strain", "crossing_period_strain"):
            self.assertTrue(np.isnan(self.of(name, 0.05, 0.3)), "there is no such column")

    def test_a_period_is_taken_as_long_as_there_are_grains(self):
        self.assertAlmostEqual(measure("period_density", steady_flow(empty_from=0.25), 0.05, 0.3), 6.6e-3, delta=1e-4)
        self.assertTrue(np.isnan(measure("period_density", steady_flow(empty_from=0.15), 0.05, 0.3)))

    def test_the_first_grain_on_the_floor(self):
        self.assertAlmostEqual(self.of("floor_arrival_first_time", height=1e-3), np.sqrt(0.099 / 4.9), delta=1e-5)

    def test_the_fluctuation_of_the_velocity_in_the_slit(self):
        self.assertAlmostEqual(self.of("slit_velocity_fluctuation", 0.05, 0.25), 0.3 / np.sqrt(2), delta=1e-3)

    def test_angles_of_the_programs_own_table(self):
        self.assertAlmostEqual(self.of("surface_angle_largest_fall"), 27 - 12)
        self.assertAlmostEqual(self.of("surface_angle_end_difference"), -3)
        self.assertAlmostEqual(self.of("surface_angle_end_difference", at=0.5), 12 - 33)
        self.assertTrue(np.isnan(self.of("surface_angle_end_difference", at=1.5)), "after the end")
        self.assertEqual(self.of("repose_angle_nearer"), 28)
        self.assertEqual(self.of("repose_angle_other"), 33)

    def test_of_one_angle_of_repose_there_is_a_nearer_one_and_no_other(self):
        run = steady_flow()
        run.table("snapshots")["repose_angle_hopper"][:] = np.nan
        self.assertEqual(measure("repose_angle_nearer", run), 28)
        self.assertTrue(np.isnan(measure("repose_angle_other", run)))

    def test_two_runs(self):
        fast = steady_flow(1.5)
        pairs = [[fast], [self.run_]], [[fast, self.run_], [self.run_]]  # the second: means over the members

        def of(name, groups, begin=0.03, end=0.28):
            return MEASURES.quantities[name].of(groups, Window(None, begin, end))
        for groups, ratio, share, part in zip(pairs, (1.5, 1.25), (1, 0.5), (1, 0.5)):
            self.assertAlmostEqual(of("discharge_rate_ratio_at_max", groups), ratio, places=9)
            self.assertEqual(of("discharge_rate_share_larger", groups), share)
            # The ripple ends two thirds through a period.
            exact = 0.5 * (0.2 * 0.28 + 1.5 * 0.02 * 0.006 / (2 * PI) + 0.05 * 3e-3 * np.sqrt(PI)) / MASS
            self.assertAlmostEqual(of("discharge_resolution_difference", groups, 0, np.inf), part * exact, delta=1e-6)
        with self.assertRaises(NotEvaluated):
            of("discharge_rate_share_larger", [[fast]])

    def test_the_largest_fall_is_that_below_an_earlier_mean(self):
        curve = curves.curve(np.arange(8) * 0.1, [0.5, 5, 4, 9, 6, 8, 7, 8.5])
        self.assertAlmostEqual(M.largest_fall(curve, 0.1), 3)
        self.assertTrue(np.isnan(M.largest_fall(curves.curve([0, 1], [0.2, 0.9]), 0.1)), "it never inclines")


def heaps():
    """The end as it might be: two wedges of 30 degrees left in the hopper, a roof of 25 degrees in the bin."""
    steep, gentle = np.tan(PI / 6), np.tan(np.radians(25))
    return np.vstack([
        lattice(WIDTH, DEPTH, 0, PLATE, H, lambda x, z: z < 0.03 + gentle * (0.05 - abs(x - 0.05))),
        lattice(WIDTH, DEPTH, PLATE, HEIGHT, H, lambda x, z: z - PLATE < steep * (abs(x - 0.05) - 0.02))])


class Heaps(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.run_ = RunInMemory(paper_case(), [Frame(heaps(), GATE + 1)], gate_time=GATE,
                               snapshots={"time": np.array([1.0]), "repose_angle_hopper": np.array([28.0])})

    def of(self, name, **place):
        return measure(name, self.run_, **place)

    def test_heights_and_slopes(self):
        self.assertAlmostEqual(self.of("surface_height_bin", **{"from": 0.02, "to": 0.03}),
                               0.03 + 0.025 * np.tan(np.radians(25)), delta=0.3e-3)
        self.assertAlmostEqual(self.of("surface_height_hopper", **{"from": 0.035, "to": 0.045}),
                               PLATE + 0.02 * np.tan(PI / 6), delta=0.5e-3)
        self.assertAlmostEqual(self.of("surface_outward_angle_bin", **{"from": 0.01, "to": 0.045}), 25, delta=1)
        inward = {"from": 0.022, "to": 0.045}
        self.assertAlmostEqual(self.of("surface_inward_angle_hopper", **inward), 30, delta=1)
        self.assertAlmostEqual(self.of("surface_inward_angle_end_difference", **inward), 2, delta=1)
        self.assertEqual(self.of("surface_inward_angle_largest_fall", **inward), 0)

    def test_the_foot_reaches_the_walls(self):
        self.assertAlmostEqual(NUMBERS.foot_reach(continuum(self.run_).snapshot(0), 5e-3), 0.05, places=12)

    def test_corners_of_a_lattice_are_as_dense_as_the_rest(self):
        for name in ("corner_packing_ratio_bin", "corner_packing_over_middle_bin"):
            self.assertAlmostEqual(self.of(name, size=0.01), 1, delta=0.01)

    def test_a_stream_that_the_heap_has_reached_has_no_numbers(self):
        for name in ("stream_packing", "stream_packing_of_cells", "stream_stress_share", "stream_stripes"):
            self.assertTrue(np.isnan(self.of(name, **{"from": 0.04, "to": 0.09})))


class Corners(unittest.TestCase):
    def test_denser_than_the_rest_of_the_layer(self):
        s = snapshot(Frame(heaps(), GATE + 1), case(WIDTH, 6e-3, HEIGHT, 2e-3, PLATE, (0.03, 0.07)))

        class Section:
            x, z = (np.arange(100) + 0.5) * 1e-3, (np.arange(250) + 0.5) * 1e-3
            value = np.full((250, 100), 0.6)
        Section.value[:10, :10] = Section.value[:10, 90:] = 0.66
        Section.value[:1] = Section.value[:, :1] = Section.value[:, 99:] = 7
        s.section, s.bin_surface = Section, surfaces.Surface(Section.x, np.full(100, 0.05))
        layer = (9 * 18 * 0.66 + 9 * 80 * 0.6) / (9 * 98)
        self.assertAlmostEqual(NUMBERS.CORNER_RATIOS["bin"](s, 0.01), 0.66 / layer, places=12)
        self.assertAlmostEqual(NUMBERS.corner_packing_over_middle_bin(s, 0.01), 1.1, places=12)


class Stream(unittest.TestCase):
    """A full hopper over an empty bin with a stream of half the slit's width, that narrows to a quarter half-way down."""

    @classmethod
    def setUpClass(cls):
        bed = lattice(WIDTH, DEPTH, PLATE, PLATE + 50 * H, H)
        stream = lattice(WIDTH, DEPTH, 30e-3, 60 * H, H,
                         lambda x, z: abs(x - 0.05) < np.where(z > 0.075, 10, 5) * H)
        in_bed = np.arange(len(bed) + len(stream)) < len(bed)
        velocity = np.zeros((len(in_bed), 3))
        velocity[:, 2] = np.where(in_bed, -0.2, -1)
        packing = np.where(in_bed, 0.6, 0.4)
        packing[len(bed) - 1] = 0.9  # one particle is no percentile
        cls.frame = Frame(np.vstack([bed, stream]), GATE + 0.2, velocity=velocity, packing=packing,
                          stress_zz=np.where(in_bed, 500, 50), stress_xx=np.where(in_bed, 250, 10))
        cls.run_ = RunInMemory(paper_case(), [cls.frame], gate_time=GATE)

    def of(self, name, **place):
        return measure(name, self.run_, **place)

    def test_width_packing_and_stress(self):
        self.assertAlmostEqual(self.of("stream_narrowing", above_from=0.09, above_to=0.1, below_from=0.04, below_to=0.06), 0.5,
                               delta=0.1)
        below = {"from": 0.04, "to": 0.09}
        self.assertAlmostEqual(self.of("stream_packing", **below), 0.4, places=12)
        of_cells = self.of("stream_packing_of_cells", **below)
        self.assertTrue(0.45 < of_cells < 0.59, "cells at the edges are not full")
        self.assertAlmostEqual(self.of("stream_stress_share", **below), 0.1, places=12)
        self.assertLess(self.of("stream_stripes", **{"from": 0.04, "to": 0.095}), 0.02)

    def test_the_bed_above_it(self):
        across = {"height": 0.12, "left": 0.03, "right": 0.07}
        self.assertAlmostEqual(self.of("hopper_velocity", **across), -0.2, places=9)
        self.assertAlmostEqual(self.of("hopper_packing", **across), 0.6, delta=0.012)
        self.assertAlmostEqual(self.of("surface_swelling", beside=0.02, width=0.004), 0, places=9)
        self.assertAlmostEqual(self.of("swelling_above_flanks", **{"from": 0.022, "to": 0.045, "width": 0.01}), 0, places=9)

    def test_the_ratio_of_stresses_leaves_out_loose_grains(self):
        self.assertAlmostEqual(self.of("stress_ratio_where_dense"), 0.5, places=12)
        frame = Frame(self.frame.positions, GATE + 0.2, packing=np.full(len(self.frame.positions), 0.5))
        self.assertTrue(np.isnan(measure("stress_ratio_where_dense", RunInMemory(paper_case(), [frame], gate_time=GATE))))

    def test_slow_flow_and_gradients_where_bed_and_stream_move_as_blocks(self):
        self.assertAlmostEqual(self.of("inertial_share_of_bearing"), 1)
        self.assertAlmostEqual(self.of("inertial_share_of_bearing_in_shear"), 1, delta=0.01)

    def test_the_percentile_of_packing_away_from_the_impact(self):
        self.assertAlmostEqual(self.of("packing_max_outside_impact", distance=0.02), 0.6, places=12)
        dense = Frame(self.frame.positions, GATE + 0.2,
                      packing=np.where(self.frame.positions[:, 2] < 0.035, 0.8, 0.6))
        run = RunInMemory(paper_case(), [dense], gate_time=GATE)
        self.assertAlmostEqual(measure("packing_max_outside_impact", run, distance=0.05), 0.6, places=12)
        self.assertAlmostEqual(measure("packing_max_outside_impact", run, distance=0.02), 0.8, places=12)


class Impact(unittest.TestCase):
    def of(self, level, points):
        s = snapshot(Frame(points, GATE + 0.2, packing=np.arange(1, len(points) + 1) / 10))
        s.bin_surface = surfaces.Surface((np.arange(50) + 0.5) * 2e-3, np.full(50, level))
        return NUMBERS.packing_max_outside_impact(s, 0.02)

    def test_it_is_the_bins_surface_below_the_slit(self):
        inside, above = (0.05, 0, 0.035), (0.05, 0, 0.041)
        beside, far = (0.085, 0, 0.02), (0.091, 0, 0.02)
        self.assertTrue(np.isnan(self.of(0.02, [inside, beside])))
        self.assertAlmostEqual(self.of(0.02, [above, inside]), 0.1)
        self.assertAlmostEqual(self.of(0.02, [far, inside]), 0.1)
        self.assertAlmostEqual(self.of(np.nan, [beside, inside]), 0.2, delta=2e-4)  # before there is one, the floor


class Foot(unittest.TestCase):
    """A layer on the floor that has come farther on the right than on the left, and falling grains above the floor at the
    wall; then with nothing on the left."""

    @staticmethod
    def reach(left, right):
        points = np.vstack([lattice(WIDTH, DEPTH, 0, 6 * H, H, lambda x, z: (x > 0.05 - left) & (x < 0.05 + right)),
                            lattice(WIDTH, DEPTH, 12 * H, 18 * H, H, lambda x, z: x > 0.09)])
        return Frame(points, GATE + 0.16)

    def test_the_reach(self):
        self.assertAlmostEqual(NUMBERS.foot_reach(snapshot(self.reach(12 * H, 18 * H)), 5e-3), 15 * H, delta=0.4 * H)
        self.assertTrue(np.isnan(NUMBERS.foot_reach(snapshot(self.reach(0, 18 * H)), 5e-3)))

    def test_the_speed(self):
        frames = []
        for n in range(9):
            frame = self.reach((6 + 2 * n) * H, (6 + 2 * n) * H)
            frame.time = GATE + 0.01 * n
            frames.append(frame)
        run = RunInMemory(paper_case(), frames, gate_time=GATE)
        place = {"height": 5e-3, "from": 9 * H, "to": 21 * H}
        self.assertAlmostEqual(measure("foot_speed", run, **place), 2 * H / 0.01, delta=0.02)
        self.assertTrue(np.isnan(measure("foot_speed", run, end=0.035, **place)), "two points")


class SlowFlow(unittest.TestCase):
    """Where grains may be: above the plate, beside the slit below it, in the stream; slow, fast and free ones."""

    def test_the_share(self):
        slow, fast = 0, 1000  # 1/s: I = 0.2 at 2500 Pa
        above, below, beside, middle = PLATE + 0.02, PLATE - 0.02, 0.01, 0.05
        grains = [(beside, above, 2500, slow), (middle, above, 2500, slow), (middle, above, 2500, fast),
                  (middle, above, 0, slow), (beside, below, 2500, slow), (beside, below, 0, slow),
                  (middle, below, 2500, fast), (middle, below, 2500, slow)]
        x, z, pressure, rate = np.array(grains).T
        frame = Frame(np.column_stack([x, 0 * x, z]), GATE + 0.2, shear_rate=rate,
                      **{f"stress_{axis}": pressure for axis in ("xx", "yy", "zz")})
        self.assertEqual(NUMBERS.inertial_share_of_bearing(snapshot(frame)), 3 / 4)
        self.assertEqual(NUMBERS.inertial_share_of_bearing(snapshot(frame, case(WIDTH, DEPTH, HEIGHT, H))), 4 / 6)

    def test_in_shear_the_largest_rate_across_axes_counts(self):
        """Rates of 0.2, 0.9 and 2 times the limit: in simple shear, in stretching, which is none, and in shear by two
        components."""
        limit = 1e-2 / (200e-6 * np.sqrt(2500 / 2500))
        points = lattice(0.06, 0.06, 0.2, 0.26, 1e-2) - (0, 0, 0.1)
        of_case = case(10, 10, 10, 1e-2, bed_height=1e-2)
        for gradient, share in (((0, 0, 0.9, 0, 0, 0, 0, 0, 0), 1), ((9, 0, 0, 0, -9, 0, 0, 0, 0), 1),
                                ((0, 0, 0.6, 0, 0, 0, 0.6, 0, 0), 0)):
            velocity = points @ (limit * np.reshape(gradient, (3, 3))).T
            frame = Frame(points + 5, GATE + 0.2, velocity=velocity,
                          **{f"stress_{axis}": np.full(len(points), 2500) for axis in ("xx", "yy", "zz")})
            run = RunInMemory(of_case, [frame], gate_time=GATE)
            self.assertEqual(measure("inertial_share_of_bearing_in_shear", run), share)


class Gradients(unittest.TestCase):
    UNIT = np.sqrt(200e-6 / 9.8)

    def run_of(self, velocity, packing=0.6):
        frame = Frame(self.points, GATE + 0.2, velocity=velocity, packing=np.full(len(self.points), packing))
        return RunInMemory(self.case, [frame], gate_time=GATE)

    def test_percentiles_over_particles(self):
        self.points = lattice(0.1, 0.05, 0, 0.1, 1e-2) + 5
        self.case = case(10, 10, 10, 1e-2, bed_height=1e-2)
        x, _, z = self.points.T
        velocity = np.column_stack([7 * z - x, 0 * x, 0 * x])
        run = self.run_of(velocity)
        # The mass of a particle, and with it the smoothing length, is that of a lattice of 1 cm.
        self.assertAlmostEqual(measure("velocity_gradient_shear_percentile", run), 7 * self.UNIT, places=9)
        self.assertAlmostEqual(measure("velocity_gradient_normal_percentile", run), self.UNIT, places=9)
        self.assertTrue(np.isnan(measure("velocity_gradient_normal_percentile", self.run_of(velocity, 0.4))))

    def test_cells_are_calmer_than_a_particle_astray(self):
        h = 1e-2
        self.points = lattice(0.2, 0.05, 0, 0.2, h)
        # The floor mirrors velocities: cells from above a plate on, all of which is a slit.
        self.case = case(0.2, 0.05, 0.3, h, 0.06, (0, 0.2), bed_height=h)
        velocity = np.zeros((len(self.points), 3))
        velocity[:, 2] = 7 * self.points[:, 0] - self.points[:, 2]
        # The kernel's mean is not exact for a linear field near the surface and off the lattice.
        run = self.run_of(velocity)
        self.assertAlmostEqual(measure("cell_gradient_shear_max", run), 7 * self.UNIT, delta=0.1 * 7 * self.UNIT)
        self.assertAlmostEqual(measure("cell_gradient_normal_max", run), self.UNIT, delta=0.1 * self.UNIT)
        self.assertLessEqual(measure("cell_gradient_shear_percentile", run), measure("cell_gradient_shear_max", run))
        self.assertLessEqual(measure("cell_gradient_normal_percentile", run), measure("cell_gradient_normal_max", run))
        velocity[len(self.points) // 2, 2] += 1
        self.assertLess(measure("cell_gradient_shear_max", self.run_of(velocity)), self.UNIT / h)


class Cases(unittest.TestCase):
    def test_other_walls_are_not_evaluated(self):
        for tables in ({"wedge": {"half_angle": 0.5}}, {"plates": {"one": {}}}, {"vessel": [{}]}, {"model": "cloud"}):
            with self.assertRaises(NotEvaluated):
                measure("stress_ratio_where_dense", RunInMemory(paper_case(**tables)))
        with self.assertRaises(NotEvaluated):
            measure("stress_ratio_where_dense", RunInMemory(case(WIDTH, DEPTH, HEIGHT, 0.02, PLATE, (0.03, 0.07))))

    def test_snapshots_without_particles_have_no_numbers(self):
        frame = Frame(np.empty((0, 3)), GATE + 1)
        run = RunInMemory(paper_case(), [frame], gate_time=GATE,
                          series=Series(time=[0, 2], discharge_rate=[0, 0], discharged_mass=[0, 0]),
                          snapshots={"time": np.array([1.0])})
        run.summary["wall_seconds"] = 3.0
        lengths = {"from": 0.02, "to": 0.03, "height": 0.12, "left": 0.03, "right": 0.07, "beside": 0.02, "width": 0.004,
                   "distance": 0.02, "size": 0.01, "x": 0.03, "above_from": 0.09, "above_to": 0.1, "below_from": 0.04,
                   "below_to": 0.06}
        for name, quantity in MEASURES.quantities.items():
            if not quantity.together and name not in ("wall_seconds", "discharge_rate_fall"):
                place = {length: lengths[length] for length in quantity.place}
                self.assertFalse(np.isfinite(measure(name, run, 0.1, 0.5, **place)), name)
        self.assertEqual(measure("wall_seconds", run), 3)


if __name__ == "__main__":
    unittest.main()
