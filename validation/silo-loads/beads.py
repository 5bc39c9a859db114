#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The silos of silo.in bead by bead, with LAMMPS (Debian's package lammps), and their loads as tables.

    validation/silo-loads/beads.py run RUNS [--silo flat|cone] [--seed N]     # six to fifteen minutes of processor time
    validation/silo-loads/beads.py reduce RUNS                               # data/SILO.csv, one table for each silo

Bands, windows and estimators are those of reference.toml. Needs python3-numpy."""
import argparse
import math
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
R, OUTLET, CONE = 0.05, 0.02, 0.0824  # m: radii of cylinder and outlet, height of the cone
HALF_ANGLE = {"flat": 0.0, "cone": math.atan((R - OUTLET) / CONE)}
COLUMNS = ("seed", "low", "high", "pressure_at_rest", "shear_at_rest", "vertical_at_rest", "packing_at_rest", "pressure_in_flow",
           "shear_in_flow", "vertical_in_flow", "packing_in_flow", "peak")


def radius_at(silo, z):
    return R if silo == "flat" or z >= CONE else OUTLET + (R - OUTLET) * z / CONE


def blocks_of(path):
    """Blocks of `fix ave/chunk`: array of (block, band, column)."""
    blocks = []
    for line in path.read_text(encoding="utf-8").splitlines():
        if line.startswith("#"):
            continue
        if not line.startswith(" "):
            blocks.append([])
        else:
            blocks[-1].append([float(word) for word in line.split()])
    return np.array(blocks)


class Bands:
    """Sums over beads by height, as sums over bands of any other edges: even within each of the former."""

    def __init__(self, silo, edges, blocks):
        z = blocks[0, :, 1]
        half = 0.5 * (z[1] - z[0])
        fine = np.append(z - half, z[-1] + half)
        running = np.concatenate([np.zeros_like(blocks[:, :1]), np.cumsum(blocks, axis=1)], axis=1)
        low, high = np.array(edges[:-1]), np.array(edges[1:])
        self.sums = np.stack([[np.interp(high, fine, block[:, c]) - np.interp(low, fine, block[:, c])
                               for c in range(blocks.shape[2])] for block in running])  # block, column, band
        middle = 0.5 * (low + high)
        angle = np.where(middle < CONE, HALF_ANGLE[silo], 0.0)
        radii = np.array([radius_at(silo, m) for m in middle])
        area = 2 * np.pi * radii * (high - low) / np.cos(angle)
        volume = np.pi * (high - low) / 3 * np.array([radius_at(silo, a)**2 + radius_at(silo, a) * radius_at(silo, b)
                                                      + radius_at(silo, b)**2 for a, b in zip(low + 1e-9, high - 1e-9)])
        outward, upward = self.sums[:, 3], self.sums[:, 4]  # of the force on the wall
        self.pressure = (outward * np.cos(angle) - upward * np.sin(angle)) / area
        self.shear = (-outward * np.sin(angle) - upward * np.cos(angle)) / area
        self.packing, self.vertical = self.sums[:, 5] / volume, -self.sums[:, 8] / volume


def reduce(folder, silo, seed):
    """The rows of one run: a line for each band."""
    given = REFERENCE[silo]
    rest, flow = (Bands(silo, given["edges"], blocks_of(folder / name)) for name in ("at_rest.txt", "in_flow.txt"))
    block = 0.01  # s, silo.in
    first, last = (round(t / block) for t in REFERENCE["flow"]["window"])
    width = round(REFERENCE["flow"]["peak_window"] / block)
    means = np.array([flow.pressure[k:k + width].mean(axis=0) for k in range(last - width + 1)])
    steady = slice(first, last)
    return np.column_stack([np.full(len(given["edges"]) - 1, seed), given["edges"][:-1], given["edges"][1:],
                            rest.pressure.mean(0), rest.shear.mean(0), rest.vertical.mean(0), rest.packing.mean(0),
                            flow.pressure[steady].mean(0), flow.shear[steady].mean(0), flow.vertical[steady].mean(0),
                            flow.packing[steady].mean(0), means.max(axis=0)])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("job", choices=["run", "reduce"])
    parser.add_argument("runs", type=Path)
    parser.add_argument("--silo", choices=["flat", "cone"], default="flat")
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    if options.job == "run":
        if not shutil.which("lmp"):
            sys.exit("lmp: not found; Debian's package is called lammps")
        folder = options.runs / f"{options.silo}-s{options.seed}"
        folder.mkdir(parents=True, exist_ok=True)
        sys.exit(subprocess.run(["lmp", "-in", HERE / "silo.in", "-var", "cone", "1" if options.silo == "cone" else "0", "-var",
                                 "seed", str(options.seed), "-screen", "none", "-log", "lammps.log"], cwd=folder).returncode)
    for silo in ("flat", "cone"):
        rows = [reduce(folder, silo, int(folder.name.rpartition("-s")[2])) for folder in sorted(options.runs.glob(f"{silo}-s*"))
                if (folder / "restart.end").is_file()]
        if not rows:
            continue
        (HERE / "data").mkdir(exist_ok=True)
        table = np.concatenate(rows)
        lines = [",".join(COLUMNS)] + [",".join(f"{value:.6g}" for value in row) for row in table]
        (HERE / "data" / f"{silo}.csv").write_text("\n".join(lines) + "\n", encoding="utf-8")
        print(f"data/{silo}.csv: {len(rows)} runs")


if __name__ == "__main__":
    main()
