# SPDX-License-Identifier: Apache-2.0
"""The command of the exact answers: those that take a moment are met, and a tolerance that is not is told."""
import json
import shutil
import subprocess
import sys
import unittest

from program import PROGRAM, PROJECT, ProgramTest

QUICK = ("pair-abreast", "pair-tandem", "triple", "ring", "ring-kept", "reversal", "thrown-place")


class Exact(ProgramTest):
    def exact(self, script, *arguments, status=0):
        done = subprocess.run([sys.executable, script, "--program", PROGRAM, *arguments], cwd=self.folder,
                              capture_output=True, text=True, timeout=120, check=False)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done.stdout

    def test_quick_ones(self):
        said = self.exact(PROJECT / "validation/exact/exact.py", "--out", "e", "--only", *QUICK)
        self.assertIn(f"{len(QUICK)} met, 0 not met", said)
        rows = json.loads((self.folder / "e/exact.json").read_text())
        self.assertEqual([row["test"] for row in rows], list(QUICK))
        for row in rows:
            self.assertLessEqual(row["error"], row["tolerance"])

    def test_what_is_not_met_is_told(self):
        shutil.copytree(PROJECT / "validation/exact", self.folder / "exact")
        path = self.folder / "exact/reference.toml"
        path.write_text(path.read_text().replace("tolerance = 1e-6", "tolerance = 0", 1))
        case = self.folder / "exact/cases/spheres.toml"
        case.write_text(case.read_text().replace('radius = "1 mm"', 'radius = "1.01 mm"'))
        said = self.exact(self.folder / "exact/exact.py", "--out", "e", "--only", "pair-abreast", status=1)
        self.assertIn("NOT MET", said)


if __name__ == "__main__":
    unittest.main()
