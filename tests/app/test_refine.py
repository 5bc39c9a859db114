# SPDX-License-Identifier: Apache-2.0
"""talus run --refine: a case and a finer one, and what both say of none; where that makes no sense it is refused."""
import json
import unittest

from program import CASE as CLOUD
from program import ProgramTest

CASE = """
model = "continuum"
[box]
width = "30 mm"
depth = "30 mm"
height = "60 mm"
front = "wall"
rear = "wall"
[bed]
spacing = "5 mm"
height = "30 mm"
[gate]
opens = "from-the-start"
[run]
end = "1 ms"
[output]
report = false
pictures = false
"""


class Refine(ProgramTest):
    def write(self, text):
        (self.folder / "case.toml").write_text(text)

    def summary(self, folder):
        return json.loads((self.folder / folder / "summary.json").read_text())["quantities"]

    def test_both_runs_stand_beside_each_other_and_the_table_extrapolates(self):
        self.write(CASE)
        said = self.talus("run", "case.toml", "--out", "run", "--refine", "--threads", 1).stdout
        coarse, fine = self.summary("run"), self.summary("run-refined")
        found = json.loads((self.folder / "run/analysis/refinement.json").read_text())
        self.assertEqual(found["ratio"], 1.5)
        for name in ("packing_max", "mass_error"):
            q = found["quantities"][name]
            self.assertEqual((q["coarse"], q["fine"]), (coarse[name]["value"], fine[name]["value"]))
            self.assertAlmostEqual(q["extrapolated"], q["fine"] + 2 * (q["fine"] - q["coarse"]))
            self.assertAlmostEqual(q["error"], abs(q["extrapolated"] - q["fine"]))
        self.assertNotEqual(found["quantities"]["packing_max"]["coarse"], found["quantities"]["packing_max"]["fine"])
        self.assertNotIn("wall_seconds", found["quantities"])
        self.assertRegex(said, r"packing_max +[0-9.]+ +[0-9.]+")
        manifest = json.loads((self.folder / "run-refined/manifest.json").read_text())
        self.assertIn("0.00333333", manifest["case"])

    def test_cells_of_the_air_are_divided_too(self):
        self.write(CASE + '[air]\nenabled = true\ncell = "6 mm"\n')
        self.talus("run", "case.toml", "--out", "run", "--refine", "--threads", 1)
        manifest = json.loads((self.folder / "run-refined/manifest.json").read_text())
        self.assertRegex(manifest["case"], r"cell = \"0\.004 m\"|cell = \"4 mm\"")

    def test_a_section_a_fixed_step_and_a_cloud_are_refused_before_anything_is_written(self):
        self.write(CASE.replace('depth = "30 mm"', 'depth = "5 mm"'))
        said = self.talus("run", "case.toml", "--out", "run", "--refine", status=2).stderr
        self.assertRegex(said, r"box\.depth.*a section.*at least 15 mm")
        self.write(CASE + '[integration]\nstep = "1 us"\n')
        self.assertIn("integration.step", self.talus("run", "case.toml", "--out", "run", "--refine", status=2).stderr)
        self.write(CLOUD)
        self.assertIn("bed.spacing", self.talus("run", "case.toml", "--out", "run", "--refine", status=2).stderr)
        self.assertFalse((self.folder / "run").exists())


if __name__ == "__main__":
    unittest.main()
