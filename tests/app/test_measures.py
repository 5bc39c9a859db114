# SPDX-License-Identifier: Apache-2.0
"""What a run says of itself: numbers that agree with each other, in the summary, in the tables and on the card."""
import json
import unittest

from program import PROJECT, ProgramTest, rows

COARSE = [option for setting in ("bed.spacing=5mm", "box.depth=5mm", "bed.height=80mm", "run.end=0.2s",
                                 "output.snapshots=20ms", "output.pictures=false") for option in ("--set", setting)]


class Measures(ProgramTest):
    def summary(self, folder="r"):
        quantities = json.loads((self.folder / folder / "summary.json").read_text())["quantities"]
        return {name: entry["value"] for name, entry in quantities.items()}

    def card(self, said):
        return said.split("Regime at the end:\n")[1].split("Done:")[0]

    def assert_rising(self, numbers, *names):
        values = [numbers[name] for name in names]
        self.assertEqual(values, sorted(values), names)

    def test_numbers_of_an_avalanche_keep_their_orders_and_the_card_agrees(self):
        said = self.talus("run", "case.toml", "--out", "r").stdout
        numbers = self.summary()
        self.assert_rising(numbers, "front_speed_min", "front_speed_end", "front_speed_max")
        self.assertIn(f"largest overlap = {numbers['overlap_max']:.3g} a_p", self.card(said))
        speeds = [float(row["front_speed [v_s]"]) for row in rows(self.folder / "r/analysis/front_speed.csv")]
        self.assertAlmostEqual(max(speeds), numbers["front_speed_max"], delta=1e-9 * max(speeds))
        again = self.talus("run", "case.toml", "--out", "r", "--resume").stdout
        self.assertEqual(self.card(again), self.card(said))

    def test_numbers_of_a_hopper_keep_their_orders_and_the_card_agrees(self):
        case = PROJECT / "cases/yuu2011-section-vacuum.toml"
        said = self.talus("run", case, *COARSE, "--out", "r").stdout
        numbers = self.summary()
        self.assert_rising(numbers, "discharge_rate_plateau", "discharge_rate_max")
        self.assertAlmostEqual(numbers["discharged_fraction"] + numbers["residual_fraction"], 1, delta=1e-12)
        table = rows(self.folder / "r/analysis/snapshots.csv")
        largest = max(float(row["packing_max [1]"]) for row in table if float(row["time [s]"]) > 0)
        self.assertAlmostEqual(largest, numbers["packing_max"], delta=1e-9)
        self.assertIn(f"share of slow flow = {numbers['inertial_share']:.3f}", self.card(said))
        again = self.talus("run", case, *COARSE, "--out", "r", "--resume").stdout
        self.assertEqual(self.card(again), self.card(said))

    def test_the_card_tells_how_far_beyond_their_range_collisions_are_used(self):
        case = PROJECT / "cases/yuu2011-section-vacuum.toml"
        said = self.talus("run", case, *COARSE, "--set", "run.end=50ms", "--set", "collisions.form=printed", "--out", "r").stdout
        numbers = self.summary()
        over = max(numbers["velocity_gradient_shear_max"] / 0.2, numbers["velocity_gradient_normal_max"] / 0.05)
        self.assertIn(f"velocity gradients over the range of collisions = {over:.3g}:", self.card(said))

    def test_a_wedge_is_measured_by_its_own_outlet_and_drawn_to_its_end(self):
        self.talus("run", PROJECT / "cases/wedge-hopper.toml", "--set", "bed.spacing=5mm", "--set", "box.depth=5mm",
                   "--set", "settle.speed=50mm/s", "--set", "settle.duration=1ms", "--set", "run.end=0.2s",
                   "--set", "output.pictures=false", "--out", "r")
        numbers = self.summary()
        self.assertNotIn("floor_stress_settled", numbers, "the bed stands on the walls of the wedge")
        self.assertGreater(numbers["discharge_rate_plateau"], 0)

    def test_the_page_of_quantities_is_that_of_this_program(self):
        self.assertEqual((PROJECT / "docs/quantities.md").read_text(), self.talus("schema", "--quantities").stdout,
                         "talus schema --quantities > docs/quantities.md")


if __name__ == "__main__":
    unittest.main()
