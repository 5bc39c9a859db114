# SPDX-License-Identifier: Apache-2.0
"""A study from its reference to its report: the runs, the rows, the figures."""
import json
import os
import re
import shutil
import subprocess
import unittest
from pathlib import Path

from program import PROJECT, ProgramTest


class Study(ProgramTest):
    """A project of its own, whose cases and references are made small."""

    def setUp(self):
        super().setUp()
        ignore = shutil.ignore_patterns("__pycache__")
        for name in ("cases", "validation", "python"):
            shutil.copytree(PROJECT / name, self.folder / name, ignore=ignore)

    def replace(self, name, pattern, text):
        path = self.folder / name
        old = path.read_text()
        new = re.sub(pattern, text, old)
        self.assertNotEqual(new, old, f"{name} has no {pattern}")
        path.write_text(new)

    def pictures_of(self, page):
        """Those that a page shows; each is there."""
        pictures = re.findall(r"\]\((figures/[^)]*)\)", page.read_text())
        for picture in pictures:
            self.assertEqual((page.parent / picture).read_bytes()[:4], b"\x89PNG", picture)
        return [Path(picture).name for picture in pictures]


class BesideBeads(Study):
    """The hopper beside beads for 110 ms, with particles of 5 mm, one run."""

    def test_rolling_friction(self):
        self.replace("cases/yuu2011-hopper-vacuum-fast.toml", r"(?m)^end = .*$", 'end = "110 ms"')
        reference = "validation/dem-hopper/reference.toml"
        self.replace(reference, '"bed.spacing" = "1.25 mm"', '"bed.spacing" = "5 mm"')
        self.replace(reference, r"(?m)^members = \d+", "members = 1")
        self.talus("reproduce", "dem-hopper", "--out", "r", "--variant", "rolling", status=1)
        rows = {row["id"]: row for row in json.loads((self.folder / "r/comparison.json").read_text())["rows"]}
        self.assertIsInstance(rows["rolling-hopper-surface-100ms-0-10mm"]["values"][0], float)
        self.assertEqual(rows["rolling-discharge"]["verdict"], "not evaluated", "the run ends before")
        self.assertEqual(rows["discharge"]["verdict"], "not evaluated", "no round grains were run")
        shown = self.pictures_of(self.folder / "r/dem-hopper.md")
        self.assertIn("side_by_side_d160-r20_rolling.png", shown)
        self.assertIn("discharge.png", shown)


class Hopper(Study):
    """The hopper's study for 30 ms, with particles of 5 mm."""

    def setUp(self):
        super().setUp()
        case = "cases/yuu2011-hopper-vacuum.toml"
        self.replace(case, r"(?m)^spacing = .*$", 'spacing = "5 mm"')
        self.replace(case, r"(?m)^end = .*$", 'end = "30 ms"')

    def test_two_variants(self):
        arguments = ("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum", "--variant", "vacuum-stiff")
        self.talus(*arguments, status=1)
        rows = {row["id"]: row for row in json.loads((self.folder / "r/comparison.json").read_text())["rows"]}
        self.assertEqual(rows["packing"]["verdict"], "met")
        self.assertEqual(rows["air-drag"]["verdict"], "not evaluated")
        self.assertEqual(rows["vacuum-discharge-plateau"]["verdict"], "not evaluated", "the run ends before")
        self.assertLess(abs(rows["settled-floor-stress"]["values"][0]), 0.05)
        page = self.folder / "r/yuu2011.md"
        shown = self.pictures_of(page)
        for picture in ("figure_04_vacuum.png", "figure_04_vacuum-stiff.png", "figure_06.png", "figure_08.png"):
            self.assertIn(picture, shown)
        self.assertNotIn("figure_11.png", shown, "there is no air")
        text = page.read_text()
        self.assertIn("| 0 | hopper (vacuum, air) | `packing_max` |", text)
        self.assertIn("## Not met, and why", text)
        for link in re.findall(r"\]\(([^)]*\.md)\)", text):
            place = (page.parent / link).resolve().relative_to(self.folder.resolve())
            self.assertTrue((PROJECT / place).is_file(), f"{link}: moved with the page to {place}")

        first = (self.folder / "r/comparison.json").read_bytes()
        (self.folder / "r/comparison.json").unlink()
        self.talus(*arguments, "--resume", status=1)
        again = json.loads((self.folder / "r/comparison.json").read_text())
        self.assertEqual(again, json.loads(first))
        said = self.talus("compare", "r/hopper-vacuum", "validation/yuu2011/reference.toml", status=1).stdout
        self.assertIn("packing_max", said)

    def test_without_a_python_that_draws(self):
        """The rows are there all the same, and what to install is said."""
        self.replace("cases/yuu2011-hopper-vacuum.toml", r"(?m)^end = .*$", 'end = "1 ms"')
        (self.folder / "without").mkdir()
        (self.folder / "without/sitecustomize.py").write_text("import sys\nsys.modules['matplotlib'] = None\n")
        arguments = ("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum")
        said = self.talus(*arguments, status=1, env={**os.environ, "PYTHONPATH": str(self.folder / "without")}).stdout
        self.assertIn("python3-matplotlib", said)
        self.assertTrue((self.folder / "r/comparison.json").exists())
        self.assertFalse((self.folder / "r/figures").exists())

    def test_a_python_of_the_current_folder_is_not_run(self):
        """An empty entry of PATH stands for it."""
        self.replace("cases/yuu2011-hopper-vacuum.toml", r"(?m)^end = .*$", 'end = "1 ms"')
        stand_in = self.folder / "python3"
        stand_in.write_text("#!/bin/sh\necho run > was_run\nexit 1\n")
        stand_in.chmod(0o755)
        self.talus("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum", status=1, env={**os.environ, "PATH": ":"})
        (self.folder / "json.py").write_text("open('was_run', 'w')\n")
        self.talus("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum", status=1)
        self.assertTrue((self.folder / "r").is_dir())
        self.assertFalse((self.folder / "was_run").exists())

    def test_a_script_that_fails(self):
        self.replace("cases/yuu2011-hopper-vacuum.toml", r"(?m)^end = .*$", 'end = "1 ms"')
        (self.folder / "validation/yuu2011/figures.py").write_text("raise SystemExit('out of ink')\n")
        said = self.talus("reproduce", "yuu2011", "--out", "r", "--variant", "vacuum", status=4).stderr
        self.assertIn("out of ink", said)

    def test_unknown_variant(self):
        said = self.talus("reproduce", "yuu2011", "--out", "r", "--variant", "vacum", status=2).stderr
        self.assertIn("vacuum", said)
        self.assertFalse((self.folder / "r").exists())


