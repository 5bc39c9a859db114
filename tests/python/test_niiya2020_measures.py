# SPDX-License-Identifier: Apache-2.0
"""The quantities of validation/niiya2020, of avalanches whose numbers are known."""
import math
import sys
import tomllib
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python"), str(PROJECT / "validation/niiya2020")]

import avalanche  # noqa: E402
import numpy as np  # noqa: E402

from talus import samples  # noqa: E402
from talus.curves import curve, part  # noqa: E402
from talus.measures import Measures, NotEvaluated, Window, table  # noqa: E402

STUDY = PROJECT / "validation/niiya2020"
MEASURES = Measures(STUDY)


class Synthetic(avalanche.Avalanche):
    """A run to t = 20 with 10 data, 2 apart. Front speed: 30 + 4 t up to t = 5, then 50 - (t - 5) - (t - 10)/2 if t > 10.
    Grains in the head: 2000 - 150 t, of 2000; width (60 - t) a, a quarter of it the thickness, but for t = 10. `shift` is
    added to the front speed."""

    def __init__(self, shift=0.0, radius=1.0, width_shift=0.0):
        self.radius, self.speed, self.unit, self.grains, self.from_the_side = radius, 1.0, radius, 2000, False
        self.contact_weight_ratio = 20.7
        t = 0.25 * np.arange(1, 81)
        self.front_speed = t, self.speed_at(t) + shift
        self.front_speed_last = self.speed_at(20.0) + shift
        self.time = t = 2.0 * np.arange(11)
        width = (60 - t) * radius
        self.columns = {
            "front_speed": np.where(t > 0, self.speed_at(t) + shift, math.nan),
            "head_count": np.full(11, 3.0), "head_particles": np.maximum(0, 2000 - 150 * t), "head_width": width,
            "head_thickness": width / np.where(t == 10, 3.5, 4), "frontal_angle": 90 - t + (10 - np.arange(11)) * shift}
        self.head_widths = (30 + 2.0 * np.arange(4) + width_shift) * radius

    @staticmethod
    def speed_at(t):
        return np.where(t <= 5, 30 + 4 * t, 50 - (t - 5) - 0.5 * np.maximum(0, t - 10))

    def column(self, name):
        return self.columns.get(name, np.zeros(len(self.time)))

    def number(self, name, n):
        return self.column(name)[n]

    @property
    def widths(self):
        return self.head_widths


def of(name, run, window=Window()):
    return MEASURES.quantities[name].of(run, window)


class OfARun(unittest.TestCase):
    def test_front_speed(self):
        run = Synthetic()
        self.assertEqual(of("front_speed_max", run), 50)
        self.assertEqual(of("front_speed_max_time", run), 5)
        self.assertEqual(of("front_speed_min", run), 30)
        self.assertEqual(of("front_speed_min", run, Window(end=10)), 31)
        self.assertEqual(of("front_speed_max", run, Window(begin=10)), 45 - 0.25 * 1.5)
        self.assertEqual(of("front_speed_rise", run), 50 / 31)
        self.assertEqual(of("front_speed_fall", run), 50 / 30)
        self.assertAlmostEqual(of("front_speed_slope_early", run) + of("front_speed_slope_change", run), -1.5, places=10)
        self.assertGreater(of("front_speed_slope_early", run), 0)
        self.assertTrue(math.isnan(of("front_speed_max", run, Window(begin=30))))

    def test_heads(self):
        run = Synthetic()
        self.assertEqual(of("head_aspect_ratio", run, Window(begin=6)), (6 * 4 + 3.5) / 7)
        self.assertEqual(of("head_aspect_ratio_min", run, Window(begin=6)), 3.5)
        self.assertEqual(of("head_aspect_ratio_max", run, Window(begin=6)), 4)
        self.assertEqual(of("head_particles_first", run), 0.85)
        self.assertAlmostEqual(of("head_particles_half_time", run), 1000 / 150, places=12)
        # 14, 16, 18 and 20 share the last place with 0 grains: ranks 1 to 6 fall, the last four are tied.
        self.assertAlmostEqual(of("head_particles_trend", run), -(82.5 - 5) / math.sqrt(82.5 * (82.5 - 5)), places=12)
        from_largest = of("head_particles_front_speed_correlation", run)
        self.assertGreater(from_largest, 0.9)
        self.assertLess(of("head_particles_front_speed_correlation_all", run), from_largest)
        self.assertEqual(of("frontal_angle_first", run), 88)
        self.assertEqual(of("contact_weight_ratio", run), 20.7)

    def test_the_datum_nearest_to_a_time(self):
        run = Synthetic()
        self.assertEqual(of("front_speed", run, Window(at=3.9)), 46)
        self.assertEqual(of("front_speed", run, Window(at=3)), 38, "of two equally near data the earlier")
        self.assertEqual(of("front_speed", run, Window(at=0)), 38, "the start is no datum")
        self.assertEqual(of("front_speed", run, Window(at=math.inf)), 30)
        self.assertEqual(of("front_speed", run), 30, "without a time: the end")


