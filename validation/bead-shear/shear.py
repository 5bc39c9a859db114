#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Shears the DEM reference's beads in a periodic box (shear.in), and fits the parameters of the law critical-state to them.

usage: shear.py run FOLDER     runs every state with LAMMPS (about half an hour on one core), to data/states.csv
       shear.py dilate FOLDER  shears dense packings at constant pressure (dilate.in, the same again), to data/dilation.csv
       shear.py fit            both to the parameters, with their standard errors
"""
import csv
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))
from talus.beads import SOFT, dilation, fit_dilatancy, fit_friction, fit_packing, fit_peak, state  # noqa: E402
from talus.lab import lammps as engine  # noqa: E402
from talus.trouble import RunError  # noqa: E402

STATES = HERE / "data" / "states.csv"
DILATION = HERE / "data" / "dilation.csv"
#: Rolling friction and the packings that are sheared with it.
PACKINGS = {0.2: (0.50, 0.51, 0.52, 0.53, 0.54, 0.545, 0.55, 0.555, 0.56, 0.58),
            0.0: (0.56, 0.57, 0.58, 0.585, 0.59, 0.595)}
COLUMNS = ("rolling", "packing", "inertial_number", "friction", "pressure_over_stiffness", "xx_over_yy", "zz_over_yy",
           "xy_over_yy")
#: Rolling friction, packing before the pressure and seed of the beads that dilate.
DENSE = ((0.2, 0.58, 1), (0.2, 0.60, 1), (0.2, 0.60, 2), (0.2, 0.60, 3), (0.2, 0.62, 1), (0.2, 0.62, 2), (0.2, 0.62, 3),
         (0.0, 0.60, 1), (0.0, 0.62, 1), (0.0, 0.62, 2), (0.0, 0.62, 3), (0.0, 0.635, 1))


def lammps(place, script, **variables):
    """Runs a script, of this folder or of the package, in a folder of its own, unless that was done."""
    path = HERE / script
    engine.run([engine.Job(path if path.exists() else engine.script(script), variables, place.resolve())], 1)


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
            rows.append((rolling, packing, *state(np.loadtxt(place / "shear.txt"))))
    write_rows(STATES, COLUMNS, rows)


def dilate(folder):
    rows = []
    for rolling, packing, seed in DENSE:
        place = folder / f"r{rolling:g}-p{packing:g}-s{seed}"
        lammps(place, "dilate.in", rolling=rolling, packing=packing, seed=seed)
        rows += [[rolling, packing, seed, *row] for row in dilation(np.loadtxt(place / "dilate.txt"))]
    write_rows(DILATION, ("rolling", "packed_at", "seed", "strain", "packing", "friction"), rows)


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
        try:
            runs[sys.argv[1]](Path(sys.argv[2]))
        except RunError as error:
            sys.exit(str(error))
    elif sys.argv[1:] == ["fit"]:
        fit()
    else:
        sys.exit(text)


if __name__ == "__main__":
    main(__doc__, fit, run=run, dilate=dilate)
