#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How horizontal and vertical stress of the beads stand to each other as the bin fills and rests, to data/stress.csv.

usage: stress_by_time.py RUN_FOLDER ...

Sums of the contact stress over all beads of a place, as row 11 of ../yuu2011/reference.toml sums over particles: what falls
bears none. Means over the frames within 2 ms. Rows of other runs are kept.
"""
import sys
from pathlib import Path

import numpy as np
from frames import PLATE, TOP, WIDTH, Run
from tables import BOXES, write_rows

FILE = Path(__file__).resolve().parent / "data" / "stress.csv"
COLUMNS = ("run", "time_s", "place", "packing", "sxx_Pa", "syy_Pa", "szz_Pa", "sxx_over_szz")
TIMES = (0.2, 0.26, 0.3, 0.34, 0.4, 0.5, 0.6, 0.8, 0.98)  # s
#: x from the nearer wall, z, m. The sums over hopper, bin and all are of their whole space, so that only ratios count.
PLACES = {"all": ((0, WIDTH / 2), (0, TOP)), "hopper": ((0, WIDTH / 2), (PLATE, TOP)), "bin": ((0, WIDTH / 2), (0, PLATE)),
          **{name: BOXES[name][:2] for name in ("bin, beside", "bin, below")},
          "bin, beside, 20 to 40 mm": ((0.006, 0.026), (0.02, 0.04))}


def rows_of(run):
    for time in TIMES:
        if not run.reaches(time):
            continue
        frames = list(run.frames(time - 2e-3, time + 2e-3))
        for name, ((left, right), (low, high)) in PLACES.items():
            space = 2 * (right - left) * (high - low) * run.depth * len(frames)
            stress, solid = np.zeros(3), 0.0
            for frame in frames:
                x = np.minimum(frame.x, WIDTH - frame.x)
                here = (x >= left) & (x < right) & (frame.z >= low) & (frame.z < high)
                stress += frame.stress[here, :3].sum(axis=0) / space
                solid += frame.volume[here].sum() / space
            yield [run.name, f"{time:g}", name, *(f"{value:.4g}" for value in (solid, *stress)),
                   f"{stress[0] / stress[2]:.3f}" if stress[2] > 1 else "nan"]


def main():
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    folders = [Path(name) for name in sys.argv[1:]]
    rows = [row for folder in folders for row in rows_of(Run(folder))]
    write_rows(FILE, COLUMNS, rows, {folder.name for folder in folders})


if __name__ == "__main__":
    main()
