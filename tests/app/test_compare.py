# SPDX-License-Identifier: Apache-2.0
"""Two runs beside each other: what is said, and that nothing is written that nobody asked for."""
import json
import os
import subprocess
import unittest

from program import PROJECT, ProgramTest, tree


class Compare(ProgramTest):
    def test_two_runs(self):
        self.talus("run", "case.toml", "--out", "a")
        self.talus("run", "case.toml", "--out", "b", "--set", "slope.angle=50 deg")
        before = tree(self.folder)
        said = self.talus("compare", "a", "b").stdout
        self.assertEqual(tree(self.folder), before)
        self.assertIn('slope.angle: "45 deg"   |   "50 deg"', said)
        self.assertIn("front_speed_max", said)
        self.assertNotIn("Picture", said)
        self.assertIn("Picture: both.png", self.talus("compare", "a", "b", "--picture", "both.png").stdout)
        self.assertEqual((self.folder / "both.png").read_bytes()[:4], b"\x89PNG")
        self.assertEqual(set(tree(self.folder)) - set(before), {"both.png"})


REFERENCE = """study = "fall"
title = "A circle"
source = "nobody"
[case.circle]
file = "case.toml"
where = { "model" = "cloud" }
[case.circle.variant]
all = {}
"""
ROW = """[[row]]
id = "{id}"
number = 1
quantity = "{quantity}"
case = "circle"
variant = ["all"]
estimator = "e"
from = "{of}"
{more}
printed = "1"
unit = "{unit}"
criterion = {{ between = [0, 1000] }}
source = "p"
"""
MEASURES = """from talus.measures import NotEvaluated, Quantity
def grains(run, window, **place):
    return len(run.snapshots.at(0)["radius"])
def scaled(run, window, height):
    return grains(run, window) * height
def missing(run, window):
    raise NotEvaluated("there is no such angle")
def members(groups, window):
    return sum(len(group) for group in groups)
QUANTITIES = {
    "grains": Quantity("1", "how many", grains),
    "scaled_grains": Quantity("m", "their number times a height", scaled, place=("height",)),
    "angle": Quantity("deg", "of none", missing),
    "members": Quantity("1", "of all variants", members, together=True)}
"""


class OfAStudy(ProgramTest):
    """Quantities of a measures.py beside the reference."""

    def setUp(self):
        super().setUp()
        (self.folder / "study").mkdir()
        self.write_measures(MEASURES)
        for seed in (1, 2):
            self.talus("run", "case.toml", "--out", f"r/{seed}", "--set", f"seed={seed}")

    def write_measures(self, text):
        (self.folder / "study/measures.py").write_text(text)

    def rows(self, *rows, status=0, env=None):
        """The evaluated rows by id, and what was said. \\param rows quantity, unit and more"""
        text = REFERENCE + "".join(ROW.format(**{"id": row["quantity"], "unit": "1", "of": "each", "more": ""} | row)
                                   for row in rows)
        (self.folder / "study/reference.toml").write_text(text)
        said = self.talus("compare", "r", "study/reference.toml", "--json", "rows.json", status=status,
                          env={**os.environ, **(env or {})})
        if status == 2 or status == 4:
            return said.stderr
        return {row["id"]: row for row in json.loads((self.folder / "rows.json").read_text())["rows"]}, said.stdout

    def test_values(self):
        rows, said = self.rows({"quantity": "grains"},
                               {"quantity": "scaled_grains", "unit": "m", "more": 'place = { height = "50 mm" }'},
                               {"quantity": "members", "of": "values"}, {"quantity": "front_speed_max"},
                               {"quantity": "angle", "unit": "deg"},
                               {"id": "late", "quantity": "grains", "more": "window = { at = 1e9 }"})
        self.assertEqual(rows["grains"]["values"], [60])
        self.assertEqual(rows["scaled_grains"]["values"], [60 * 0.05])
        self.assertEqual(rows["members"]["values"], [2])
        self.assertIsInstance(rows["front_speed_max"]["values"][0], float, "the program's own")
        self.assertEqual(rows["angle"]["verdict"], "not evaluated")
        self.assertEqual(rows["angle"]["missing"], "there is no such angle")
        self.assertIn("1 row not evaluated: there is no such angle", said)
        self.assertEqual(rows["late"]["verdict"], "not evaluated")
        self.assertIn("ends before", rows["late"]["missing"])
        self.assertFalse((self.folder / "study/__pycache__").exists(), "nothing is left beside the study")

    def test_what_is_wrong_with_rows(self):
        said = self.rows({"quantity": "grain"}, {"quantity": "front_sped_max"}, {"quantity": "angle"},
                         {"quantity": "scaled_grains", "unit": "m"},
                         {"id": "two", "quantity": "grains", "more": 'place = { height = "1 m" }'}, status=2)
        self.assertIn('there is no quantity "grain"', said)
        self.assertIn("grains", said)
        self.assertIn("front_speed_max", said, "the nearest of both lists")
        self.assertIn("is not that of angle", said)
        self.assertIn("scaled_grains needs height", said)
        self.assertIn("grains takes no height", said)

    def test_without_python(self):
        stand_in = self.folder / "bin/python3"
        stand_in.parent.mkdir()
        stand_in.write_text("#!/bin/sh\nexit 1\n")
        stand_in.chmod(0o755)
        without = {**os.environ, "PATH": str(stand_in.parent)}
        for command in (("compare", "r/1", "r/2"), ("ensemble", "case.toml"), ("reproduce", "niiya2020")):
            said = self.talus(*command, status=1, env=without)
            self.assertEqual(said.stderr, f"talus: {command[0]} takes python3 with numpy, h5py and the package talus (Debian: "
                                          "python3-numpy, python3-h5py, python3-talus)\n")
            self.assertEqual(said.stdout, "")
        self.assertIn("Done", self.talus("run", "case.toml", "--out", "alone", env=without).stdout)

    def test_measures_that_fail(self):
        self.write_measures("QUANTITIES = 1 / 0\n")
        said = self.rows({"quantity": "grains"}, status=4)
        self.assertIn("measures.py", said)
        self.assertIn("ZeroDivisionError", said)

    def test_several_runs_together_take_a_study(self):
        (self.folder / "study/measures.py").unlink()
        said = self.rows({"quantity": "front_speed_max", "of": "curves"}, status=2)
        self.assertIn("measures.py", said)

    def test_as_a_table(self):
        table = subprocess.run(["/usr/bin/python3", "-B", "-m", "talus.measures", "--table", self.folder / "study"],
                               env={**os.environ, "PYTHONPATH": str(PROJECT / "python")}, check=True,
                               capture_output=True, text=True).stdout
        self.assertIn("| `scaled_grains` | m | their number times a height | height |", table)


if __name__ == "__main__":
    unittest.main()
