# SPDX-License-Identifier: Apache-2.0
"""Points that nobody's run made, as `talus analyze --as` measures them: talus.lab.analyze on lattices."""
import math
import os
import subprocess
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]
PROGRAM = os.path.abspath(sys.argv.pop())

import numpy as np  # noqa: E402

from talus.grains import head_size, pairs  # noqa: E402
from talus.lab import analyze  # noqa: E402
from talus.surfaces import Surface, heap_slopes, surface_angle  # noqa: E402
from talus.trouble import InputError  # noqa: E402

A = 0.5e-3  # m


def roof(angle, corner):
    """Spheres 2 a apart on a simple cubic lattice, `angle` degrees steep on both sides, 200 of them wide."""
    height = [0.01 + math.tan(math.radians(angle)) * (0.1 - abs((i - 99.5) * 2 * A)) for i in range(200)]
    return np.array([(i, j, k) for i in range(200) for j in range(3)
                     for k in range(math.ceil(height[i] / (2 * A) - 0.5))]) * 2 * A + corner


def measured(name, position, column=None, bins=20, a=A, **columns):
    columns = {"position": ("m", np.array(position, dtype=float)), **columns}
    quantities, _, rows = analyze.MEASURES[name](analyze.points_of("points", columns, a), column, bins)
    return {key: value for key, (_, value) in quantities.items()}, rows


class Heaps(unittest.TestCase):
    def test_angle_of_repose_of_a_roof_anywhere(self):
        for angle in (15, 25, 33):
            found, slopes = measured("repose", roof(angle, (-3, 7, 2)))
            self.assertAlmostEqual(found["repose_angle"], angle, delta=0.5)
            self.assertAlmostEqual(found["repose_angle_left"], found["repose_angle_right"], delta=1e-6)
            self.assertEqual(len(slopes), 2)

    def test_surface_of_a_roof(self):
        found, rows = measured("surface", roof(25, (0, 0, A)))
        self.assertEqual(len(rows), 200)
        self.assertAlmostEqual(found["surface_angle"], 25, delta=0.5)
        self.assertAlmostEqual(found["surface_z_max"], 0.01 + 0.1 * math.tan(math.radians(25)), delta=2 * A)

    def test_packing_of_a_lattice(self):
        found, rows = measured("packing", roof(0, (0, 0, 0)))
        for value in (found["packing_median"], found["packing_max"], rows[5][1]):
            self.assertAlmostEqual(value, math.pi / 6, delta=0.015)
        self.assertLess(rows[-1][1], 1e-9, "above the heap")

    def test_slopes_end_at_gaps_and_a_middle_column_is_of_both_sides(self):
        x = np.arange(41.0)
        z = 20 - np.abs(x - 20)
        self.assertEqual([(s.start, s.end, round(s.slope, 12)) for s in heap_slopes(Surface(x, z), 10)],
                         [(0, 20, 1), (20, 40, -1)])
        z[8] = np.nan
        self.assertEqual([(s.start, s.end) for s in heap_slopes(Surface(x, z), 10)], [(9, 20), (20, 40)])
        self.assertTrue(math.isnan(surface_angle(Surface(x[19:22], z[19:22]), 20)), "two heights a side")
        self.assertAlmostEqual(surface_angle(Surface(x[18:23], z[18:23]), 20), math.pi / 4, places=12)


