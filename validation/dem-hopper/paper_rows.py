#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the beads have where the rows of ../yuu2011/reference.toml ask, from data/*.csv.

usage: paper_rows.py

Estimators as there, on lines 2 mm apart and every 20 ms; the width of the stream from a picture's cells of 2 mm.
"""
import csv
from collections import defaultdict
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parent / "data"
MIDDLE = 50.0  # mm
SWELLING_AT, STRESS_AT = 0.2, 0.4  # s


def groups(name, *keys):
    """The rows of a table by the values of some columns, each as an array of the others that are numbers."""
    found = defaultdict(list)
    with open(DATA / name, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            key = tuple(row.pop(k) for k in keys)
            found[key].append([float(value or "nan") for value in row.values()])
    return {key: np.array(rows) for key, rows in found.items()}


def line(x, z, low, high):
    there = (x >= low) & (x <= high) & np.isfinite(z)
    return np.polyfit(x[there], z[there], 1) if there.sum() > 5 else (np.nan, np.nan)


def inward_angle(x, z):
    """Of the hopper's surface between 22 and 45 mm from its middle, degrees; positive where it falls towards it."""
    left, right = line(x, z, MIDDLE - 45, MIDDLE - 22), line(x, z, MIDDLE + 22, MIDDLE + 45)
    return np.degrees(np.arctan(0.5 * (right[0] - left[0])))


def mean_height(x, z, at, half):
    there = (abs(x - at) <= half) & np.isfinite(z)
    return z[there].mean() if there.any() else np.nan


def swelling(x, z):
    """Height in the middle above lines through the flanks, and above what lies 5 mm beside it, mm."""
    top = mean_height(x, z, MIDDLE, 2)
    flanks = np.mean([np.polyval(line(x, z, *ends), MIDDLE) for ends in ((5, 35), (65, 95))])
    return top - flanks, top - 0.5 * (mean_height(x, z, MIDDLE - 5, 2) + mean_height(x, z, MIDDLE + 5, 2))


def stream_width(x, z, packing, low, high):
    """Between 5 and 95 % of what is there, mm."""
    there = (z > low) & (z < high)
    places = np.unique(x)
    share = np.cumsum([packing[there & (x == place)].sum() for place in places])
    return np.subtract(*np.interp([0.95, 0.05], share / share[-1], places))


def main():
    surfaces, states = groups("surfaces.csv", "run", "time_s"), groups("states.csv", "run", "time_s", "place")
    print("| run | 11: sigma_xx/sigma_zz in the bin beside and below, 0.4 s | 21: swelling above flanks, in the middle, "
          "0.2 s, mm | 26: largest inward angle, and its largest fall, degrees | until, s |")
    print("|" + "---|" * 5)
    for run in sorted({run for run, _ in surfaces}):
        times = sorted((time for r, time in surfaces if r == run), key=float)
        angles = np.array([inward_angle(*surfaces[run, time][:, :2].T) for time in times])
        angles = angles[np.isfinite(angles)]
        fall = (np.maximum.accumulate(angles) - angles).max()
        ratios = [f"{states[run, str(STRESS_AT), place][0, -1]:.2f}" if (run, str(STRESS_AT), place) in states else "-"
                  for place in ("bin, beside", "bin, below")]
        above, middle = swelling(*surfaces[run, str(SWELLING_AT)][:, :2].T)
        print(f"| {run} | {', '.join(ratios)} | {above:.1f}, {middle:.1f} | {angles.max():.1f}, {fall:.1f} | {times[-1]} |")
    print("\n| picture | t, s | 14: width of the stream at 40-60 over 90-98 mm |\n|---|---|---|")
    for path in sorted(DATA.glob("picture-*.csv")):
        for (time,), rows in groups(path.name, "time_s").items():
            x, z, packing = rows[:, 0], rows[:, 1], rows[:, 3]
            if float(time) in (0.16, 0.2):  # falls freely down to 40 mm
                widths = [stream_width(x, z, packing, *ends) for ends in ((40, 60), (90, 98))]
                print(f"| {path.stem} | {time} | {widths[0]:.1f} / {widths[1]:.1f} = {widths[0] / widths[1]:.2f} |")


if __name__ == "__main__":
    main()
