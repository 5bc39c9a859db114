# SPDX-License-Identifier: Apache-2.0
"""The package's curves, fields of particles and surfaces, on what is known exactly.

Usage: test_fields.py TALUS
"""
import sys
import unittest
from pathlib import Path

sys.argv.pop()
sys.path[:0] = [str(Path(__file__).resolve().parent), str(Path(__file__).resolve().parents[2] / "python")]

import numpy as np  # noqa: E402
from runs_in_memory import lattice  # noqa: E402
from talus import curves, surfaces  # noqa: E402
from talus.fields import Box, Field, Grains, Plate, cell_centres, cubic_spline, packing_section  # noqa: E402

PI = np.pi
CLOSED = ("wall", "wall", "symmetry", "symmetry", "wall", "open")
OPEN = ("open",) * 6


def grains(points, h, packing=0.6):
    count = len(points)
    return Grains(points, np.full(count, h), np.full(count, h**3), np.full(count, packing * h**3))


def sampled(start, end, step, function):
    time = start + np.arange(int((end - start) / step + 1e-9) + 1) * step
    return curves.curve(time, function(time))


class Rates(unittest.TestCase):
    def test_means_of_a_linear_rate_are_its_value_in_the_middle(self):
        """Q = 2 + 3 t on uneven times."""
        n = np.arange(2001)
        time = 1e-3 * n + 2e-4 * np.sin(n)
        passed = curves.curve(time, 2 * time + 1.5 * time**2)
        self.assertAlmostEqual(curves.mean_rate(passed, 0.4, 0.6), 3.5, delta=1e-4)
        means = curves.mean_rates(passed, 0.1, 0.05, 0.2, 1.0)
        self.assertEqual(len(means.time), 15)
        np.testing.assert_allclose(means.value, 2 + 3 * means.time, atol=1e-4)
        self.assertAlmostEqual(curves.drift(passed, 0.1, 0.2, 1.0), 3 * 0.8 / (2 + 3 * 0.6), delta=1e-3)
        self.assertTrue(np.isnan(curves.mean_rate(passed, 1.9, 2.1)))
        self.assertTrue(np.isnan(curves.drift(passed, 0.1, 1, 3)))
        self.assertEqual(len(curves.mean_rates(curves.EMPTY, 0.1, 0.1, 0, 1).time), 0)

    def test_the_integral_of_a_line(self):
        self.assertAlmostEqual(curves.integral(sampled(0, 2, 0.1, lambda t: 4 * t)).value[-1], 8, places=12)

    def test_a_part_has_its_end_and_not_its_start(self):
        part = curves.part(curves.curve([0, 0.1, 0.2, 0.1 + 0.2], [1, 2, 3, 4]), 0.1, 0.3)
        np.testing.assert_array_equal(part.value, [3, 4])
        self.assertEqual(len(curves.part(part, 0, np.inf).time), 2)

    def test_the_first_time_below_a_level(self):
        curve = curves.curve([0, 1, 2, 3], [4, np.nan, 3, 1])
        self.assertAlmostEqual(curves.first_time_at_or_below(curve, 2), 2.5)
        self.assertEqual(curves.first_time_at_or_below(curve, 4), 0)
        self.assertTrue(np.isnan(curves.first_time_at_or_below(curve, 0)))

    def test_the_fluctuation_of_a_sinusoid_on_a_trend(self):
        curve = sampled(0, 1, 1e-4, lambda t: 3 + 2 * t + 0.5 * np.sin(2 * PI * t / 5e-3))
        rest = curves.about_running_mean(curve, 20e-3, 0.1, 0.9)
        self.assertAlmostEqual(curves.standard_deviation(rest.value), 0.5 / np.sqrt(2), delta=1e-3)
        ended = curves.Curve(curve.time, np.where(curve.time < 0.5, curve.value, np.nan))
        rest = curves.about_running_mean(ended, 20e-3, 0.1, 0.9)
        self.assertAlmostEqual(rest.time[-1], 0.49, delta=2e-4)

    def test_the_nearest_of_two_equally_near_is_the_earlier(self):
        self.assertEqual(curves.nearest_point([0, 1, 2], 0.5), 0)
        self.assertEqual(curves.nearest_point([0, 1, 2], 1.6), 2)