class OfMembers(unittest.TestCase):
    members = [Synthetic(-1), Synthetic(0), Synthetic(1)]

    def test_means_spreads_and_pooled_values(self):
        mean = MEASURES.mean(self.members)
        self.assertEqual(of("front_speed_max", mean), 50)
        self.assertEqual(of("front_speed_fall", mean), 50 / 30)
        expected = np.mean(1 / self.members[1].front_speed[1])
        self.assertAlmostEqual(of("front_speed_spread", [self.members]), expected, places=14)
        # The angles' standard deviation is 10 - n at datum n of 10: a quarter is 2 data, 9 and 8 against 1 and 0.
        self.assertAlmostEqual(of("frontal_angle_spread_ratio", [self.members]), 1 / 17, places=12)
        self.assertAlmostEqual(of("head_width_skewness", [self.members]), 0, places=12)
        self.assertGreater(of("head_width_normality_p_value", [self.members]), 0)
        with self.assertRaises(NotEvaluated):
            of("front_speed_spread", [self.members[:1]])

    def test_members_without_an_angle_are_left_out_while_they_are_the_fewer(self):
        members = [Synthetic(-1), Synthetic(0), Synthetic(1)]
        members[2].columns["frontal_angle"][1] = math.nan
        # The first datum's standard deviation is now that of two angles, 9 degrees apart.
        self.assertAlmostEqual(of("frontal_angle_spread_ratio", [members]), 1 / (9 / math.sqrt(2) + 8), places=12)
        members[1].columns["frontal_angle"][1] = math.nan
        self.assertTrue(math.isnan(of("frontal_angle_spread_ratio", [members])))

    def test_the_aspect_ratio_is_that_of_the_means(self):
        members = [Synthetic(), Synthetic()]
        thickness = 2 * members[0].columns["head_thickness"]
        members[1].columns |= {"head_thickness": thickness, "head_width": 3 * thickness}
        ratio = of("head_aspect_ratio_max", MEASURES.mean(members), Window(begin=10))
        self.assertAlmostEqual(ratio, (4 + 2 * 3) / 3, places=12, msg="4 l + 6 l over l + 2 l, not the mean of 4 and 3")

    def test_members_that_differ(self):
        members = [Synthetic(), Synthetic()]
        members[1].time = members[1].time[:2]
        with self.assertRaises(NotEvaluated):
            MEASURES.mean(members)
        members = [Synthetic(), Synthetic()]
        members[1].front_speed = members[1].front_speed[0] * 1.01, members[1].front_speed[1]
        with self.assertRaises(NotEvaluated):
            of("front_speed_spread", [members])

    def test_widths_proportional_to_the_radius(self):
        groups = [[Synthetic(0, 0.001), Synthetic(1, 0.001)], [Synthetic(0, 0.0025)], [Synthetic(0, 0.005)]]
        self.assertAlmostEqual(of("head_width_line_r_squared", groups), 1, places=12)
        self.assertAlmostEqual(of("head_width_line_origin_r_squared", groups), 1, places=12)
        self.assertAlmostEqual(of("head_width_median_spread", groups), 0, places=12)
        groups[1] = [Synthetic(0, 0.0025, 11)]
        self.assertAlmostEqual(of("head_width_median_spread", groups), 11 / ((33 + 44 + 33) / 3), places=12)
        self.assertLess(of("head_width_line_origin_r_squared", groups), 0.999)
        for too_few in (groups[:2], groups[:2] + [[]]):
            with self.assertRaises(NotEvaluated):
                of("head_width_line_r_squared", too_few)

    def test_every_row_that_is_the_studys_has_a_value(self):
        groups = [[Synthetic(0, a), Synthetic(1, a)] for a in (0.001, 0.0025, 0.005)]
        rows = tomllib.loads((STUDY / "reference.toml").read_text())["row"]
        named = set()
        for row in rows:
            quantity = MEASURES.quantities.get(row["quantity"])
            if quantity is None:
                self.assertEqual(row["from"], "each", row["id"])
                continue
            named.add(row["quantity"])
            self.assertEqual(quantity.unit, row["unit"], row["id"])
            window = row.get("window", {})
            times = {"begin": window.get("from", 0.0), "end": window.get("to", math.inf), "at": window.get("at")}
            window = Window(**{key: math.inf if time == "end" else time for key, time in times.items()})
            value = of(row["quantity"], groups if quantity.together else groups[0][0], window)
            self.assertTrue(math.isfinite(value), row["id"])
        self.assertEqual(set(MEASURES.quantities) - named, {"front_speed"}, "no quantity without a row but the figures'")


