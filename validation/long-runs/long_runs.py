#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs each case with a vessel for a million steps and counts its particles.

    validation/long-runs/long_runs.py [--out results/long-runs] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again, one that was cut off is resumed. Exit status 1 if a row of reference.toml is not met. Needs
python3-numpy, python3-h5py and python3-matplotlib."""
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
CASES = REFERENCE["case"]
POLYGON = 1 / 50  # of a spacing: by as much its corners are outside of the circle


def half_width(z, *profile):
    """Of a vessel at the heights z. \\param profile pairs of height and half width or radius, upwards"""
    heights, widths = zip(*profile)
    return np.interp(z, heights, widths)


def outside(case, x, slack):
    """Which places are where a particle can only have come to through a wall. \\param x places, mm \\param slack mm"""
    radius, across = np.hypot(x[:, 0] - 50, x[:, 1] - 50), np.abs(x - 45).max(axis=1, where=[True, True, False], initial=0)
    z = x[:, 2]
    if case == "silo-cone":
        return (z > 60) & (radius > half_width(z, (60, 15), (90.3, 32.5)) + slack)
    if case == "silo-square":
        return (z > 50) & (across > half_width(z, (50, 15), (90, 30)))
    if case == "hourglass":
        return (z < 10) | (radius > half_width(z, (10, 45), (65, 15), (120, 45)) + slack)
    if case == "drum":
        return (np.hypot(x[:, 0] - 55, z - 55) > 50 + slack) | (x[:, 1] < 5) | (x[:, 1] > 29)
    if case == "chute-bend":
        return (x[:, 0] > 20) & (x[:, 0] < 280) & (z < np.interp(x[:, 0], [20, 140, 280], [240, 120, 55]))
    if case == "wedge-hopper":
        return (z > 60) & (np.abs(x[:, 0] - 50) > 10 + (z - 60) * np.tan(np.pi / 6))
    raise ValueError(case)


def cases(options):
    share = {"output.report": "false"}
    runs = []
    for name, case in CASES.items():
        opening = case["settings"].get("gate.time", "0 s")
        whole = sum(float(text.split()[0]) for text in (opening, case["settings"]["run.end"]))
        runs.append((study.PROJECT / "cases" / f"{name}.toml", options.out / name,
                     case["settings"] | share | {"output.series": f"{whole / 1000:g} s",
                                                     "output.snapshots": f"{whole / 100:g} s"}))
    return runs


def measure(options):
    found = {}
    for name, case in CASES.items():
        run = talus.Run(options.out / name)
        first, last = run.snapshots[0], run.snapshots[-1]
        slack = POLYGON * float(case["settings"]["bed.spacing"].split()[0])
        steps = int(run.series["step"][-1])
        mass = run.case["grains"]["density"] * run.case["bed"]["packing"] * run.case["bed"]["spacing"] ** 3
        fed, removed = (round(float(run.summary.get(key, 0)) / float(mass)) for key in ("fed_mass", "removed_mass"))
        found[name] = {
            "lost": len(first.positions) + fed - removed - len(last.positions),
            "outside": sum(int(outside(name, 1e3 * np.asarray(s.positions), slack).sum()) for s in run.snapshots),
            "missing": max(0, REFERENCE["steps"] - steps),
            "steps": steps, "particles": len(first.positions), "fed": fed, "removed": removed, "end": len(last.positions),
            "time": float(run.series["time"][-1]), "snapshots": len(run.snapshots), "cpu": run.summary["cpu_seconds"]}
    return {row: max((f[row] for f in found.values()), key=abs) for row in ("lost", "outside", "missing")}, (found, options.out)


def tell(numbers, found):
    lines = [study.table_of_numbers(REFERENCE, numbers, digits=0).rstrip(), "",
             "| case | steps | simulated, s | particles at the start | fed | removed | at the end | lost | outside | snapshots | "
             "processor time, s |", "|---|---|---|---|---|---|---|---|---|---|---|"]
    for name, f in found[0].items():
        lines.append("| `%s` | %d | %.4g | %d | %d | %d | %d | %d | %d | %d | %.0f |" % (
            name, f["steps"], f["time"], f["particles"], f["fed"], f["removed"], f["end"], f["lost"], f["outside"], f["snapshots"],
            f["cpu"]))
    return "\n".join(lines) + "\n"


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(2, len(found[0]), figsize=(11, 4.4), layout="constrained")
    for column, name in enumerate(found[0]):
        run = talus.Run(found[1] / name)
        for axis, snapshot in zip(axes[:, column], (run.snapshots[len(run.snapshots) // 2 - 2], run.snapshots[-1])):
            x = 1e3 * np.asarray(snapshot.positions)
            axis.plot(x[:, 0], x[:, 2], ".", ms=2)
            axis.set(aspect="equal", title=f"{name}, {snapshot.time:.0f} s", xlabel="x, mm", ylabel="z, mm")
            axis.title.set_size(7)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/long-runs", REFERENCE, cases, measure, tell, draw))
