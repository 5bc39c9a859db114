# SPDX-License-Identifier: Apache-2.0
"""The law critical-state from what beads do by discrete elements: sheared at constant volume and at constant pressure, and in
layers on a slope (inputs/*.in); of beads that stick its cohesion. Fits with intervals of 95 %. Tests:
tests/python/test_bead_shear.py."""
import math

import numpy as np

from talus.powder import Estimate, student

RATE = 2e-4  # shear rate times (rho_p d^3/k)^(1/2), as in shear.in
#: Pressure times diameter over stiffness, beyond which overlaps fill more than 0.2 % of the volume: such states have
#: the friction of hard beads, but not their packing.
SOFT = 1e-3
STRAIN = 0.01  # of one row of a dense packing
STEADY = 0.7   # strain from which on it flows steadily
DENSE_INERTIAL = 0.007  # of dense packings that flow steadily, as in dilate.in
#: Mean velocity over (g d)^(1/2) below which a layer has stopped, above which it has started, and from which on the
#: friction that stops it is taken.
STILL, MOVES, SLOW = 0.005, 0.05, 0.3
SLIDES = 1.0, 0.2  # between these mean velocities the friction of a flat wall is taken
SECONDS = 2.0      # in which the slope falls
GRAVITY, DIAMETER = 9.8, 1e-3  # as in incline.in
#: Of beads that stick (cohesive.in): pressure over k/d; strain from which on they flow steadily; the largest attraction over pressure
#: times d^2, C, that is computed.
COHESIVE_PRESSURE, COHESIVE_STEADY, STICKIEST = 2e-4, 1.0, 5
PLANE = 1.5        # thickness of the beads that are the plane, in diameters


def state(table):
    """Inertial number, friction, pressure over stiffness, and xx/yy, zz/yy, xy/yy of shear.txt, means from a strain of 1 on.

    The friction is that of Mohr's circle in the plane of shear: radius over centre. The law has it in simple shear,
    where its normal stresses are equal.
    """
    steady = table[table[:, 1] > 1.0]
    xx, yy, zz, xy = steady[:, 2:6].mean(axis=0)
    centre, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    pressure = (xx + yy + zz) / 3
    return RATE / np.sqrt(pressure), radius / centre, pressure, xx / yy, zz / yy, abs(xy) / yy


def dilation(table):
    """Strain, packing and friction (Mohr's circle) of dilate.txt, means over strains of STRAIN."""
    strain, packing, xx, yy, _, xy = table[:, 1:7].T
    friction = np.hypot(0.5 * (xx - yy), xy) / (0.5 * (xx + yy))
    place = (strain / STRAIN).astype(int)
    return [[values[place == p].mean() for values in (strain, packing, friction)] for p in np.unique(place)]


def fit_dilatancy(strain, packing, friction):
    """k and b of a dense packing that is sheared: beta = -d ln(phi)/dgamma against the packing beyond the critical one,
    and the friction beyond the critical one against beta, by least squares through zero, from the peak of the friction
    until a tenth of the excess is left. Returns also the packing and the friction of the steady end."""
    steady = strain > STEADY
    critical, slow = packing[steady].mean(), friction[steady].mean()
    rate = -np.gradient(np.log(packing), strain)
    excess = packing - critical
    used = (np.arange(len(strain)) >= friction.argmax()) & (np.cumsum(excess < 0.1 * excess[0]) == 0)
    k = np.sum(rate[used] * excess[used]) / np.sum(excess[used] ** 2)
    b = np.sum((friction[used] - slow) * rate[used]) / np.sum(rate[used] ** 2)
    return k, b, critical, slow


def fit_peak(dilatancy, friction_critical, packing_critical, packing, friction):
    """b by the peak: of a bed of the packing with which a run begins the law's friction is at most mu_s + b k (phi - phi_c),
    at once; of the beads it is at most the run's largest (three rows together), after a strain of 0.03 to 0.1 in which
    they have lost part of that packing."""
    peak = np.convolve(friction, np.ones(3) / 3, "valid").max()
    return (peak - friction_critical) / (dilatancy * (packing[0] - packing_critical))


def fit_friction(inertial, friction):
    """mu_s, mu_2 and I_0 of mu_s + (mu_2 - mu_s)/(1 + I_0/I) by least squares, I_0 by search. Returns them and the
    root mean square of what is left."""
    best = None
    for scale in np.geomspace(0.05, 2, 400):
        shape = np.column_stack([np.ones_like(inertial), inertial / (inertial + scale)])
        (slow, rise), *_ = np.linalg.lstsq(shape, friction, rcond=None)
        left = np.sqrt(np.mean((shape @ (slow, rise) - friction) ** 2))
        if best is None or left < best[3]:
            best = (slow, slow + rise, scale, left)
    return best


def friction_estimates(inertial, friction):
    """The same three, each an Estimate, by the curvature of the least squares at their minimum."""
    slow, fast, scale, left = fit_friction(inertial, friction)
    share = inertial / (inertial + scale)
    slopes = np.column_stack([1 - share, share, -(fast - slow) * share / (inertial + scale)])
    freedom = len(inertial) - 3
    covariance = np.linalg.pinv(slopes.T @ slopes) * left**2 * len(inertial) / freedom
    half = student(freedom) * np.sqrt(np.diag(covariance))
    return [Estimate(float(value), float(max(least, value - more)), float(value + more))
            for value, more, least in zip((slow, fast, scale), half, (0.0, slow, 0.0))]