class Avalanche(Study):
    """The avalanches' study with a tenth of the grains, for an eighth of the time."""

    def setUp(self):
        super().setUp()
        reference = "validation/niiya2020/reference.toml"
        for shape in ("circle", "rectangle", "triangle"):
            self.replace(f"cases/niiya2020-{shape}.toml", r"(?m)^count = .*$", "count = 200")
        self.replace(reference, '"0.34 m"', '"0.11 m"')
        self.replace(reference, '"3.4 m"', '"0.34 m"')
        self.replace(reference, '"0.6 m"', '"0.19 m"')
        self.replace(reference, '"run.end" = "5 ms"', '"run.end" = "1 ms"')

    def test_all_figures(self):
        self.talus("reproduce", "niiya2020", "--out", "r", "--variant", "5 mm", "--members", "2", status=1)
        shown = self.pictures_of(self.folder / "r/niiya2020.md")
        self.assertEqual(shown, [f"figure_{n:02}.png" for n in range(3, 12)] + ["figure_motions.png"])
        text = (self.folder / "r/niiya2020.md").read_text()
        self.assertIn("Mean and standard deviation of 2 members", " ".join(text.split()))
        self.assertIn("Left out: width against radius", " ".join(text.split()))

    def test_what_is_there_of_it(self):
        """One run of one case, and no more: its figures, and a word on the others."""
        self.talus("run", "cases/niiya2020-triangle.toml", "--set", 'particles.size="0.19 m"', "--set", 'run.end="1 ms"',
                   "--out", "r/one")
        self.replace("validation/niiya2020/reference.toml", '"run.end" = "1 ms"', '"run.end" = "5 ms"')
        self.talus("compare", "r", "validation/niiya2020/reference.toml", "--json", "r/comparison.json", status=1)
        subprocess.run(["/usr/bin/python3", "validation/niiya2020/figures.py", "r"], cwd=self.folder, check=True,
                       capture_output=True)
        page = self.folder / "r/niiya2020.md"
        self.assertEqual(self.pictures_of(page),
                         ["figure_03.png", "figure_07.png", "figure_11.png", "figure_motions.png"])
        self.assertIn("Figures 4, 5, 8 and 9 (circle), Figure 6 (rectangle)", " ".join(page.read_text().split()))

    def test_no_comparison_yet(self):
        (self.folder / "r").mkdir()
        done = subprocess.run(["/usr/bin/python3", "validation/niiya2020/figures.py", "r"], cwd=self.folder, check=False,
                              capture_output=True, text=True)
        self.assertEqual(done.returncode, 1)
        self.assertIn("talus compare DIR REFERENCE.toml --json", done.stderr)


if __name__ == "__main__":
    unittest.main()
