#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How steep layers of the DEM reference's beads rest: on a rough plane whose slope falls until they stop, and rises until
they start (incline.in), and on a flat wall of the hopper.

usage: incline.py run FOLDER    with LAMMPS (an hour on one core), to data/incline.csv
       incline.py walls FOLDER  on the flat wall (some minutes), to data/walls.csv
       incline.py fit           the slopes at which a layer stops and starts, by its thickness in diameters, the strength
                                at rest of the thickest, and the friction of the wall
"""
import csv

import numpy as np
from shear import HERE, lammps, main, write_rows
from talus.beads import SLIDES, angles, friction_between

TABLE, WALLS = HERE / "data" / "incline.csv", HERE / "data" / "walls.csv"
#: Rolling friction, thickness in diameters, seed, and slopes at first, in between and at last, in degrees.
LAYERS = ((0.2, 4, 1, 34, 24, 40), (0.2, 8, 1, 30, 24, 36),
          (0.2, 16, 1, 28, 24, 36), (0.2, 16, 2, 28, 24, 36), (0.2, 16, 3, 28, 24, 36),
          (0, 16, 1, 26, 17, 32), (0, 16, 2, 26, 17, 32), (0, 16, 3, 26, 17, 32))
#: The same on a flat wall, on which the layer slides as a block.
BLOCKS = ((0.2, 6, 1, 24, 8, 24), (0, 6, 1, 18, 2, 18), (0, 6, 2, 18, 2, 18), (0, 6, 3, 18, 2, 18))
THICKEST = 16
SLOW_SHEAR = {0.2: 0.48, 0: 0.344}  # friction that slow plane shear has, by rolling friction (shear.py)
COLUMNS = ("rolling", "layers", "seed", "thickness", "stops_at_deg", "balanced_at_deg", "starts_at_deg")


def strengths(rows, rolling):
    """How far beyond the friction of slow shear the slopes are at which the thickest layers start, one of each seed.
    \\param rows of data/incline.csv"""
    slopes = [float(row["starts_at_deg"]) for row in rows
              if float(row["rolling"]) == rolling and int(row["layers"]) == THICKEST]
    return np.tan(np.radians(slopes)) - SLOW_SHEAR[rolling]


def layer(folder, name, rolling, thickness, seed, first, between, last, **settings):
    """What a layer of LAYERS or BLOCKS leaves, run unless it was: stop.txt and start.txt. \\param settings of incline.in"""
    place = folder / f"{name}r{rolling:g}-h{thickness}-s{seed}"
    lammps(place, "incline.in", rolling=rolling, thickness=thickness, seed=seed, to=between, up=last,
           **{"from": first}, **settings)
    return [np.loadtxt(place / text) for text in ("stop.txt", "start.txt")]


def run(folder):
    write_rows(TABLE, COLUMNS, [[*one[:3], *angles(*layer(folder, "", *one))] for one in LAYERS])


def walls(folder):
    write_rows(WALLS, ("rolling", "layers", "seed", "friction"),
               [[*one[:3], friction_between(layer(folder, "wall-", *one, smooth=1)[0], *SLIDES)] for one in BLOCKS])


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
    table = np.genfromtxt(WALLS, delimiter=",", names=True)
    for rolling in SLOW_SHEAR:
        friction = table["friction"][table["rolling"] == rolling]
        print(f"rolling friction {rolling:g}: on a flat wall {friction.mean():.3f}, {len(friction)} seed(s), "
              f"{friction.min():.3f} to {friction.max():.3f}")


if __name__ == "__main__":
    main(__doc__, fit, run=run, walls=walls)
