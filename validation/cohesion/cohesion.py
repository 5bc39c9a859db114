#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Puts bodies of cohesive grains on the verge of failure, and samples of their law into a shear cell.

    validation/cohesion/cohesion.py [--out results/cohesion] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import math
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
M, DENSITY, GRAVITY = 0.5, 1500.0, 9.81  # SI
CUT, LAYER, BAR = 0.1, 0.04, 0.2         # m
COHESION = M * 236.0                     # Pa, of slope.toml
BASE = {"walls.coefficient": 0.3, "walls.adhesion": 100.0}
SERIES = {"cut": ("cuts", "spacings"), "slope": ("slopes", "layers"), "base": ("bases", "layers"), "bar": ("bars", "bar_spacings")}


def settings_of(name, number):
    """What the case of a series is given for its number."""
    if name == "cut":
        c = DENSITY * GRAVITY * CUT / (number * math.tan(math.radians(60)))
        return {"law.critical-state.tensile_strength": f"{c * math.cos(math.asin(M)) / M:.6g} Pa"}
    if name == "bar":
        return {"law.critical-state.tensile_strength": f"{number * DENSITY * GRAVITY * BAR * (1 + M) / (2 * M):.6g} Pa"}
    tilt = {"gravity.tilt": f"{number:g} deg"}
    if name == "slope":
        return tilt
    return tilt | {"walls.coefficient": BASE["walls.coefficient"], "walls.adhesion": f"{BASE['walls.adhesion']:g} Pa",
                   "law.critical-state.tensile_strength": "5 kPa"}


def folder_of(out, name, spacing, number):
    return out / f"{name}-h{spacing:.3g}-{number:g}"


def cases(options):
    for name, (numbers, spacings) in SERIES.items():
        for spacing in REFERENCE[spacings]:
            for number in REFERENCE[numbers]:
                case = HERE / ("slope.toml" if name == "base" else f"{name}.toml")
                size = {"bed.spacing": f"{spacing:.8g} mm", "box.depth": f"{spacing:.8g} mm"}
                quiet = {"output.report": False, "output.pictures": False}
                yield case, folder_of(options.out, name, spacing, number), settings_of(name, number) | size | quiet


def has_failed(folder, name, spacing):
    run = talus.Run(folder)
    frames = list(run.snapshots)
    last = frames[-1]
    if name in ("slope", "base"):
        return np.linalg.norm(last["velocity"], axis=1).mean() > REFERENCE["speed"]
    first = next(frame for frame in frames if frame.time >= run.gate_time)
    before, after = (np.asarray(frame.positions)[np.argsort(frame["identity"])] for frame in (first, last))
    return np.linalg.norm(after - before, axis=1).max() > REFERENCE["failed"] * 1e-3 * spacing


def number_at_failure(options, name, spacing):
    """The middle between the largest without and the smallest with failure; a bar and a cut fail below a strength and above a
    height."""
    numbers = sorted(REFERENCE[SERIES[name][0]], reverse=name == "bar")
    failed = [bool(has_failed(folder_of(options.out, name, spacing, number), name, spacing)) for number in numbers]
    if failed != sorted(failed) or all(failed) or not any(failed):
        sys.exit(f"{name}, {spacing:g} mm: no number at failure among {list(zip(numbers, failed))}")
    n = failed.index(True)
    return 0.5 * (numbers[n - 1] + numbers[n])


def steepness(beta, friction, cohesion):
    """tan(beta) over what a layer bears, less 1."""
    return math.tan(beta) / (friction + cohesion / (DENSITY * GRAVITY * LAYER * math.cos(beta))) - 1


def shear_cell(options):
    """Rows of flow-function.csv."""
    program = talus.find_program(options.program)
    loads = ",".join(f"{load:g} Pa" for load in REFERENCE["loads"])
    folder = options.out / "shear-cell"
    subprocess.run([program, "shear-cell", HERE / "powder.toml", "--loads", loads, "--out", folder, "--overwrite"], check=True,
                   stdout=subprocess.DEVNULL)
    return np.genfromtxt(folder / "flow-function.csv", delimiter=",", skip_header=1)


def measure(options):
    found = {name: [(spacing, number_at_failure(options, name, spacing)) for spacing in REFERENCE[spacings]]
             for name, (_, spacings) in SERIES.items()}
    slopes = {name: [(spacing, steepness(math.radians(beta), *strength)) for spacing, beta in found[name]]
              for name, strength in (("slope", (M, COHESION)), ("base", tuple(BASE.values())))}
    found["steepness"] = slopes
    table = shear_cell(options)
    strength = 100 + 0.2 * table[:, 0]
    off = {"locus": table[:, 3] / (M * strength), "plane": table[:, 8] / (2 * M * strength / (1 - M)),
           "cylinder": table[:, 9] / (3 * M * strength / (math.sqrt(3) - M))}
    rows = {"cut": found["cut"][-1][1], "slope": slopes["slope"][-1][1], "base": slopes["base"][-1][1],
            "bar": found["bar"][-1][1]}
    return rows | {name: max(ratio - 1, key=abs) for name, ratio in off.items()}, found


def tell(numbers, found):
    lines = ["| at failure | " + " | ".join(f"{n}" for n in ("coarse", "middle", "fine")) + " |", "|---|---|---|---|"]
    for name, says in (("cut", "cut, N"), ("slope", "slope, deg"), ("base", "sliding on its base, deg"), ("bar", "bar")):
        cells = [f"{number:.4g} ({spacing:.3g} mm)" for spacing, number in found[name]]
        lines.append(f"| {says} | " + " | ".join(cells + [""] * (3 - len(cells))) + " |")
    return "\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, numbers)


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(1, 2, figsize=(7, 2.8), layout="constrained")
    axes[0].plot(*zip(*found["cut"]), "o-")
    for bound in (2, 3.83):
        axes[0].axhline(bound, color="0.6", linewidth=0.8)
    axes[0].set(xlabel="spacing (mm)", ylabel="N at failure of a vertical cut", xlim=(0, None), ylim=(0, 5))
    for name, label in (("slope", "rough base"), ("base", "sliding on its base")):
        axes[1].plot(*zip(*found["steepness"][name]), "o-", label=label)
    axes[1].axhline(0, color="0.6", linewidth=0.8)
    axes[1].set(xlabel="spacing (mm)", ylabel="tan β at failure over theory, less 1", xlim=(0, None))
    axes[1].legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/cohesion", REFERENCE, cases, measure, tell, draw))
