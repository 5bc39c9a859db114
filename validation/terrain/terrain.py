#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the mountain side, runs the layer of sand on it, and measures what walls do to it.

    validation/terrain/terrain.py [--out results/terrain] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import shutil
import struct
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
GRAVITY, SPACING, SLOW = 9.81, 15e-3, 20e-3  # SI
COLUMNS, ROWS = 174, 87  # cells of the ground: 30,276 triangles


def ground(x, y):
    """Height of the mountain side, m: a slope of 40 degrees that runs out to 5, a gully, and bumps of a few spacings."""
    slope = np.where(x < 0.9, 1.0 - np.tan(np.radians(40)) * (x - 0.1),
                     1.0 - np.tan(np.radians(40)) * 0.8 - np.tan(np.radians(5)) * (x - 0.9))
    gully = 0.08 * (np.abs(y - 0.5) / 0.5) ** 2
    bumps = 0.012 * np.sin(23 * x + 3 * y) * np.cos(19 * y) + 0.006 * np.sin(61 * x - 17 * y)
    return slope + gully + bumps


def write_ground(path):
    x, y = np.linspace(-0.1, 2.1, COLUMNS + 1), np.linspace(-0.05, 1.05, ROWS + 1)
    grid = np.stack(np.broadcast_arrays(x[:, None], y[None, :], ground(x[:, None], y[None, :])), axis=-1)
    a, b, c, d = grid[:-1, :-1], grid[1:, :-1], grid[1:, 1:], grid[:-1, 1:]
    triangles = np.concatenate([np.stack([a, b, c], axis=-2).reshape(-1, 3, 3), np.stack([a, c, d], axis=-2).reshape(-1, 3, 3)])
    with open(path, "wb") as file:
        file.write(b"ground".ljust(80, b" ") + struct.pack("<I", len(triangles)))
        for t in triangles.astype("<f4"):
            file.write(np.zeros(3, "<f4").tobytes() + t.tobytes() + b"\0\0")


def cases(options):
    options.out.mkdir(parents=True, exist_ok=True)
    case = options.out / "terrain.toml"
    if not case.exists():
        write_ground(options.out / "ground.stl")
        shutil.copy(HERE / "terrain.toml", case)
    yield case, options.out / "run", {}


def height_above(x):
    """Of places, along the normal of the ground, m."""
    step = 1e-4
    gx = (ground(x[:, 0] + step, x[:, 1]) - ground(x[:, 0] - step, x[:, 1])) / (2 * step)
    gy = (ground(x[:, 0], x[:, 1] + step) - ground(x[:, 0], x[:, 1] - step)) / (2 * step)
    return (x[:, 2] - ground(x[:, 0], x[:, 1])) / np.sqrt(1 + gx ** 2 + gy ** 2)


def heads(snapshot):
    return snapshot.positions[:, 2] + (snapshot["velocity"] ** 2).sum(axis=1) / (2 * GRAVITY)


def measure(options):
    run = talus.Run(options.out / "run")
    shots = [run.snapshots[n] for n in range(len(run.snapshots))]
    start = heads(shots[0]).max()
    excess = np.array([heads(s).max() - start if len(s.positions) else -np.inf for s in shots])
    last = shots[-1]
    speed = np.sqrt((last["velocity"] ** 2).sum(axis=1))
    numbers = {"excess": max(0.0, excess.max() / SPACING), "resting": (speed < SLOW).mean(),
               "lowest": height_above(np.asarray(last.positions)).min() / SPACING,
               "mass": 1.0 + float(run.summary["mass_error"])}
    return numbers, {"time": np.array([float(s.time) for s in shots]), "excess": excess / SPACING,
                     "position": np.asarray(last.positions)}


def tell(numbers, found):
    return study.table_of_numbers(REFERENCE, numbers)


def draw(found):
    from matplotlib import pyplot as plt
    figure, (above, beside) = plt.subplots(1, 2, figsize=(9, 3.6), layout="constrained")
    x, y = np.meshgrid(np.linspace(0, 2, 200), np.linspace(0, 1, 100), indexing="ij")
    above.contour(x, y, ground(x, y), 30, colors="0.6", linewidths=0.5)
    above.plot(found["position"][:, 0], found["position"][:, 1], ".", markersize=1.5)
    above.set(xlabel="x, m", ylabel="y, m", aspect="equal", title="at rest")
    beside.plot(found["time"], found["excess"])
    beside.axhline(0, color="0.6", linewidth=0.8)
    beside.set(xlabel="time, s", ylabel="largest head less that at the start, spacings")
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/terrain", REFERENCE, cases, measure, tell, draw))
