#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the four outlets at two spacings, fits Beverloo's law and draws it.

    validation/orifice/orifice.py [--program build/talus] [--out results/orifice] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and
python3-matplotlib."""
import argparse
import csv
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
DENSITY, GRAVITY, GRAIN, K, C = 1500.0, 9.81, 0.2e-3, 1.5, 0.58  # SI
QUARTERS = 4
MEAN = 20e-3  # s


def folder_of(out, outlet, spacing):
    return out / f"D{outlet:g}-h{spacing:g}"


def run(program, out, outlet, spacing):
    folder = folder_of(out, outlet, spacing)
    if (folder / "summary.json").exists():
        return
    radius = f"{outlet / 2:g} mm"
    command = [program, "run", HERE / "orifice.toml", "--set", f"vessel.2.hole={radius}", "--set", f"vessel.3.radius={radius}",
               "--set", f"bed.spacing={spacing:.9g} mm", "--set", f"title=Discharge through a round hole of {outlet:g} mm",
               "--out", folder]
    subprocess.run(command + ["--resume"] if (folder / "manifest.json").exists() else command, check=True)


def rates(folder):
    """Means of the discharge of the whole vessel over 20 ms within the window, kg/s, and their middles, s."""
    with open(folder / "series.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split(" [")[0] for name in rows[0]]
    columns = np.array(rows[1:], dtype=float).T
    time, rate = columns[names.index("time")], columns[names.index("discharge_rate")]
    gate = columns[names.index("gate_time")]
    time = time - gate[-1]
    passed = np.concatenate([[0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
    begin, end = REFERENCE["window"]
    edges = np.linspace(begin, end, round((end - begin) / MEAN) + 1)
    if time[-1] < end:
        sys.exit(f"{folder}: ends at {time[-1]:.3f} s, before the window does")
    return QUARTERS * np.diff(np.interp(edges, time, passed)) / np.diff(edges), 0.5 * (edges[1:] + edges[:-1])


def constants(discharge, diameter):
    return discharge / (DENSITY * np.sqrt(GRAVITY) * (diameter - K * GRAIN) ** 2.5)


def exponent(discharge, diameter):
    return np.polyfit(np.log(diameter - K * GRAIN), np.log(discharge), 1)[0]


def measured(out):
    """All numbers of the study: by set ("coarse", "fine", "extrapolated") D, Q, its uncertainty, C; the rows by name."""
    found = {}
    for name in ("coarse", "fine"):
        chosen = REFERENCE[name]
        diameter = 1e-3 * np.array(chosen["outlets"], dtype=float)
        means = [rates(folder_of(out, outlet, chosen["spacing"])) for outlet in chosen["outlets"]]
        discharge = np.array([m.mean() for m, _ in means])
        error = np.array([2 * m.std(ddof=1) / np.sqrt(len(m)) for m, _ in means])
        drift = np.array([np.polyfit(t, m, 1)[0] * (REFERENCE["window"][1] - REFERENCE["window"][0]) / m.mean() for m, t in means])
        # Q^(2/5) is a line in D; where it meets 0 is the width that the edges take.
        slope, intercept = np.polyfit(diameter, discharge ** 0.4, 1)
        found[name] = {"D": diameter, "Q": discharge, "error": error, "drift": drift, "C": constants(discharge, diameter),
                       "lost": -intercept / slope / (1e-3 * chosen["spacing"])}
    coarse, fine = found["coarse"], found["fine"]
    both = [d for d in fine["D"] if d in coarse["D"]]
    q = {name: np.array([of["Q"][list(of["D"]).index(d)] for d in both]) for name, of in found.items()}
    ratio = REFERENCE["coarse"]["spacing"] / REFERENCE["fine"]["spacing"]
    extrapolated, both = q["fine"] + (q["fine"] - q["coarse"]) / (ratio - 1), np.array(both)
    found["extrapolated"] = {"D": both, "Q": extrapolated, "C": constants(extrapolated, both)}
    c = fine["C"]
    rows = {"exponent": exponent(fine["Q"], fine["D"]), "exponent-extrapolated": exponent(extrapolated, both),
            "constant": c.mean(), "constant-extrapolated": found["extrapolated"]["C"].mean(),
            "scatter": np.abs(c / c.mean() - 1).max(), "plateau": np.abs(fine["drift"]).max()}
    return found, rows


def table(found, rows):
    spacing = {name: REFERENCE[name]["spacing"] for name in ("coarse", "fine")}
    lines = ["| D | particles across | Q, kg/s, spacing %.3g mm | %.3g mm | extrapolated | Beverloo | C (%.3g mm) | C (%.3g mm) | "
             "C extrapolated |" % (spacing["coarse"], spacing["fine"], spacing["coarse"], spacing["fine"]),
             "|---|---|---|---|---|---|---|---|---|"]

    def of(name, column, d, text):
        diameters = list(found[name]["D"])
        if d not in diameters:
            return "-"
        n = diameters.index(d)
        return text % (found[name][column][n], found[name]["error"][n]) if "±" in text else text % found[name][column][n]

    for d in sorted({*found["coarse"]["D"], *found["fine"]["D"]}):
        hand = C * DENSITY * np.sqrt(GRAVITY) * (d - K * GRAIN) ** 2.5
        lines.append("| %.0f mm | %.3g, %.3g | %s | %s | %s | %.3f | %s | %s | %s |"
                     % (1e3 * d, 1e3 * d / spacing["coarse"], 1e3 * d / spacing["fine"], of("coarse", "Q", d, "%.3f ± %.3f"),
                        of("fine", "Q", d, "%.3f ± %.3f"), of("extrapolated", "Q", d, "%.3f"), hand, of("coarse", "C", d, "%.3f"),
                        of("fine", "C", d, "%.3f"), of("extrapolated", "C", d, "%.3f")))
    lines += ["", "| what | computed | value, tolerance | |", "|---|---|---|---|"]
    for name, value in rows.items():
        reference = REFERENCE[name]
        lines.append("| %s | %.3f | %g ± %g | %s |" % (reference["says"], value, reference["value"], reference["tolerance"],
                                                    "met" if is_met(name, value) else "**not met**"))
    coarse = found["coarse"]
    lines += ["", "Spacing %.3g mm: exponent %.3f, C %.3f. Width that the edges take (where the line through Q^(2/5) against D meets "
              "0): %.2f mm with %.3g mm, %.2f mm with %.3g mm."
              % (spacing["coarse"], exponent(coarse["Q"], coarse["D"]), coarse["C"].mean(), coarse["lost"] * spacing["coarse"],
                 spacing["coarse"], found["fine"]["lost"] * spacing["fine"], spacing["fine"])]
    return "\n".join(lines) + "\n"


def is_met(name, value):
    return abs(value - REFERENCE[name]["value"]) <= REFERENCE[name]["tolerance"]


def draw(path, found):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(5, 3.6), layout="constrained")
    diameter = found["coarse"]["D"]
    line = np.linspace(0.95 * diameter[0], 1.05 * diameter[-1], 50)
    for c, style in ((0.55, ":"), (0.58, "-"), (0.65, ":")):
        axes.loglog(1e3 * line, c * DENSITY * np.sqrt(GRAVITY) * (line - K * GRAIN) ** 2.5, style, color="0.5",
                    label="Beverloo, C = 0.58 (0.55, 0.65)" if style == "-" else None)
    for name, mark in (("coarse", "s"), ("fine", "o")):
        axes.errorbar(1e3 * found[name]["D"], found[name]["Q"], found[name]["error"], fmt=mark, mfc="none",
                      label="spacing %.3g mm" % REFERENCE[name]["spacing"])
    axes.loglog(1e3 * found["extrapolated"]["D"], found["extrapolated"]["Q"], "k+", ms=9, label="extrapolated")
    axes.set(xlabel="D, mm", ylabel="Q, kg/s")
    axes.set_xticks(1e3 * diameter, [f"{1e3 * d:.0f}" for d in diameter])
    axes.set_xticks([], minor=True)
    axes.set_yticks([0.4, 0.6, 0.8, 1, 1.4], ["0.4", "0.6", "0.8", "1", "1.4"])
    axes.set_yticks([], minor=True)
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/talus")
    parser.add_argument("--out", type=Path, default=Path("results/orifice"))
    parser.add_argument("--markdown", type=Path)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    for name in ("coarse", "fine"):
        for outlet in REFERENCE[name]["outlets"]:
            run(options.program, options.out, outlet, REFERENCE[name]["spacing"])
    found, rows = measured(options.out)
    text = table(found, rows)
    print(text, end="")
    if options.markdown:
        options.markdown.write_text(text, encoding="utf-8")
    if options.picture:
        draw(options.picture, found)
    return 0 if all(is_met(name, value) for name, value in rows.items()) else 1


if __name__ == "__main__":
    sys.exit(main())