def block(x, y, rows, columns, spacing=2.0):
    """Rows along x, from (x, y) on."""
    grid = np.mgrid[:rows, :columns].reshape(2, -1).T * spacing
    return np.column_stack([grid + [x, y], np.zeros(len(grid))])


class Frame(dict):
    """A snapshot by hand."""

    def __init__(self, positions, velocity, radius=1.0, time=3.0):
        super().__init__(velocity=np.asarray(velocity, dtype=float), radius=np.full(len(positions), radius))
        self.positions, self.time = np.asarray(positions, dtype=float), time


class Still(Synthetic):
    """A run whose front runs at a given speed, of snapshots by hand."""

    def __init__(self, front_speed=0.0, from_the_side=False, scales=(1.0, 1.0)):
        super().__init__()
        self.radius, self.speed = scales
        self.of_front, self.from_the_side = front_speed, from_the_side

    def front_speed_at(self, time):
        return self.of_front

    def of(self, name, frame):
        return avalanche.SNAPSHOT_NUMBERS[name](avalanche.View(self, frame))


class Documents(unittest.TestCase):
    def test_the_readme_says_how_the_quantities_are_listed_and_each_is_defined(self):
        self.assertIn("python3 -m talus.measures --table validation/niiya2020", (STUDY / "README.md").read_text())
        listed = table(MEASURES.quantities)
        for name, quantity in MEASURES.quantities.items():
            self.assertIn(f"| `{name}` | {quantity.unit} | ", listed)
            self.assertTrue(quantity.unit and len(quantity.text) > 10, name)


