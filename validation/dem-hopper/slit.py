#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The flow through the slit and below it, of beads and of Talus: packing, velocity and stress by height and distance from
the middle, left and right together, means over 0.166 to 0.2 s from the opening of the gate.

usage: slit.py beads RUN_FOLDER ...                    # frames of hopper.in to data/slit.csv, other runs' rows kept
       slit.py draw TALUS_RUN ... [--beads d050-r20] [--out slit.png]   # beside the beads: a picture, and a table
"""
import argparse
import csv
import sys
from pathlib import Path

import numpy as np
from frames import DENSITY, DEPTH, MASS, WIDTH, Run
from tables import write_rows

HERE = Path(__file__).resolve().parent
TABLE = HERE / "data" / "slit.csv"
WINDOW = 0.166, 0.2  # s
HEIGHTS = np.array([(low, low + 4e-3) for low in (0.056, 0.076, 0.096, 0.100, 0.104, 0.112, 0.12)])  # m
EDGES = np.array([0, 4, 8, 12, 14, 16, 18, 20]) * 1e-3  # m from the middle; the slit ends at 20 mm
COLUMNS = ["packing", "downwards_m_per_s", "inwards_m_per_s", "stress_xx_pa", "stress_zz_pa"]


def moments(x, z, values):
    """Sums of each of the values over the cells: an array of heights, distances, values."""
    away = abs(x - WIDTH / 2)
    sums = np.zeros((len(HEIGHTS), len(EDGES) - 1, len(values)))
    for k, (low, high) in enumerate(HEIGHTS):
        there = (z >= low) & (z < high)
        for n, value in enumerate(values):
            sums[k, :, n] = np.histogram(away[there], EDGES, weights=value[there])[0]
    return sums


def means(samples, depth):
    """COLUMNS of each cell. \\param samples of (x, z, u, w, volume of solid, volume times stress xx and zz), SI"""
    total, count = 0, 0
    for x, z, u, w, volume, xx, zz in samples:
        inwards = -u * np.sign(x - WIDTH / 2)
        total = total + moments(x, z, [volume, -volume * w, volume * inwards, xx, zz])
        count += 1
    if count == 0:
        raise ValueError(f"nothing between {WINDOW[0]} and {WINDOW[1]} s")
    cell = 2 * np.diff(EDGES) * (HEIGHTS[0, 1] - HEIGHTS[0, 0]) * depth * count
    solid = total[..., 0]
    with np.errstate(invalid="ignore"):
        return np.stack([solid / cell, *(total[..., n] / solid for n in (1, 2)), *(total[..., n] / cell for n in (3, 4))], -1)


def of_beads(folder):
    run = Run(folder)
    if not run.reaches(WINDOW[1]):
        raise ValueError(f"{folder}: ends before {WINDOW[1]} s")
    return means(((f.x, f.z, f.velocity[:, 0], f.velocity[:, 2], f.volume, f.stress[:, 0], f.stress[:, 2])
                  for f in run.frames(*WINDOW)), run.depth)


def of_talus(folder):
    """Of a run of the whole hopper, whose slice is DEPTH deep."""
    sys.path.insert(0, str(HERE.parents[1] / "python"))
    import talus
    run = talus.Run(folder)

    def samples():
        for s in run.snapshots:
            if WINDOW[0] - 1e-6 <= s.time - run.gate_time <= WINDOW[1] + 1e-6:
                x, u = s.positions, s["velocity"]
                solid = np.full(len(x), MASS / DENSITY / len(x))
                bulk = solid * DENSITY / s["density"]
                yield x[:, 0], x[:, 2], u[:, 0], u[:, 2], solid, bulk * s["stress_xx"], bulk * s["stress_zz"]

    return means(samples(), DEPTH)


def discharge(profile, k):
    """Through a height, kg/s in 5 mm."""
    return 2 * DENSITY * DEPTH * np.nansum(profile[k, :, 0] * profile[k, :, 1] * np.diff(EDGES))


def write(folders):
    rows = []
    for folder in folders:
        profile = of_beads(folder)
        for k, n in np.ndindex(profile.shape[:2]):
            place = [f"{1e3 * HEIGHTS[k].mean():g}", f"{1e3 * EDGES[n:n + 2].mean():g}"]
            rows.append([folder.name, *place, *(f"{value:.3g}" for value in profile[k, n])])
    write_rows(TABLE, ["run", "z_mm", "x_mm", *COLUMNS], rows, {folder.name for folder in folders})


def read(name):
    with open(TABLE, encoding="utf-8") as file:
        values = [[float(row[c]) for c in COLUMNS] for row in csv.DictReader(file) if row["run"] == name]
    if not values:
        raise ValueError(f"{TABLE}: has no {name}")
    return np.array(values).reshape(len(HEIGHTS), len(EDGES) - 1, len(COLUMNS))


def draw(profiles, path):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    figure, axes = plt.subplots(2, 2, figsize=(9, 6.4), layout="constrained")
    middles, styles = 1e3 * (EDGES[:-1] + EDGES[1:]) / 2, ["ko", "C0-", "C1--", "C2-."]
    panels = [("velocity downwards, m/s", 1, [1, 3, 5]), ("packing", 0, [1, 5]), ("stress σxx, Pa", 3, [3, 4, 5]),
              ("stress σzz, Pa", 4, [3, 4, 5])]  # and the heights that are shown
    for axis, (title, column, heights) in zip(axes.flat, panels):
        for (name, profile), style in zip(profiles.items(), styles):
            for k in heights:
                axis.plot(middles, profile[k, :, column], style, markersize=4, label=name if k == heights[0] else None)
        for k in heights:  # named at the beads
            n = 4 if column == 0 else 0
            value = next(iter(profiles.values()))[k, n, column]
            axis.annotate(f"z = {1e3 * HEIGHTS[k].mean():g} mm", (middles[n], value), (4, 6), textcoords="offset points",
                          fontsize=8)
        axis.set(title=title, xlabel="distance from the middle, mm", xlim=(0, 20), ylim=(0, None), xticks=range(0, 21, 4))
    axes.flat[0].legend(frameon=False, loc="lower left")
    figure.savefig(path, dpi=110)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("task", choices=["beads", "draw"])
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--beads", default="d050-r20", help="run in data/slit.csv")
    parser.add_argument("--out", type=Path, default=Path("slit.png"))
    given = parser.parse_args()
    try:
        if given.task == "beads":
            return write(given.folders)
        profiles = {f"beads, {given.beads}": read(given.beads), **{f"Talus, {f.name}": of_talus(f) for f in given.folders}}
    except (OSError, ValueError) as error:
        sys.exit(str(error))
    draw(profiles, given.out)
    print("| z, mm | | discharge, kg/s | " + " | ".join(f"{1e3 * a:g}-{1e3 * b:g} mm" for a, b in zip(EDGES, EDGES[1:])) + " |")
    print("|---|---|---|" + "---|" * (len(EDGES) - 1))
    for k in (1, 3, 5):
        for name, profile in profiles.items():
            cells = [f"{value:.2f}" for value in profile[k, :, 1]]
            print(f"| {1e3 * HEIGHTS[k].mean():g} | {name} | {discharge(profile, k):.4f} | " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
