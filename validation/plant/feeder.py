#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the bunker over a belt feeder: what the belt draws, bears and needs.

    validation/plant/feeder.py [--out results/plant-feeder] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = study.rows_of(HERE, "feeder-")
FROM, TO, AT_REST = 12.0, 26.0, 0.3  # s after the belt starts; s before
SPEED, SECTION, DENSITY = 0.2, 0.48 * 0.24, 810.0  # m/s, m^2, kg/m^3
QUARTERS = np.linspace(0.3, 1.5, 5)  # of the slot, m


def cases(options):
    yield HERE.parents[1] / "cases" / "belt-feeder.toml", options.out / "feeder", {}


def mean_rate(run, column, begin, end):
    """Of a sum in series.csv between two times after the opening, both halves of the bunker."""
    time = np.asarray(run.series["time"]) - run.gate_time
    first, last = np.interp([begin, end], time, np.asarray(run.series[column]))
    return 2 * (last - first) / (end - begin)


def drawn(run):
    """Share of what sinks into the slot by its quarters, from the rear."""
    sums = np.zeros(4)
    for snapshot in run.snapshots:
        if not FROM <= snapshot.time - run.gate_time <= TO:
            continue
        x, flow = snapshot.positions, -study.mass_ratios(snapshot) * snapshot["velocity"][:, 2]
        inside = (x[:, 2] > 0.52) & (x[:, 2] < 0.64)
        sums += np.histogram(x[inside, 0], QUARTERS, weights=flow[inside])[0]
    return sums / sums.sum()


def measure(options):
    run = talus.Run(options.out / "feeder")
    numbers = {"rate": mean_rate(run, "removed_mass", FROM, TO),
               "rest": -mean_rate(run, "impulse_belt_z", -AT_REST, 0), "flow": -mean_rate(run, "impulse_belt_z", FROM, TO),
               "pull": -mean_rate(run, "impulse_belt_x", FROM, TO), "drawn": drawn(run), "run": run}
    return {"feeder-efficiency": numbers["rate"] / (DENSITY * SECTION * SPEED),
            "feeder-load": numbers["flow"] / numbers["rest"]}, numbers


def tell(numbers, found):
    quarters = ", ".join(f"{100 * share:.0f}" for share in found["drawn"])
    return (f"{found['rate']:.2f} kg/s; the belt bears {found['rest'] / 1e3:.2f} kN at rest, {found['flow'] / 1e3:.2f} kN in "
            f"flow, and needs {found['pull'] / 1e3:.2f} kN; quarters of the slot from the rear: {quarters} %\n\n"
            + study.table_of_numbers(REFERENCE, numbers))


def draw(found):
    """The last snapshot along the plane of symmetry, by speed."""
    from matplotlib import colors, pyplot as plt
    last = found["run"].snapshots[-1]
    x, size, speed = last.positions, 0.03 * np.cbrt(study.mass_ratios(last)), np.linalg.norm(last["velocity"], axis=1)
    shown = x[:, 1] < 0.7 * size
    figure, axis = plt.subplots(figsize=(6, 5), layout="constrained")
    marks = axis.scatter(x[shown, 0], x[shown, 2], s=(85 * size[shown]) ** 2, c=speed[shown], linewidths=0,
                         norm=colors.LogNorm(3e-3, 0.3))
    for place, height in (([0.1, 2.1], [0.3, 0.3]), ([0.3, 0.3], [0.3, 2.9]), ([1.5, 1.5], [0.54, 2.9])):
        axis.plot(place, height, "k", linewidth=1)
    axis.set(aspect="equal", xlabel="x, m", ylabel="height, m")
    figure.colorbar(marks, label="speed, m/s", shrink=0.7)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/plant-feeder", REFERENCE, cases, measure, tell, draw))
