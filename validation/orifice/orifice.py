#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the outlets, fits Beverloo's law and draws it.

    validation/orifice/orifice.py [--out results/orifice] [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
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
DENSITY, GRAVITY, GRAIN, K, C = 1500.0, 9.81, 0.2e-3, 1.5, 0.58  # SI
QUARTERS = 4
MEAN = 20e-3  # s
SETS = ("coarse", "fine")  # the cheap ones first


def folder_of(out, outlet, spacing):
    return out / f"D{outlet:g}-h{spacing:g}"


def cases(options):
    for spacing, outlet in ((REFERENCE[name]["spacing"], outlet) for name in SETS for outlet in REFERENCE[name]["outlets"]):
        radius = f"{outlet / 2:g} mm"
        yield (HERE / "orifice.toml", folder_of(options.out, outlet, spacing),
               {"vessel.2.hole": radius, "vessel.3.radius": radius, "bed.spacing": f"{spacing:.9g} mm",
                "title": f"Discharge through a round hole of {outlet:g} mm"})


def rates(folder, window):
    """Means of the discharge of the whole vessel over 20 ms within a window, kg/s, and their middles, s."""
    run = talus.Run(folder)
    time, rate = run.series["time"] - run.gate_time, run.series["discharge_rate"]
    passed = np.concatenate([[0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
    begin, end = window
    edges = np.linspace(begin, end, round((end - begin) / MEAN) + 1)
    if time[-1] < end:
        sys.exit(f"{folder}: ends at {time[-1]:.3f} s, before the window does")
    return QUARTERS * np.diff(np.interp(edges, time, passed)) / np.diff(edges), 0.5 * (edges[1:] + edges[:-1])


def constants(discharge, diameter):
    return discharge / (DENSITY * np.sqrt(GRAVITY) * (diameter - K * GRAIN) ** 2.5)


def exponent(discharge, diameter):
    return np.polyfit(np.log(diameter - K * GRAIN), np.log(discharge), 1)[0]


def lost(discharge, diameter):
    """The width that the edges take, m: Q^(2/5) is a line in D, which meets 0 there."""
    slope, intercept = np.polyfit(diameter, discharge ** 0.4, 1)
    return -intercept / slope


def by_set(out, window):
    """By set ("coarse", "fine", "extrapolated") D, Q, its uncertainty, C."""
    found = {}
    for name in SETS:
        chosen = REFERENCE[name]
        diameter = 1e-3 * np.array(chosen["outlets"], dtype=float)
        means = [rates(folder_of(out, outlet, chosen["spacing"]), window) for outlet in chosen["outlets"]]
        discharge = np.array([m.mean() for m, _ in means])
        length = window[1] - window[0]
        found[name] = {"D": diameter, "Q": discharge, "C": constants(discharge, diameter),
                       "error": np.array([2 * m.std(ddof=1) / np.sqrt(len(m)) for m, _ in means]),
                       "drift": np.array([np.polyfit(t, m, 1)[0] * length / m.mean() for m, t in means])}
    coarse, fine = found["coarse"], found["fine"]
    both = np.array([d for d in fine["D"] if d in coarse["D"]])
    q = {name: np.array([found[name]["Q"][list(found[name]["D"]).index(d)] for d in both]) for name in SETS}
    ratio = REFERENCE["coarse"]["spacing"] / REFERENCE["fine"]["spacing"]
    extrapolated = q["fine"] + (q["fine"] - q["coarse"]) / (ratio - 1)
    found["extrapolated"] = {"D": both, "Q": extrapolated, "C": constants(extrapolated, both)}
    return found


def rows_of(found):
    fine, extrapolated = found["fine"], found["extrapolated"]
    c = fine["C"]
    return {"exponent": exponent(fine["Q"], fine["D"]),
            "exponent-extrapolated": exponent(extrapolated["Q"], extrapolated["D"]),
            "constant": c.mean(), "constant-extrapolated": extrapolated["C"].mean(),
            "scatter": np.abs(c / c.mean() - 1).max(), "plateau": np.abs(fine["drift"]).max()}


def measure(options):
    """The rows by name, and what they are made of, by_set() of the window."""
    found = by_set(options.out, REFERENCE["window"])
    early = rows_of(by_set(options.out, REFERENCE["early_window"]))
    return rows_of(found) | {f"{name}-early": value for name, value in early.items()}, found


def tell(numbers, found):
    lines = ["| D | spacing | particles across | Q, kg/s | Beverloo | C |", "|---|---|---|---|---|---|"]
    for name, spacing in (("fine", REFERENCE["fine"]["spacing"]), ("coarse", REFERENCE["coarse"]["spacing"]),
                          ("extrapolated", 0)):
        of = found[name]
        for n, d in enumerate(of["D"]):
            hand = C * DENSITY * np.sqrt(GRAVITY) * (d - K * GRAIN) ** 2.5
            error = f" ± {of['error'][n]:.3f}" if "error" in of else ""
            lines.append(f"| {1e3 * d:.0f} mm | " + (f"{spacing:g} mm | {1e3 * d / spacing:.3g}" if spacing else "none | ")
                         + f" | {of['Q'][n]:.3f}{error} | {hand:.3f} | {of['C'][n]:.3f} |")
    fine = found["fine"]
    return ("\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, numbers) +
            f"\nWidth that the edges take: {1e3 * lost(fine['Q'], fine['D']):.2f} mm.\n")


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.6), layout="constrained")
    diameter = found["fine"]["D"]
    line = np.linspace(0.95 * diameter[0], 1.05 * diameter[-1], 50)
    for c, style in ((0.55, ":"), (0.58, "-"), (0.65, ":")):
        axes.loglog(1e3 * line, c * DENSITY * np.sqrt(GRAVITY) * (line - K * GRAIN) ** 2.5, style, color="0.5",
                    label="Beverloo, C = 0.58 (0.55, 0.65)" if style == "-" else None)
    for name, mark in (("fine", "o"), ("coarse", "s")):
        axes.errorbar(1e3 * found[name]["D"], found[name]["Q"], found[name]["error"], fmt=mark, mfc="none",
                      label="spacing %.3g mm" % REFERENCE[name]["spacing"])
    axes.loglog(1e3 * found["extrapolated"]["D"], found["extrapolated"]["Q"], "k+", ms=9, label="extrapolated")
    axes.set(xlabel="D, mm", ylabel="Q, kg/s")
    axes.set_xticks(1e3 * diameter, [f"{1e3 * d:.0f}" for d in diameter])
    axes.set_xticks([], minor=True)
    axes.set_yticks([0.4, 0.6, 0.8, 1, 1.4], ["0.4", "0.6", "0.8", "1", "1.4"])
    axes.set_yticks([], minor=True)
    axes.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/orifice", REFERENCE, cases, measure, tell, draw))
