#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The commands of the first page and of the how-tos do their work one after the other, and tools/run_commands.py finds
those that do not.

Usage: test_run_commands.py TALUS
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = pathlib.Path(sys.argv.pop()).resolve()
sys.path.insert(0, str(ROOT / "tools"))

import run_commands  # noqa: E402


class Commands(unittest.TestCase):
    def run_text(self, text):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            return run_commands.run_page(PROGRAM, page, pathlib.Path(folder))

    def test_those_of_the_pages_that_a_newcomer_reads(self):
        pages = [ROOT / "docs/first-run.md", *sorted((ROOT / "docs/how-to").glob("*.md"))]
        done = subprocess.run([ROOT / "tools/run_commands.py", "--program", PROGRAM, *pages], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        self.assertGreater(int(done.stdout.splitlines()[-1].split()[0]), 25)

    def test_what_is_planted_is_found(self):
        problems, count, _ = self.run_text("    talus picture results/none --time 0 -o p.png\n")
        self.assertEqual((len(problems), count), (1, 1))
        self.assertIn("page.md:1", problems[0])
        problems, count, _ = self.run_text(
            "    talus run cases/niiya2020-circle.toml --out a\n    talus picture a --time 0 --color packng -o p.png\n")
        self.assertEqual((len(problems), count), (1, 2))
        self.assertIn("packng", problems[0])

    def test_what_is_right_is_not_and_what_is_left_out_is_named(self):
        problems, count, left_out = self.run_text(
            "    talus run cases/niiya2020-circle.toml --walltime 30\n"
            "    talus run cases/niiya2020-circle.toml --resume --set run.end=\"8 ms\"    longer\n"
            "    talus picture results/niiya2020-circle --time 0.002 -o p.png\n"
            "    talus report ONE OTHER\n    ./run --build-only\n    validation/dem-hopper/run.py results/d280\n"
            "    talus movie results/d280 -o beads.gif\n")
        self.assertEqual((problems, count), ([], 3))
        self.assertEqual([line.split(": ")[1] for line in left_out],
                         ["placeholders", "builds", "takes ten minutes, and needs LAMMPS", "needs what another program makes"])

    def test_what_is_neither_run_nor_listed_is_a_problem(self):
        problems, count, left_out = self.run_text("    tools/another --thing\n")
        self.assertEqual((len(problems), count, left_out), (1, 0, []))
        self.assertIn("NOT_RUN", problems[0])

    def test_every_command_of_the_pages_is_run_or_listed(self):
        commands = list(run_commands.commands_of(ROOT, run_commands.tracked(ROOT, *run_commands.PAGES)))
        self.assertGreater(len(commands), 120)
        self.assertEqual([where for where, words, _ in commands if not words
                          or run_commands.reason_to_leave_out(words) in ("unknown", "placeholders")], [])

    def test_python_of_a_page(self):
        text = ("```python\nimport talus\nrun = talus.Run(\"results/niiya2020-circle\")\n```\nText.\n"
                "```python\nassert run.{} == \"done\"\n```\n    python3 -c \"print(1)\"\n")
        self.assertEqual(self.run_text(text.format("status"))[:2], ([], 2))
        problems, count, _ = self.run_text(text.format("statuses"))
        self.assertEqual((len(problems), count), (1, 2))
        self.assertIn("statuses", problems[0])

    def test_a_study_a_placeholder_and_a_cluster(self):
        problems, count, left_out = self.run_text(
            "    talus reproduce niiya2020 --quick\n    talus report DIR --frames 2\n"
            "    talus ensemble cases/niiya2020-circle.toml --members 20 --launch slurm\n"
            "    talus compare results/mine validation/yuu2011/reference.toml --json results/mine/comparison.json\n")
        self.assertEqual((problems, count, left_out), ([], 4, []))


if __name__ == "__main__":
    unittest.main()