class Spectra(unittest.TestCase):
    @staticmethod
    def two(size):
        return sampled(0, 0.25, 1 / 5000, lambda t: 5 + 30 * t + np.sin(2 * PI * t / 0.005 + 1) +
                       size * np.sin(2 * PI * t / 0.012))

    def test_the_power_of_a_sinusoid_has_a_peak_of_a_quarter_of_its_square(self):
        curve = sampled(0, 0.5, 1 / 5000, lambda t: 2 + 3 * t + 0.8 * np.sin(2 * PI * t / 0.005))
        frequency, power = curves.power_spectrum(curve, 50, 500)
        self.assertAlmostEqual(power.max(), 0.16, delta=1e-3)
        self.assertAlmostEqual(1 / frequency[power.argmax()], 0.005, delta=1e-5)
        with self.assertRaises(ValueError):
            curves.power_spectrum(curves.curve([0, 1, 2], [0, 1, 0]), 0.1, 1)

    def test_the_higher_of_two_peaks_is_dominant(self):
        self.assertAlmostEqual(curves.dominant_period(self.two(0.7), 2e-3, 20e-3), 0.005, delta=5e-5)
        self.assertAlmostEqual(curves.dominant_period(self.two(1.4), 2e-3, 20e-3), 0.012, delta=1.5e-4)
        self.assertAlmostEqual(curves.dominant_period(self.two(1.4), 2e-3, 9e-3), 0.005, delta=5e-5)

    def test_without_a_peak_there_is_no_period(self):
        self.assertTrue(np.isnan(curves.dominant_period(sampled(0, 0.25, 1 / 5000, lambda t: 2 + 0 * t), 2e-3, 20e-3)))
        self.assertTrue(np.isnan(curves.dominant_period(curves.EMPTY, 2e-3, 20e-3)))

    def test_equal_times_are_interpolated(self):
        curve = curves.curve([0, 0.1, 0.4, 1.0], [0, 1, 4, 10])
        equal = curves.at_equal_times(curve, 10, 0.2, 0.8)
        self.assertEqual(len(equal.time), 7)
        np.testing.assert_allclose(equal.value, 10 * equal.time, rtol=1e-12)
        self.assertEqual(len(curves.at_equal_times(curve, 10, 0.2, 1.2).time), 0)

    def test_crossings_count_the_periods_of_a_sinusoid(self):
        curve = sampled(0, 0.25, 1 / 5000, lambda t: np.sin(2 * PI * t / 0.0066 + 0.7))
        self.assertAlmostEqual(curves.crossing_period(curve), 0.0066, delta=1e-6)
        self.assertTrue(np.isnan(curves.crossing_period(sampled(0, 0.25, 2e-4, lambda t: t - 0.1))), "one crossing")


