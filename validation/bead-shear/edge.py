#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What stays of a bed at the edge of a plate when the gate above the edge is taken away, beads of edge.in beside the law.

usage: edge.py run FOLDER    with LAMMPS (half an hour on one core), to data/edge.csv
       edge.py beside RUN    a run of edge.toml by `talus run`: how steep it is, beside the beads
       edge.py fit           how steep the beads are, by time and by the length of the plate in diameters
"""
import csv
import sys

import numpy as np
from shear import HERE, lammps, main, write_rows

TABLE = HERE / "data" / "edge.csv"
#: Length of the plate in diameters, and seed.
BEDS = ((24, 1), (24, 2), (48, 1))
COLUMNS = ("length", "seed", "time", "angle_deg", "height_at_wall", "left")
DIAMETER, ACROSS, GRAVITY = 1e-3, 4e-3, 9.8  # as in edge.in
PACKING = 0.58  # at which the height of a column follows from its grains
PLATE = 0.03    # height of the plate in edge.toml, m
TIMES = (2, 4, 6, 8, 10, 12, 14, 16)


def shape(x, volume, length):
    """Slope in degrees, height at the wall and what is left, in units of the length of the plate and its square: columns
    one diameter wide, as high as their grains at PACKING; least squares from 15 to 85 % of the plate, mean of the three
    columns at the wall. \\param x, volume of the grains on the plate, m and m^3; \\param length m"""
    columns = round(length / DIAMETER)
    height, edges = np.histogram(x, np.linspace(0, length, columns + 1), weights=volume)
    height /= DIAMETER * ACROSS * PACKING
    middle = 0.5 * (edges[1:] + edges[:-1])
    inner = (middle > 0.15 * length) & (middle < 0.85 * length)
    slope = np.polyfit(middle[inner], height[inner], 1)[0]
    return -np.degrees(np.arctan(slope)), height[:3].mean() / length, height.sum() * DIAMETER / length**2


def run(folder):
    rows = []
    for length, seed in BEDS:
        place = folder / f"l{length}-s{seed}"
        (place / "frames").mkdir(parents=True, exist_ok=True)
        lammps(place, "edge.in", length=length, seed=seed)
        frames = sorted((place / "frames").glob("*.txt"), key=lambda path: int(path.stem))
        for time, path in enumerate(frames):
            radius, x, z = np.loadtxt(path, skiprows=9, ndmin=2).T[:3]
            on = z > -DIAMETER
            rows.append([length, seed, time, *shape(x[on], 4 / 3 * np.pi * radius[on] ** 3, length * DIAMETER)])
    write_rows(TABLE, COLUMNS, rows)


def beads():
    """Rows of the table by length, a mean over seeds: {length: {time: (angle, height, left)}}."""
    rows = {}
    with open(TABLE, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            rows.setdefault(int(row["length"]), {}).setdefault(int(row["time"]), []).append(
                [float(row[name]) for name in COLUMNS[3:]])
    return {length: {time: np.mean(values, axis=0) for time, values in times.items()} for length, times in rows.items()}


def print_rows(columns):
    """A table of Markdown, times down, columns of shape() across: {title: {time: shape}}."""
    print("| time, (L/g)^½ | " + " | ".join(columns) + " |\n|" + "---|" * (len(columns) + 1))
    for time in TIMES:
        print(f"| {time} | " + " | ".join("{:.1f}°, {:.2f}, {:.2f}".format(*rows[time]) for rows in columns.values()) + " |")


def fit():
    print_rows({f"beads, L = {length} diameters": rows for length, rows in beads().items()})


def beside(run_folder):
    import talus

    result = talus.Run(run_folder)
    length, rows = 0.048, {}
    for time in TIMES:
        at = result.gate_time + time * np.sqrt(length / GRAVITY)
        snapshot = result.snapshots.at(at)
        if abs(snapshot.time - at) > 0.01:
            sys.exit(f"{run_folder}: ends before {at:.3g} s")
        x, _, z = np.asarray(snapshot.positions).T
        on = z > PLATE - DIAMETER
        rows[time] = shape(x[on], np.full(on.sum(), 0.6 * DIAMETER**3), length)
    print_rows({"beads": beads()[48], "Talus": rows})


if __name__ == "__main__":
    main(__doc__, fit, run=run, beside=beside)
