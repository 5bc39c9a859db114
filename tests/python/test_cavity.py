# SPDX-License-Identifier: Apache-2.0
"""The study of the driven cavity, on a grid that takes seconds.

Usage: test_cavity.py TALUS
"""
import argparse
import os
import pathlib
import sys
import tempfile
import unittest

os.environ["TALUS"] = os.path.abspath(sys.argv.pop())
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "validation/cavity"))
import cavity  # noqa: E402
import talus  # noqa: E402


class Cavity(unittest.TestCase):
    def test_a_coarse_grid_comes_near_the_tables(self):
        cavity.REFERENCE["cells"] = 20
        with tempfile.TemporaryDirectory() as name:
            options = argparse.Namespace(out=pathlib.Path(name) / "run")
            for case, folder, settings in cavity.cases(options):
                talus.simulate(case, folder, settings | {"output.report": False}, threads=1)
            numbers, (x, _, _) = cavity.measure(options)
            self.assertEqual(len(x), 20)
            for row, within in (("least-u-ghia", 0.05), ("least-w-ghia", 0.05), ("largest-w-ghia", 0.05)):
                self.assertAlmostEqual(numbers[row] / cavity.REFERENCE[row]["value"], 1, delta=within)
            self.assertLess(max(numbers["difference-u"], numbers["difference-w"]), 0.03)
            self.assertIn("least u", cavity.tell(numbers, None))


if __name__ == "__main__":
    unittest.main()
