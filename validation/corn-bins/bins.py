#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Fills two bins with maize and puts the pressure on their walls beside what was measured.

    validation/corn-bins/bins.py [--out results/corn-bins] [--threads N] [--markdown FILE] [--picture FILE]

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
BINS = list(zip(REFERENCE["bins"]["diameter"], REFERENCE["bins"]["depth"]))
SPACINGS = REFERENCE["bins"]["spacing"]  # mm
MEASURED = [REFERENCE[name]["value"] for name in ("wide", "narrow")]  # kPa
FLOOR, ROOM, EDGE, LAYER, MEAN = 1.0, 0.4, 0.85, 1.5, 0.1  # m, m, radii, spacings, s
MARKS = "os^"


def folder_of(out, diameter, spacing):
    return out / f"D{diameter:g}-h{spacing:g}"


def cases(options):
    for diameter, depth in BINS:
        radius, width = f"{diameter / 2:g} m", f"{diameter / 2 + ROOM:g} m"
        for spacing in SPACINGS:
            yield (HERE / "bin.toml", folder_of(options.out, diameter, spacing),
                   {"title": f"A bin of {diameter:g} m with {depth:g} m of maize", "box.width": width, "box.depth": width,
                    "box.height": f"{FLOOR + depth + 2:g} m", "vessel.1.radius": radius, "vessel.2.radius": radius,
                    "vessel.1.top": f"{FLOOR + depth + 1.6:g} m", "bed.height": f"{depth:g} m",
                    "bed.spacing": f"{spacing:g} mm"})


def measure_bin(folder, diameter, spacing):
    run = talus.Run(folder)
    bands = run.table("wall_loads")
    wall = np.flatnonzero(bands["patch"] == 1)
    last = run.snapshots[-1]
    x = np.asarray(last.positions)
    lowest = x[:, 2] < FLOOR + LAYER * spacing
    beyond = np.hypot(x[:, 0], x[:, 1]) > EDGE * diameter / 2
    stress = np.asarray(last["stress_zz"])
    time = run.series["time"]

    def force(column):
        return (run.series[column][-1] - np.interp(time[-1] - MEAN, time, run.series[column])) / MEAN

    upward = -force("impulse_wall_z") - force("impulse_floor_of_it_z")
    return {"z": 0.5 * (bands["low"][wall] + bands["high"][wall]) - FLOOR, "band": bands["high"][wall][0] - bands["low"][wall][0],
            "pressure": 1e-3 * bands["pressure_at_rest"][wall],
            "shear": 1e-3 * bands["shear_at_rest"][wall], "hand": 1e-3 * bands["pressure_at_rest_by_hand"][wall],
            "edge": stress[lowest & beyond].mean() / stress[lowest & ~beyond].mean(),
            "balance": upward / -force("impulse_gravity_z") - 1, "particles": len(x)}


def measure(options):
    found = [[measure_bin(folder_of(options.out, diameter, spacing), diameter, 1e-3 * spacing) for spacing in SPACINGS]
             for diameter, _ in BINS]
    runs = sum(found, [])
    largest = [[run["pressure"].max() for run in runs_of_bin] for runs_of_bin in found]
    scatter = [np.abs(np.array(of_bin) / np.mean(of_bin) - 1).max() for of_bin in largest]
    beside_janssen = []
    for (_, depth), of_bin in zip(BINS, found):
        for spacing, run in zip(SPACINGS, of_bin):
            counted = (run["z"] > run["band"] / 2 + 2e-3 * spacing) & (run["z"] + run["band"] / 2 < depth)
            beside_janssen.append(np.abs(run["pressure"] - run["hand"])[counted].max() / run["hand"][counted].max())
    return {"scatter": max(scatter), "janssen": max(beside_janssen), "wide": np.mean(largest[0]), "narrow": np.mean(largest[1]), "edge": max(run["edge"] for run in runs),
            "balance": max((run["balance"] for run in runs), key=abs)}, found


def tell(numbers, found):
    lines = [study.table_of_numbers(REFERENCE, numbers),
             "| bin | spacing | particles in a quarter | largest pressure, kPa | Janssen there, kPa | friction of the wall | floor, "
             "edge over middle |", "|---|---|---|---|---|---|---|"]
    for (diameter, depth), runs in zip(BINS, found):
        for spacing, run in zip(SPACINGS, runs):
            top = run["pressure"].argmax()
            lines.append("| %g m, %g m deep | %g mm | %d | %.1f | %.1f | %.2f | %.2f |"
                         % (diameter, depth, spacing, run["particles"], run["pressure"][top], run["hand"][top],
                            run["shear"].sum() / run["pressure"].sum(), run["edge"]))
    return "\n".join(lines) + "\n"


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(8, 3.8), layout="constrained", sharey=True)
    for axis, (diameter, depth), runs, measured in zip(axes, BINS, found, MEASURED):
        for spacing, run, mark, colour in zip(SPACINGS, runs, MARKS, ("C0", "C1", "C2")):
            filled = run["z"] < depth
            axis.plot(run["pressure"][filled], run["z"][filled], mark, ms=4, color=colour, label=f"{spacing:g} mm")
            axis.plot(run["hand"][filled], run["z"][filled], "-", lw=1, color=colour)
        axis.axvline(measured, color="C3", ls="--", lw=1, label="largest measured")
        axis.set(title=f"{diameter:g} m wide, {depth:g} m deep", xlabel="pressure on the wall, kPa", xlim=(0, 36))
    axes[0].set(ylabel="above the floor, m")
    axes[0].legend(frameon=False, title="lines: Janssen")
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/corn-bins", REFERENCE, cases, measure, tell, draw))
