# SPDX-License-Identifier: Apache-2.0
"""What the scripts of validation/bead-shear make of states with known parameters, and of those that are kept.

Usage: test_bead_shear.py TALUS
"""
import sys
import unittest
from pathlib import Path

sys.argv.pop()
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "bead-shear"))

import cohesion  # noqa: E402
import edge  # noqa: E402
import incline  # noqa: E402
import numpy as np  # noqa: E402
import settle  # noqa: E402
import shear  # noqa: E402
from talus import beads  # noqa: E402
from talus.lab import lammps  # noqa: E402


class Fits(unittest.TestCase):
    def test_the_friction_of_states_on_a_curve_is_that_curve(self):
        inertial = np.geomspace(1e-3, 0.5, 9)
        slow, fast, scale, left = beads.fit_friction(inertial, 0.4 + 0.3 / (1 + 0.2 / inertial))
        self.assertAlmostEqual(slow, 0.4, delta=0.002)
        self.assertAlmostEqual(fast, 0.7, delta=0.01)
        self.assertAlmostEqual(scale, 0.2, delta=0.01)
        self.assertLess(left, 1e-3)

    def test_intervals_hold_the_curve_19_times_of_20(self):
        noise, inertial = np.random.default_rng(51), np.geomspace(1e-3, 0.5, 9)
        law, trials = (0.4, 0.7, 0.2), 100
        held = np.zeros(3)
        for _ in range(trials):
            found = beads.friction_estimates(inertial, 0.4 + 0.3 / (1 + 0.2 / inertial) + 0.01 * noise.standard_normal(9))
            held += [one.low <= value <= one.high for one, value in zip(found, law)]
        self.assertGreater((held / trials).min(), 0.9)

    def test_means_of_few_seeds_take_the_scatter_that_is_known(self):
        two, three = beads.mean_estimate([1, 1], 0.1), beads.mean_estimate([1, 2, 3], 0.1)
        self.assertAlmostEqual(two.high - two.value, 0.2 / 2**0.5)
        self.assertAlmostEqual(three.high - three.value, 4.303 / 3**0.5)

    def test_the_bulk_stiffness_is_that_of_the_states_that_bear_pressure(self):
        packing = np.array([0.5, 0.55, 0.56, 0.58])
        self.assertAlmostEqual(beads.bulk_stiffness(packing, np.maximum(0.24 * np.log(packing / 0.548), 1e-6)), 0.24, places=6)
        self.assertTrue(np.isnan(beads.bulk_stiffness(packing[:2], np.array([1e-6, 1e-3]))))

    def test_the_packing_of_states_on_a_line_is_that_line(self):
        inertial = np.array([0.01, 0.1, 0.2, 0.4])
        critical, fall, *errors = beads.fit_packing(inertial, 0.56 - 0.1 * inertial)
        self.assertAlmostEqual(critical, 0.56)
        self.assertAlmostEqual(fall, 0.1)
        self.assertLess(max(errors), 1e-6)

    def test_the_friction_of_a_state_is_that_of_mohrs_circle(self):
        table = np.tile([0, 2.0, 1.2, 0.8, 0.7, -0.3], (5, 1))
        table[0, 1:] = 0.5, 9, 9, 9, 9  # before the steady part
        row = dict(zip(shear.COLUMNS[2:], beads.state(table)))
        self.assertAlmostEqual(row["friction"], np.hypot(0.2, 0.3))
        self.assertAlmostEqual(row["inertial_number"], beads.RATE / np.sqrt(0.9))
        self.assertAlmostEqual(row["xy_over_yy"], 0.375)

    def test_the_dilatancy_of_a_logistic_curve_is_its_rate(self):
        strain = np.arange(0.005, 1, 0.01)
        packing = 0.56 / (1 + (0.56 / 0.62 - 1) * np.exp(-9 * 0.56 * strain))
        rise = np.minimum(strain / 0.05, 1)  # elastic before the peak
        k, b, critical, slow = beads.fit_dilatancy(strain, packing, rise * (0.48 + 0.5 * 9 * (packing - 0.56)))
        self.assertAlmostEqual(k, 9, delta=0.45)  # a part of the excess is still there when it is called steady
        self.assertAlmostEqual(b, 0.5, delta=0.025)
        self.assertAlmostEqual(critical, 0.56, delta=0.001)
        self.assertAlmostEqual(slow, 0.48, delta=0.005)

    def test_the_cohesion_of_states_on_a_line_is_that_line(self):
        bond, law = np.array([0.3, 1, 2.5, 5]), (0.48, 0.72, 0.27)
        over = 0.05 + 0.2 * bond
        np.testing.assert_allclose(beads.strength(0.014, beads.cohesive_friction(0.014, over, law), law), over)
        self.assertAlmostEqual(beads.strength(1e-9, 0.72, law), 0.5)  # slow: friction over mu_s
        alpha, kappa = beads.cohesion_estimates(bond, over, 0.02)
        self.assertAlmostEqual(alpha.value, 0.2)
        self.assertAlmostEqual(kappa.value, 0.05)
        # A friction without cohesion that is 2 % off moves every 1 + a/sigma by as much.
        self.assertAlmostEqual(alpha.high - alpha.value, 0.004)
        self.assertAlmostEqual(kappa.high - kappa.value, 0.021)

    def test_intervals_of_cohesion_hold_the_line_19_times_of_20(self):
        noise, bond, trials = np.random.default_rng(7), np.array([0.3, 0.6, 1, 2.5, 5]), 400
        over, held = 0.3 + 0.2 * bond, np.zeros(2)
        for _ in range(trials):
            found = beads.cohesion_estimates(bond, over + 0.02 * (1 + over) * noise.standard_normal(5))
            held += [one.low <= value <= one.high for one, value in zip(found, (0.2, 0.3))]
        for share in held / trials:
            self.assertAlmostEqual(share, 0.95, delta=0.03)

    def test_a_strength_that_would_be_negative_is_none(self):
        bond = np.array([1.0, 2, 4])
        alpha, kappa = beads.cohesion_estimates(bond, 0.2 * bond - 0.05)
        self.assertEqual(kappa.value, 0)
        self.assertAlmostEqual(alpha.value, 0.18, delta=0.01)
        self.assertEqual([one.value for one in beads.cohesion_estimates(bond, -0.1 * bond)], [0, 0])

    def test_the_state_of_beads_that_stick_is_that_of_their_steady_part(self):
        table = np.array([[0, 0.5, 0.6, 9, 9, 9, 9], [1, 1.2, 0.5, 3e-4, 1e-4, 1e-4, -2e-4], [2, 1.4, 0.48, 3e-4, 1e-4, 1e-4, -2e-4]])
        bond, inertial, friction, packing = beads.cohesive_state(table, 3)
        self.assertAlmostEqual(bond, 3)
        self.assertAlmostEqual(inertial, beads.RATE / (5e-4 / 3) ** 0.5)
        self.assertAlmostEqual(friction, 5**0.5 / 2)
        self.assertAlmostEqual(packing, 0.49)


