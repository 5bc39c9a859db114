# SPDX-License-Identifier: Apache-2.0
"""Keys that mean nothing under the choices of a case, old names of keys, and what leaves the range of a law."""
import json
import unittest

from program import CASE, HOPPER, InputTest


class Choices(InputTest):
    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(HOPPER)

    def given(self, *settings, command="check"):
        return self.problems(command, "case.toml", *(part for s in settings for part in ("--set", s)))

    def assert_one(self, setting, *parts, others=()):
        [problem] = self.given(*others, setting)
        self.assertTrue(problem.startswith(f"--set {setting}: {setting.split('=')[0]}: "), problem)
        for part in parts:
            self.assertIn(part, problem)

    def test_a_key_of_another_law(self):
        self.assert_one("law.drucker-prager.friction=0.5", 'given, but law.name is "critical-state"',
                        'allowed: law.name = "drucker-prager"')
        self.assert_one("law.linear-elastic.lambda=1 MPa", 'but law.name is "drucker-prager"',
                        others=["law.name=drucker-prager"])

    def test_a_key_of_the_chosen_law(self):
        said = self.talus("check", "case.toml", "--all", "--set", "law.name=drucker-prager", "--set",
                          "law.drucker-prager.friction=0.5").stdout
        self.assertIn("law.drucker-prager.friction", said)
        self.assertNotIn("law.critical-state.", said)

    def test_a_key_of_an_option_that_is_not_taken(self):
        for setting, but, *others in (
                ("air.pressure=10 Pa", "air.enabled is false"),
                ("air.cell=5 mm", "air.enabled is false", "air.enabled=false"),
                ("air.top_pressure=1 Pa", 'air.top is "wall"', "air.enabled=true", "air.top=wall"),
                ("air.upwind=0.5", 'air.motion is "frozen"', "air.enabled=true", "air.motion=frozen"),
                ("gate.time=1 ms", 'gate.opens is "when-settled"'),
                ("settle.speed=1 mm/s", 'gate.opens is "at-time"', "gate.opens=at-time"),
                ("walls.coefficient=0.5", 'walls.friction is "none"', "walls.friction=none"),
                ("collisions.normal=1", 'collisions.form is "none"', "collisions.form=none"),
                ("law.yuu-umekage.compaction=1", 'law.yuu-umekage.volume is "density"', "law.name=yuu-umekage"),
                ("sph.density_relaxation=0.5", 'law.name is "linear-elastic"; allowed: law.name of grains that flow',
                 "law.name=linear-elastic"),
                ("collisions.range=printed", 'collisions.form is "none"', "collisions.form=none"),
                ("law.critical-state.ageing_time=1 ms", "law.critical-state.ageing_strength is 0",
                 "law.name=critical-state", "law.critical-state.ageing_strength=0")):
            self.assert_one(setting, f"given, but {but}", others=others)

    def test_keys_of_the_cloud_too(self):
        (self.folder / "case.toml").write_text(CASE)
        self.assert_one("contact.stiffness=1 N/m", "contact.enabled is false", others=["contact.enabled=false"])
        self.assert_one("fluid.precision=single", 'fluid.mobility is "none"', others=["fluid.mobility=none"])

    def test_old_names_tell_the_new_ones(self):
        (self.folder / "case.toml").write_text(HOPPER + '[law]\nscale = 4\nform = "printed"\ncollisions = "none"\n'
                                               'friction = 0.4\n')
        problems = self.problems("run", "case.toml")
        for problem, (line, key, now) in zip(problems, ((16, "scale", "law.yuu-umekage.scale"),
                                                        (17, "form", 'law.name = "yuu-umekage"'),
                                                        (18, "collisions", "collisions.form"),
                                                        (19, "friction", "law.drucker-prager.friction")), strict=True):
            self.assertTrue(problem.startswith(f"case.toml:{line}: law.{key}: has another name now"), problem)
            self.assertIn(now, problem)
        self.assert_nothing_written()

    def test_old_names_of_every_model_tell_one_new_key(self):
        for case, known, pairs in (
                (HOPPER, "continuum", {
                    "law.critical-state.friction": "static_friction", "law.critical-state.fast_friction": "dynamic_friction",
                    "law.critical-state.loosest_packing": "random_loose_packing",
                    "law.critical-state.loosening": "packing_slope", "law.critical-state.strength_at_rest": "ageing_strength",
                    "law.critical-state.strength_adds": "ageing_adds", "law.critical-state.healing_time": "ageing_time",
                    "law.critical-state.breaking_strain": "ageing_strain", "law.yuu-umekage.largest_deviator": "max_deviator",
                    "law.yuu-umekage-printed.largest_deviator": "max_deviator",
                    "law.drucker-prager.largest_deviator": "max_deviator", "settle.longest": "max_time",
                    "air.longest_step": "max_step", "air.most_iterations": "max_iterations"}),
                (CASE, "cloud", {"integration.largest_step": "max_step", "integration.largest_overlap": "max_overlap"}),
                ('model = "air"\n', "air", {"air.longest_step": "max_step", "air.most_iterations": "max_iterations"})):
            (self.folder / "case.toml").write_text(case)
            page = self.talus("schema", known).stdout
            for old, name in pairs.items():
                with self.subTest(model=known, key=old):
                    now = old.rpartition(".")[0] + "." + name
                    problems = "\n".join(self.problems("check", "case.toml", "--set", f"{old}=1"))
                    self.assertIn(f"{old}: has another name now; allowed: {now}", problems)
                    self.assertIn(f'"{name}"', page)

    def test_an_angle_for_a_friction(self):
        self.assert_one("walls.coefficient=35", "35 looks like an angle in degrees, whose tangent is 0.70")
        self.assert_one("law.drucker-prager.friction=35", "35 looks like an angle", "0.70",
                        others=["law.name=drucker-prager"])

    def warnings(self, *settings):
        """Names of the warnings of a run's summary; `check` and the card have the same before and at the end."""
        options = [part for s in ("law.name=yuu-umekage", *settings) for part in ("--set", s)]
        checked = self.talus("check", "case.toml", *options).stdout
        out = f"r{len(list(self.folder.iterdir()))}"
        said = self.talus("run", "case.toml", "--out", out, *options, "--set", "output.pictures=false", "--set",
                          "gate.opens=from-the-start").stdout
        found = json.loads((self.folder / out / "summary.json").read_text())["warnings"]
        for warning in found:
            self.assertIn("! " + warning.split(": ", 1)[1], said)
        names = [warning.split(":")[0] for warning in found]
        for name in ("grain-diameter", "particles-across-the-outlet", "particle-spacing-over-grain-diameter",
                     "weight-of-the-bed-over-its-area", "grains-across-the-outlet"):
            self.assertEqual(name in names, f"! {name.replace('-', ' ')} = " in checked, checked)
        return names

    def test_what_leaves_the_range_of_the_law_is_warned_of(self):
        self.assertEqual([n for n in self.warnings() if "grain" in n or "particle" in n or "weight" in n], [])
        self.assertIn("grain-diameter", self.warnings("grains.diameter=1 mm"))
        self.assertNotIn("grain-diameter", self.warnings("grains.diameter=1 mm", "law.name=drucker-prager",
                                                         "law.drucker-prager.friction=0.5"))
        metre = self.warnings("grains.diameter=1 m")
        for name in ("grain-diameter", "particle-spacing-over-grain-diameter", "grains-across-the-outlet"):
            self.assertIn(name, metre)
        self.assertIn("particles-across-the-outlet", self.warnings("plate.slit_left=40 mm", "plate.slit_right=65 mm"))
        self.assertIn("weight-of-the-bed-over-its-area", self.warnings("law.yuu-umekage.scale=0.5"))

    def test_warnings_of_a_cloud(self):
        (self.folder / "case.toml").write_text(CASE)
        self.assertIn("Reynolds number of a single grain", self.talus("check", "case.toml").stdout.split("Warnings")[1])
        self.talus("run", "case.toml", "--out", "r")
        found = json.loads((self.folder / "r/summary.json").read_text())["warnings"]
        self.assertIn("reynolds-number-of-a-single-grain", [warning.split(":")[0] for warning in found])


if __name__ == "__main__":
    unittest.main()
