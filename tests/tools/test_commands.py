#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Every command of the documents is one that the program takes, and tools/check_commands.py finds those that are not.

Usage: test_commands.py TALUS
"""
import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop()).resolve())
sys.path.insert(0, str(ROOT / "tools"))

import check_commands  # noqa: E402


class Commands(unittest.TestCase):
    def problems(self, text):
        with tempfile.TemporaryDirectory() as folder:
            page = pathlib.Path(folder) / "page.md"
            page.write_text(text, encoding="utf-8")
            (pathlib.Path(folder) / "cases").symlink_to(ROOT / "cases")
            return check_commands.check(pathlib.Path(folder), PROGRAM, [page])

    def test_those_of_the_documents(self):
        done = subprocess.run([ROOT / "tools/check_commands.py", PROGRAM], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stdout)
        self.assertGreater(int(done.stdout.split()[0]), 60)

    def test_what_is_planted_is_found(self):
        for line, word in {"talus rnu cases/slot.toml": "no command 'rnu'",
                           "build/talus run cases/slot.toml --thread=2": "no option --thread",
                           "talus run cases/slots.toml": "no cases/slots.toml",
                           "talus run": "takes 1",
                           "talus run cases/slot.toml other": "takes 1",
                           "talus run cases/slot.toml --out": "lacks its value",
                           "talus run cases/slot.toml --overwrite=1": "takes no value",
                           "talus new hoper": "no command 'new hoper'",
                           "talus picture r --view above -o p.png": "one of xz",
                           "talus completion csh": "one of bash",
                           "talus run cases/slot.toml --set box.widht=1": "box.widht",
                           "talus ensemble cases/slot.toml --vary box.width=1 m,2 m": "takes 1",
                           "talus ensemble cases/slot.toml --vary \"box.width=200 mm,2 kg\"": "2 kg",
                           "tools/nothing": "no tools/nothing",
                           "python3 python/examples/none.py": "no python/examples/none.py"}.items():
            problems, count, _ = self.problems(f"Text.\n\n    {line}\n")
            self.assertEqual((count, len(problems)), (1, 1), (line, problems))
            self.assertIn(word, problems[0])
            self.assertTrue(problems[0].startswith("page.md:3: "), problems[0])

    def test_what_is_right_is_not(self):
        problems, count, cases = self.problems(
            "    talus run cases/slot.toml --set run.end=\"0.1 s\" \\\n        --out results/it    the paper's\n"
            "    talus report DIR  again\n\n```sh\ntalus check cases/slot.toml\n```\n\n```python\ntalus nothing\n```\n"
            "Prose: talus nothing.\n")
        self.assertEqual((problems, count, cases), ([], 3, 2))


if __name__ == "__main__":
    unittest.main()