class States(unittest.TestCase):
    def test_dense_beads_dilate_twice_as_fast_as_their_friction_rises(self):
        for rolling, rate in ((0.2, 8.2), (0.0, 9.8)):
            k, b, critical, slow = shear.dilatancy(rolling).mean(axis=1)
            self.assertAlmostEqual(k, rate, delta=1)
            self.assertAlmostEqual(b, 0.5, delta=0.1)
            # At constant pressure they come to the state that constant volume has.
            s = shear.states(rolling)
            self.assertAlmostEqual(critical, np.interp(0.007, s["inertial_number"][::-1], s["packing"][::-1]), delta=0.012)
            self.assertAlmostEqual(slow, np.interp(0.007, s["inertial_number"][::-1], s["friction"][::-1]), delta=0.025)

    def test_the_peak_of_dense_beads_is_that_of_the_law_with_a_smaller_part_of_the_dilatancy(self):
        self.assertAlmostEqual(beads.fit_peak(8, 0.48, 0.55, np.array([0.6, 0.59]), np.array([0.5, 0.6, 0.6, 0.6, 0.5])), 0.3)
        for rolling in shear.PACKINGS:
            k, b, packing, friction = shear.dilatancy(rolling).mean(axis=1)
            peaks = [beads.fit_peak(k, friction, packing, *run[1:]) for run in shear.dense_runs(rolling)]
            self.assertAlmostEqual(np.mean(peaks), 0.37, delta=0.01)
            self.assertLess(np.mean(peaks), b - 0.1)

    def test_beads_that_hardly_roll_have_more_friction_and_a_looser_critical_state(self):
        fits = {}
        for rolling in shear.PACKINGS:
            s = shear.states(rolling)
            hard = s["pressure_over_stiffness"] < beads.SOFT
            fits[rolling] = (beads.fit_friction(s["inertial_number"], s["friction"]),
                             beads.fit_packing(s["inertial_number"][hard], s["packing"][hard]))
        self.assertAlmostEqual(fits[0.2][0][0], 0.48, delta=0.02)
        self.assertAlmostEqual(fits[0.2][1][0], 0.55, delta=0.005)
        self.assertGreater(fits[0.2][0][0], fits[0.0][0][0] + 0.1)
        self.assertLess(fits[0.2][1][0], fits[0.0][1][0] - 0.03)


