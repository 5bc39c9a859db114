# SPDX-License-Identifier: Apache-2.0
"""A study from its reference to its report: the runs, the rows, the figures."""
import json
import re
import shutil
import unittest

from program import PROJECT, ProgramTest

CASE = "cases/yuu2011-hopper-vacuum.toml"
REFERENCE = "validation/yuu2011/reference.toml"


class Hopper(ProgramTest):
    """The hopper's study for 30 ms, with particles of 5 mm."""

    def setUp(self):
        super().setUp()
        for name in (CASE, REFERENCE):
            (self.folder / name).parent.mkdir(parents=True)
            shutil.copy(PROJECT / name, self.folder / name)
        self.replace(CASE, r"(?m)^spacing = .*$", 'spacing = "5 mm"')
        self.replace(CASE, r"(?m)^end = .*$", 'end = "30 ms"')

    def replace(self, name, pattern, text):
        path = self.folder / name
        path.write_text(re.sub(pattern, text, path.read_text()))

    def test_two_variants(self):
        arguments = ("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum", "--variant", "vacuum-stiff")
        self.talus(*arguments, status=1)
        rows = {row["id"]: row for row in json.loads((self.folder / "r/comparison.json").read_text())["rows"]}
        self.assertEqual(rows["packing"]["verdict"], "met")
        self.assertEqual(rows["air-drag"]["verdict"], "not evaluated")
        self.assertEqual(rows["vacuum-discharge-plateau"]["verdict"], "not evaluated", "the run ends before")
        self.assertLess(abs(rows["settled-floor-stress"]["values"][0]), 0.05)
        report = (self.folder / "r/yuu2011.md").read_text()
        for figure in re.findall(r"\]\((figures/[^)]*)\)", report):
            self.assertEqual((self.folder / "r" / figure).read_bytes()[:4], b"\x89PNG")
        self.assertIn("figures/figure_04_vacuum-stiff.png", report)
        self.assertIn("figures/figure_06.png", report)

        first = (self.folder / "r/comparison.json").read_bytes()
        (self.folder / "r/comparison.json").unlink()
        self.talus(*arguments, "--resume", status=1)
        again = json.loads((self.folder / "r/comparison.json").read_text())
        self.assertEqual(again, json.loads(first))
        said = self.talus("compare", "r/hopper-vacuum", REFERENCE, status=1).stdout
        self.assertIn("packing_max", said)

    def test_unknown_variant(self):
        said = self.talus("reproduce", "yuu2011", "--out", "r", "--variant", "vacum", status=2).stderr
        self.assertIn("vacuum", said)
        self.assertFalse((self.folder / "r").exists())


if __name__ == "__main__":
    unittest.main()
