# SPDX-License-Identifier: Apache-2.0
"""The key accuracy as a user meets it: forecasts, problems, a run and its resume."""
import json
import re
import unittest

from program import InputTest

SILO = """model = "continuum"
accuracy = "design"

[box]
width = "100 mm"
depth = "100 mm"
height = "170 mm"
floor = "open"

[removal]
below = "30 mm"

[[vessel]]
name = "cylinder"
shape = "cylinder"
radius = "32.5 mm"
bottom = "90.3 mm"
top = "160 mm"

[[vessel]]
name = "cone"
shape = "cone"
lower_radius = "15 mm"
upper_radius = "32.5 mm"
bottom = "60 mm"
top = "90.3 mm"

[[vessel]]
name = "gate"
shape = "disc"
radius = "15 mm"
height = "60 mm"
gate = true

[gate]
opens = "from-the-start"

[bed]
packing = 0.6
height = "80 mm"

[run]
end = "0.02 s"
"""


class Accuracy(InputTest):
    def setUp(self):
        super().setUp()
        (self.folder / "case.toml").write_text(SILO)

    def test_every_problem_is_told(self):
        problems = self.problems("check", "case.toml", "--set", "accuracy=desing", "--set", "grains.density=-1 kg/m3")
        self.assertTrue(any('accuracy: "desing"' in p and "design" in p for p in problems), problems)
        self.assertTrue(any("grains.density" in p for p in problems), problems)

    def test_check_forecasts_each(self):
        said = self.talus("check", "case.toml").stdout
        self.assertRegex(said, r"accuracy +sets what the case leaves out:\n    draft .*\n(.*\n)*?    design .*\n(.*\n)*?"
                               r"    reference ")

    def test_what_is_the_same_case_is_measured_once(self):
        kept = SILO.replace('floor = "open"\n', "").replace('[removal]\nbelow = "30 mm"\n', "").replace("0.02 s", "1000 s")
        (self.folder / "case.toml").write_text(kept)
        said = self.talus("check", "case.toml", "--set", "accuracy=draft").stdout
        time = re.search(r"\n  time +(.*)\n", said).group(1)
        self.assertIn(time + ":", re.search(r"\n    draft +(.*)\n", said).group(1))

    def test_a_run_keeps_what_was_set(self):
        self.talus("run", "case.toml", "--out", "r", "--set", "accuracy=draft")
        case = json.loads((self.folder / "r/manifest.json").read_text())["case"]
        text = json.dumps(case)
        self.assertIn('accuracy = \\"draft\\"', text)
        self.assertIn('spacing = \\"0.00375 m\\"', text)
        self.assertIn('pair_precision = \\"single\\"', text)
        self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "accuracy=draft", "--set", "run.end=0.025 s")
        said = self.talus("run", "case.toml", "--out", "r", "--resume", "--set", "accuracy=design", status=2).stderr
        self.assertIn("accuracy", said)


if __name__ == "__main__":
    unittest.main()
