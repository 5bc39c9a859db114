# SPDX-License-Identifier: Apache-2.0
"""The law critical-state from what a powder laboratory measures: least squares with intervals of 95 %.

A yield locus of the law after steady shear under a load s is tau = M (sigma + a_0 + kappa s), so that M, M a_0 and M kappa are
coefficients of a linear fit to all points of all loci. Points weigh as errors in proportion to the shear stress have it."""
from dataclasses import dataclass
from statistics import NormalDist

import numpy as np


@dataclass
class Estimate:
    """A number with the ends of its interval of 95 %."""

    value: float
    low: float
    high: float


def student(freedom):
    """The 97.5 % quantile of Student's t; Cornish and Fisher's series (Abramowitz & Stegun 26.7.5), for few degrees exact."""
    exact = {1: 12.706, 2: 4.303, 3: 3.182, 4: 2.776}
    if freedom in exact:
        return exact[freedom]
    z, n = NormalDist().inv_cdf(0.975), freedom
    return (z + (z**3 + z) / (4 * n) + (5 * z**5 + 16 * z**3 + 3 * z) / (96 * n**2)
            + (3 * z**7 + 19 * z**5 + 17 * z**3 - 15 * z) / (384 * n**3))


def linear(columns, target):
    """Least squares with errors in proportion to the target: coefficients, their covariance, degrees of freedom."""
    weight = 1 / np.abs(target)
    matrix = np.column_stack(columns) * weight[:, None]
    freedom = len(target) - matrix.shape[1]
    found = np.linalg.lstsq(matrix, target * weight, rcond=None)[0]
    variance = np.sum((matrix @ found - 1) ** 2) / freedom if freedom else 0.0
    return found, variance * np.linalg.inv(matrix.T @ matrix), freedom


def quotients(found, covariance, freedom):
    """The first coefficient, and the others over it; ends below 0 are 0."""
    t, first = student(freedom), found[0]
    estimates = []
    for k, value in enumerate(found):
        gradient = np.zeros(len(found))
        gradient[k] = 1.0 if k == 0 else 1 / first
        if k:
            gradient[0] = -value / first**2
            value = value / first
        half = t * np.sqrt(gradient @ covariance @ gradient)
        estimates.append(Estimate(float(value), max(0.0, float(value - half)), float(value + half)))
    return estimates


def fit_loci(consolidation, normal, shear):
    """M, a_0 (Pa) and kappa of points of failure, each an Estimate; a_0 or kappa that would be negative is 0, and then nothing is
    known of how far above. \\param consolidation, normal, shear of each point, Pa"""
    columns = {"a_0": np.ones_like(normal), "kappa": consolidation}
    wanted = list(columns)
    while True:
        found, covariance, freedom = linear([normal, *(columns[name] for name in wanted)], shear)
        below = [name for name, value in zip(wanted, found[1:]) if value < 0]
        if not below:
            break
        wanted.remove(min(below, key=lambda name: found[1 + wanted.index(name)]))
    friction, *others = quotients(found, covariance, freedom)
    strengths = dict(zip(wanted, others))
    return friction, *(strengths.get(name, Estimate(0.0, 0.0, 0.0)) for name in columns)


def fit_wall(normal, shear):
    """Coefficient of friction and adhesion (Pa) of a wall yield locus, each an Estimate."""
    found, covariance, freedom = linear([normal, np.ones_like(normal)], shear)
    if found[1] < 0:
        found, covariance, freedom = linear([normal], shear)
        return quotients(found, covariance, freedom)[0], Estimate(0.0, 0.0, 0.0)
    friction, _ = quotients(found, covariance, freedom)
    half = student(freedom) * np.sqrt(covariance[1, 1])
    return friction, Estimate(float(found[1]), max(0.0, float(found[1] - half)), float(found[1] + half))
