# SPDX-License-Identifier: Apache-2.0
"""Curves of runs, ensembles and material points as PNG files.

    python3 -m talus.charts run RUN FOLDER               a run's curves: discharge, slope, wall loads, front speed
    python3 -m talus.charts runs RUN OTHER PICTURE       the series of two runs over each other
    python3 -m talus.charts ensemble FOLDER GROUPS [QUANTITIES]   of an ensemble quantities against the varied key, and
                                                         bands and histograms of its groups; names separated by commas
    python3 -m talus.charts law FOLDER                   the path of a material point, and its law's fitted functions

The commands start the last three. Each function returns the paths of what it drew.
"""
import csv
import math
import re
import sys
from pathlib import Path

import matplotlib
import numpy as np

from talus import draw
from talus.program import Sweep
from talus.run import Run
from talus.table import Table

MAX_PANELS = 12  # of a sweep whose quantities are not named
NORMAL, SHEAR = ("xx", "yy", "zz"), ("xy", "yz", "zx")


def panels(count, columns=None):
    """A figure and its axes, row by row: two columns, three from five panels on."""
    from matplotlib import pyplot
    columns = columns or min(count, 3 if count >= 5 else 2)
    rows = math.ceil(count / columns)
    figure, axes = pyplot.subplots(rows, columns, squeeze=False, figsize=({1: 4.8, 2: 7.2}.get(columns, 8.6),
                                                                         0.2 + rows * {1: 3.4, 2: 2.7}.get(columns, 2.3)))
    for ax in axes.flat[count:]:
        ax.set_axis_off()
    for ax in axes.flat[:count]:
        ax.locator_params(nbins=5)
    return figure, list(axes.flat[:count])


def save(figure, path, title=""):
    """Writes a figure and returns its path. The title is plain text, a dollar sign too."""
    if title:
        figure.suptitle(title.replace("$", r"\$"), fontsize=9, x=0.01, ha="left")
    path = Path(path)
    path.parent.mkdir(parents=True, exist_ok=True)
    draw.save(figure, path)
    return path


# ------------------------------------------------------------------------------------------------------------- one run

def run(folder, out):
    """The curves of a run that are there, in the folder `out`."""
    of, out, drawn = Run(folder), Path(out), []
    title = str(of.case.get("title", ""))
    tables = {path.stem: Table(path) for path in sorted((of.folder / "analysis").glob("*.csv"))}

    def against_time(table, column, name, label=None, level=math.nan):
        if table not in tables or column not in tables[table]:
            return
        time, value = tables[table]["time"], tables[table][column]
        later = np.asarray(time) >= 0
        if not np.isfinite(value[later]).any():
            return
        figure, (ax,) = panels(1)
        ax.plot(time[later], value[later])
        if level > 0:
            ax.axhline(level, color=draw.MUTED, linestyle="--", label="analytical estimate")
            ax.legend()
        ax.set(xlabel=draw.label("time", time.units), ylabel=label or draw.label(column, value.units))
        drawn.append(save(figure, out / name, title))

    estimate = of.summary["discharge_rate_beverloo"] if "discharge_rate_beverloo" in of.summary else math.nan
    against_time("discharge", "discharge_rate", "discharge.png", "discharge (kg/s)", float(estimate))
    against_time("snapshots", "surface_angle_hopper", "surface_angle.png", "slope of the hopper's surface (deg)")
    against_time("front_speed", "front_speed", "front_speed.png")
    if "wall_loads" in tables:
        figure, (ax,) = panels(1)
        wall_loads(ax, tables["wall_loads"])
        drawn.append(save(figure, out / "wall_loads.png", title))
    return drawn


def wall_loads(ax, loads):
    """Pressure on a vessel's walls against height, of each patch by its bands, with the analytical estimates
    and what EN 1991-4 has for filling and discharge (upper characteristic values)."""
    has_height = np.asarray(loads["high"] > loads["low"])
    middle, patches = 500 * (loads["low"] + loads["high"]), np.asarray(loads["patch"])
    for column, text, style in (("pressure_at_rest", "at rest", {"color": "C0", "marker": "o"}),
                                ("pressure_at_rest_by_hand", "analytical estimate: Janssen, Walker",
                                 {"color": "C0", "linestyle": "--"}),
                                ("pressure_in_flow", "in flow", {"color": "C1", "marker": "o"}),
                                ("pressure_in_flow_by_hand", "analytical estimate, in flow",
                                 {"color": "C1", "linestyle": "--"}),
                                ("pressure_in_flow_enstad", "Enstad, in flow", {"color": "C1", "linestyle": ":"}),
                                ("en_pressure_filling", "EN 1991-4, filling", {"color": "C0", "linestyle": "-."}),
                                ("en_pressure_discharge", "EN 1991-4, discharge", {"color": "C1", "linestyle": "-."}),
                                ("pressure_largest", "peak", {"color": draw.MUTED, "linestyle": ":"})):
        if column not in loads:
            continue  # a run of an earlier version
        for patch in np.unique(patches):
            there = has_height & (patches == patch) & np.isfinite(loads[column])
            order = np.argsort(middle[there])
            if there.any():
                alone = {"marker": "d"} if there.sum() == 1 and "marker" not in style else {}  # no line
                ax.plot(loads[column][there][order], middle[there][order], markersize=3, label=text, **style, **alone)
                text = None  # one entry of the legend for all patches
    ax.set(xlabel="pressure on the wall (Pa)", ylabel="z (mm)")
    ax.legend()


