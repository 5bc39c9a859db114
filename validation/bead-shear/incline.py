#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How steep layers of the referee's beads rest: on a rough plane whose slope falls until they stop, and rises until they
start (incline.in).

usage: incline.py run FOLDER   with LAMMPS (twenty minutes on one core), to data/incline.csv
       incline.py fit          the slopes at which a layer stops and starts, by its thickness in diameters
"""
import csv

import numpy as np
from shear import HERE, lammps, main, write_rows

TABLE = HERE / "data" / "incline.csv"
ROLLING = 0.2
#: Thickness in diameters, and slopes at first, in between and at last, in degrees.
LAYERS = ((4, 34, 24, 40), (8, 30, 24, 36), (16, 28, 24, 36))
PLANE = 1.5  # thickness of the beads that are the plane, in diameters
COLUMNS = ("rolling", "thickness", "stops_at_deg", "balanced_at_deg", "starts_at_deg")
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


def run(folder):
    rows = []
    for thickness, first, between, last in LAYERS:
        place = folder / f"r{ROLLING:g}-h{thickness}"
        lammps(place, "incline.in", rolling=ROLLING, thickness=thickness, to=between, up=last, **{"from": first})
        rows.append([ROLLING, *angles(*(np.loadtxt(place / name) for name in ("stop.txt", "start.txt")))])
    write_rows(TABLE, COLUMNS, rows)


def fit():
    print("| thickness, diameters | stops at, degrees | friction as it stops | starts at |\n|---|---|---|---|")
    with open(TABLE, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            print("| " + " | ".join(f"{float(row[name]):.1f}" for name in COLUMNS[1:]).replace("nan", "not seen") + " |")


if __name__ == "__main__":
    main(__doc__, fit, run=run)
