# SPDX-License-Identifier: Apache-2.0
"""talus calibrate --shear-cell and hopper-design, as a user meets them: intervals, refusals, and a case that takes the file."""
import re
import sys
import unittest
from pathlib import Path

import numpy as np
from program import PROJECT, ProgramTest

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
from talus import heap, powder  # noqa: E402

CASE = """model = "continuum"
[box]
width = "20 mm"
depth = "2 mm"
height = "30 mm"
[gate]
opens = "from-the-start"
[grains]
material = "my-powder.toml"
diameter = "50 um"
[walls]
material = "steel"
friction_from = "start"
[bed]
spacing = "2 mm"
height = "20 mm"
[collisions]
form = "none"
[run]
end = "0.2 ms"
[output]
pictures = false
report = false
"""
M, A0, KAPPA = 0.6, 150.0, 0.15


def loci(loads=(2000, 4000, 8000), shares=(0.25, 0.4, 0.55, 0.7), noise=None):
    """Consolidation, normal and shear stress of points of failure of a law, Pa. \\param noise generator of 3 %"""
    points = np.array([(load, share * load, M * (share * load + A0 + KAPPA * load)) for load in loads for share in shares])
    if noise is not None:
        points[:, 2] *= 1 + 0.03 * noise.standard_normal(len(points))
    return points.T


def text_of(points):
    rows = "\n".join(f"{a:.6g},{b:.6g},{c:.6g},620" for a, b, c in (points / [[1e3], [1e3], [1e3]]).T)
    return "consolidation [kPa],normal_stress [kPa],shear_stress [kPa],bulk_density [kg/m3]\n" + rows + "\n"


class Fits(unittest.TestCase):
    def test_loci_without_noise_give_the_law_back(self):
        for estimate, value in zip(powder.fit_loci(*loci()), (M, A0, KAPPA)):
            self.assertAlmostEqual(estimate.value / value, 1, 6)

    def test_of_loci_with_3_percent_of_noise_19_intervals_of_20_hold_the_law(self):
        noise = np.random.default_rng(51)
        trials = 1000
        held = np.zeros(3)
        for _ in range(trials):
            found = powder.fit_loci(*loci(noise=noise))
            held += [one.low <= value <= one.high for one, value in zip(found, (M, A0, KAPPA))]
        for share in held / trials:
            self.assertGreater(share, 0.93)  # two standard errors of 1000 trials below 0.95
            self.assertLess(share, 0.99)

    def test_a_powder_without_cohesion_has_none(self):
        consolidation, normal, _ = loci()
        friction, strength, growth = powder.fit_loci(consolidation, normal, 0.5 * normal - 10)
        self.assertEqual((strength.value, growth.value), (0, 0))
        self.assertAlmostEqual(friction.value, 0.5, delta=0.02)

    def test_a_wall(self):
        normal = np.array([500.0, 1000, 2000, 4000])
        friction, adhesion = powder.fit_wall(normal, 0.4 * normal + 60)
        self.assertAlmostEqual(friction.value, 0.4, 9)
        self.assertAlmostEqual(adhesion.value, 60, 6)
        self.assertEqual(powder.fit_wall(normal, 0.4 * normal - 60)[1].value, 0)

    def test_students_quantiles(self):
        for freedom, value in ((1, 12.706), (4, 2.776), (5, 2.571), (9, 2.262), (30, 2.042)):
            self.assertAlmostEqual(powder.student(freedom), value, delta=0.01)


class Heaps(unittest.TestCase):
    def test_the_slope_of_a_cone(self):
        spacing, slope = 1.0, np.tan(np.radians(30))
        x, y, z = np.meshgrid(*[np.arange(-60, 61) * spacing] * 2, np.arange(0, 40) * spacing + 0.5)
        inside = z + slope * np.hypot(x, y) < 30
        found = heap.slope_of(np.column_stack([x[inside], y[inside], z[inside]]), spacing)
        self.assertAlmostEqual(found, 30, delta=1.5)

    def test_secants_end_near_the_angle_that_was_asked_for(self):
        asked = []

        def heap_of(friction, number):
            asked.append(friction)
            return np.degrees(np.arctan(friction)) * 0.9 + 6.5
        for angle in (24, 30, 36):
            found, low, high = heap.friction_of(angle, heap_of, lambda _: None)
            self.assertAlmostEqual(heap_of(found, 0), angle, delta=0.2)
            self.assertLess(low, found)
            self.assertGreater(high, found)
        self.assertLess(len(asked), 3 * heap.MOST_RUNS)


