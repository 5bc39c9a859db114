#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Puts the loads of two silos of beads beside discrete elements: filled in layers, at rest, in flow.

    validation/silo-loads/silos.py [--out results/silo-loads] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import sys
from pathlib import Path

import numpy as np

import beads

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = beads.REFERENCE
OUTLET_HEIGHT, REST, EVERY = 0.06, 0.02, 0.01  # m, s, s
STANDARD = 5.0  # mm, the spacing that is compared with the beads in flow
SILOS = ("flat", "cone")


def variants():
    """Spacing, mm, and seed of each run; the first of a silo has neither disorder nor another spacing."""
    given = REFERENCE["runs"]
    return [(STANDARD, 0)] + [(STANDARD, seed) for seed in given["seeds"]] + [(spacing, 0) for spacing in given["spacings"]]


def folder_of(out, silo, spacing, seed):
    return out / (f"{silo}-h{spacing:g}" + (f"-s{seed}" if seed else ""))


def cases(options):
    for silo in SILOS:
        for spacing, seed in variants():
            disorder = {"bed.disorder": 0.05, "seed": seed} if seed else {}
            yield (HERE / f"beads-{silo}.toml", folder_of(options.out, silo, spacing, seed),
                   {"bed.spacing": f"{spacing:.8g} mm", **disorder})


def read_beads(silo):
    """Means over the seeds by the lower edge of each band, and their number."""
    table = np.genfromtxt(HERE / "data" / f"{silo}.csv", delimiter=",", names=True)
    lows = np.unique(table["low"])
    return {low: {name: table[name][table["low"] == low].mean() for name in beads.COLUMNS} for low in lows}, \
        len(np.unique(table["seed"]))


def loads_of(folder, edges):
    """Normal and shear stress of the bands between the edges, Pa, and the balance of the weight at rest."""
    run = talus.Run(folder)
    time = run.series["time"] - run.gate_time
    table = run.table("wall_loads")
    names = [name.removeprefix("normal_impulse_") for name in run.series if name.startswith("normal_impulse_")]
    first, last = REFERENCE["flow"]["window"]
    width = REFERENCE["flow"]["peak_window"]
    starts = np.arange(0, last - width + 0.5 * EVERY, EVERY)

    def rate(curve, begin, end):
        return (np.interp(end, time, curve) - np.interp(begin, time, curve)) / (end - begin)

    found = []
    for low, high in zip(edges[:-1], edges[1:]):
        # Other spacings have other bands: their forces, by the share of each that lies between the edges.
        begin, end = table["low"] - OUTLET_HEIGHT, table["high"] - OUTLET_HEIGHT
        share = np.clip((np.minimum(end, high) - np.maximum(begin, low)) / np.maximum(end - begin, 1e-9), 0, 1)
        rows = [k for k in range(len(names)) if share[k] > 1e-3]
        area = sum(share[k] * table["area"][k] for k in rows)
        normal, shear = (sum(share[k] * run.series[f"{kind}_impulse_{names[k]}"] for k in rows) / area
                         for kind in ("normal", "shear"))
        found.append({"pressure_at_rest": rate(normal, -REST, 0), "shear_at_rest": rate(shear, -REST, 0),
                      "pressure_in_flow": rate(normal, first, last), "shear_in_flow": rate(shear, first, last),
                      "peak": max(rate(normal, start, start + width) for start in starts)})
    return found, run.summary["weight_balance_error_at_rest"]