def two_runs(first, second, path):
    """The columns that the series of both have, against time."""
    runs = Run(first), Run(second)
    names = [name for name in runs[0].series if name != "time" and name in runs[1].series]
    if not names:
        return []
    figure, axes = panels(len(names))
    for ax, name in zip(axes, names):
        for of, style in zip(runs, ("-", "--")):
            draw.curve(ax, of.series, name, linestyle=style, label=of.folder.resolve().name)
    axes[0].legend()
    return [save(figure, path, " and ".join(of.folder.resolve().name for of in runs))]


# ----------------------------------------------------------------------------------------------------------- ensembles

def ensemble(folder, groups, quantities=""):
    """sweep.png where keys were varied; of each group means with bands of a standard deviation, and histograms of the
    members' quantities."""
    folder = Path(folder)
    drawn = sweep(folder, quantities.split(",") if quantities else ()) if (folder / "sweep.json").is_file() else []
    return drawn + [path for group in groups.split(",") for path in _group(folder / group, group)]


def _group(folder, name):
    drawn = []
    for path in sorted(folder.glob("bands_*.csv")):
        bands = Table(path)
        columns = [column.removesuffix("_mean") for column in bands if column.endswith("_mean")]
        figure, axes = panels(len(columns))
        for ax, column in zip(axes, columns):
            draw.curve(ax, bands, column + "_mean", spread=np.nan_to_num(bands[column + "_deviation"]))
            ax.set_ylabel(draw.label(column, bands.units[column + "_mean"]))
        drawn.append(save(figure, folder / "pictures" / (path.stem + ".png"), name))
    samples = _samples(folder)
    if samples:
        figure, axes = panels(len(samples))
        for ax, (label, sample) in zip(axes, samples.items()):
            histogram(ax, sample, label)
        drawn.append(save(figure, folder / "pictures" / "histograms.png", name))
    return drawn


def _samples(folder):
    """By label: quantities of five members and more that differ."""
    with open(folder / "members.csv", encoding="utf-8", newline="") as file:
        rows = list(csv.DictReader(file))
    samples = {}
    for heading in list(rows[0])[2:]:
        values = np.array([float(row[heading]) for row in rows if row["status"] == "done"])
        values = values[np.isfinite(values)]
        if len(values) >= 5 and values.std() > 0:
            samples[draw.label(*re.fullmatch(r"(.*) \[(.*)\]", heading).groups())] = values
    return samples


def histogram(ax, sample, label):
    """With the Gaussian of the same mean and standard deviation."""
    ax.hist(sample, max(5, int(math.sqrt(len(sample)))), density=True, color="C0", alpha=0.6)
    mean, deviation = sample.mean(), sample.std(ddof=1)
    x = mean + deviation * np.linspace(-3.6, 3.6, 121)
    ax.plot(x, np.exp(-0.5 * ((x - mean) / deviation) ** 2) / (deviation * math.sqrt(2 * math.pi)), "--", color=draw.INK,
            label="Gaussian of the same mean and deviation")
    ax.set(xlabel=label, ylabel="probability density")


def sweep(folder, quantities=()):
    """Quantities (those that differ between groups, twelve at most, if none is named) against the first varied key that is
    a number, a line for each combination of the others; against the groups' numbers if none is."""
    of = Sweep(folder)
    shown = list(quantities) or [name for name in of.quantities if _differs(of[name])][:MAX_PANELS]
    if not shown:
        return []
    x, label, lines = _across(of)
    figure, axes = panels(len(shown))
    for ax, name in zip(axes, shown):
        mean, deviation = of[name], np.nan_to_num(of.deviation(name))
        for line in dict.fromkeys(lines):
            rows = np.array([n for n, of_line in enumerate(lines) if of_line == line])
            rows = rows[np.argsort(x[rows], kind="stable")]
            curve, = ax.plot(x[rows], mean[rows], marker="o", markersize=3, label=line or None)
            if deviation.any():
                ax.fill_between(x[rows], (mean - deviation)[rows], (mean + deviation)[rows], color=curve.get_color(),
                                alpha=0.2, linewidth=0)
        ax.set(xlabel=label, ylabel=draw.label(name, mean.units))
    if any(lines):
        axes[0].legend()
    return [save(figure, of.folder / "sweep.png")]


def _differs(means):
    means = np.asarray(means)[np.isfinite(means)]
    return len(means) > 0 and means.max() - means.min() > 1e-12 * np.abs(means).max()


