# SPDX-License-Identifier: Apache-2.0
"""benchmarks/compare/compare.py starts its programs wherever its folder and the program are, on a program made up for it."""
import os
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
# run CASE ... --out FOLDER: one more line in its log; check CASE: the number of particles.
PROGRAM = """#!/bin/sh
if [ $1 = check ]; then echo "  particles  10"; exit; fi
while [ $1 != --out ]; do shift; done
/bin/mkdir -p $2
n=0; [ -f $2/log.txt ] && n=1
echo "done: t = $n s, $((7 * n + 3)) steps, 1 s wall, $((2 * n + 1)).5 s of processor" >> $2/log.txt
"""


class Compare(unittest.TestCase):
    def test_paths_may_be_relative(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            (folder / "bin").mkdir()
            (folder / "bin/talus").write_text(PROGRAM)
            (folder / "bin/talus").chmod(0o755)
            said = subprocess.run([sys.executable, PROJECT / "benchmarks/compare/compare.py", "runs/compare", "--talus", "bin/talus"],
                                  cwd=folder, env={**os.environ, "PATH": str(folder / "bin")}, capture_output=True, text=True)
            self.assertEqual(said.returncode, 0, said.stdout + said.stderr)
            self.assertIn("| Talus, continuum | ", (folder / "runs/compare/table.md").read_text())
            self.assertEqual([path.name for path in folder.iterdir() if path.name not in ("bin", "runs")], [])


if __name__ == "__main__":
    unittest.main()
