#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs a silo of plant size with grains of several stiffnesses and viscosities and compares its discharge.

    validation/plant/softness.py [--out results/plant] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = study.rows_of(HERE, "softness-", "line", "loss")
RUNS = [("draft", 0.025), ("design", 0.025), ("design", 0.1), ("reference", 0.1)]
OVER_WEIGHT = {"draft": 62.5, "design": 250, "reference": 1000}
OUTLET, HEIGHT, GRAVITY = 0.5, 1.0, 9.81  # m, m, m/s2
REGION, WINDOW = (0.2, 1.5), (5.0, 15.0)  # above the outlet, m; after the opening, s


def folder_of(out, accuracy, alpha):
    return out / f"{accuracy}-{alpha:g}"


def cases(options):
    for accuracy, alpha in RUNS:
        yield (HERE / "silo.toml", folder_of(options.out, accuracy, alpha),
               {"accuracy": accuracy, "integration.pair_precision": "double", "levels.count": 0,
                "sph.viscosity_alpha": alpha})


def packing(run):
    means = []
    for snapshot in run.snapshots:
        if not WINDOW[0] <= snapshot.time - run.gate_time <= WINDOW[1]:
            continue
        z = snapshot.positions[:, 2] - HEIGHT
        means.append(snapshot["packing"][(z > REGION[0]) & (z < REGION[1])].mean())
    return float(np.mean(means))


def viscosity_of(run):
    """v of reference.toml."""
    case = run.case
    law, density = case["law"]["critical-state"], case["grains"]["density"] * case["bed"]["packing"]
    sound = np.sqrt((law["bulk_modulus"] + 4 / 3 * law["shear_modulus"]) / density)
    h = case["sph"]["smoothing_ratio"] * case["bed"]["spacing"]
    return case["sph"]["viscosity_alpha"] * sound * h / (OUTLET * np.sqrt(GRAVITY * OUTLET))


def measure(options):
    """The rows by name, and by (accuracy, alpha) v, rate, its error, packing, steps, seconds."""
    found = {}
    for accuracy, alpha in RUNS:
        run = talus.Run(folder_of(options.out, accuracy, alpha))
        q = run.summary
        found[accuracy, alpha] = {"v": viscosity_of(run), "rate": q["discharge_steady"],
                                  "error": q["discharge_steady_error"], "packing": packing(run), "steps": q["steps"],
                                  "seconds": q["cpu_seconds"]}
    v, rate = (np.array([f[name] for f in found.values()]) for name in ("v", "rate"))
    slope, q0 = np.polyfit(v, rate, 1)
    soft, stiff = found["draft", 0.025], found["design", 0.025]
    return {"softness-rate": soft["rate"] / stiff["rate"] - 1, "softness-packing": soft["packing"] / stiff["packing"] - 1,
            "line": np.abs(rate - q0 - slope * v).max() / q0, "loss": -slope / q0}, {"runs": found, "q0": q0, "slope": slope}


def tell(numbers, found):
    lines = ["| modulus over weight | `sph.viscosity_alpha` | v | rate, kg/s | line | packing | steps | processor time, s |",
             "|---|---|---|---|---|---|---|---|"]
    for (accuracy, alpha), f in found["runs"].items():
        lines.append(f"| {OVER_WEIGHT[accuracy]:g} | {alpha:g} | {f['v']:.3f} | {f['rate']:.1f} ± {f['error']:.1f} | "
                     f"{found['q0'] + found['slope'] * f['v']:.1f} | {f['packing']:.4f} | {f['steps']:.0f} | "
                     f"{f['seconds']:.0f} |")
    return ("\n".join(lines) + f"\n\nWithout viscosity: {found['q0']:.1f} kg/s.\n\n" +
            study.table_of_numbers(REFERENCE, numbers))


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.4), layout="constrained")
    for accuracy, mark in (("draft", "o"), ("design", "s"), ("reference", "^")):
        of = [f for (name, _), f in found["runs"].items() if name == accuracy]
        axes.errorbar([f["v"] for f in of], [f["rate"] for f in of], [f["error"] for f in of], fmt=mark, mfc="none",
                      label=f"modulus {OVER_WEIGHT[accuracy]:g} times the weight")
    v = np.array([0, max(f["v"] for f in found["runs"].values())])
    axes.plot(v, found["q0"] + found["slope"] * v, color="0.5", lw=1)
    axes.set(xlabel="viscosity at the outlet, α c h/(D √(g D))", ylabel="discharge, kg/s")
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/plant", REFERENCE, cases, measure, tell, draw))
