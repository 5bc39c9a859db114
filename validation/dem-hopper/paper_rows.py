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
from frames import WIDTH
from surfaces import band, outward_angle

DATA = Path(__file__).resolve().parent / "data"
FLANKS = (0.005, 0.035), (0.065, 0.095)  # m
SWELLING_AT, STRESS_AT, RATE_AT, RATES_OVER = 0.2, 0.4, 0.12, 0.02  # s
ANGLES_AT = 0.2, 0.24, 0.28, 0.3, 0.32, 0.34, 0.4, 0.44  # s
FINE = 0.2  # mm, the paper's beads


def groups(name, *keys):
    """The rows of a table by the values of some columns, each as an array of the others that are numbers."""
    found = defaultdict(list)
    with open(DATA / name, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            key = tuple(row.pop(k) for k in keys)
            found[key].append([float(value or "nan") for value in row.values()])
    return {key: np.array(rows) for key, rows in found.items()}


def swelling(x, z):
    """Height in the middle above lines through the flanks, and above what lies 5 mm beside it, m."""
    top = band(x, z, 0, 2e-3)
    flanks = []
    for low, high in FLANKS:
        there = (x >= low) & (x <= high) & np.isfinite(z)
        flanks.append(np.polyval(np.polyfit(x[there], z[there], 1), WIDTH / 2))
    return top - np.mean(flanks), top - band(x, z, 3e-3, 7e-3)


def packings(path):
    """Of a file of a picture, by time: x and z of its cells, mm, and their packing."""
    found = defaultdict(list)
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            found[float(row["time_s"])].append([float(row[name]) for name in ("x_mm", "z_mm", "packing")])
    return {time: np.array(rows).T for time, rows in found.items()}


def stream_width(x, z, packing, low, high):
    """Between 5 and 95 % of what is there; in the unit of the places."""
    there = (z > low) & (z < high)
    places = np.unique(x)
    share = np.cumsum([packing[there & (x == place)].sum() for place in places])
    return np.subtract(*np.interp([0.95, 0.05], share / share[-1], places))


def share_of_largest(times, masses):
    """The discharge about RATE_AT over its largest, both means over RATES_OVER."""
    middles = np.arange(RATES_OVER, times[-1] - RATES_OVER / 2, RATES_OVER / 10)
    passed = [np.interp(middles + side * RATES_OVER / 2, times, masses) for side in (1, -1)]
    rates = np.subtract(*passed)
    return np.interp(RATE_AT, middles, rates) / rates.max()


def rolling_diameters():
    """Of the runs with rolling friction, mm."""
    with open(DATA / "numbers.csv", encoding="utf-8") as file:
        return {row["run"]: float(row["diameter_mm"]) for row in csv.DictReader(file) if float(row["rolling"]) > 0}


def prolonged(diameters, values):
    """The line through values over diameters at FINE, and its standard error."""
    line, covariance = np.polyfit(diameters, values, 1, cov=True)
    at = np.array([FINE, 1])
    return line @ at, np.sqrt(at @ covariance @ at)


def hopper_surfaces():
    """Places and heights of the hopper's surface, m, by run and time; a run on the hopper alone (run.py --hopper-of) bears
    the name of the one that it goes on from, and `-rest`."""
    return {(run.removesuffix("-rest"), time): rows[:, :2].T * 1e-3
            for (run, time), rows in groups("surfaces.csv", "run", "time_s").items()}


def main():
    surfaces = hopper_surfaces()
    states = groups("states.csv", "run", "time_s", "place")
    discharges = groups("discharge.csv", "run")
    print("| run | 3: discharge at 0.12 s over its largest | 11: sigma_xx/sigma_zz in the bin beside and below, 0.4 s | 21: swelling above flanks, in the middle, "
          "0.2 s, mm | 26: largest inward angle, and its largest fall, degrees | until, s |")
    print("|" + "---|" * 6)
    for run in sorted({run for run, _ in surfaces}):
        times = sorted((time for r, time in surfaces if r == run), key=float)
        angles = np.array([-outward_angle(*surfaces[run, time], 0.022, 0.045) for time in times])
        angles = angles[np.isfinite(angles)]
        fall = (np.maximum.accumulate(angles) - angles).max()
        ratios = [f"{states[run, str(STRESS_AT), place][0, -1]:.2f}" if (run, str(STRESS_AT), place) in states else "-"
                  for place in ("bin, beside", "bin, below")]
        above, middle = 1e3 * np.array(swelling(*surfaces[run, str(SWELLING_AT)]))
        share = share_of_largest(*discharges[run,][:, :2].T)
        print(f"| {run} | {share:.2f} | {', '.join(ratios)} | {above:.1f}, {middle:.1f} | {angles.max():.1f}, {fall:.1f} | {times[-1]} |")
    diameters = rolling_diameters()
    print("\n| t, s | 26: inward angle of the hopper, rolling friction, prolonged to 0.2 mm, degrees |\n|---|---|")
    for time in ANGLES_AT:
        runs = [run for run in diameters if (run, str(time)) in surfaces]
        angles = [-outward_angle(*surfaces[run, str(time)], 0.022, 0.045) for run in runs]
        value, error = prolonged([diameters[run] for run in runs], angles)
        print(f"| {time} | {value:.1f} ± {error:.1f} |")
    print("\n| picture | t, s | 14: width of the stream at 40-60 over 90-98 mm |\n|---|---|---|")
    for path in sorted(DATA.glob("picture-*.csv")):
        for time, cells in packings(path).items():
            if time in (0.16, 0.2):  # falls freely down to 40 mm, of 0.5 mm at 0.2 s to 55 mm
                widths = [stream_width(*cells, *ends) for ends in ((40, 60), (90, 98))]
                print(f"| {path.stem} | {time} | {widths[0]:.1f} / {widths[1]:.1f} = {widths[0] / widths[1]:.2f} |")


if __name__ == "__main__":
    main()