def fit_packing(inertial, packing):
    """phi_c and Delta of phi_c - Delta I by least squares, with their standard errors."""
    (slope, critical), covariance = np.polyfit(inertial, packing, 1, cov=True)
    return critical, -slope, *np.sqrt(np.diag(covariance))[::-1]


def bulk_stiffness(packing, pressure):
    """dp/d ln(phi) of states that bear more than SOFT/5, in the unit of the pressure; nan of fewer than two."""
    firm = pressure > SOFT / 5
    return np.polyfit(np.log(packing[firm]), pressure[firm], 1)[0] if firm.sum() > 1 else math.nan


def cohesive_state(table, bond):
    """C, inertial number, friction and packing of cohesive.txt, means of its steady part. C is the attraction over sigma d^2, with
    sigma at the centre of Mohr's circle, for which friction is taken too. \\param bond the same over the pressure across"""
    packing, xx, yy, zz, xy = table[table[:, 1] > COHESIVE_STEADY, 2:7].mean(axis=0)
    centre = 0.5 * (xx + yy)
    return (bond * COHESIVE_PRESSURE / centre, RATE / np.sqrt((xx + yy + zz) / 3), np.hypot(0.5 * (xx - yy), xy) / centre, packing)


def strength(inertial, friction, law):
    """a/sigma of steady shear in which tau = mu(I') (sigma + a), I' = I/(1 + a/sigma)^1/2. \\param law mu_s, mu_2 and I_0"""
    slow, fast, scale = law
    total = friction / slow  # 1 + a/sigma
    for _ in range(50):
        total = friction / (slow + (fast - slow) / (1 + scale * np.sqrt(total) / inertial))
    return total - 1


def cohesive_friction(inertial, over, law):
    """The reverse: tau/sigma. \\param over a/sigma"""
    slow, fast, scale = law
    return (1 + over) * (slow + (fast - slow) / (1 + scale * np.sqrt(1 + over) / inertial))


def cohesion_estimates(bond, over, doubt=0.0):
    """alpha and kappa of a/sigma = kappa + alpha C, each an Estimate, by least squares with errors in proportion to 1 + a/sigma, as
    the friction has them. What would be negative is 0, and then nothing is known of how far above. \\param bond, over C and a/sigma
    of each state; \\param doubt half of the interval of the friction without cohesion over it: moves all 1 + a/sigma alike"""
    columns = {"alpha": bond / (1 + over), "kappa": 1 / (1 + over)}
    wanted = list(columns)
    while wanted:
        shape, target = np.column_stack([columns[name] for name in wanted]), over / (1 + over)
        values = np.linalg.lstsq(shape, target, rcond=None)[0]
        if (values >= 0).all():
            break
        wanted.remove(wanted[values.argmin()])
    found = dict.fromkeys(columns, Estimate(0.0, 0.0, 0.0))
    if wanted:
        freedom = len(target) - len(wanted)
        covariance = np.linalg.inv(shape.T @ shape) * np.sum((shape @ values - target) ** 2) / freedom
        for name, value, error in zip(wanted, values, np.sqrt(np.diag(covariance))):
            half = np.hypot(student(freedom) * error, doubt * (value + (name == "kappa")))
            found[name] = Estimate(float(value), float(max(value - half, 0)), float(value + half))
    return found["alpha"], found["kappa"]


def mean_estimate(values, scatter):
    """The mean of runs that differ by their seeds. \\param scatter their standard deviation, taken where there are not three"""
    values = np.asarray(values)
    few = len(values) < 3
    half = (2 * scatter if few else student(len(values) - 1) * values.std(ddof=1)) / math.sqrt(len(values))
    return Estimate(float(values.mean()), float(values.mean() - half), float(values.mean() + half))


def friction_between(stop, fast, slow, seconds=SECONDS):
    """The friction that slows a layer down from the last time at which it is faster than `fast` to the first at which it is
    slower than `slow`; nan where it never is. \\param stop columns of stop.txt; \\param fast, slow mean velocities over
    (g d)^(1/2)"""
    still = np.nonzero(stop[:, 2] < slow)[0]
    still = still[still > np.argmax(stop[:, 2])]
    if not len(still):
        return np.nan
    faster = np.nonzero(stop[:still[0], 2] > fast)[0]
    first = faster[-1] if len(faster) else 0
    time = seconds * (stop[still[0], 0] - stop[first, 0]) / (stop[-1, 0] - stop[0, 0])
    lost = (stop[first, 2] - stop[still[0], 2]) * np.sqrt(GRAVITY * DIAMETER) / time
    slope = np.radians(stop[first:still[0] + 1, 1].mean())
    return np.tan(slope) + lost / (GRAVITY * np.cos(slope))


def angles(stop, start):
    """Thickness in diameters, and slopes in degrees: at which a layer stops, while the slope falls; that would have balanced
    the friction as it slowed down from SLOW; at which it starts. nan where it does not. \\param stop, start columns of
    stop.txt and start.txt: step, slope, mean velocity, top and centre above the floor"""
    thickness = 2 * (stop[-1, 4] - PLANE)
    moves = np.nonzero(start[:, 2] > MOVES)[0]
    starts = start[moves[0], 1] if len(moves) else np.nan
    still = np.nonzero(stop[:, 2] < STILL)[0]
    stops = stop[still[0], 1] if len(still) else np.nan
    return thickness, stops, np.degrees(np.arctan(friction_between(stop, SLOW, STILL))), starts
