# SPDX-License-Identifier: Apache-2.0
"""What validation/yuu2011/deviators.py makes of particles under known stresses.

Usage: test_yuu2011.py TALUS
"""
import sys
import unittest
from pathlib import Path

sys.argv.pop()
sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "validation" / "yuu2011"))

import deviators  # noqa: E402
import numpy as np  # noqa: E402

WIDTH, PLATE = 0.1, 0.1


def bed():
    """Places on both sides of the stream, and below it."""
    x, z = np.meshgrid(np.arange(0.0005, WIDTH, 0.001), np.arange(0.0005, 0.05, 0.001))
    return np.column_stack([x.ravel(), np.zeros(x.size), z.ravel()])


def sheared(signs):
    """Under a pressure of 1 Pa and a shear stress along x and z of 0.4 Pa times the sign."""
    signs = np.broadcast_to(signs, len(bed()))
    return np.column_stack([np.ones((len(signs), 3)), np.zeros((len(signs), 2)), 0.4 * signs])


class Deviators(unittest.TestCase):
    def row(self, stress, packing=0.6):
        position = bed()
        return dict(zip(deviators.COLUMNS[1:],
                        deviators.row_of(position, stress, np.full(len(position), packing), WIDTH, PLATE)))

    def test_deviators_that_mirror_each_other_agree(self):
        row = self.row(sheared(np.sign(bed()[:, 0] - WIDTH / 2)))
        for name in ("particle", "cells", "all"):
            self.assertAlmostEqual(row[name], 0.4)
        self.assertAlmostEqual(row["scatter of p"], 0)

    def test_deviators_that_alternate_have_none_in_a_cell(self):
        cell = np.round(bed() / 0.001 - 0.5).astype(int)
        row = self.row(sheared(np.where((cell[:, 0] + cell[:, 2]) % 2 == 0, 1, -1)))
        self.assertAlmostEqual(row["particle"], 0.4)
        self.assertAlmostEqual(row["cells"], 0)
        self.assertAlmostEqual(row["all"], 0)

    def test_ratios_are_those_of_the_sums_and_loose_grains_do_not_count(self):
        stress = sheared(0)
        stress[:, 0] = 0.6
        self.assertAlmostEqual(self.row(stress)["sxx/szz"], 0.6)
        self.assertAlmostEqual(self.row(stress)["syy/szz"], 1)
        position, packing = bed(), np.full(len(bed()), 0.6)
        loose = position[:, 2] > 0.02
        stress[loose], packing[loose] = 9, 0.4
        row = deviators.row_of(position, stress, packing, WIDTH, PLATE)
        self.assertAlmostEqual(row[-1], 0.6)
        # |s|/(2^(1/2) p) of (0.6, 1, 1)
        self.assertAlmostEqual(row[0], 0.4 / np.sqrt(3) / (2.6 / 3))


if __name__ == "__main__":
    unittest.main()
