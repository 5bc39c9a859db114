#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the cavity whose lid moves and compares its middle lines with Ghia's tables and the spectral extremes.

    validation/cavity/cavity.py [--out results/cavity-128] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))


def cases(options):
    cell = f"{1e3 / REFERENCE['cells']:.9g} mm"
    yield (study.PROJECT / "cases/cavity.toml", options.out,
           {"air.cell": cell, "box.depth": cell, "run.end": f"{REFERENCE['end']} s", "output.snapshots": f"{REFERENCE['end']} s"})


def lines(folder):
    """Middles of the cells along a line, u on the upright middle line and w on the level one, at the end of the run."""
    air = talus.Run(folder).air[-1]
    velocity = np.asarray(air.layer("velocity"))
    middle = velocity.shape[0] // 2
    beside = slice(middle - 1, middle + 1)  # the line runs between two rows of cells
    return np.asarray(air.x), velocity[beside, :, 0].mean(axis=0), velocity[:, beside, 2].mean(axis=1)


def measure(options):
    """The rows by name, and the lines."""
    x, u, w = found = lines(options.out)
    numbers = {}
    for name in ("", "-ghia"):
        numbers |= {"least-u" + name: u.min(), "least-w" + name: w.min(), "largest-w" + name: w.max()}
    table_u, table_w = REFERENCE["table-u"], REFERENCE["table-w"]
    # At the walls the fluid is at rest, at the lid it moves with it.
    numbers["difference-u"] = np.abs(np.interp(table_u["z"], [0, *x, 1], [0, *u, 1]) - table_u["u"]).max()
    numbers["difference-w"] = np.abs(np.interp(table_w["x"], [0, *x, 1], [0, *w, 0]) - table_w["w"]).max()
    return numbers, found


def tell(numbers, _):
    return study.table_of_numbers(REFERENCE, numbers, digits=4)


def draw(found):
    from matplotlib import pyplot as plt
    x, u, w = found
    figure, axes = plt.subplots(1, 2, figsize=(7, 3), layout="constrained")
    axes[0].plot(u, x, label=f"Talus, {REFERENCE['cells']}² cells")
    axes[0].plot(REFERENCE["table-u"]["u"], REFERENCE["table-u"]["z"], "o", mfc="none", label="Ghia, Ghia & Shin 1982")
    axes[0].set(xlabel="u, upright middle line", ylabel="z")
    axes[1].plot(x, w)
    axes[1].plot(REFERENCE["table-w"]["x"], REFERENCE["table-w"]["w"], "o", mfc="none")
    axes[1].set(xlabel="x", ylabel="w, level middle line")
    axes[0].legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/cavity-128", REFERENCE, cases, measure, tell, draw))