def measure(options):
    numbers, found = {}, {}
    for silo in SILOS:
        edges = REFERENCE[silo]["edges"]
        reference, seeds = read_beads(silo)
        transition = REFERENCE[silo].get("apart", 0)
        low, high = REFERENCE[silo]["counted"]
        bands = [k for k in range(len(edges) - 1) if edges[k] >= low - 1e-9 and edges[k + 1] <= high + 1e-9
                 and not (transition and edges[k] < transition + 0.01 - 1e-9 and edges[k + 1] > transition - 0.01 + 1e-9)]
        runs = {(spacing, seed): loads_of(folder_of(options.out, silo, spacing, seed), edges) for spacing, seed in variants()}
        of_beads = [reference[min(reference, key=lambda at: abs(at - edges[k]))] for k in range(len(edges) - 1)]

        def worst(name):
            return max((runs[STANDARD, 0][0][k][name] / of_beads[k][name] - 1 for k in bands), key=abs)

        def scatter(which):
            rest = np.array([[runs[v][0][k]["pressure_at_rest"] for k in bands] for v in which])
            return np.abs(rest / rest.mean(axis=0) - 1).max()

        numbers |= {f"{silo}_rest": worst("pressure_at_rest"), f"{silo}_flow": worst("pressure_in_flow"), f"{silo}_peak": worst("peak"),
                    f"{silo}_seeds": scatter([v for v in runs if v[0] == STANDARD]),
                    f"{silo}_spacings": scatter([v for v in runs if not v[1]]),
                    f"{silo}_balance": max((balance for _, balance in runs.values()), key=abs)}
        found[silo] = {"edges": edges, "bands": bands, "runs": runs, "beads": of_beads, "seeds": seeds}
    return numbers, found


def tell(numbers, found):
    lines = [study.table_of_numbers(REFERENCE, numbers)]
    for silo, given in found.items():
        lines += [f"{silo}, pressure in Pa (shear over pressure), Talus | beads:", "",
                  "| height, mm | at rest | | in flow | | peak | |", "|---|---|---|---|---|---|---|"]
        ours = given["runs"][STANDARD, 0][0]
        for k in range(len(given["edges"]) - 1):
            a, b = ours[k], given["beads"][k]
            cells = [f"{r[f'pressure_{when}']:.0f} ({r[f'shear_{when}'] / r[f'pressure_{when}']:.2f})"
                     for when in ("at_rest", "in_flow") for r in (a, b)] + [f"{a['peak']:.0f}", f"{b['peak']:.0f}"]
            mark = "" if k in given["bands"] else " *"
            lines.append(f"| {1e3 * given['edges'][k]:.0f} to {1e3 * given['edges'][k + 1]:.0f}{mark} | " + " | ".join(cells) + " |")
        lines += ["", "*: not counted.", ""]
    return "\n".join(lines) + "\n"


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(1, 4, figsize=(12, 4), layout="constrained")
    for n, (silo, given) in enumerate(found.items()):
        middle = 500 * (np.array(given["edges"][:-1]) + np.array(given["edges"][1:]))
        for axis, name, title in ((axes[2 * n], "at_rest", "at rest"), (axes[2 * n + 1], "in_flow", "in flow")):
            for variant, (ours, _) in given["runs"].items():
                axis.plot([1e-3 * r[f"pressure_{name}"] for r in ours], middle, "-", lw=2 if variant == (STANDARD, 0) else 0.7,
                          color="C0" if variant == (STANDARD, 0) else "C7",
                          label={(STANDARD, 0): "Talus", variants()[1]: "other seeds, spacings"}.get(variant))
            axis.plot([1e-3 * r[f"pressure_{name}"] for r in given["beads"]], middle, "ko", ms=5, label="discrete elements")
            if name == "in_flow":
                axis.plot([1e-3 * r["peak"] for r in given["runs"][STANDARD, 0][0]], middle, "C0--", lw=1, label="peak, Talus")
                axis.plot([1e-3 * r["peak"] for r in given["beads"]], middle, "k+", label="peak, discrete elements")
            axis.set(title=f"{'flat bottom' if silo == 'flat' else 'cone of 20°'}, {title}", xlabel="normal pressure on the wall, kPa")
            axis.set_xlim(left=0)
    axes[0].set_ylabel("above the outlet, mm")
    axes[0].legend(frameon=False, fontsize=8)
    axes[3].legend(frameon=False, fontsize=8)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/silo-loads", REFERENCE, cases, measure, tell, draw))
