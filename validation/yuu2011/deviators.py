#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whether the deviatoric stresses of a heap agree with those around them (docs/design/stabilisation.md).

usage: deviators.py RUN [TIME ...]     times from the opening of the gate, s; 0.2, 0.46, 0.72 and 0.98 if none are given

Of the particles of the bin beside the stream (25 mm and more from the middle) with a packing above 0.5 that bear pressure:
|s|/(2^(1/2) p), weighted with the pressure, of each particle by itself, of the mean stress of cells of 10 mm, and of the mean
of all, where left and right count as mirror images; sxx/szz and syy/szz of all; the scatter of the pressure over its mean.
The last column is sxx/szz of all grains of the bin with a packing above 0.5.
"""
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))

import talus  # noqa: E402

COMPONENTS = ("xx", "yy", "zz", "xy", "yz", "zx")
BESIDE, CELL, LEAST_PACKING = 0.025, 0.01, 0.5  # m, m, 1
COLUMNS = ("time, s", "particle", "cells", "all", "sxx/szz", "syy/szz", "scatter of p", "bin")


def ratio(stress, pressure):
    """|s|/(2^(1/2) p) of sums of stresses (n, 6) over the sum of the pressures: the mean weighted with these."""
    mean = stress[:, :3].sum(axis=1, keepdims=True) / 3
    square = 0.5 * ((stress[:, :3] - mean)**2).sum(axis=1) + (stress[:, 3:]**2).sum(axis=1)
    return np.sqrt(square).sum() / pressure.sum()


def in_cells(place, stress):
    """Sums of the stress over the cells of 10 mm in x and z that hold particles."""
    _, cell = np.unique(np.floor(place / CELL).astype(int), axis=0, return_inverse=True)
    sums = np.zeros((cell.max() + 1, stress.shape[1]))
    np.add.at(sums, cell.ravel(), stress)
    return sums


def row_of(position, stress, packing, width, plate):
    """What COLUMNS has after the time, of particles at `position` (n, 3), m, under `stress` (n, 6), Pa."""
    in_bin = (position[:, 2] < plate) & (packing > LEAST_PACKING)
    pressure = stress[:, :3].sum(axis=1) / 3
    x = position[:, 0] - width / 2
    beside = in_bin & (np.abs(x) > BESIDE) & (pressure > 0)
    place, loads, pressure = position[beside][:, (0, 2)], stress[beside], pressure[beside]
    mirrored = loads * np.where(x[beside, None] > 0, 1, [1, 1, 1, -1, 1, -1])
    all_xx, all_yy, all_zz = loads[:, :3].sum(axis=0)
    return (ratio(loads, pressure), ratio(in_cells(place, loads), pressure),
            ratio(mirrored.sum(axis=0, keepdims=True), pressure), all_xx / all_zz, all_yy / all_zz,
            pressure.std() / pressure.mean(), stress[in_bin, 0].sum() / stress[in_bin, 2].sum())


def main(folder, times):
    run = talus.Run(folder)
    width, plate = float(run.case["box"]["width"]), float(run.case["plate"]["height"])
    print(" | ".join(COLUMNS))
    for time in times:
        shot = run.snapshots.at(run.gate_time + time)
        stress = np.column_stack([shot[f"stress_{c}"] for c in COMPONENTS])
        row = row_of(np.asarray(shot.positions), stress, np.asarray(shot["packing"]), width, plate)
        print(" | ".join([f"{shot.time - run.gate_time:.2f}", *(f"{value:.3f}" for value in row)]))


if __name__ == "__main__":
    if len(sys.argv) < 2:
        sys.exit(__doc__)
    main(sys.argv[1], [float(time) for time in sys.argv[2:]] or (0.2, 0.46, 0.72, 0.98))
