#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Blows air through a bed, below and above the velocity that lifts it: what it bears, and how high it lies.

    validation/fluidised-bed/fluidised_bed.py [--out results/fluidised-bed] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
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
SETUP = REFERENCE["setup"]
#: Velocity over U_mf and spacing, mm.
RUNS = [(ratio, SETUP["spacing"]) for ratio in SETUP["velocities"]]
RUNS += [(ratio, SETUP["finer"]) for ratio in SETUP["velocities"] if ratio < 1]
ROWS = {name: row for name, row in REFERENCE.items() if name != "setup"}


def ergun(velocity):
    """Pressure drop over the weight of the bed per area. \\param velocity superficial, m/s"""
    void, d = 1 - SETUP["packing"], SETUP["diameter"]
    viscous = 150 * SETUP["packing"] * SETUP["viscosity"] / (void**3 * d**2)
    inertial = 1.75 * SETUP["air_density"] / (void**3 * d)
    return (viscous * velocity + inertial * velocity**2) / (SETUP["grain_density"] * SETUP["gravity"])


def lifting_velocity():
    """U_mf, m/s: where ergun() is 1."""
    linear = ergun(1.0) - (square := (ergun(2.0) - 2 * ergun(1.0)) / 2)
    return (np.sqrt(linear**2 + 4 * square) - linear) / (2 * square)


def folder_of(ratio, spacing):
    return f"u-{ratio:g}-h{spacing:g}"


def cases(options):
    for ratio, spacing in RUNS:
        velocity, size = f"{ratio * lifting_velocity():.6g} m/s", f"{spacing:g} mm"
        yield (HERE.parents[1] / "cases" / "fluidised-bed.toml", options.out / folder_of(ratio, spacing),
               {"air.floor_velocity": ["0 m/s", "0 m/s", velocity], "bed.spacing": size, "box.depth": size, "bed.disorder": 0,
                "run.end": "1.6 s" if ratio > 1 else "1 s", "output.report": False, "output.pictures": False})


def lift_and_height(run):
    """Of the window: the air's force over the weight, and the mean height of the particles over that before the air came in."""
    time = np.asarray(run.series["time"]) - run.gate_time
    lift, weight = (np.asarray(run.series[f"impulse_{name}_z"]) for name in ("air", "gravity"))
    begin, end = SETUP["from"], time[-1]
    gained = [np.interp(end, time, sums) - np.interp(begin, time, sums) for sums in (lift, weight)]
    heights = [(snapshot.time - run.gate_time, snapshot.positions[:, 2].mean()) for snapshot in run.snapshots]
    still = [height for at, height in heights if at <= 0][-1]
    return gained[0] / -gained[1], np.mean([height for at, height in heights if at >= begin]) / still


def measure(options):
    found = {run: lift_and_height(talus.Run(options.out / folder_of(*run))) for run in RUNS}
    coarse, fine = SETUP["spacing"], SETUP["finer"]
    lift, height = ({ratio: found[ratio, coarse][n] for ratio in SETUP["velocities"]} for n in (0, 1))

    def extrapolated(ratio):
        finer = found[ratio, fine][0]
        return (finer + (finer - lift[ratio]) * fine / (coarse - fine)) / ergun(ratio * lifting_velocity())

    return {"lift-half": extrapolated(0.5), "lift-below": extrapolated(0.9),
            "lift-above": lift[1.1], "lift-far-above": 0.5 * (lift[1.5] + lift[2.0]),
            "height-below": height[0.9] - 1, "height-above": height[1.1] - 1}, found


def tell(numbers, found):
    lines = ["| U over U_mf | spacing | lift over weight | Ergun's | height over that at rest |", "|---|---|---|---|---|"]
    for (ratio, spacing), (lift, height) in found.items():
        hand = min(1, ergun(ratio * lifting_velocity()))
        lines.append(f"| {ratio:g} | {spacing:g} mm | {lift:.3f} | {hand:.3f} | {height:.3f} |")
    return f"U_mf {lifting_velocity():.4f} m/s\n\n" + "\n".join(lines) + "\n\n" + study.table_of_numbers(ROWS, numbers)


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(4.6, 3.2), layout="constrained")
    ratio = np.linspace(0, 2.1, 200)
    axes.plot(ratio, np.minimum(1, ergun(ratio * lifting_velocity())), "k-", linewidth=1, label="Ergun, weight")
    at = [ratio for ratio, _ in found]
    axes.plot(at, [lift for lift, _ in found.values()], "o", label="lift")
    axes.plot(at, [height for _, height in found.values()], "s", label="height over that at rest")
    axes.set(xlabel="velocity over U_mf", ylim=(0, None), xlim=(0, 2.1))
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/fluidised-bed", ROWS, cases, measure, tell, draw))