class Cohesion(unittest.TestCase):
    def test_cells_that_stick_have_the_law_s_line_and_predict_the_one_held_out(self):
        table = np.genfromtxt(cohesion.CELLS, delimiter=",", names=True)
        over = beads.strength(table["inertial_number"], table["friction"], cohesion.law())
        self.assertAlmostEqual(over[0], 0, delta=0.05)  # without attraction: the friction of constant volume
        used = (table["bond"] > 0) & (table["bond"] != cohesion.HELD_OUT)
        alpha, kappa = (one.value for one in beads.cohesion_estimates(table["attraction_over_stress"][used], over[used]))
        [row] = table[table["bond"] == cohesion.HELD_OUT]
        predicted = beads.cohesive_friction(row["inertial_number"], kappa + alpha * row["attraction_over_stress"], cohesion.law())
        self.assertAlmostEqual(row["friction"] / predicted, 1, delta=0.05)
        self.assertTrue((np.diff(table["packing"]) < 0).all())

    def test_layers_get_the_attraction_of_the_cells(self):
        text = cohesion.sticky(lammps.script("incline.in").read_text(encoding="utf-8"))
        cell = lammps.script("cohesive.in").read_text(encoding="utf-8")
        [style] = [line for line in cell.splitlines() if line.startswith("pair_style")]
        self.assertEqual(text.count(style), 1)
        self.assertEqual(text.count("granular 1 hooke"), text.count("granular 2 dmt 1 0 0.3 ${energy}"))
        self.assertNotIn("* * hooke", text)

    def test_a_slope_holds_by_friction_and_by_the_attraction_over_its_weight(self):
        self.assertAlmostEqual(np.tan(np.radians(cohesion.slope_of(0, 0.5, 0.2, 0))), 0.5)
        steep = np.radians(cohesion.slope_of(13.3 * np.cos(0.7), 0.5, 1, 0.1))  # C = 1 on the plane at 0.7
        self.assertAlmostEqual(np.tan(steep) / (0.5 * (1.1 + np.cos(0.7) / np.cos(steep))), 1, delta=0.01)


class Reversals(unittest.TestCase):
    strains = np.linspace(0.005, 0.495, 50)

    def turned(self, parameters):
        forward, fabric = settle.law(parameters, self.strains, 0.59, 0j, 1)
        back, _ = settle.law(parameters, self.strains, forward[0][-5:].mean(), fabric, -1)
        return [(np.vstack([self.strains, forward]), np.vstack([self.strains, back]))]

    def test_a_law_that_made_the_curves_is_found_again(self):
        true = np.array([0.4, 0.25, 0.2, 7.0, 0.56, 0.45, 0.6])
        runs = self.turned(true)
        runs[0][0][1][0] = 0.59
        found, _, left = settle.least_squares(lambda p: settle.misfit(p, runs), (0.5, 0.3, 0.25, 8, 0.55, 0.48, 0.7))
        self.assertLess(left, 0.2)
        np.testing.assert_allclose(found, true, rtol=0.05)

    def test_steady_shear_leaves_the_fabric_behind_by_its_spin(self):
        _, fabric = settle.law((0.4, 0.3, 0.2, 8, 0.55, 0.48, 0.5), [6.0], 0.55, 0j, 1)
        self.assertAlmostEqual(fabric.real, 1 / (1 + 0.3**2), delta=2e-3)

    def test_what_turned_back_contracts_at_first(self):
        packing, strains = 0.55, np.array([0.005, 0.015])
        (found, _), _ = settle.law((0.4, 0.3, 0.2, 0, 0.55, 0.48, 0.5), strains, packing, 1 + 0j, -1)
        self.assertAlmostEqual(np.log(found[1] / found[0]) / 0.01, 0.4 * np.exp(-0.01 / 0.3), delta=3e-3)

    @unittest.skipUnless(settle.REVERSAL.exists(), "no table")
    def test_the_table_has_the_parameters_of_the_page(self):
        found, errors, left = settle.least_squares(lambda p: settle.misfit(p, settle.reversals()),
                                                   (0.5, 0.3, 0.25, 8, 0.55, 0.48, 0.7))
        self.assertLess(left, 1)
        np.testing.assert_allclose(found[:3], (0.5, 0.3, 0.25), rtol=0.15)
        self.assertLess((errors[:3] / found[:3]).max(), 0.05)


