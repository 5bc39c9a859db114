#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a bed at rest, a column, a slit, also in air, pressure pulses and a silo with particles of two sizes and of one, and compares
them.

    validation/plant/levels.py [--out results/plant-levels] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = study.rows_of(HERE, "levels-")
AIR = {"grains.diameter": "0.2 mm", "air.enabled": True, "air.cell": "7.5 mm", "air.drag": "ergun-wen-yu", "air.floor": "open",
       "air.top": "wall", "run.end": "0.45 s"}
CASES = {"bed": ("levels-bed.toml", {}), "column": ("levels-column.toml", {}),
         "slit": ("levels-slit.toml", {"removal.below": "10 mm"}), "air": ("levels-slit.toml", AIR),
         "finer": ("levels-wave.toml", {}), "coarser": ("levels-wave.toml", {}),
         "silo": ("silo.toml", {"accuracy": "draft", "integration.pair_precision": "double"})}
LEVELS = {"bed": {"levels.count": 1, "levels.distance": "24 mm", "levels.low": ["80 mm", "0 mm", "60 mm"],
                  "levels.high": ["112 mm", "64 mm", "100 mm"]},
          "column": {"levels.count": 1, "levels.distance": "20 mm", "levels.low": ["100 mm", "0 mm", "0 mm"],
                     "levels.high": ["240 mm", "40 mm", "40 mm"]},
          "slit": {"levels.count": 1}, "air": {"levels.count": 1},
          "finer": {"levels.count": 1, "levels.distance": "1 mm", "levels.low": ["0 mm", "0 mm", "0 mm"],
                    "levels.high": ["48 mm", "48 mm", "320 mm"]},
          "coarser": {"levels.count": 1, "levels.distance": "1 mm", "levels.low": ["0 mm", "0 mm", "320 mm"],
                      "levels.high": ["48 mm", "48 mm", "720 mm"]},
          "silo": {"levels.count": 1}}
CHANGE, PULSE = 0.32, 0.16  # height where the level changes; length of the pulse, m
SPACING = 4e-3  # of the column, m
BEHIND, BEHIND_AIR, SPLIT, NEAR, AXIS, OUTLET = 20.0, 0.4, 0.75, 0.1, 0.96665, 1.0  # s; s; m from the outlet's rim; m; m; m


def folder_of(out, case, count):
    return out / f"{case}-{count}"


def cases(options):
    for case, (file, settings) in CASES.items():
        for levels in ({"levels.count": 0}, LEVELS[case]):
            yield HERE / file, folder_of(options.out, case, levels["levels.count"]), settings | levels


def percentile(values, weights, share):
    order = np.argsort(values)
    return values[order][np.searchsorted(np.cumsum(weights[order]), share * weights.sum())]


def layers(run):
    """Vertical stress of the layers of the bed, Pa."""
    last = run.snapshots[-1]
    z, volume = last.positions[:, 2], study.mass_ratios(last) / last["density"]
    means = []
    for low in np.arange(0, 0.128, 0.016):
        inside = (z >= low) & (z < low + 0.016)
        means.append(np.average(last["stress_zz"][inside], weights=volume[inside]))
    return np.array(means)


def heap(run):
    """Front and height of the column at the end, by the outer edges of its particles, m."""
    last = run.snapshots[-1]
    x, mass = last.positions, study.mass_ratios(last)
    half = 0.5 * SPACING * np.cbrt(mass)
    beside = x[:, 0] < 0.02
    return percentile(x[:, 0] + half, mass, 0.995), percentile((x[:, 2] + half)[beside], mass[beside], 0.995)


def comes_back(run):
    """Momentum above the change of level over that of the pulse, mean of the snapshots in which the pulse is between the
    change and the column's end. A pulse is where its momentum is."""
    first, found = run.snapshots[0], []
    whole = (study.mass_ratios(first) * first["velocity"][:, 2]).sum()
    for snapshot in run.snapshots:
        z, momentum = snapshot.positions[:, 2], study.mass_ratios(snapshot) * snapshot["velocity"][:, 2]
        below = z < CHANGE
        if not momentum[below].sum() / whole > 0.5:
            continue
        middle = (momentum * z)[below].sum() / momentum[below].sum()
        if 0.6 * PULSE < middle < CHANGE - 0.6 * PULSE:
            found.append(momentum[~below].sum() / whole)
    return float(np.mean(found))


