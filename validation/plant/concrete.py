#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the concrete silo with an eccentric outlet: its rate, and what the wall bears in and beside the flow channel.

    validation/plant/concrete.py [--out results/plant-concrete] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = study.rows_of(HERE, "concrete-")
AXIS = 3.2  # m
SIDES = {"outlet's side": (0, 45), "beside": (45, 135), "far side": (135, 180)}  # degrees from the outlet's direction
HEIGHTS = np.arange(1, 23, 2)  # m, lower ends of bands
MEASURED = slice(1, 4)  # of these: 3 to 9 m
FROM = 10.0  # s after the opening


def cases(options):
    yield HERE.parents[1] / "cases" / "concrete-silo.toml", options.out / "silo", {}


def pressures(run, column):
    """By height and side, Pa: means over the area of the cylinder."""
    walls = run.walls[-1]
    place, area, values = walls.middles, walls.areas, np.asarray(walls[column])
    wall = (np.asarray(walls["patch"]) == 0) & (place[:, 1] > 0)
    angle = np.degrees(np.arctan2(place[:, 1], place[:, 0] - AXIS))
    found = np.zeros((len(HEIGHTS), len(SIDES)))
    for n, height in enumerate(HEIGHTS):
        for side, (begin, end) in enumerate(SIDES.values()):
            there = wall & (angle >= begin) & (angle < end) & (place[:, 2] >= height) & (place[:, 2] < height + 2)
            found[n, side] = np.average(values[there], weights=area[there])
    return found


def measure(options):
    run = talus.Run(options.out / "silo")
    rest, flow = pressures(run, "pressure_at_rest"), pressures(run, "pressure_in_flow")
    still, channel, beside = rest[MEASURED, 0].mean(), flow[MEASURED, 0].mean(), flow[MEASURED, 1].mean()
    time, gone = np.asarray(run.series["time"]) - run.gate_time, np.asarray(run.series["removed_mass"])
    rate = (gone[-1] - np.interp(FROM, time, gone)) / (time[-1] - FROM)
    numbers = {"concrete-rate": rate / run.summary["discharge_rate_beverloo"],
               "concrete-channel": channel / still, "concrete-beside": beside / (2 * still - channel)}
    return numbers, {"run": run, "rest": rest, "flow": flow}


def tell(numbers, found):
    lines = ["| height, m | " + " | ".join(f"{side}: at rest, in flow, kPa" for side in SIDES) + " |", "|---" * (len(SIDES) + 1) + "|"]
    for height, rest, flow in zip(HEIGHTS, found["rest"], found["flow"]):
        lines.append(f"| {height} to {height + 2} | " + " | ".join(f"{a / 1e3:.1f}, {b / 1e3:.1f}" for a, b in zip(rest, flow)) + " |")
    return "\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, numbers)


def draw(found):
    """Pressures by height, and the speed along the plane of symmetry in the last snapshot."""
    from matplotlib import colors, pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(7, 5.5), layout="constrained")
    for side, colour in zip(range(len(SIDES)), ("C3", "C0", "C2")):
        left.plot(found["rest"][:, side] / 1e3, HEIGHTS + 1, "--", color=colour, linewidth=1)
        left.plot(found["flow"][:, side] / 1e3, HEIGHTS + 1, "-", color=colour, label=list(SIDES)[side])
    left.set(xlabel="pressure on the wall, kPa (dashed: at rest)", ylabel="height, m", xlim=(0, None), ylim=(0, 24))
    left.legend(frameon=False)
    last = found["run"].snapshots[-1]
    x, size, speed = last.positions, 0.0875 * np.cbrt(study.mass_ratios(last)), np.linalg.norm(last["velocity"], axis=1)
    shown = x[:, 1] < 0.7 * size
    marks = right.scatter(x[shown, 0], x[shown, 2], s=(16 * size[shown]) ** 2, c=speed[shown], linewidths=0,
                          norm=colors.LogNorm(3e-3, 1))
    right.set(aspect="equal", xlabel="x, m", ylim=(0, 24))
    figure.colorbar(marks, label="speed, m/s", shrink=0.7)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/plant-concrete", REFERENCE, cases, measure, tell, draw))
