# SPDX-License-Identifier: Apache-2.0
"""Sums of validation/silo-loads by bands of height."""
import sys
import unittest
from pathlib import Path

import numpy as np

STUDY = Path(__file__).resolve().parents[2] / "validation/silo-loads"
sys.path.insert(0, str(STUDY))
import beads  # noqa: E402


class Bands(unittest.TestCase):
    def blocks(self, outward, upward):
        """One block of bands of 10 mm up to 0.3 m, each with the same force on the wall."""
        z = np.arange(0.005, 0.3, 0.01)
        block = np.zeros((len(z), 9))
        block[:, 1], block[:, 3], block[:, 4] = z, outward, upward
        return block[None]

    def test_a_uniform_pressure_on_a_cylinder_stays_uniform(self):
        area = 2 * np.pi * beads.R * 0.01
        bands = beads.Bands("flat", beads.REFERENCE["flat"]["edges"], self.blocks(1000 * area, -300 * area))
        np.testing.assert_allclose(bands.pressure, 1000, rtol=1e-12)
        np.testing.assert_allclose(bands.shear, 300, rtol=1e-12)

    def test_on_a_cone_normal_and_shear_are_turned(self):
        angle = beads.HALF_ANGLE["cone"]
        normal, shear = 5.0, 2.0  # N on each 10 mm of height
        outward = normal * np.cos(angle) - shear * np.sin(angle)
        upward = -normal * np.sin(angle) - shear * np.cos(angle)
        edges = [0.0, 0.02, 0.04]
        bands = beads.Bands("cone", edges, self.blocks(outward, upward))
        for k, middle in enumerate((0.01, 0.03)):
            area = 2 * np.pi * beads.radius_at("cone", middle) * 0.02 / np.cos(angle)
            self.assertAlmostEqual(bands.pressure[0, k] * area, 2 * normal, places=9)
            self.assertAlmostEqual(bands.shear[0, k] * area, 2 * shear, places=9)

    def test_tables_of_the_beads_have_every_band_and_three_seeds(self):
        for silo in ("flat", "cone"):
            table = np.genfromtxt(STUDY / "data" / f"{silo}.csv", delimiter=",", names=True)
            self.assertEqual(len(np.unique(table["seed"])), 3)
            np.testing.assert_allclose(np.unique(table["low"]), beads.REFERENCE[silo]["edges"][:-1])
            self.assertGreater(table["pressure_at_rest"].min(), 0)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
