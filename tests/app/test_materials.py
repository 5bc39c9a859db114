# SPDX-License-Identifier: Apache-2.0
"""Materials by name, as a user meets them: values that follow, values that win, slips, and warnings."""
import json
import re
import unittest

from program import InputTest, ProgramTest

CASE = """model = "continuum"
[box]
width = "20 mm"
depth = "2 mm"
height = "30 mm"
[gate]
opens = "from-the-start"
[grains]
material = "sand"
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


def line_of(said, key):
    """Value and origin of a key in the table of talus check."""
    found = re.search(rf"^  {re.escape(key)} +(\S+)(?: (\S+))? +(given|material|bed|method|default|option) ", said, re.M)
    return found.group(1), found.group(3)


class Materials(ProgramTest):
    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(CASE)

    def check(self, *options):
        return self.talus("check", "case.toml", "--all", "--threads", 1, *options).stdout

    def test_values_follow_and_what_the_case_gives_holds(self):
        said = self.check()
        self.assertEqual(line_of(said, "grains.density"), ("2650", "material"))
        self.assertEqual(line_of(said, "walls.coefficient"), ("0.48", "material"))
        self.assertEqual(line_of(said, "law.name")[1], "material")
        self.assertEqual(line_of(said, "law.critical-state.static_friction"), ("0.675", "material"))
        modulus, origin = line_of(said, "law.critical-state.bulk_modulus")
        self.assertEqual(origin, "bed")
        self.assertAlmostEqual(float(modulus) / (1000 * 0.55 * 2650 * 9.81 * 0.02), 1, 6)
        said = self.check("--set", "grains.density=2600 kg/m3", "--set", "walls.coefficient=0.1")
        self.assertEqual(line_of(said, "grains.density"), ("2600", "option"))
        self.assertEqual(line_of(said, "walls.coefficient"), ("0.1", "option"))

    def test_a_run_goes_on_with_the_same_values(self):
        self.talus("run", "case.toml", "--out", "first")
        case = json.loads((self.folder / "first" / "manifest.json").read_text())["case"]
        self.assertIn('material = "sand"', case)
        self.assertIn("static_friction = 0.675", case)
        (self.folder / "again.toml").write_text(case)
        self.talus("run", "again.toml", "--out", "second")
        self.assertEqual((self.folder / "first" / "series.csv").read_bytes(),
                         (self.folder / "second" / "series.csv").read_bytes())

    def test_grains_and_pressures_out_of_range_warn(self):
        self.assertNotIn("Warnings", self.check())
        said = self.check("--set", "grains.diameter=0.05 mm")
        self.assertRegex(said, r"! diameter of the material's grains = 0.05 mm: the values of sand hold from 0.1 to 2 mm")
        said = re.sub(r"\s+", " ", self.check("--set", "gravity.acceleration=5000 m/s2"))
        self.assertIn("the values of sand hold up to a pressure of 1e+05 Pa", said)
        self.talus("run", "case.toml", "--out", "fine", "--set", "grains.diameter=0.05 mm")
        summary = json.loads((self.folder / "fine" / "summary.json").read_text())
        self.assertIn("diameter-of-the-material-s-grains", json.dumps(summary["warnings"]))

    def test_every_key_beyond_the_range_of_its_material_warns(self):
        for key, value, kept in (("grains.density", "1600 kg/m3", "2630 kg/m3 to 2670 kg/m3"),
                                 ("grains.density", "1.6 kg/m3", "2630 kg/m3 to 2670 kg/m3"),
                                 ("bed.packing", "0.3", "0.506 to 0.626"), ("bed.packing", "0.7", "0.506 to 0.626"),
                                 ("law.critical-state.static_friction", "0.5", "0.625 to 0.727")):
            said = self.check("--set", f"{key}={value}")
            self.assertRegex(said, rf"! {re.escape(key)} = {value}: the range of sand is {kept}")
        self.assertNotIn("Warnings", self.check("--set", "grains.density=2640 kg/m3", "--set", "bed.packing=0.6"))
        self.talus("run", "case.toml", "--out", "light", "--set", "grains.density=1600 kg/m3")
        summary = json.loads((self.folder / "light" / "summary.json").read_text())
        self.assertIn("grains-density", json.dumps(summary["warnings"]))

    def test_they_are_listed_with_their_sources(self):
        said = self.talus("materials").stdout
        for name in ("glass-beads", "sand", "wheat", "maize"):
            self.assertIn(name, said)
            values = self.talus("materials", name).stdout
            self.assertRegex(re.sub(r"\s+", " ", values),
                             r"test: [a-z ]+, \S+ deg; as an angle \S+ degrees on the plane of a shear tester, \S+ in plane "
                             r"strain, \S+ in triaxial compression")
            self.assertRegex(values, r"walls\.steel = 0\.\d+  \(0\.\d+ to 0\.\d+\)\n  \S")


class Slips(InputTest):
    def test_the_nearest_name_is_said(self):
        (self.folder / "case.toml").write_text(CASE.replace("sand", "glass_bead").replace("steel", "steal"))
        problems = self.problems("check", "case.toml")
        self.assertEqual(len(problems), 2)
        self.assertIn("glass-beads", problems[0])
        self.assertIn("steel", problems[1])
        (self.folder / "case.toml").write_text(CASE.replace('material = "sand"', 'density = "2500 kg/m3"'))
        self.assertIn("the grains have no material", self.problems("check", "case.toml")[0])
        (self.folder / "case.toml").write_text(CASE.replace("steel", "glass"))
        self.assertIn("no friction of sand on glass is known", self.problems("check", "case.toml")[0])


if __name__ == "__main__":
    unittest.main()