class OfASnapshot(unittest.TestCase):
    def test_two_vortices_whatever_the_scales(self):
        # Two blocks beside the centre line; the flow is fastest there: v_x = 40 - 3 |y|, and outwards: v_y = 2 y.
        places = np.concatenate([block(0, 4, 8, 6), block(0, -14, 8, 6)])
        y = places[:, 1]
        velocity = np.column_stack([40 - 3 * np.abs(y), 2 * y, 0 * y])
        for a, v in ((1.0, 1.0), (0.005, 39.8)):
            run = Still(20.0, scales=(a, v))
            for half, sign in (("left", 1), ("right", -1)):
                one = places[sign * y > 0]
                frame = Frame(one * a, velocity[sign * y > 0] * v, a)
                np.testing.assert_allclose(avalanche.View(run, frame).curls, 3 * sign, rtol=1e-9)
                self.assertTrue(math.isfinite(run.of(f"head_curl_{half}", frame)))

    def test_parts_of_a_head(self):
        # Six rows of a block: the rear half of the layer and the front half, |y| <= 15 of 30 wide in the central half.
        places = block(0, -14, 6, 15)
        y = places[:, 1]
        run = Still(20.0)
        frame = Frame(places, np.column_stack([40 - 3 * np.abs(y), 2 * y, 0 * y]))
        view = avalanche.View(run, frame)
        self.assertEqual(view.size.width, 30)
        self.assertEqual(view.size.thickness, 12)
        central = np.abs(y[:15])[np.abs(y[:15]) <= 7.5]
        self.assertAlmostEqual(run.of("head_rear_relative_velocity", frame), 40 - 3 * central.mean() - 20, places=12)
        self.assertAlmostEqual(run.of("head_front_outward_velocity", frame), 2 * np.abs(y[:15]).mean(), places=12)
        self.assertAlmostEqual(run.of("head_concavity", frame), 0, places=12, msg="straight at the rear")

    def test_a_crescent_is_concave(self):
        # Columns of four grains whose rear ends lie the farther back the farther they are from the middle.
        places = np.concatenate([block(-0.5 * abs(y), y, 4, 1) for y in range(-30, 31, 2)])
        run = Still()
        view = avalanche.View(run, Frame(places, np.zeros_like(places)))
        rear_of_sides = -15 - 1
        self.assertAlmostEqual(avalanche.SNAPSHOT_NUMBERS["head_concavity"](view), (view.size.inner - rear_of_sides) / view.size.thickness, places=12)
        self.assertGreater(avalanche.SNAPSHOT_NUMBERS["head_concavity"](view), 0.5)

    def test_no_value_without_grains(self):
        run = Still()
        frame = Frame([[0, 0, 0]], [[0, 0, 0]])
        for name in ("head_curl_left", "head_rear_relative_velocity", "head_concavity", "front_rear_thickness_ratio"):
            self.assertTrue(math.isnan(run.of(name, frame)), name)

    def test_curl_needs_three_grains_off_one_line(self):
        line = np.column_stack([0.1 * np.arange(6), 0.3 * np.arange(6), np.zeros(6)])
        view = avalanche.View(Still(), Frame(line, np.random.default_rng(1).normal(size=(6, 3))))
        self.assertTrue(np.isnan(view.curls).all())

    def test_head_and_tail(self):
        # A tail of one layer from x = 0 to 60, then a head of six layers from 62 to 100; unit grains 2 apart. The layers
        # of the head, from below, have v_x = 9, 8, ..., 4; the tail has 1.
        places = [(x, 7, 1 + 2 * layer) for x in range(0, 101, 2) for layer in range(6 if x > 60 else 1)]
        velocity = [(10 - (z + 1) / 2 if x > 60 else 1, 0, 0) for x, _, z in places]
        run, frame = Still(7.0, from_the_side=True), Frame(places, velocity)
        # 151 grains: 5 % of the way along them is x = 15, in the column that ends at 12.
        thickness, _, crest, head_columns = avalanche.View(run, frame).profile
        self.assertEqual((len(thickness), crest, head_columns), (22, 0, 10))
        self.assertEqual(run.of("front_rear_thickness_ratio", frame), 12 / 2)
        self.assertAlmostEqual(run.of("head_upper_relative_velocity", frame), 4.5 - 7, places=12)
        self.assertAlmostEqual(run.of("head_lower_relative_velocity", frame), 7.5 - 7, places=12)
        self.assertAlmostEqual(run.of("tail_relative_velocity", frame), 1 - 7, places=12)
        self.assertTrue(math.isnan(run.of("head_concavity", frame)), "from the side there is none")

    def test_the_head_reaches_over_the_crest(self):
        # Heights of columns 4 long: the crest is the third, the fourth is half of it, the fifth not.
        heights = [2, 8, 12, 6, 5, 12, 2, 2]
        places = np.array([(-4.0 * n, 0, height - 1) for n, height in enumerate(heights) for _ in range(1 if n < 7 else 30)])
        thickness, _, crest, head_columns = avalanche.thickness_profile(places, np.ones(len(places)), 1)
        self.assertEqual(thickness.tolist(), heights)
        self.assertEqual((crest, head_columns), (2, 4))

    def test_displacements_do_not_see_a_common_shift(self):
        before = Frame([(0, 0, 0), (5, 1, 0), (2, 7, 0)], np.zeros((3, 3)))
        after = Frame([(10, 1, 0), (16, 2, 0), (11, 8, 0)], np.zeros((3, 3)))
        run = Still()
        run.view = lambda n: avalanche.View(run, before)
        self.assertAlmostEqual(run.of("displacement_spread", after), 0.1, places=14)
        self.assertAlmostEqual(run.of("displacement_lateral", after), 0, places=14)
        with self.assertRaises(NotEvaluated):
            run.of("displacement_spread", Frame([(0, 0, 0)], np.zeros((1, 3))))


