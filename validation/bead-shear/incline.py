#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How steep layers of the referee's beads rest: on a rough plane whose slope falls until they stop, and rises until they
start (incline.in).

usage: incline.py run FOLDER   with LAMMPS (an hour on one core), to data/incline.csv
       incline.py fit          the slopes at which a layer stops and starts, by its thickness in diameters, and the
                               strength at rest of the thickest
"""
import csv

import numpy as np
from shear import HERE, lammps, main, write_rows

TABLE = HERE / "data" / "incline.csv"
#: Rolling friction, thickness in diameters, seed, and slopes at first, in between and at last, in degrees.
LAYERS = ((0.2, 4, 1, 34, 24, 40), (0.2, 8, 1, 30, 24, 36),
          (0.2, 16, 1, 28, 24, 36), (0.2, 16, 2, 28, 24, 36), (0.2, 16, 3, 28, 24, 36),
          (0, 16, 1, 26, 17, 32), (0, 16, 2, 26, 17, 32), (0, 16, 3, 26, 17, 32))
THICKEST = 16
SLOW_SHEAR = {0.2: 0.48, 0: 0.344}  # friction that slow plane shear has, by rolling friction (shear.py)
PLANE = 1.5  # thickness of the beads that are the plane, in diameters
COLUMNS = ("rolling", "layers", "seed", "thickness", "stops_at_deg", "balanced_at_deg", "starts_at_deg")
#: Mean velocity over (g d)^(1/2) below which a layer has stopped, above which it has started, and from which on the
#: friction that stops it is taken.
STILL, MOVES, SLOW = 0.005, 0.05, 0.3
SECONDS = 2.0  # in which the slope falls
GRAVITY, DIAMETER = 9.8, 1e-3  # as in incline.in


def angles(stop, start):
    """Thickness in diameters, and slopes in degrees: at which a layer stops, while the slope falls; that would have balanced
    the friction as it slowed down from SLOW; at which it starts. nan where it does not. \\param stop, start columns of
    stop.txt and start.txt: step, slope, mean velocity, top and centre above the floor"""
    thickness = 2 * (stop[-1, 4] - PLANE)
    moves = np.nonzero(start[:, 2] > MOVES)[0]
    starts = start[moves[0], 1] if len(moves) else np.nan
    still = np.nonzero(stop[:, 2] < STILL)[0]
    if not len(still):
        return thickness, np.nan, np.nan, starts
    faster = np.nonzero(stop[:still[0], 2] > SLOW)[0]
    slow = faster[-1] if len(faster) else 0
    time = SECONDS * (stop[still[0], 0] - stop[slow, 0]) / (stop[-1, 0] - stop[0, 0])
    lost = (stop[slow, 2] - stop[still[0], 2]) * np.sqrt(GRAVITY * DIAMETER) / time
    slope = np.radians(stop[slow:still[0] + 1, 1].mean())
    balanced = np.arctan(np.tan(slope) + lost / (GRAVITY * np.cos(slope)))
    return thickness, stop[still[0], 1], np.degrees(balanced), starts


def strengths(rows, rolling):
    """How far beyond the friction of slow shear the slopes are at which the thickest layers start, one of each seed.
    \\param rows of data/incline.csv"""
    slopes = [float(row["starts_at_deg"]) for row in rows
              if float(row["rolling"]) == rolling and int(row["layers"]) == THICKEST]
    return np.tan(np.radians(slopes)) - SLOW_SHEAR[rolling]


def run(folder):
    rows = []
    for rolling, thickness, seed, first, between, last in LAYERS:
        place = folder / f"r{rolling:g}-h{thickness}-s{seed}"
        lammps(place, "incline.in", rolling=rolling, thickness=thickness, seed=seed, to=between, up=last,
               **{"from": first})
        rows.append([rolling, thickness, seed, *angles(*(np.loadtxt(place / name) for name in ("stop.txt", "start.txt")))])
    write_rows(TABLE, COLUMNS, rows)


def fit():
    print("| rolling friction | seed | thickness, diameters | stops at, degrees | friction as it stops | starts at |\n"
          "|---|---|---|---|---|---|")
    with open(TABLE, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    for row in rows:
        print(f"| {row['rolling']} | {row['seed']} | "
              + " | ".join(f"{float(row[name]):.1f}" for name in COLUMNS[3:]).replace("nan", "not seen") + " |")
    for rolling, friction in SLOW_SHEAR.items():
        strength = strengths(rows, rolling)
        print(f"rolling friction {rolling:g}: the thickest start {strength.mean():.3f} +- "
              f"{strength.std(ddof=1) / np.sqrt(len(strength)):.3f} above a friction of {friction:g}")


if __name__ == "__main__":
    main(__doc__, fit, run=run)
