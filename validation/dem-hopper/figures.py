#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""The hopper grain by grain beside Talus at equal times, and the page of the comparison.

    build/talus reproduce dem-hopper --variant vacuum --variant rolling --out RUNS      draws them at its end
    python3 validation/dem-hopper/figures.py RUNS                                       draws them again
"""
import csv
import sys
from collections import defaultdict
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "yuu2011")]

from study import main  # noqa: E402  (it also finds the package talus)

import numpy as np  # noqa: E402
import talus.draw  # noqa: E402
from hopper import Hopper  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

MM = 1e-3
DEPTH = 5e-3  # m, for which discharges are given
CELL = 2.0    # mm, of the DEM reference's pictures
FASTEST = 1.5  # m/s, of the colours
PROFILE, HEIGHTS = 0.2, (105, 120, 140, 160)  # s, mm


def read(name):
    """A table of data/ as dictionaries a row, numbers where they are numbers."""
    def number(text):
        try:
            return float(text)
        except ValueError:
            return text
    with open(HERE / "data" / name, encoding="utf-8") as file:
        return [{key: number(text) for key, text in row.items()} for row in csv.DictReader(file)]


def by(rows, *keys):
    groups = defaultdict(list)
    for row in rows:
        groups[tuple(row[key] for key in keys)].append(row)
    return groups


def column(rows, key):
    return np.array([row[key] for row in rows], float)


def vessel(ax):
    for line in (((0, 190), (0, 0), (100, 0), (100, 190)), ((0, 100), (30, 100)), ((70, 100), (100, 100))):
        ax.plot(*zip(*line), color=talus.draw.INK, linewidth=0.9)
    ax.set(aspect="equal", xlim=(-1, 101), ylim=(-1, 190))


def referee_picture(ax, rows):
    """Cells of 2 mm by the mean speed of their beads; the sparser, the paler."""
    speed, packing = (np.full((95, 50), np.nan) for _ in range(2))
    for row in rows:
        if row["z_mm"] < 190:
            place = int(row["z_mm"] // CELL), int(row["x_mm"] // CELL)
            speed[place], packing[place] = row["speed_m_per_s"], row["packing"]
    return ax.pcolormesh(np.arange(51) * CELL, np.arange(96) * CELL, speed, vmin=0, vmax=FASTEST, rasterized=True,
                         alpha=np.clip(np.nan_to_num(packing) / 0.4, 0, 1))


def pictures(hopper, album):
    surfaces = by(read("surfaces.csv"), "run", "time_s")
    for path in sorted((HERE / "data").glob("picture-*.csv")):
        referee = path.stem.removeprefix("picture-")
        if ("-r" in referee) != (hopper.variant == "rolling"):
            continue  # beads with rolling friction beside the run that has their friction
        shown = [(time, rows) for (time,), rows in by(read(path.name), "time_s").items() if hopper.reaches(time)]
        if not shown:
            continue
        figure, axes = plt.subplots(2, len(shown), figsize=(1.75 * len(shown), 6.4), sharex=True, sharey=True, squeeze=False)
        for (time, rows), above, below in zip(shown, *axes):
            snapshot = hopper.at(time)
            speed = np.linalg.norm(snapshot["velocity"], axis=1)
            mesh = referee_picture(above, rows)
            talus.draw.particles(below, snapshot, speed, radius=hopper.spacing / 2, unit=MM, limits=(0, FASTEST))
            heights = surfaces.get((referee, time), [])
            for key in ("hopper_mm", "bin_mm"):
                below.plot(column(heights, "x_mm"), column(heights, key), color="#d55e00", linewidth=1.2)
            above.set_title(f"$t$ = {time:.2f} s")
            for ax in (above, below):
                vessel(ax)
        axes[0, 0].set_ylabel(f"beads ({referee}): $z$ (mm)")
        axes[1, 0].set_ylabel(f"Talus ({hopper.variant}): $z$ (mm)")
        figure.colorbar(mesh, ax=list(axes.flat), label="speed (m/s)", location="bottom", shrink=0.5, aspect=40)
        album.add(f"side_by_side_{referee}_{hopper.variant}.png", figure, f"Beads and Talus at equal times: {hopper.variant}",
                  f"Above the beads of the run {referee}, means over cells of 2 mm; below Talus's particles. Orange: the "
                  "beads' surfaces.")


def kinds_of_runs():
    """Rolling friction and diameter, mm, of each run of beads."""
    return {row["run"]: (row["rolling"], row["diameter_mm"]) for row in read("numbers.csv")}


def read_in_order(name):
    """A table of data/, runs without rolling friction first, and of these the coarsest."""
    kinds = kinds_of_runs()
    return sorted(read(name), key=lambda row: (kinds[row["run"]][0], -kinds[row["run"]][1]))


def styles_of(rows):
    """A shade for each size of the beads, a dash for those with rolling friction; seeds look alike, the first has a name."""
    kinds = kinds_of_runs()
    sizes = sorted({diameter for _, diameter in kinds.values()})
    styles, named = {}, set()
    for run in dict.fromkeys(row["run"] for row in rows):
        rolling, diameter = kinds[run]
        name = f"beads, {diameter:g} mm" + (", rolling" if rolling else "")
        styles[run] = {"color": plt.cm.Greys_r(0.75 * sizes.index(diameter) / len(sizes)),
                       "linestyle": "--" if rolling else "-", "linewidth": 0.9,
                       "label": None if name in named else name}
        named.add(name)
    return styles


def discharge(hoppers, album):
    rows = read_in_order("discharge.csv")
    styles = styles_of(rows)
    figure, ax = plt.subplots(figsize=(5.4, 3.4))
    for (run,), points in by(rows, "run").items():
        ax.plot(column(points, "time_s"), column(points, "rate_kg_per_s"), **styles[run])
    for hopper in hoppers:
        time, rate = hopper.means("discharge_rate", 20e-3)
        ax.plot(time, rate * DEPTH / float(hopper.run.case["box"]["depth"]), color=hopper.colour,
                label=f"Talus, {hopper.variant}")
    ax.set(xlabel="$t$ (s)", ylabel="discharge $Q$ (kg/s)", xlim=(0, 0.6), ylim=(0, None))
    ax.legend(fontsize=7)
    album.add("discharge.png", figure, "Discharge", "20 ms means, of 5 mm of depth. Larger beads pass more slowly (Beverloo).")


def velocity(hoppers, album):
    rows = [row for row in read_in_order("profiles.csv") if row["time_s"] == PROFILE]
    styles = styles_of(rows)
    figure, axes = plt.subplots(1, len(HEIGHTS), figsize=(7.6, 2.9), sharey=True)
    for ax, height in zip(axes, HEIGHTS):
        for (run,), points in by((row for row in rows if row["z_mm"] == height), "run").items():
            ax.plot(column(points, "x_mm"), -column(points, "velocity_m_per_s"), **styles[run])
        for hopper in hoppers:
            snapshot = hopper.at(PROFILE)
            if snapshot is None:
                continue
            there = abs(snapshot.positions[:, 2] - height * MM) < 3 * MM
            cells = np.digitize(snapshot.positions[there, 0] / MM, np.arange(4, 100, 4))
            known, fall = np.unique(cells), -snapshot["velocity"][there, 2]
            ax.plot(4 * known + 2, [fall[cells == c].mean() for c in known], color=hopper.colour,
                    label=f"Talus, {hopper.variant}")
        ax.set(title=f"$z$ = {height} mm", xlabel="$x$ (mm)", xlim=(0, 100))
    axes[0].set_ylabel(f"$-u_z$ at {PROFILE} s (m/s)")
    axes[-1].legend(fontsize=6, loc="center left", bbox_to_anchor=(1.02, 0.5))
    album.add("velocity.png", figure, f"Velocity in the hopper at {PROFILE} s",
              "Means over cells of 4 mm by 6 mm; of the beads also over 20 ms.")


def draw(study, album):
    ensembles = [ensemble for case in ("hopper", "section", "rolling") for ensemble in study.of_case(case)]
    hoppers = [Hopper(ensemble, number) for number, ensemble in enumerate(ensembles)]
    for hopper in hoppers:
        pictures(hopper, album)
    discharge(hoppers, album)
    velocity(hoppers, album)


if __name__ == "__main__":
    main(draw, __file__)