class Fields(unittest.TestCase):
    H = 1e-2

    def bed(self, width=0.1, depth=0.03, faces=CLOSED, plate=None, height=0.1):
        points = lattice(width, depth, 0, height, self.H)
        return points, Field(grains(points, self.H), Box((width, depth, 0.3), faces, plate))

    def test_a_lattice_has_its_packing_up_to_the_walls(self):
        _, field = self.bed()
        places = [(0.05, 0.015, 0.05), (0.055, 0.015, 0.055), (0, 0, 0), (0.1, 0.03, 0.003), (0.001, 0.002, 0.05),
                  (0.033, 0, 0.017)]
        np.testing.assert_allclose(field.packing(np.array(places)), 0.6, atol=0.012)
        self.assertAlmostEqual(field.packing(np.array([(0.05, 0.015, 0.1)]))[0], 0.3, delta=0.006)
        self.assertEqual(field.packing(np.array([(0.05, 0.015, 0.12)]))[0], 0)

    def test_means_are_exact_for_a_constant_and_vectors_of_images_are_mirrored(self):
        points, field = self.bed(depth=0.05)
        velocity = np.tile([1.0, 2.0, 3.0], (len(points), 1))
        packing, mean = field.packing_and_mean(np.array([(0.0431, 0.021, 0.0387), (0, 0.025, 0.055), (0.05, 0.02, 0.2)]),
                                               velocity)
        np.testing.assert_allclose(mean[0], [1, 2, 3], rtol=1e-12)
        np.testing.assert_allclose(mean[1], [0, 2, 3], atol=1e-12)
        self.assertTrue(np.isnan(mean[2]).all() and packing[2] == 0)

    def test_as_printed_faces_leave_velocities_as_they_are(self):
        points, field = self.bed(depth=0.05, faces=("free-as-printed", *CLOSED[1:]))
        velocity = np.tile([1.0, 2.0, 3.0], (len(points), 1))
        np.testing.assert_allclose(field.packing_and_mean(np.array([(0, 0.025, 0.055)]), velocity)[1][0], [1, 2, 3])

    def test_what_leaves_a_periodic_face_enters_the_other(self):
        points, field = self.bed(faces=("periodic", "periodic", *CLOSED[2:]))
        velocity = np.column_stack([np.zeros(len(points)), points[:, 0], np.zeros(len(points))])
        middle = field.packing_and_mean(np.array([(0, 0.015, 0.055)]), velocity)[1][0]
        self.assertAlmostEqual(middle[1], 0.05, delta=1e-9)

    def test_a_plate_is_seen_through_its_open_slit_alone(self):
        plate = Plate(0.1, ())
        _, shut = self.bed(plate=plate)
        self.assertEqual(shut.packing(np.array([(0.05, 0.015, 0.105)]))[0], 0)
        self.assertAlmostEqual(shut.packing(np.array([(0.05, 0.015, 0.0999)]))[0], 0.6, delta=0.012)
        _, opened = self.bed(plate=Plate(0.1, (0.03, 0.07)))
        above, within, beside = opened.packing(np.array([(0.05, 0.015, 0.105), (0.05, 0.015, 0.0999), (0.01, 0.015, 0.105)]))
        self.assertGreater(above, 0.05)
        self.assertAlmostEqual(within, 0.3, delta=0.012)
        self.assertEqual(beside, 0)

    def test_thin_particles_reach_farther(self):
        """The sum of two, of different smoothing lengths, one of them beyond the reach of the other's."""
        of = Grains(np.array([(0.5, 0.5, 0.5), (0.5, 0.5, 0.6)] + [(0.1, 0.5, 0.5)] * 8), np.array([0.02, 0.08] + [0.02] * 8),
                    np.full(10, 1.0), np.full(10, 2.0))
        field = Field(of, Box((1, 1, 1), OPEN))
        at = np.array([(0.5, 0.5, 0.52)])
        self.assertAlmostEqual(field.packing(at)[0], 2 * (cubic_spline(0.02, 0.02) + cubic_spline(0.08, 0.08)), places=6)

    def test_gradients_are_exact_for_linear_velocities(self):
        points = lattice(0.1, 0.05, 0, 0.1, self.H)
        points[:, 0] += 2e-3 * np.sin(np.arange(len(points)))  # no lattice
        exact = np.array([[2, 0, -3], [0.5, 1, 0], [4, -1, 6.0]])
        gradient = Field(grains(points, self.H), Box((0.1, 0.05, 0.2), CLOSED)).velocity_gradients(points @ exact.T)
        inner = (abs(points[:, 0] - 0.05) < 0.02) & (points[:, 1] == 0.025) & (points[:, 2] == 0.055)
        self.assertTrue(inner.any())
        np.testing.assert_allclose(gradient[inner], np.broadcast_to(exact, (inner.sum(), 3, 3)), atol=1e-11)

    def test_a_gradient_beside_open_space_is_exact_too_and_of_one_alone_zero(self):
        points = np.vstack([lattice(0.1, 0.05, 0, 0.1, self.H), [(0.5, 0.5, 0.5)]])
        velocity = np.column_stack([7 * points[:, 2] - points[:, 0], np.zeros(len(points)), np.zeros(len(points))])
        gradient = Field(grains(points, self.H), Box((1, 1, 1), OPEN)).velocity_gradients(velocity)
        np.testing.assert_allclose(gradient[:-1, 0], np.broadcast_to([-1, 0, 7], (len(points) - 1, 3)), atol=1e-11)
        np.testing.assert_array_equal(gradient[-1], np.zeros((3, 3)))

    def test_particles_of_a_density(self):
        of = Grains.of_density(np.zeros((2, 3)), [1500, 12], 12e-3, 2500)
        np.testing.assert_allclose(of.volume, [8e-6, 1e-3])
        np.testing.assert_allclose(of.smoothing_length, [0.02, 0.1])
        self.assertAlmostEqual(of.solid_volume[0], 4.8e-6)
        self.assertEqual(Grains.of_density(np.zeros((1, 3)), [1500], 12e-3, 2500, 0.03).smoothing_length[0], 0.03)

    def test_the_centre_of_a_cell(self):
        np.testing.assert_allclose(cell_centres([[0.05, 0.0025, 0.105]], 1.25e-3), [[50.625e-3, 3.125e-3, 105.625e-3]])


