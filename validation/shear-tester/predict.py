#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Leaves each load of a published flow function out, and predicts its strength by the law that the others give.

    validation/shear-tester/predict.py [--markdown FILE] [--picture FILE]

Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and python3-matplotlib, and a talus that is built."""
import math
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
from talus import powder  # noqa: E402
from talus.ask import ask  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
HELD = 1240  # Pa


def strength_at(law, major):
    """f_c of the law where its steady shear has sigma_1, both Pa. \\param law M, a_0, kappa"""
    friction, bond, growth = law
    phi = math.atan(friction)
    factor = (1 + friction**2) * (1 + math.sin(phi))  # sigma_1 + a = factor (sigma + a)
    load = (major - (factor - 1) * bond) / (factor + (factor - 1) * growth)
    return 2 * friction * (bond + growth * load) * math.cos(phi) / (1 - math.sin(phi))


def law_of(loci):
    points = np.array([(locus["consolidation"], *point) for locus in loci for point in locus["points"]])
    return [estimate.value for estimate in powder.fit_loci(*points.T)]


def measure(_):
    pairs = np.array(ask("yield-loci", file=str(HERE / "data" / "powder.csv"))).reshape(-1, 2)
    strengths = np.array([[locus["strength"] for locus in pair] for pair in pairs])
    scatter = np.sqrt(np.mean(np.var(strengths / strengths.mean(axis=1)[:, None], axis=1, ddof=1)))
    rows = []
    for n, pair in enumerate(pairs):
        law = law_of(np.delete(pairs, n, axis=0).ravel())
        major, mean = np.mean([locus["major"] for locus in pair]), strengths[n].mean()
        predicted = strength_at(law, major)
        rows.append((major, *strengths[n], predicted, (predicted / mean - 1) / scatter))
    held = min(rows, key=lambda row: abs(row[0] - HELD))
    return {"held": held[-1]}, (rows, scatter, law_of(pairs.ravel()))


def tell(numbers, found):
    rows, scatter, _ = found
    lines = ["| σ₁, Pa | f_c of both samples, Pa | predicted | off, over the scatter |", "|---|---|---|---|"]
    lines += [f"| {a:.0f} | {b:.0f}, {c:.0f} | {p:.0f} | {off:.1f} |" for a, b, c, p, off in rows]
    return "\n".join(lines) + f"\n\nScatter: {100 * scatter:.1f} %.\n\n" + study.table_of_numbers(REFERENCE, numbers)


def draw(found):
    from matplotlib import pyplot as plt
    rows, _, law = found
    table = np.array(rows)
    figure, axes = plt.subplots(figsize=(4, 2.8), layout="constrained")
    axes.plot(np.repeat(table[:, 0], 2), table[:, 1:3].ravel(), "o", markersize=4, label="samples")
    axes.plot(table[:, 0], table[:, 3], "x", label="predicted, each load left out")
    line = np.linspace(100, 2100)
    axes.plot(line, [strength_at(law, major) for major in line], linewidth=0.8, color="0.5", label="fit to all")
    axes.set(xlabel="$\\sigma_1$ (Pa)", ylabel="$f_c$ (Pa)", xlim=(0, None), ylim=(0, None))
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/shear-tester", REFERENCE, lambda options: (), measure, tell, draw))
