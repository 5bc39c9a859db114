#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a silo whole and by sectors, three beds each, and puts them beside each other.

    validation/sector/sector.py [--out results/sector] [--threads N] [--spacing MM] [--markdown FILE] [--picture FILE]

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
RADIUS, OUTLET, GRAVITY = 32.5e-3, 60e-3, 9.81  # SI
WALLS = ("cylinder", "cone", "gate")
REST = 10e-3  # s


def folder_of(out, sector, seed):
    return out / (f"{sector:g}deg-{seed}" if sector else f"whole-{seed}")


def cases(options):
    for sector in (None, *REFERENCE["sectors"]):
        changed = {"box.sector": f"{sector:g} deg"} if sector else {}
        for seed in REFERENCE["seeds"]:
            yield (HERE / "silo.toml", folder_of(options.out, sector, seed),
                   changed | {"bed.spacing": f"{options.spacing:.9g} mm", "bed.disorder": 0.1, "seed": seed})


def read(out, sector):
    """Means over the beds; of the curve of what has passed the first."""
    runs = [numbers_of(folder_of(out, sector, seed)) for seed in REFERENCE["seeds"]]
    curve = {name: runs[0][name] for name in ("time", "passed")}
    return {name: np.mean([run[name] for run in runs], axis=0) for name in runs[0] if name not in curve} | curve | {
        "rates": [run["rate"] for run in runs]}


def numbers_of(folder):
    """Numbers of a run of the whole vessel, whichever part of it was computed."""
    run = talus.Run(folder)
    series = run.series
    time, gate = series["time"], run.gate_time
    passed = series["discharged_mass"] + series["removed_mass"]
    mass = -np.polyfit(time[time <= gate][-20:], series["impulse_gravity_z"][time <= gate][-20:], 1)[0] / GRAVITY

    def when(share):
        return np.interp(share * mass, passed, time)

    def force(column, begin, end):
        return (np.interp(end, time, series[column]) - np.interp(begin, time, series[column])) / (end - begin)

    def pressing(wall):
        return sum(force(name, when(0.2), when(0.5)) for name in series if name.startswith(f"normal_impulse_{wall}"))

    weight = mass * GRAVITY
    x = np.asarray(run.snapshots.at(when(0.4)).positions)
    x = x[x[:, 2] > OUTLET]
    radius = np.hypot(x[:, 0] - 50e-3, x[:, 1] - 50e-3)
    surface = [1e3 * np.percentile(x[part, 2], 98) for part in (radius < RADIUS / 2, radius >= RADIUS / 2)]
    return {"mass": mass, "rate": 0.5 * mass / (when(0.7) - when(0.2)), "emptied": when(0.99) - gate,
            "rest": np.array([-force(f"impulse_{wall}_z", gate - REST, gate) / weight for wall in WALLS]),
            "flow": np.array([pressing(wall) for wall in WALLS[:2]]), "surface": np.array(surface),
            "cpu": run.summary["cpu_seconds"], "steps": run.summary["steps"], "time": time - gate, "passed": passed / mass}


def measure(options):
    whole = read(options.out, None)
    found, rows = {"whole": whole}, {"balance": 0.0}

    def largest(values):
        return values[np.argmax(np.abs(values))]

    for sector in REFERENCE["sectors"]:
        one = found[f"{sector} deg"] = read(options.out, sector)
        rows |= {f"rate-{sector}": one["rate"] / whole["rate"] - 1, f"emptied-{sector}": one["emptied"] / whole["emptied"] - 1,
                 f"rest-{sector}": largest(one["rest"] - whole["rest"]), f"flow-{sector}": largest(one["flow"] / whole["flow"] - 1),
                 f"surface-{sector}": largest(one["surface"] - whole["surface"])}
        rows["balance"] = largest(np.array([rows["balance"], one["rest"].sum() - 1]))
    return rows, found


def tell(rows, found):
    lines = ["| computed | mass, g | rate, g/s (of each) | emptied, s | cylinder, cone, gate at rest | pressing on cylinder, cone in flow, N | "
             "surface, mm | steps | processor time, s |", "|---|---|---|---|---|---|---|---|---|"]
    for name, one in found.items():
        rates = ", ".join(f"{1e3 * rate:.0f}" for rate in one["rates"])
        lines.append("| %s | %.1f | %.1f (%s) | %.3f | %.3f, %.3f, %.3f | %.2f, %.2f | %.1f, %.1f | %d | %.0f |"
                     % (name, 1e3 * one["mass"], 1e3 * one["rate"], rates, one["emptied"], *one["rest"], *one["flow"], *one["surface"],
                        one["steps"], one["cpu"]))
    return "\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, rows)


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(4.6, 3.4), layout="constrained")
    for (name, one), style in zip(found.items(), ("k-", "C0--", "C1-.", "C3:", "C2-")):
        axes.plot(one["time"], one["passed"], style, label=name)
    axes.set(xlabel="t, s", ylabel="share that has passed", xlim=(0, None), ylim=(0, 1.02))
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/sector", REFERENCE, cases, measure, tell, draw,
                           spacing=3.3333333))
