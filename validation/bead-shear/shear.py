#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Shears the DEM reference's beads in a periodic box (shear.in), and fits the parameters of the law critical-state to them.

usage: shear.py run FOLDER     runs every state with LAMMPS (about half an hour on one core), to data/states.csv
       shear.py dilate FOLDER  shears dense packings at constant pressure (dilate.in, the same again), to data/dilation.csv
       shear.py fit            both to the parameters, with their standard errors
"""
import csv
import subprocess
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
STATES = HERE / "data" / "states.csv"
DILATION = HERE / "data" / "dilation.csv"
RATE = 2e-4  # shear rate times (rho_p d^3/k)^(1/2), as in shear.in
#: Rolling friction and the packings that are sheared with it.
PACKINGS = {0.2: (0.50, 0.51, 0.52, 0.53, 0.54, 0.545, 0.55, 0.555, 0.56, 0.58),
            0.0: (0.56, 0.57, 0.58, 0.585, 0.59, 0.595)}
COLUMNS = ("rolling", "packing", "inertial_number", "friction", "pressure_over_stiffness", "xx_over_yy", "zz_over_yy",
           "xy_over_yy")
#: Pressure times diameter over stiffness, beyond which overlaps fill more than 0.2 % of the volume: such states have
#: the friction of hard beads, but not their packing.
SOFT = 1e-3
#: Rolling friction, packing before the pressure and seed of the beads that dilate; strain of one row; steady from here.
DENSE = ((0.2, 0.58, 1), (0.2, 0.60, 1), (0.2, 0.60, 2), (0.2, 0.60, 3), (0.2, 0.62, 1), (0.2, 0.62, 2), (0.2, 0.62, 3),
         (0.0, 0.60, 1), (0.0, 0.62, 1), (0.0, 0.62, 2), (0.0, 0.62, 3), (0.0, 0.635, 1))
STRAIN = 0.01
STEADY = 0.7


def state(rolling, packing, table):
    """One row of the states from a run's means over the second half of its strain or more.

    The friction is that of Mohr's circle in the plane of shear: radius over centre. The law has it in simple shear,
    where its normal stresses are equal.
    """
    steady = table[table[:, 1] > 1.0]
    xx, yy, zz, xy = steady[:, 2:6].mean(axis=0)
    centre, radius = 0.5 * (xx + yy), np.hypot(0.5 * (xx - yy), xy)
    pressure = (xx + yy + zz) / 3
    return rolling, packing, RATE / np.sqrt(pressure), radius / centre, pressure, xx / yy, zz / yy, abs(xy) / yy


def lammps(place, script, **variables):
    """Runs a script in a folder of its own, unless that was done."""
    if (place / "done").exists():
        return
    place.mkdir(parents=True, exist_ok=True)
    words = [word for name, value in variables.items() for word in ("-var", name, f"{value:g}")]
    with open(place / "out.txt", "w", encoding="utf-8") as out:
        subprocess.run(["lmp", "-in", HERE / script, *words], cwd=place, stdout=out, check=True)
    (place / "done").touch()


def write_rows(path, columns, rows):
    path.parent.mkdir(exist_ok=True)
    with open(path, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(columns)
        writer.writerows([f"{value:.5g}" for value in row] for row in rows)


def run(folder):
    rows = []
    for rolling, packings in PACKINGS.items():
        for packing in packings:
            place = folder / f"r{rolling:g}-p{packing:g}"
            lammps(place, "shear.in", rolling=rolling, packing=packing)
            rows.append(state(rolling, packing, np.loadtxt(place / "shear.txt")))
    write_rows(STATES, COLUMNS, rows)


def dilation(table):
    """Strain, packing and friction (Mohr's circle) of a run, means over strains of STRAIN."""
    strain, packing, xx, yy, _, xy = table[:, 1:7].T
    friction = np.hypot(0.5 * (xx - yy), xy) / (0.5 * (xx + yy))
    place = (strain / STRAIN).astype(int)
    return [[values[place == p].mean() for values in (strain, packing, friction)] for p in np.unique(place)]


def dilate(folder):
    rows = []
    for rolling, packing, seed in DENSE:
        place = folder / f"r{rolling:g}-p{packing:g}-s{seed}"
        lammps(place, "dilate.in", rolling=rolling, packing=packing, seed=seed)
        rows += [[rolling, packing, seed, *row] for row in dilation(np.loadtxt(place / "dilate.txt"))]
    write_rows(DILATION, ("rolling", "packed_at", "seed", "strain", "packing", "friction"), rows)


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


def fit_packing(inertial, packing):
    """phi_c and Delta of phi_c - Delta I by least squares, with their standard errors."""
    (slope, critical), covariance = np.polyfit(inertial, packing, 1, cov=True)
    return critical, -slope, *np.sqrt(np.diag(covariance))[::-1]


def states(rolling):
    with open(STATES, encoding="utf-8") as lines:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(lines)]
    chosen = [row for row in rows if row["rolling"] == rolling]
    return {name: np.array([row[name] for row in chosen]) for name in COLUMNS}


def fit():
    for rolling in PACKINGS:
        s = states(rolling)
        slow, fast, scale, left = fit_friction(s["inertial_number"], s["friction"])
        hard = s["pressure_over_stiffness"] < SOFT
        critical, fall, critical_error, fall_error = fit_packing(s["inertial_number"][hard], s["packing"][hard])
        print(f"rolling friction {rolling:g}: static_friction {slow:.3f}, dynamic_friction {fast:.3f}, "
              f"inertial_number {scale:.2f} (left {left:.3f}); critical_packing {critical:.4f} +- {critical_error:.4f}, "
              f"packing_slope {fall:.3f} +- {fall_error:.3f}")
        fits = dilatancy(rolling)
        print("    dense and sheared at constant pressure: " + ", ".join(
            f"{name} {values.mean():.3f} +- {values.std(ddof=1) / np.sqrt(len(values)):.3f}"
            for name, values in zip(("dilatancy", "dilatant_friction", "critical_packing", "static_friction"), fits)))
        k, _, packing, friction = fits.mean(axis=1)
        peaks = np.array([fit_peak(k, friction, packing, *run[1:]) for run in dense_runs(rolling)])
        print(f"    dilatant_friction by the peak {peaks.mean():.3f} +- {peaks.std(ddof=1) / np.sqrt(len(peaks)):.3f}")


def dense_runs(rolling):
    """Strain, packing and friction of every run of dense beads."""
    table = np.genfromtxt(DILATION, delimiter=",", names=True)
    table = table[table["rolling"] == rolling]
    runs = table[["packed_at", "seed"]]
    return [[table[name][runs == run] for name in ("strain", "packing", "friction")] for run in np.unique(runs)]


def dilatancy(rolling):
    """What fit_dilatancy() returns, of every run."""
    return np.array([fit_dilatancy(*run) for run in dense_runs(rolling)]).T


def main(text, fit, **runs):
    """The command line of these scripts: `NAME FOLDER` runs one of `runs` there, `fit` evaluates what was run."""
    if len(sys.argv) == 3 and sys.argv[1] in runs:
        runs[sys.argv[1]](Path(sys.argv[2]))
    elif sys.argv[1:] == ["fit"]:
        fit()
    else:
        sys.exit(text)


if __name__ == "__main__":
    main(__doc__, fit, run=run, dilate=dilate)
