# SPDX-License-Identifier: Apache-2.0
"""talus calibrate --shear-cell and hopper-design, as a user meets them: intervals, refusals, and a case that takes the file."""
import re
import sys
import unittest
from pathlib import Path

import numpy as np
from program import ProgramTest

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
        said = self.said("hopper-design", "--material", "nosuch", "--wall", "brick", "--outlet", "3", status=2)
        self.assertEqual(len(said.strip().split("\n")), 4)


if __name__ == "__main__":
    unittest.main()
