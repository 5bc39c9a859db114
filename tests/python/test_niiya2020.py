# SPDX-License-Identifier: Apache-2.0
"""Heads and frontal angles of validation/niiya2020, of lattices whose numbers are known."""
import math
import sys
import types
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python"), str(PROJECT / "validation" / "niiya2020")]

import numpy as np  # noqa: E402
from avalanche import SNAPSHOT_NUMBERS, View  # noqa: E402
from curves import mean_and_deviation, nearest_gaussian, gaussian  # noqa: E402

from talus import grains  # noqa: E402


def block(corner, nx, ny, spacing=2.0):
    """A square lattice in the plane x, y."""
    return np.array([(corner[0] + i * spacing, corner[1] + j * spacing, 0) for j in range(ny) for i in range(nx)])


def bow(centre, columns):
    """Unit grains, 2 apart: 4 layers from x = -6 to 0, and behind the outermost three columns of each side two legs of 4 more
    layers. Width 2 `columns`, thickness 8."""
    left = centre - (columns - 1)
    return np.concatenate([block((-6, left), 4, columns), block((-14, left), 4, 3), block((-14, centre + columns - 5), 4, 3)])


def heads_of(points):
    return grains.find_heads(points, 1)


class Heads(unittest.TestCase):
    def test_two_bows_and_a_crumb(self):
        small, large = bow(100, 21), bow(0, 31)
        points = np.concatenate([small, large, block((0, -100), 1, 19)])
        heads = heads_of(points)
        self.assertEqual([list(head) for head in heads],
                         [list(range(len(small), len(small) + len(large))), list(range(len(small)))])
        for head, width, centre in zip(heads, (62, 42), (0, 100)):
            size = grains.head_size(points, np.ones(len(points)), head, 1)
            self.assertEqual((size.width, size.thickness, size.left + size.right), (width, 8, 2 * centre))
            self.assertTrue(set(size.grains) <= set(head))

    def test_the_least_number_of_grains(self):
        five = block((0, 0), 1, 5)
        self.assertEqual((len(heads_of(five)), len(heads_of(five[:4])), len(heads_of(five[:1]))), (1, 0, 0))

    def test_a_thin_bridge_does_not_merge_two(self):
        bridge = np.array([(9, y, 0) for y in range(21, 59, 3)])
        points = np.concatenate([block((0, 0), 10, 10), block((0, 60), 10, 10), bridge])
        i, j = grains.pairs(points, 4)
        self.assertFalse(grains.connected(len(points), i, j).any(), "linked, they are one part")
        self.assertEqual(len(heads_of(points)), 2)

    def test_a_weak_head_takes_its_own_largest_number_for_its_rim(self):
        # Inside, a lattice of spacing 1 has n = 44 and n' = 44², one of spacing 1.3 n = 28 and n' = 28².
        points = np.concatenate([block((0, 0), 20, 20, 1), block((0, 100), 16, 16, 1.3)])
        i, j = grains.pairs(points, 4)
        direct = np.bincount(i, minlength=len(points))
        indirect = np.bincount(i, weights=direct[j], minlength=len(points))
        self.assertEqual((indirect[10 * 20 + 10], indirect[400 + 8 * 16 + 8]), (44**2, 28**2))
        weak = np.arange(400, len(points))
        with_rim = weak[indirect[weak] > 28**2 / 4]
        self.assertGreater(len(with_rim), (indirect[weak] > 44**2 / 4).sum())
        self.assertEqual(list(heads_of(points)[1]), list(with_rim))

    def test_a_part_far_weaker_than_the_strongest_has_none(self):
        few = block((0, 100), 3, 3)
        self.assertEqual(len(heads_of(np.concatenate([block((0, 0), 20, 20, 1), few]))), 1)
        self.assertEqual(len(heads_of(few)), 1, "alone it is one")

    def test_a_tail_is_no_part_of_the_head(self):
        # In the tail n' = 25; of the last two n' = 3 + 5 + 5 = 13 is below 64 / 4.
        [head] = heads_of(np.concatenate([block((0, 0), 10, 10), block((-40, 8), 20, 2)]))
        self.assertEqual(len(head), 138)

    def test_the_order_of_the_grains_and_the_side_do_not_matter(self):
        rng = np.random.default_rng(5)
        points = rng.uniform(-60, 60, (800, 3)) * [1, 1, 0]
        points, radii = points[np.linalg.norm(points, axis=1) < 60], rng.uniform(0.95, 1.05, 800)
        order = rng.permutation(len(points))
        heads, turned = heads_of(points), heads_of(points[order] * [1, -1, 1])
        self.assertGreater(len(heads), 2)
        for one, other in zip(heads, turned, strict=True):
            self.assertEqual(set(one), set(order[other]))
            a = grains.head_size(points, radii, one, 1)
            b = grains.head_size(points[order] * [1, -1, 1], radii[order], other, 1)
            self.assertAlmostEqual(a.width, b.width, places=12)
            self.assertEqual((a.thickness, a.left), (b.thickness, -b.right))

    def test_size_by_the_grains_own_radii(self):
        points, radii = np.array([(0, -5, 0), (0, 5, 0), (2, 0, 0), (-1, 1, 0)]), np.array([0.5, 2, 1, 0.25])
        size = grains.head_size(points, radii, np.arange(4), 1)
        self.assertEqual((size.width, size.left + size.right, size.foremost, size.inner), (12.5, 1.5, 3, -1.25))

    def test_a_gap_outside_the_central_half_does_not_count(self):
        points = block((-6, -30), 4, 31)
        head = np.flatnonzero(~((points[:, 1] > 17) & (points[:, 1] < 27) & (points[:, 0] < 0)))
        self.assertEqual(grains.head_size(points, np.ones(len(points)), head, 1).thickness, 8)