def _across(of):
    """A value for each group, the axis's name, and which line each belongs to. Values are in the unit of the first as it was
    given: "5 mm" is drawn at 5."""
    numbers = [key for key in of.keys if hasattr(of[key], "units")]
    if not numbers:
        count = np.arange(1, len(of.groups) + 1)
        return count.astype(float), ", ".join(f"{n}: {name}" for n, name in zip(count, of.groups)), [""] * len(count)
    key = numbers[0]
    values, unit = np.asarray(of[key]), of[key].units
    given = re.fullmatch(r"\s*([-+.\deE]+)\s*(.*?)\s*", of.texts(key)[0])
    if given and float(given[1]) != 0 and given[2]:
        values, unit = values * (float(given[1]) / values[0]), given[2]
    others = [other for other in of.keys if other != key]
    texts = {other: of.texts(other) for other in others}
    lines = [", ".join(f"{other} = {texts[other][n]}" for other in others) for n in range(len(of.groups))]
    return values, draw.label(key, unit or "1"), lines


# ------------------------------------------------------------------------------------------------------ material points

def law(folder):
    """The stresses along a strain path, the friction and the pressure; and the functions that a fitted law is made of."""
    folder = Path(folder)
    path = Table(folder / "path.csv")
    strain, stress = ({c: path[f"{of}_{c}"] for c in NORMAL + SHEAR} for of in ("strain", "stress"))

    def most_varied(components):
        return max(components, key=lambda c: np.ptp(strain[c]))

    normal, shear = most_varied(NORMAL), most_varied(SHEAR)
    sheared = np.ptp(strain[shear]) > 0
    figure, axes = panels(4 if sheared else 3, columns=2)
    ax = axes.pop(0)
    k = NORMAL.index(normal)
    for c, style in zip(NORMAL[k:] + NORMAL[:k], ("-", "--", ":")):
        ax.plot(strain[normal], stress[c], style, label=rf"$\tau_{{{c}}}$")
    ax.set(title="normal stress", xlabel=f"$e_{{{normal}}}$", ylabel=r"$\tau$ (Pa)")
    ax.legend()
    if sheared:
        ax = axes.pop(0)
        ax.plot(strain[shear], stress[shear])
        ax.set(title="shear stress", xlabel=f"$e_{{{shear}}}$", ylabel=rf"$\tau_{{{shear}}}$ (Pa)")
    mean = sum(strain[c] for c in NORMAL) / 3
    deviator = np.sqrt(sum((strain[c] - mean) ** 2 for c in NORMAL) + 2 * sum(strain[c] ** 2 for c in SHEAR))
    axes[0].plot(deviator, path["friction"])
    axes[0].set(title="friction", xlabel=r"$|e_{dev}|$", ylabel=r"$|\tau_{dev}| / \sqrt{2}\,p$")
    axes[1].plot(path["packing"], path["pressure"])
    axes[1].set(title="pressure", xlabel="packing", ylabel="$p$ (Pa)")
    for letter, drawn_on in zip("abcd", figure.axes):
        drawn_on.set_title(f"({letter}) {drawn_on.get_title(loc='left')}")
    drawn = [save(figure, folder / "path.png")]
    if (folder / "functions.csv").is_file():
        drawn.append(_fitted_functions(Table(folder / "functions.csv"), folder / "functions.png"))
    return drawn


def _fitted_functions(table, path):
    """A1 to A4 of a fitted law over the printed ones, the friction and the pressure that follow."""
    figure, axes = panels(6, columns=2)
    for ax, (name, title, across) in zip(axes, [(f"A{k}", f"A{k}", "$|Ea|$") for k in (1, 2, 3, 4)] +
                                         [("friction", "friction in simple shear", r"$|e_{dev}|$"),
                                          ("pressure", "pressure", "$e_v$")]):
        for which, style in (("printed", {"color": "C1", "linewidth": 0.9}), ("repaired", {"color": "C0"})):
            if f"{name}_{which}" in table:
                ax.plot(table["strain"], table[f"{name}_{which}"], label=which, **style)
        ax.set(title=title, xlabel=across, ylabel=draw.label(name, table.units[f"{name}_printed"]), xscale="log",
               xlim=(table["strain"][0], table["strain"][-1]))
        if name != "friction":
            ax.set_yscale("log")
    axes[2].set_ylim(bottom=1e3)
    axes[0].legend()
    return save(figure, path)


DRAW_OF = {"run": run, "runs": two_runs, "ensemble": ensemble, "law": law}


def draw_charts(what, *arguments):
    """As the command line: draw_charts("law", FOLDER)."""
    matplotlib.use("Agg")
    with draw.style():
        return DRAW_OF[what](*arguments)


def main(arguments):
    counts = {"run": (2,), "runs": (3,), "ensemble": (2, 3), "law": (1,)}
    what, *rest = arguments or [""]
    if what not in DRAW_OF or len(rest) not in counts[what]:
        print(__doc__, file=sys.stderr)
        return 2
    for path in draw_charts(what, *rest):
        print(path)
    return 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