class Calibrate(ProgramTest):
    def said(self, *arguments, status=0):
        done = self.talus(*arguments, status=status)
        return done.stdout + done.stderr

    def calibrate(self, text, *options, status=0):
        (self.folder / "loci.csv").write_text(text)
        return self.said("calibrate", "--shear-cell", "loci.csv", *options, "--out", "my-powder.toml", status=status)

    def test_a_case_takes_the_file(self):
        (self.folder / "wall.csv").write_text("normal_stress [kPa],shear_stress [kPa]\n1,0.36\n2,0.66\n4,1.26\n8,2.46\n")
        self.calibrate(text_of(loci()), "--wall", "steel=wall.csv")
        material = (self.folder / "my-powder.toml").read_text()
        self.assertRegex(material, r"\[law.critical-state.tensile_strength\]\nvalue = \"150 Pa\"")
        (self.folder / "case.toml").write_text(CASE)
        said = self.said("run", "case.toml", "--out", "run")
        manifest = (self.folder / "run" / "manifest.json").read_text()
        for key in ('tensile_strength = \\"150 Pa\\"', "consolidation_strength = 0.15", "coefficient = 0.3"):
            self.assertIn(key, manifest, said)
        self.assertNotIn("my-powder", re.sub(r'"command.*', "", manifest.split("case")[-1]))
        # The run is whole without the file.
        (self.folder / "my-powder.toml").unlink()
        self.talus("analyze", "run")

    def test_the_same_data_give_the_same_file(self):
        self.calibrate(text_of(loci()))
        first = (self.folder / "my-powder.toml").read_bytes()
        self.calibrate(text_of(loci()))
        self.assertEqual((self.folder / "my-powder.toml").read_bytes(), first)

    def test_everything_that_is_wrong_is_said_at_once_and_nothing_is_written(self):
        wrong_unit = text_of(loci()).replace("normal_stress [kPa]", "normal_stress [kg]")
        said = self.calibrate(wrong_unit, "--diameter", "3 kg", "--wall", "brick=x.csv", status=2)
        for words in ("no unit of pressure", "--diameter 3 kg", "--wall brick=x.csv"):
            self.assertIn(words, said)
        said = self.calibrate(text_of(loci()).replace("[kPa]", "[Pa]"), status=2)
        self.assertIn("is no stress of a shear tester", said)
        said = self.calibrate(text_of(loci(loads=[2000])), status=2)
        self.assertIn("two loci of different consolidation", said)
        said = self.calibrate(text_of(loci(shares=[0.5])), status=2)
        self.assertEqual(said.count("at least two loads below the consolidation"), 3)
        self.assertFalse((self.folder / "my-powder.toml").exists())

    def test_a_flow_factor_below_1_is_refused(self):
        rows = "consolidation [kPa],friction_angle [deg],cohesion [kPa],major_stress [kPa],bulk_density [kg/m3]\n1,30,2,2.2,600\n2,30,1,4,600\n"
        said = self.calibrate(rows, status=2)
        self.assertIn("loci.csv:2", said)
        self.assertIn("ff_c = 0.32", said)

    def test_loci_that_do_not_fix_the_law_are_refused(self):
        header = "consolidation [kPa],friction_angle [deg],cohesion [kPa],bulk_density [kg/m3]\n"
        for rows, words in (("2,31,0.27,600\n2,31,0.28,600\n", "two loci of different consolidation"),
                            ("2,31,0.27,600\n2,31,0.27,600\n", "two loci of different consolidation"),
                            ("2,90,0.27,600\n4,31,0.5,600\n", "loci.csv:2: friction_angle: 90 deg is out of range"),
                            ("2,85,0.27,600\n4,31,0.5,600\n", "allowed: above 0 and below 80 deg"),
                            ("2,31,0.27,0\n4,31,0.5,600\n", "loci.csv:2: bulk_density: 0 kg/m3 is out of range"),
                            ("1,31,1.05,600\n2,31,2.1,600\n4,31,4.2,600\n",
                             "--shear-cell loci.csv: gives a material that no case takes: my-powder.toml:")):
            with self.subTest(rows=rows):
                self.assertIn(words, self.calibrate(header + rows, status=2))
                self.assertFalse((self.folder / "my-powder.toml").exists())

    def test_a_column_without_its_unit_is_refused(self):
        said = self.calibrate("consolidation [kPa],friction_angle,cohesion [kPa],bulk_density\n2,31,0.27,600\n4,31,0.5,600\n", status=2)
        self.assertIn("loci.csv:1: friction_angle: needs a unit of angle; allowed: deg", said)
        self.assertIn("loci.csv:1: bulk_density: needs a unit of density; allowed: kg/m3", said)
        (self.folder / "wall.csv").write_text("normal_stress,shear_stress [kPa]\n1,0.36\n2,0.66\n4,1.26\n")
        said = self.calibrate(text_of(loci()), "--wall", "steel=wall.csv", status=2)
        self.assertIn("wall.csv:1: normal_stress: needs a unit of pressure", said)

    def test_walls_that_do_not_span_loads_and_grains_lighter_than_the_bed_are_refused(self):
        for rows, words in (("2,1\n2,1.1\n2,1.05\n", "its points are under one load"),
                            ("2,0.7\n1.6,0.9\n1.3,1.05\n", "its shear stress does not grow with the load")):
            (self.folder / "wall.csv").write_text("normal_stress [kPa],shear_stress [kPa]\n" + rows)
            self.assertIn(words, self.calibrate(text_of(loci()), "--wall", "steel=wall.csv", status=2))
        said = self.calibrate(text_of(loci()), "--grain-density", "500 kg/m3", status=2)
        self.assertIn("--grain-density 500 kg/m3: is no more than the bulk density of 620 kg/m3", said)
        self.assertFalse((self.folder / "my-powder.toml").exists())

    def test_rows_of_pre_shear_count_by_their_mean_in_any_order(self):
        """One of 40 Pa more and one of 40 Pa less, of other densities, say what one alone does."""
        def rows_of(order):
            return "".join(f"{load},{load},{0.95 * M * (load + A0 + KAPPA * load) + 40 * sign},{620 + 20 * sign}\n"
                           for load in (2000, 4000, 8000) for sign in order)
        header = "consolidation [Pa],normal_stress [Pa],shear_stress [Pa],bulk_density [kg/m3]\n"
        failures = "".join(f"{a},{b},{c},500\n" for a, b, c in loci().T)
        said = [self.calibrate(header + rows_of(order) + failures) for order in ((0,), (1, -1), (-1, 1))]
        files = (self.folder / "my-powder.toml").read_text()
        self.assertEqual(said[0], said[1])
        self.assertEqual(said[0], said[2])
        self.assertIn("620 kg/m3", files)

    def test_columns_by_semicolons_or_tabs_with_decimal_commas(self):
        self.calibrate(text_of(loci()))
        first = (self.folder / "my-powder.toml").read_text()
        for separator in ";\t":
            self.calibrate(text_of(loci()).replace(",", separator).replace(".", ","))
            self.assertEqual((self.folder / "my-powder.toml").read_text(), first)
        said = self.calibrate(text_of(loci()).replace(",", ";") + "8;1,000;2.1;620\n", status=2)
        self.assertIn("'1,000' has another decimal mark than entries before", said)

    def test_loci_stronger_than_the_fit_are_warned_of(self):
        """Pre-shear below the loci: ff_c 1.25 where the law, which ends on them, has 1.75."""
        said = self.said("calibrate", "--shear-cell", str(PROJECT / "validation/shear-tester/data/lumacaftor.csv"), "--out", "my-powder.toml")
        self.assertRegex(said, "Warning: at the loci's sigma_1 the fit has 7. % of their f_c: .* on the unsafe side")
        self.assertIn("# Warning: at the loci's sigma_1", (self.folder / "my-powder.toml").read_text())
        self.assertNotIn("Warning", self.calibrate(text_of(loci())))

    def test_slips_in_a_material_file_are_said_with_their_lines(self):
        self.calibrate(text_of(loci()))
        path = self.folder / "my-powder.toml"
        path.write_text(path.read_text().replace('"150 Pa"', '"150 kg"').replace("static_friction", "static_frition"))
        (self.folder / "case.toml").write_text(CASE)
        said = self.said("check", "case.toml", status=2)
        self.assertRegex(said, r"my-powder.toml:\d+: law.critical-state.tensile_strength.value: \"150 kg\" is not a pressure")
        self.assertRegex(said, r"my-powder.toml:\d+: law.critical-state.static_frition: is no key")
        self.assertRegex(said, r"case.toml:\d+: walls.material: no friction of my-powder on steel is known")

    def test_hopper_design_of_the_file(self):
        self.calibrate(text_of(loci()))
        said = self.said("hopper-design", "--material", "my-powder.toml", "--wall", "0.35", "--outlet", "1 m", "--silo-diameter", "4 m",
                          "--silo-height", "8 m")
        for words in ("critical outlet", "rathole", "Johanson", "EN 1991-4"):
            self.assertIn(words, said)
        self.assertNotIn("funnel", said.replace("if the flow is a funnel", ""))
        said = self.said("hopper-design", "--material", "my-powder.toml", "--wall", "0.35", "--outlet", "1 m", "--half-angle", "60 deg")
        self.assertEqual(len(re.findall(r"(?m)^(?:flow factor there|critical outlet|discharge, coarse grains) +funnel +funnel ", said)), 3)
        self.assertIn("wedge: funnel flow beyond the limit", " ".join(said.split()))
        for angle, words in (("20", '"20" has no unit'), ("95 deg", "is out of range; allowed: above 0 and below 90 deg")):
            self.assertIn(words, self.said("hopper-design", "--material", "cement", "--half-angle", angle, status=2))
        said = self.said("hopper-design", "--material", "flour", status=2)
        self.assertTrue(said.startswith("--material flour: is no material"), said)
        said = self.said("hopper-design", "--material", "nosuch", "--wall", "brick", "--outlet", "3", status=2)
        self.assertEqual(len(said.strip().split("\n")), 4)

    def test_hopper_design_by_delta_with_adhesion_and_beyond_the_range(self):
        """kappa alone: delta by it, at any stress; no outlet arches, or all do, and no stress is told."""
        self.calibrate(text_of(loci()))
        path = self.folder / "my-powder.toml"
        text = path.read_text()
        sticky = text.replace('value = "150 Pa"', 'value = "0 Pa"').replace("value = 0.15\n", "value = 0.774\n")
        path.write_text(sticky)
        said = self.said("hopper-design", "--material", "my-powder.toml", "--wall", "0.3")
        self.assertRegex(said, r"effective angle, delta +49\.\d deg +49\.\d deg")
        self.assertRegex(said, r"half angle of mass flow, at most +\S+ deg +30\.\d deg")
        path.write_text(sticky.replace("value = 0.774\n", "value = 1.0\n")
                        .replace("static_friction]\nvalue = 0.6\n", "static_friction]\nvalue = 0.9\n").replace("value = 0.856\n", "value = 1.2\n"))
        said = self.said("hopper-design", "--material", "my-powder.toml", "--wall", "0.2", "--half-angle", "10 deg")
        self.assertRegex(said, r"sigma_1 there +none +none")
        self.assertRegex(said, r"critical outlet +arches +arches")
        path.write_text(text + '\n[walls.steel]\nvalue = 0.3\nadhesion = "100 Pa"\n')
        said = self.said("hopper-design", "--material", "my-powder.toml", "--silo-diameter", "6 m", "--silo-height", "12 m")
        self.assertRegex(said, r"angle of the wall at the outlet +30\.\d deg +29\.\d deg")
        self.assertRegex(said, r"half angle there, at most +21\.\d deg +15\.\d deg")
        self.assertRegex(said, r"! sigma_1 of [\d.]+ kPa: the values of my-powder hold up to 8 kPa")
        words = ("hopper-design", "--material", "my-powder.toml", "--outlet", "300 mm", "--half-angle")
        self.assertRegex(self.said(*words, "25 deg"), r"discharge, coarse grains +\S+ t/h +funnel")
        self.assertRegex(self.said(*words, "20 deg"), r"discharge, coarse grains +\S+ t/h +\S+ t/h")
        of_angle, of_number = (self.said("hopper-design", "--material", "glass-beads", "--wall", wall)
                               for wall in ("16.699244 deg", "0.3"))
        self.assertEqual(of_angle.split("\n")[1:], of_number.split("\n")[1:])
        said = self.said("hopper-design", "--material", "glass-beads")
        self.assertIn("below 30 deg the closed forms are", " ".join(said.split()))


if __name__ == "__main__":
    unittest.main()