def wall(layers, columns, shift):
    """Columns of unit grains, each backwards lower by a little; each layer moved by `shift`. The front column comes first."""
    return np.array([(-2.0 * c + shift * k, 0, 1 + 2.0 * k - 0.01 * c) for c in range(columns) for k in range(layers)])


def triangle(side):
    """Equilateral, of unit grains, 2 apart, its base on the slope."""
    return np.array([(-2.0 * n - k, 0, 1 + k * math.sqrt(3)) for k in range(side) for n in range(side - k)])


def angle(points):
    return math.degrees(grains.angle_of_line(points, grains.surface_walk(points, 1)))


class FrontalAngle(unittest.TestCase):
    def test_of_a_triangle_and_walls(self):
        walk = grains.surface_walk(triangle(12), 1)
        self.assertEqual((len(walk), walk[0]), (12, 0))
        self.assertAlmostEqual(angle(triangle(12)), 60, places=9)
        self.assertAlmostEqual(angle(np.concatenate([triangle(12), [(50, 0, 1)]])), 60, places=9, msg="a grain far ahead")
        self.assertAlmostEqual(angle(wall(10, 8, 0)), 90, places=9)
        self.assertAlmostEqual(angle(wall(10, 8, -0.5)), math.degrees(math.atan2(2, 0.5)), places=9)
        self.assertEqual(len(grains.surface_walk(wall(10, 8, 0.5), 1)), 1, "the foremost of an overhang is its top")

    def test_grains_below_the_foremost_take_no_part(self):
        below = wall(4, 8, 0.5) + [-2, 0, -8]
        walk = grains.surface_walk(np.concatenate([wall(10, 8, -0.5), below]), 1)
        self.assertEqual((len(walk), walk.max()), (10, 9))

    def test_the_walk_ends_at_a_grain_that_sticks_out_and_at_a_gap(self):
        points = triangle(12)
        bump = (points[12 + 11][0] + 1, 0, 1 + 3 * math.sqrt(3) + 0.02)
        walk = grains.surface_walk(np.concatenate([points, [bump]]), 1)
        self.assertEqual(walk[-1], len(points))
        self.assertLess(len(walk), 12)
        upper = wall(5, 4, 0) + [0, 0, 11.5]  # linked at 3.5, but no step of 3
        self.assertEqual(len(grains.surface_walk(np.concatenate([wall(5, 4, 0), upper]), 1)), 5)

    def test_the_line_turns_with_the_grains(self):
        flat, all_ = np.array([(-3, 0, 0.4), (-1, 0, -0.3), (0.5, 0, 0.2), (2, 0, -0.1), (4, 0, 0.1)]), np.arange(5)
        own = grains.angle_of_line(flat, all_)
        for turn in np.radians(range(5, 175, 10)):
            turned = np.array([(x * math.cos(turn) + z * math.sin(turn), 0, z * math.cos(turn) - x * math.sin(turn))
                               for x, _, z in flat])
            self.assertAlmostEqual((grains.angle_of_line(turned, all_) - own - turn + 2.5 * math.pi) % math.pi, math.pi / 2,
                                   places=12)
        self.assertLess(grains.angle_of_line(np.array([(0, 0, 0), (-1, 0, 2), (-2, 0, 4.5)]), [0, 1, 2]), math.pi / 2,
                        "it leans back")


class Snapshots(unittest.TestCase):
    def view(self, positions, from_the_side):
        run = types.SimpleNamespace(radius=1.0, speed=1.0, from_the_side=from_the_side)
        columns = {"radius": np.ones(len(positions)), "velocity": np.zeros((len(positions), 3))}
        view = View.__new__(View)
        view.run, view.a, view.positions = run, 1.0, np.array(positions, dtype=float)
        view.radii, view.velocity = columns["radius"], columns["velocity"]
        return {name: SNAPSHOT_NUMBERS[name](view)
                for name in ("head_count", "head_particles", "head_width", "head_thickness", "frontal_angle")}

    def test_from_above_and_from_the_side(self):
        above = self.view(bow(0, 31), False)
        self.assertTrue(math.isnan(above.pop("frontal_angle")))
        self.assertEqual(list(above.values()), [1, 4 * 31 + 24, 62, 8])
        none = self.view(np.zeros((1, 3)), False)
        self.assertEqual((none["head_count"], none["head_particles"], math.isnan(none["head_width"])), (0, 0, True))
        side = self.view(triangle(12), True)
        self.assertAlmostEqual(side["frontal_angle"], 60, places=9)
        self.assertTrue(math.isnan(side["head_count"]) and math.isnan(side["head_width"]))
        self.assertTrue(math.isnan(self.view(triangle(1), True)["frontal_angle"]), "of fewer than three grains")


class Numbers(unittest.TestCase):
    def test_members_that_lack_a_number_are_left_out(self):
        mean, deviation = mean_and_deviation(np.array([[1, 2, np.nan], [3, np.nan, np.nan]]))
        np.testing.assert_array_equal(mean, [2, 2, np.nan])
        np.testing.assert_allclose(deviation, [np.sqrt(2), 0, 0])

    def test_the_nearest_gaussian(self):
        x = np.arange(1, 31, 2.0)
        np.testing.assert_allclose(nearest_gaussian(x, gaussian(x, 12.3, 2.7)), (12.3, 2.7), rtol=1e-8)
        self.assertIsNone(nearest_gaussian(x, np.where(x == 7, 0.5, 0)), "all in one bin")


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