class FrontSpeed(unittest.TestCase):
    def test_only_where_the_front_was_there_all_the_time(self):
        run = Synthetic()
        run.__dict__["front"] = np.array([0, 0.2, 0.4]), np.array([0.0, 1, 2])
        self.assertTrue(math.isnan(avalanche.Avalanche.front_speed_at(run, 0.2)))
        self.assertAlmostEqual(avalanche.Avalanche.front_speed_at(run, 0.3), 5, places=12)
        self.assertTrue(math.isnan(avalanche.Avalanche.front_speed_at(run, 0.5)))

    def test_a_part_leaves_its_first_time_out_and_keeps_its_last(self):
        values = curve([0.1, 0.2, 0.1 + 0.2, 0.4], [1, 2, 3, 4])
        self.assertEqual(part(values, 0.1, 0.3)[1].tolist(), [2, 3])  # 0.1 + 0.2 is 0.30000000000000004
        self.assertEqual(part(values, 0.3, math.inf)[1].tolist(), [4])


class Statistics(unittest.TestCase):
    def test_rank_correlation(self):
        # Intelligence against hours of television, the textbook example: -29/165.
        x = [106, 100, 86, 101, 99, 103, 97, 113, 112, 110]
        self.assertAlmostEqual(samples.spearman_correlation(x, [7, 27, 2, 50, 28, 29, 20, 12, 6, 17]), -29 / 165, places=14)
        self.assertAlmostEqual(samples.spearman_correlation([1, 2, 3, 4], [-5, 0, 1, 1e9]), 1, places=14)
        # Equal values share the mean rank: 1, 2.5, 2.5, 4.
        self.assertAlmostEqual(samples.spearman_correlation([1, 2, 3, 4], [1, 2, 2, 3]), 4.5 / math.sqrt(5 * 4.5), places=14)
        self.assertTrue(math.isnan(samples.spearman_correlation([1, 2, 3], [1, 1, 1])))

    def test_lines(self):
        x, y = [1, 2, 3], [3, 5, 10]
        np.testing.assert_allclose(samples.fit_line(x, y), (3.5, 1 - 1.5 / 26), rtol=1e-13)
        origin = samples.fit_line(x, y, through_origin=True)
        np.testing.assert_allclose(origin, (43 / 14, 1 - (134 - 43 * 43 / 14) / 26), rtol=1e-13)
        self.assertLess(samples.fit_line(x, [10, 11, 12], through_origin=True)[1], 0, "worse than the mean")
        self.assertTrue(math.isnan(samples.fit_line([2, 2], [1, 3])[0]))

    def test_skewness(self):
        self.assertAlmostEqual(samples.skewness([2, 4, 4, 4, 5, 5, 7, 9]), (-27 - 1 - 1 - 1 + 8 + 64) / 8 / 8, places=14)

    def test_normality(self):
        # Stephens 1974, mean and deviation estimated.
        for a, p, delta in ((0.631, 0.10, 2e-3), (0.752, 0.05, 1e-3), (0.873, 0.025, 5e-4), (1.035, 0.01, 2e-4)):
            self.assertAlmostEqual(samples.anderson_darling_p_value(a), p, delta=delta)
        random = np.random.default_rng(11)
        rejected = sum(samples.anderson_darling(3 + 2 * random.normal(size=50))[1] < 0.05 for _ in range(1000))
        self.assertAlmostEqual(rejected, 50, delta=21)  # three standard deviations
        self.assertLess(samples.anderson_darling(random.uniform(size=300) ** 3)[1], 1e-6)
        for too_few in (np.arange(7.0), np.ones(20)):
            self.assertTrue(math.isnan(samples.anderson_darling(too_few)[1]))
        sample = np.array([1, 2, 2.5, 4, 4.1, 5, 7, 11, 12])
        self.assertAlmostEqual(samples.anderson_darling(sample)[0], samples.anderson_darling(100 - 8 * sample)[0], places=12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