class Edges(unittest.TestCase):
    def test_a_wedge_has_its_slope_its_height_and_what_is_left(self):
        x = (np.arange(24000) + 0.5) * 1e-6
        volume = (12e-3 - 0.5 * x) * edge.ACROSS * edge.PACKING * 1e-6
        angle, height, left = edge.shape(x, volume, 0.024)
        self.assertAlmostEqual(angle, np.degrees(np.arctan(0.5)), places=6)
        self.assertAlmostEqual(height, 0.5 - 0.5 * 1.5 / 24, places=6)
        self.assertAlmostEqual(left, 0.25, places=6)

    @unittest.skipUnless(edge.TABLE.exists(), "no table")
    def test_beads_rest_steeper_than_the_friction_of_slow_shear(self):
        for rows in edge.beads().values():
            angle, height, left = rows[max(rows)]
            self.assertGreater(angle, np.degrees(np.arctan(0.48)) + 4)
            self.assertAlmostEqual(height, 0.62, delta=0.02)
            self.assertAlmostEqual(left, 0.345, delta=0.015)


class Slopes(unittest.TestCase):
    STEPS, FALL = np.arange(0, 1001), np.linspace(30, 20, 1001)  # of SECONDS

    def layer(self, slopes, velocity):
        still = np.full(len(slopes), 1.0)
        return np.column_stack([self.STEPS, slopes, velocity, 9 * still, 5.5 * still])

    def stopping(self, friction):
        """A layer that slows down by that friction from where it has SLOW to rest."""
        time = beads.SECONDS * self.STEPS / self.STEPS[-1]
        slope = np.radians(self.FALL)
        rate = beads.GRAVITY * (np.sin(slope) - friction * np.cos(slope)) / np.sqrt(beads.GRAVITY * beads.DIAMETER)
        moving = (np.tan(slope) < friction) & (time > 0)
        velocity = 0.5 + np.cumsum(np.where(moving, rate, 0)) * time[1]
        return np.maximum(velocity, 0)

    def test_the_friction_that_stops_a_layer_is_found_though_the_slope_falls_on(self):
        friction = np.tan(np.radians(27))
        thickness, stops, balanced, starts = beads.angles(self.layer(self.FALL, self.stopping(friction)),
                                                            self.layer(self.FALL[::-1], np.where(self.STEPS > 700, 1, 0)))
        self.assertAlmostEqual(thickness, 8)
        self.assertLess(stops, 26.5)
        self.assertAlmostEqual(balanced, 27, delta=0.1)
        self.assertAlmostEqual(starts, 27.01)

    def test_the_friction_between_two_velocities_is_found(self):
        stop = self.layer(self.FALL, self.stopping(0.5))
        self.assertAlmostEqual(beads.friction_between(stop, 0.45, 0.1), 0.5, delta=2e-3)
        self.assertTrue(np.isnan(beads.friction_between(self.layer(self.FALL, np.ones(1001)), 0.45, 0.1)))

    def test_round_beads_roll_along_a_flat_wall_and_others_slide(self):
        table = np.genfromtxt(incline.WALLS, delimiter=",", names=True)
        np.testing.assert_allclose(table["friction"][table["rolling"] == 0.2], 0.3, atol=2e-3)
        self.assertLess(table["friction"][table["rolling"] == 0].max(), 0.2)

    def test_what_does_not_stop_or_start_has_no_slope(self):
        moving, resting = (self.layer(self.FALL, np.full(1001, v)) for v in (1.0, 0.0))
        self.assertTrue(np.isnan(beads.angles(moving, resting)[1:]).all())

    @unittest.skipUnless(incline.TABLE.exists(), "no table")
    def test_thin_layers_stop_before_thick_ones(self):
        table = np.genfromtxt(incline.TABLE, delimiter=",", names=True)
        table = table[(table["rolling"] == 0.2) & (table["seed"] == 1)]
        self.assertEqual(len(table), 3)
        self.assertTrue((np.diff(table["balanced_at_deg"][np.argsort(table["thickness"])]) < 0).all())

    def test_the_strength_at_rest_is_what_the_thickest_layers_have_beyond_slow_shear(self):
        rows = [{"rolling": "0.2", "layers": str(layers), "starts_at_deg": str(degrees)}
                for layers, degrees in ((8, 50), (incline.THICKEST, 30), (incline.THICKEST, 45))]
        rows.append({"rolling": "0", "layers": str(incline.THICKEST), "starts_at_deg": "60"})
        np.testing.assert_allclose(incline.strengths(rows, 0.2), [3**-0.5 - 0.48, 1 - 0.48])


if __name__ == "__main__":
    unittest.main()
