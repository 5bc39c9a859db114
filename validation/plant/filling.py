#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the bin that is filled through a spout off its axis: where its heap lies and how steep it is.

    validation/plant/filling.py [--out results/plant-filling] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = study.rows_of(HERE, "filling-")
AXIS, RADIUS, BASE, SPOUT = 1.35, 1.25, 0.1, 0.85  # m
SPACING, RATE, DURATION = 0.05, 50.0, 60.0  # m, kg/s, s; of the half
PARTICLE = 1350 * 0.6 * SPACING**3  # kg


def cases(options):
    yield HERE.parents[1] / "cases" / "bin-filling.toml", options.out / "filling", {}


def surface(positions):
    """Places along the plane of symmetry and the height of the bed there: upper edge of the highest particle within 0.1 m of
    the plane, by columns of two spacings."""
    near = positions[:, 1] < 0.1
    x, z = positions[near, 0], positions[near, 2] + 0.5 * SPACING
    edges = np.arange(AXIS - RADIUS, AXIS + RADIUS + SPACING, 2 * SPACING)
    column = np.digitize(x, edges) - 1
    tops = np.array([z[column == n].max() if np.any(column == n) else np.nan for n in range(len(edges) - 1)])
    middles = 0.5 * (edges[1:] + edges[:-1])
    return middles[np.isfinite(tops)], tops[np.isfinite(tops)]


def slope(x, z):
    return np.degrees(np.arctan(abs(np.polyfit(x, z, 1)[0])))


def measure(options):
    run = talus.Run(options.out / "filling")
    last = run.snapshots[-1]
    x, z = surface(last.positions)
    apex = x[np.argmax(z)]
    far = (x > SPOUT + 0.6) & (x < AXIS + RADIUS - 0.15)
    place = last.positions
    inside = (np.hypot(place[:, 0] - AXIS, place[:, 1]) < RADIUS) & (place[:, 2] > BASE)
    numbers = {"filling-slope": slope(x[far], z[far]), "filling-apex": apex - SPOUT,
               "filling-mass": PARTICLE * inside.sum() / (RATE * DURATION) - 1}
    return numbers, {"run": run, "x": x, "z": z, "apex": apex}


def tell(numbers, found):
    x, z = found["x"], found["z"] - BASE
    return (f"apex {z.max():.2f} m high, {AXIS - found['apex']:.2f} m off the axis; {z[0]:.2f} m at the near wall, {z[-1]:.2f} m at the "
            f"far one; slope {numbers['filling-slope']:.1f} degrees towards the far wall\n\n"
            + study.table_of_numbers(REFERENCE, numbers))


def draw(found):
    """The bed along its plane of symmetry, by when its particles came in."""
    from matplotlib import pyplot as plt
    last = found["run"].snapshots[-1]
    x = last.positions
    shown = x[:, 1] < 0.06
    figure, axis = plt.subplots(figsize=(6, 4.2), layout="constrained")
    arrived = DURATION * last["identity"] / last["identity"].max()
    marks = axis.scatter(x[shown, 0], x[shown, 2], s=14, c=arrived[shown], linewidths=0, cmap="twilight")
    for place in (AXIS - RADIUS, AXIS + RADIUS):
        axis.plot([place, place], [BASE, 3.3], "k", linewidth=1)
    axis.plot([AXIS - RADIUS, AXIS + RADIUS], [BASE, BASE], "k", linewidth=1)
    axis.set(aspect="equal", xlabel="x, m", ylabel="height, m")
    figure.colorbar(marks, label="came in after, s", shrink=0.8)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/plant-filling", REFERENCE, cases, measure, tell, draw))
