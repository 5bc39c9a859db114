#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Scatter of the DEM reference's numbers between seeds and their trend with the size of the beads, from data/numbers.csv.

usage: trend.py [data/numbers.csv] [--rolling MU]

A line a number: mean and standard deviation over the seeds of each diameter D, then the least-squares line in D through
these means, its value at D = 0.2 mm, and the largest distance of a mean from it. With two diameters there is no such
distance. The discharge is fitted also with Beverloo's form Q = C (B - k D)^(3/2), B = 40 mm.
"""
import argparse
import csv
from collections import defaultdict
from pathlib import Path

import numpy as np

SLIT, GRAINS = 40.0, 0.2  # mm


def read(path, rolling, stiffness=1.0):
    """Values by (quantity, place, time, unit) and then by diameter, of the runs with that rolling friction."""
    numbers = defaultdict(lambda: defaultdict(list))
    with open(path, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            value = float(row["value"])
            if float(row["rolling"]) == rolling and float(row["stiffness"]) == stiffness and np.isfinite(value):
                key = tuple(row[name] for name in ("quantity", "place", "time_s", "unit"))
                numbers[key][float(row["diameter_mm"])].append(value)
    return numbers


def line_at(diameter, means, at=GRAINS):
    """Value at a diameter of the line through the means, and the largest distance of one from it; nan where there are too
    few."""
    if len(diameter) < 2:
        return np.nan, np.nan
    fit = np.polyfit(diameter, means, 1)
    return np.polyval(fit, at), abs(np.polyval(fit, diameter) - means).max() if len(diameter) > 2 else np.nan


def slope_and_error(values):
    """Slope of the line through the means of each diameter, and its standard error: that of the seeds, all diameters
    together; nan where no diameter has two. \\param values by diameter"""
    diameter = np.array(sorted(values))
    seeds = np.array([len(values[d]) for d in diameter])
    if seeds.max() < 2 or len(diameter) < 2:
        return np.nan, np.nan
    means = np.array([np.mean(values[d]) for d in diameter])
    variance = sum(np.sum((np.array(values[d]) - np.mean(values[d]))**2) for d in diameter) / (seeds - 1).sum()
    arms = (diameter - diameter.mean()) / np.sum((diameter - diameter.mean())**2)
    return arms @ means, np.sqrt(variance * np.sum(arms**2 / seeds))


def beverloo(diameter, rates, at=GRAINS):
    """k and the discharge at a diameter: Q^(2/3) is linear in D."""
    slope, intercept = np.polyfit(diameter, np.asarray(rates)**(2 / 3), 1)
    return -slope * SLIT / intercept, (intercept + slope * at)**1.5


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("numbers", nargs="?", type=Path, default=Path(__file__).resolve().parent / "data/numbers.csv")
    parser.add_argument("--rolling", type=float, default=0.0)
    given = parser.parse_args()
    numbers = read(given.numbers, given.rolling)
    diameters = sorted({d for values in numbers.values() for d in values}, reverse=True)
    print("| quantity | place | t, s | unit | " + " | ".join(f"{d:g} mm" for d in diameters) + " | at 0.2 mm | off the line |")
    print("|" + "---|" * (6 + len(diameters)))
    for (quantity, place, time, unit), values in numbers.items():
        known = [d for d in diameters if d in values]
        means = [np.mean(values[d]) for d in known]
        cells = [f"{np.mean(values[d]):.3g}" + (f" ± {np.std(values[d], ddof=1):.2g}" if len(values[d]) > 1 else "")
                 if d in values else "" for d in diameters]
        cells += ["" if np.isnan(x) else f"{x:.3g}" for x in line_at(known, means)]
        print("| " + " | ".join([f"`{quantity}`", place, time, unit, *cells]) + " |")
        if quantity.startswith("discharge_rate") and len(known) > 1:
            k, rate = beverloo(known, means)
            print(f"| | Beverloo | | | " + "| " * len(known) + f"k = {k:.2g} | {rate:.3g} | |")


if __name__ == "__main__":
    main()
