# SPDX-License-Identifier: Apache-2.0
"""Statistics of samples: line of least squares, rank correlation, skewness, test of normality."""
import math

import numpy as np

from talus import curves


def fit_line(x, y, *, through_origin=False):
    """Slope of the line of least squares, and 1 - sum of squared residuals over the sum of squares about the mean of y."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    intercept, slope = (0.0, (x * y).sum() / (x * x).sum()) if through_origin else curves.line(x, y)
    total = ((y - y.mean()) ** 2).sum()
    return slope, 1 - ((y - intercept - slope * x) ** 2).sum() / total if total > 0 else math.nan


def spearman_correlation(x, y):
    """Correlation of the ranks, equal values sharing their mean rank."""
    def ranks(sample):
        _, which, counts = np.unique(sample, return_inverse=True, return_counts=True)
        last = np.cumsum(counts)
        return (last - (counts - 1) / 2)[which]
    x, y = ranks(np.asarray(x)), ranks(np.asarray(y))
    x, y = x - x.mean(), y - y.mean()
    scatter = (x * x).sum() * (y * y).sum()
    return (x * y).sum() / math.sqrt(scatter) if scatter > 0 else math.nan


def skewness(sample):
    """Third central moment over the 3/2 power of the second."""
    d = np.asarray(sample) - np.mean(sample)
    second = (d**2).mean()
    return (d**3).mean() / second**1.5 if second > 0 else math.nan


def anderson_darling(sample):
    """Adjusted statistic, A² (1 + 0.75/n + 2.25/n²), of the test of normality with mean and standard deviation of the
    sample, and the probability of a larger one: D'Agostino & Stephens, Goodness-of-Fit Techniques (1986), table 4.9. nan
    below 8 values, to which the table does not reach."""
    sample = np.sort(sample)
    n = len(sample)
    if n < 8 or not sample.std() > 0:
        return math.nan, math.nan
    z = (sample - sample.mean()) / sample.std(ddof=1)
    below = np.array([log_normal_below(value) for value in z])
    above = np.array([log_normal_below(-value) for value in z[::-1]])
    a = -n - ((2 * np.arange(n) + 1) * (below + above)).sum() / n
    a *= 1 + 0.75 / n + 2.25 / n**2
    return a, anderson_darling_p_value(a)


def log_normal_below(z):
    """Logarithm of the standard normal distribution function. Below -37, where erfc underflows, the first term of the
    tail's asymptotic series errs by less than 1/z² < 1e-3, in a logarithm of -690."""
    if z < -37:
        return -0.5 * z * z - math.log(-z) - 0.5 * math.log(2 * math.pi)
    return math.log(0.5 * math.erfc(-z / math.sqrt(2)))


def anderson_darling_p_value(a):
    if a > 10:  # the formulas turn around far outside the table
        return 0.0
    if a >= 0.6:
        return math.exp(1.2937 - 5.709 * a + 0.0186 * a * a)
    if a >= 0.34:
        return math.exp(0.9177 - 4.279 * a - 1.38 * a * a)
    if a >= 0.2:
        return 1 - math.exp(-8.318 + 42.796 * a - 59.938 * a * a)
    return 1 - math.exp(-13.436 + 101.14 * a - 223.73 * a * a)


def finite_values(numbers):
    """Those that are not nan, as long as the others are the fewer; else none."""
    numbers = np.asarray(numbers)
    there = numbers[np.isfinite(numbers)]
    return there if 2 * len(there) >= len(numbers) else there[:0]
