#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How steep layers of the referee's beads rest: on a rough plane whose slope falls until they stop (incline.in).

usage: incline.py run FOLDER   with LAMMPS (a quarter of an hour on one core), to data/incline.csv
       incline.py fit          the slope at which a layer stops, by its thickness in diameters
"""
import csv
import sys
from pathlib import Path

import numpy as np
from shear import HERE, lammps, write_rows

TABLE = HERE / "data" / "incline.csv"
ROLLING = 0.2
#: Thickness in diameters, slopes at first and at last in degrees, and seconds from one to the other.
LAYERS = ((3, 34, 24, 2), (6, 31, 25, 2), (12, 28, 24.5, 2), (24, 27, 24.5, 2))
PLANE = 1.5  # thickness of the beads that are the plane, in diameters
COLUMNS = ("rolling", "thickness", "stops_at_deg")
STILL = 0.005  # mean velocity over (g d)^(1/2) below which a layer has stopped


def stopped(table):
    """Thickness in diameters and slope in degrees at which a layer stops; nan if it does not. \\param table columns of
    incline.txt: step, slope, mean velocity, top and centre above the floor"""
    still = np.nonzero(table[:, 2] < STILL)[0]
    if not len(still):
        return np.nan, np.nan
    return 2 * (table[still[0], 4] - PLANE), table[still[0], 1]


def run(folder):
    rows = []
    for thickness, start, end, time in LAYERS:
        place = folder / f"r{ROLLING:g}-h{thickness}"
        lammps(place, "incline.in", rolling=ROLLING, thickness=thickness, **{"from": start, "to": end, "time": time})
        rows.append([ROLLING, *stopped(np.loadtxt(place / "incline.txt"))])
    write_rows(TABLE, COLUMNS, rows)


def fit():
    print("| thickness, diameters | stops at, degrees |\n|---|---|")
    with open(TABLE, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            print(f"| {float(row['thickness']):.1f} | {float(row['stops_at_deg']):.1f} |")


if __name__ == "__main__":
    if len(sys.argv) == 3 and sys.argv[1] == "run":
        run(Path(sys.argv[2]))
    elif sys.argv[1:] == ["fit"]:
        fit()
    else:
        sys.exit(__doc__)