def left(run, behind, column="removed_mass"):
    """What has left the vessel so long after the opening, kg."""
    time = np.asarray(run.series["time"]) - run.gate_time
    return float(np.interp(behind, time, np.asarray(run.series[column])))


def suction(run):
    """Mean of the air's lowest pressure over the second half of the time in which the slit is watched, Pa."""
    time = np.asarray(run.series["time"]) - run.gate_time
    watched = (time >= 0.5 * BEHIND_AIR) & (time <= BEHIND_AIR)
    return float(np.asarray(run.series["air_pressure_min"])[watched].mean())


def density_over_sum(run):
    """Mean over the snapshots in the middle of the run, of particles that split last."""
    means = []
    for snapshot in run.snapshots:
        if not 5 <= snapshot.time - run.gate_time <= 15:
            continue
        x = snapshot.positions - (AXIS, AXIS, OUTLET)
        distance = np.hypot(np.maximum(np.hypot(x[:, 0], x[:, 1]) - 0.25, 0), x[:, 2])
        near = (x[:, 2] > 0) & (distance > SPLIT - NEAR) & (distance < SPLIT) & (study.mass_ratios(snapshot) < 3)
        means.append((snapshot["density"][near] / snapshot["packing"][near]).mean())
    return float(np.mean(means))


def measure(options):
    """The rows by name, and the runs by case and levels."""
    runs = {(case, count): talus.Run(folder_of(options.out, case, count))
            for case in CASES for count in (0, 1)}

    def over_one_size(case, number):
        return number(runs[case, 1]) / number(runs[case, 0]) - 1
    return {"levels-rest": np.abs(over_one_size("bed", layers)).max(),
            "levels-front": over_one_size("column", lambda run: heap(run)[0]),
            "levels-height": over_one_size("column", lambda run: heap(run)[1]),
            "levels-slit": over_one_size("slit", lambda run: run.summary["discharge_steady"]),
            **{f"levels-wave-{case}": comes_back(runs[case, 1]) - comes_back(runs[case, 0]) for case in ("finer", "coarser")},
            "levels-rate": over_one_size("silo", lambda run: run.summary["discharge_steady"]),
            "levels-left": over_one_size("silo", lambda run: left(run, BEHIND)),
            "levels-air": over_one_size("air", lambda run: left(run, BEHIND_AIR, "discharged_mass")),
            "levels-air-pressure": over_one_size("air", suction),
            "levels-density": over_one_size("silo", density_over_sum)}, runs


def tell(numbers, runs):
    lines = ["| case | levels | particles at the start | steps | processor time, s |", "|---|---|---|---|---|"]
    for (case, count), run in runs.items():
        first = run.snapshots[0]
        lines.append(f"| {case} | {count} | {len(first.positions)} | {run.summary['steps']:.0f} | "
                     f"{run.summary['cpu_seconds']:.0f} |")
    return "\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, numbers)


def draw(runs):
    """The column at the end, particles by their size."""
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(2, 1, figsize=(7, 3.6), sharex=True, sharey=True, layout="constrained")
    for axis, count in zip(axes, (1, 0)):
        last = runs["column", count].snapshots[-1]
        x, size = last.positions, SPACING * np.cbrt(study.mass_ratios(last))
        shown = np.abs(x[:, 1] - 0.02) < 0.75 * size
        axis.scatter(1e3 * x[shown, 0], 1e3 * x[shown, 2], s=2.2 * (1e3 * size[shown]) ** 2 / 4,
                     c=np.where(size[shown] > 1.2 * SPACING, "C1", "C0"), linewidths=0)
        axis.set(aspect="equal", ylabel="height, mm", title="two sizes" if count else "one size")
    axes[-1].set(xlabel="distance, mm", xlim=(0, 420), ylim=(0, 125))
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/plant-levels", REFERENCE, cases, measure, tell, draw))
