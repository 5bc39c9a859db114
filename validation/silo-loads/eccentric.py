#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Puts what a round silo's wall carries around its circumference in flow, the outlet off its axis, beside EN 1991-4's patch load.

    validation/silo-loads/eccentric.py [--out results/silo-eccentric] [--threads N]

A run that is there is not made again. Needs python3-numpy and python3-h5py."""
import argparse
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))
import talus  # noqa: E402
from talus.element_loads import received, window  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text())["eccentric"]
CASE = tomllib.loads((HERE / "wheat-eccentric.toml").read_text())
OUTLET, PLATES = 1.1, 4.3  # m: of the hole, and where the floor's plates end
MIDDLE = 2.2               # m, of the box


def keys_of(offset):
    """Of the case with its outlet elsewhere along x."""
    low, high = MIDDLE + offset - 0.5 * OUTLET, MIDDLE + offset + 0.5 * OUTLET
    parts = {part["name"]: n for n, part in enumerate(CASE["vessel"], 1)}

    def metres(*values):
        return "[" + ",".join(f'"{value:.6g} m"' for value in values) + "]"

    changed = {"floor_left.first_edge": metres(low - 0.1, 0, 0), "floor_right.corner": metres(high, 0.1, 1),
               "floor_right.first_edge": metres(PLATES - high, 0, 0)}
    for name, y in (("floor_front", 0.1), ("floor_rear", MIDDLE + 0.5 * OUTLET), ("gate", MIDDLE - 0.5 * OUTLET)):
        changed[f"{name}.corner"] = metres(low, y, 1)
    return {f"vessel.{parts[key.split('.')[0]]}.{key.split('.')[1]}": value for key, value in changed.items()}


def rings(run):
    """Of each ring that the bed fills at the end of the window: its height, means of the patches (the first lies towards the outlet)
    over the window, and the same over each interval between snapshots."""
    walls = run.walls[-1]
    wall = np.asarray(walls["patch"]) == 0
    middles, areas = np.asarray(walls.middles)[wall], np.asarray(walls.areas)[wall]
    begin, end = window(run)
    count, width = REFERENCE["patches"], 4.0
    height = np.pi * width / count
    angle = np.arctan2(middles[:, 1] - MIDDLE, middles[:, 0] - MIDDLE)
    patch = np.round(angle * count / (2 * np.pi)).astype(int) % count
    ring = np.floor((middles[:, 2] - 1) / height).astype(int)

    def by_patch(first, last):
        pressure = (received(run, last, "pressure_in_flow") - received(run, first, "pressure_in_flow"))[wall] / (last - first)
        return np.array([[np.average(pressure[of], weights=areas[of]) for of in (where & (patch == k) for k in range(count))]
                         for where in (ring == n for n in range(int(ring.max())))])  # the uppermost is no whole ring

    times = [float(time) for time in run.walls.times if run.gate_time <= time <= end * (1 + 1e-12)]
    mean, intervals = by_patch(begin, end), np.array([by_patch(*pair) for pair in zip(times[:-1], times[1:])])
    return begin, end, [(1 + (n + 0.5) * height, mean[n], intervals[:, n]) for n in range(len(mean))]


def tell(run):
    begin, end, found = rings(run)
    code = run.table("en1991")
    rows = [f"window {begin - run.gate_time:.1f} to {end - run.gate_time:.1f} s after the opening; EN 1991-4: "
            f"patch load {1e-3 * code['p_pe'][0]:.2f} kPa (discharge, upper) at z = {code['patch_height'][0]:.2f} m, "
            f"e_o = {code['e_o'][0]:.2f} m", "",
            "| z, m | mean around, kPa | towards the outlet | largest patch | at | first harmonic | away from | "
            "scatter | peak of a patch over the mean |",
            "|---|---|---|---|---|---|---|---|---|"]
    for height, mean, intervals in found:
        around = mean.mean()
        if not around > 500:  # Pa: no bed there
            continue
        first = 2 * np.fft.rfft(mean)[1] / len(mean)
        scatter = np.sqrt(np.mean((0.5 * (mean - np.roll(mean[::-1], 1))) ** 2))
        over = intervals - intervals.mean(axis=1)[:, None]
        rows.append(f"| {height:.1f} | {1e-3 * around:.1f} | {1e-3 * mean[0]:.1f} | {1e-3 * mean.max():.1f} | "
                    f"{360 / len(mean) * mean.argmax():.0f}° | {1e-3 * abs(first):.2f} | {(180 - np.degrees(np.angle(first))) % 360:.0f}° | {1e-3 * scatter:.2f} | {1e-3 * over.max():.2f} |")
    return "\n".join(rows) + "\n"


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n", maxsplit=1)[0])
    parser.add_argument("--out", type=Path, default=Path("results/silo-eccentric"))
    parser.add_argument("--threads", type=int, default=2)
    options = parser.parse_args()
    for offset in REFERENCE["offset"]:
        folder = options.out / f"offset-{offset:g}"
        if not folder.is_dir():
            given = [f"--set={key}={value}" for key, value in keys_of(offset).items()]
            subprocess.run([talus.find_program(), "run", HERE / "wheat-eccentric.toml", "--out", folder, "--threads",
                            str(options.threads), *given], check=True)
        print(f"Outlet {offset:g} m off the axis:", tell(talus.Run(folder)), sep="\n")


if __name__ == "__main__":
    main()