class Sections(unittest.TestCase):
    H, WIDTH, DEPTH, HEIGHT = 2e-3, 0.2, 0.006, 0.2

    def section(self, is_there, plate=None):
        points = lattice(self.WIDTH, self.DEPTH, 0, self.HEIGHT, self.H, is_there)
        self.of, self.box = grains(points, self.H), Box((self.WIDTH, self.DEPTH, self.HEIGHT), CLOSED, plate)
        return packing_section(self.of, self.box, self.H, 0.5 * self.H)

    def surface(self, z):
        return surfaces.free_surface(self.section(lambda x, at: at < z(x)), 0, self.HEIGHT, True)

    def test_a_section_is_the_mean_over_the_depth(self):
        section = self.section(lambda x, z: (x + z < 0.15) & (z < 0.1), Plate(0.06, (0.05, 0.15)))
        self.assertEqual(section.value.shape, (200, 100))
        field = Field(self.of, self.box)
        y = (np.arange(48) + 0.5) * self.DEPTH / 48
        for column, row in ((0, 0), (50, 58), (50, 60), (49, 59), (70, 5), (80, 61), (24, 99)):
            places = np.column_stack([np.full(48, section.x[column]), y, np.full(48, section.z[row])])
            self.assertAlmostEqual(section.value[row, column], field.packing(places).mean(), delta=1e-6)

    def test_a_level_bed_has_its_height(self):
        surface = self.surface(lambda x: 0.1 + 0 * x)
        np.testing.assert_allclose(surface.z, 0.1, atol=0.02 * self.H)
        self.assertEqual(len(surface.x), 100)

    def test_a_wedge_has_its_slope(self):
        for angle in (10, 20, 30, 35):
            slope = np.tan(np.radians(angle))
            surface = self.surface(lambda x, slope=slope: 0.03 + slope * x)
            np.testing.assert_allclose(surface.z[5:95], 0.03 + slope * surface.x[5:95], atol=self.H)
            self.assertAlmostEqual(curves.line(surface.x, surface.z)[1], slope, delta=0.01)

    def test_a_parabola_swells(self):
        surface = self.surface(lambda x: 0.12 - 4 * (x - 0.1)**2)
        self.assertAlmostEqual(surfaces.swelling(surface, 0.1, 0.05, 0.02), 4 * 0.05**2, delta=0.2 * self.H)

    def test_a_falling_stream_is_no_surface(self):
        section = self.section(lambda x, z: (z < 0.04) | ((abs(x - 0.1) < 0.02) & (z > 0.05)) |
                               ((abs(x - 0.05) < 0.005) & (z > 0.1) & (z < 0.12)))
        np.testing.assert_allclose(surfaces.free_surface(section, 0, 0.15, False).z, 0.04, atol=0.1 * self.H)
        from_above = surfaces.free_surface(section, 0, 0.15, True)
        self.assertAlmostEqual(from_above.z[abs(from_above.x - 0.05).argmin()], 0.12, delta=0.1 * self.H)
        joined = self.section(lambda x, z: (z < 0.04) | (abs(x - 0.1) < 0.02))
        hidden = surfaces.free_surface(joined, 0, 0.15, False)
        self.assertTrue(np.isnan(hidden.z[abs(hidden.x - 0.1).argmin()]))
        self.assertAlmostEqual(hidden.mean_height(0, self.WIDTH), 0.04, delta=0.1 * self.H)

    def test_flanks_leave_out_what_falls_on_the_middle(self):
        x = np.arange(100) + 0.5
        away, slope = abs(x - 50), np.tan(np.radians(20))
        z = np.where((x < 5) | (x > 95), 99, np.where(away < 20, 60, 50 - slope * away))
        surface = surfaces.Surface(x, z)
        self.assertAlmostEqual(np.degrees(surfaces.outward_angle(surface, 50, 22, 45)), 20, places=9)
        self.assertAlmostEqual(surfaces.swelling_above_flanks(surface, 50, 22, 45, 10), 10, places=9)
        self.assertTrue(np.isnan(surfaces.swelling_above_flanks(surface, 50, 44, 45, 10)), "two heights are no line")
        right = surfaces.Surface(x, np.where(x > 50, z, np.nan))
        self.assertAlmostEqual(np.degrees(surfaces.outward_angle(right, 50, 22, 45)), 20, places=9)
        self.assertAlmostEqual(surfaces.height_beside(surface, 50, 22, 24), 50 - slope * 23, places=9)


if __name__ == "__main__":
    unittest.main()