class Columns(unittest.TestCase):
    def test_means_of_a_column_in_layers(self):
        # Three layers of 2, 1 and 3 points; none in between.
        position = [(0, 0, 1), (1, 0, 1.5), (0, 0, 4.5), (0, 0, 10), (1, 0, 10.5), (2, 0, 11)]
        stress = {"stress_zz": ("Pa", np.array([70, 90, 40, 1, 2, 6]))}
        _, rows = measured("layers", position, "stress_zz", 5, 0.5, **stress)
        self.assertEqual(rows, [[1.25, 80, 2], [4.5, 40, 1], [10.5, 3, 3]])
        with self.assertRaisesRegex(InputError, "points has no such column.*did you mean 'stress_zz'"):
            measured("layers", position, "stress_xy", 5, 0.5, **stress)
        _, [[height, mean, _]] = measured("layers", position, "position_z", 1, 0.5)
        self.assertAlmostEqual(height, mean, places=14)

    def test_bins_hold_their_lower_edges_and_the_last_its_upper(self):
        found, rows = measured("histogram", np.zeros((6, 3)), "size", 2, 1, size=("m", np.array([0, 0.5, 1, 1.5, 2, 2])))
        self.assertEqual([row[:2] for row in rows], [[0.5, 2], [1.5, 4]])
        self.assertAlmostEqual(rows[1][2], 4 / 6)
        self.assertEqual(measured("histogram", np.zeros((6, 3)), "size", 2, 1, size=("m", np.ones(6)))[1], [])


class Avalanches(unittest.TestCase):
    def test_pairs_are_those_of_a_plain_search(self):
        positions = np.random.default_rng(5).uniform(-3, 9, (400, 3)) * [1, 2, 0.1]
        distance = np.linalg.norm(positions[:, None] - positions[None], axis=2)
        i, j = np.nonzero((distance < 1.3) & ~np.eye(400, dtype=bool))
        self.assertGreater(len(i), 400)
        for found, expected in zip(pairs(positions, 1.3), (i, j)):
            np.testing.assert_array_equal(found, expected)

    def test_a_crescent_is_concave(self):
        across = np.arange(-10, 11)
        bow = np.array([(-0.05 * y * y - 2 * layer, 2.0 * y, 0) for y in across for layer in range(3)])
        size = head_size(bow, np.ones(len(bow)), np.arange(len(bow)), 1.0)
        self.assertAlmostEqual(size.concavity, (size.inner - (bow[:, 0].min() - 1)) / size.thickness)
        self.assertGreater(size.concavity, 0)
        self.assertTrue(math.isnan(head_size(bow[:1], np.ones(1), [0], 1.0).concavity))

    def test_thickness_and_velocities_of_head_and_tail(self):
        position = np.array([(-4.0 * n, 0, z) for n in range(8) for z in (0, 5 if n < 3 else 1)])
        found, _ = measured("head-tail", position, a=1.0, velocity=("m/s", np.tile([2.0, 0, 0], (16, 1))))
        self.assertEqual((found["front_thickness"], found["rear_thickness"], found["head_length"]), (6, 2, 12))
        self.assertEqual(found["tail_velocity_x"], 2)

    def test_front(self):
        found, _ = measured("front", [(0, 0, 0), (3, 0, 1), (5, 0, 4)], a=1.0, velocity=("m/s", np.eye(3)))
        self.assertEqual(found, {"front_x": 5, "front_on_slope_x": 3, "front_velocity_x": 0})


class Faults(unittest.TestCase):
    def test_what_points_need(self):
        for columns, radius, told in (
                ({"position": ("m", np.empty((0, 3)))}, 1, "holds no points"),
                ({"position": ("m", np.zeros((1, 3)))}, None, "has no column 'radius'"),
                ({"position": ("m", np.zeros((1, 3))), "radius": ("m", np.zeros(1))}, None, "radii that are not above 0"),
                ({"position": ("m", np.array([[0, 0, 0], [2e6, 0, 0]]))}, 1, "a million radii apart"),
                ({"position": ("m", np.array([[0, 0, 0], [np.nan, 0, 0]]))}, 1, "not finite")):
            with self.assertRaisesRegex(InputError, told):
                analyze.points_of("points", columns, radius)

    def test_help_lists_every_measure(self):
        said = subprocess.run([PROGRAM, "analyze", "--help"], capture_output=True, text=True, check=True).stdout
        listed = [line.split()[0] for line in said.splitlines() if line.startswith("  ") and line[2:3].isalpha()]
        self.assertEqual([name for name in listed if name in analyze.MEASURES], list(analyze.MEASURES))


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
