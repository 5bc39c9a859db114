# SPDX-License-Identifier: Apache-2.0
"""Skewness and the test of normality: talus.samples."""
import math
import sys
import unittest
from pathlib import Path

PROJECT = Path(__file__).resolve().parents[2]
sys.path[:0] = [str(PROJECT / "python")]

import numpy as np  # noqa: E402

from talus.samples import anderson_darling, anderson_darling_p_value, skewness  # noqa: E402


class Samples(unittest.TestCase):
    def test_skewness(self):
        self.assertAlmostEqual(skewness([2, 4, 4, 4, 5, 5, 7, 9]), (-27 - 1 - 1 - 1 + 8 + 64) / 8 / 4**1.5, places=14)
        self.assertTrue(math.isnan(skewness([3, 3, 3])))

    def test_the_statistic_is_the_defining_integral(self):
        """n times the integral of (F_n - F)² / (F (1 - F)) dF, by the midpoint rule between the order statistics: independent of
        the sum in the code."""
        sample = np.array([148, 154, 158, 160, 161, 162, 166, 170, 182, 195, 236.0])
        n, z = len(sample), (sample - sample.mean()) / sample.std(ddof=1)
        bounds = [0, *(0.5 * math.erfc(-value / math.sqrt(2)) for value in z), 1]
        integral = 0
        for k, (below, above) in enumerate(zip(bounds, bounds[1:])):
            f = below + (above - below) * (np.arange(200000) + 0.5) / 200000
            integral += ((k / n - f)**2 / (f * (1 - f))).mean() * (above - below)
        adjusted, p_value = anderson_darling(sample[::-1])
        self.assertAlmostEqual(adjusted, n * integral * (1 + 0.75 / n + 2.25 / n**2), delta=1e-5)
        self.assertLess(p_value, 0.05)

    def test_p_values_meet_the_published_critical_values(self):
        for a, p, within in ((0.631, 0.10, 0.002), (0.752, 0.05, 0.001), (0.873, 0.025, 0.0005), (1.035, 0.01, 0.0002)):
            self.assertAlmostEqual(anderson_darling_p_value(a), p, delta=within)  # Stephens 1974
        values = [anderson_darling_p_value(a) for a in np.arange(0.1, 12, 0.01)]
        self.assertLess(np.diff(values).max(), 2e-3, "the pieces meet within that")

    def test_rejects_normal_samples_as_often_as_it_says_and_finds_others(self):
        random = np.random.default_rng(11)
        rejected = sum(anderson_darling(random.normal(3, 2, 50))[1] < 0.05 for _ in range(2000))
        self.assertAlmostEqual(rejected, 100, delta=30)  # three standard deviations
        self.assertLess(anderson_darling(random.uniform(size=300)**3)[1], 1e-6)
        for sample in (np.ones(7), np.ones(20)):
            self.assertTrue(math.isnan(anderson_darling(sample)[1]))

    def test_shift_scale_and_mirror_do_not_matter(self):
        sample = np.array([1, 2, 2.5, 4, 4.1, 5, 7, 11, 12])
        self.assertAlmostEqual(anderson_darling(sample)[0], anderson_darling(100 - 8 * sample)[0], places=12)


if __name__ == "__main__":
    unittest.main(argv=sys.argv[:1])
