#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the cylinder and puts its loads beside Janssen's.

    validation/janssen-cylinder/cylinder.py [--program build/talus] [--out results/janssen-cylinder] [--spacing MM] [--markdown FILE]
                                            [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import argparse
import csv
import subprocess
import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
DENSITY, GRAVITY, DIAMETER, FRICTION, FLOOR = 1500.0, 9.81, 0.03, 0.3, 0.01  # SI
AREA = np.pi * DIAMETER ** 2 / 4


def series_of(folder):
    with open(folder / "series.csv", encoding="utf-8") as file:
        rows = list(csv.reader(file))
    names = [name.split(" [")[0] for name in rows[0]]
    return dict(zip(names, np.array(rows[1:], dtype=float).T))


def table_of(path):
    with open(path, encoding="utf-8") as file:
        rows = list(csv.reader(file))
    return dict(zip([name.split(" [")[0] for name in rows[0]], np.array(rows[1:], dtype=float).T))


def measured(folder):
    series, bands = series_of(folder), table_of(folder / "analysis" / "wall_loads.csv")
    time = series["time"]

    def force(column):
        return (series[column][-1] - np.interp(time[-1] - REFERENCE["window"], time, series[column])) / REFERENCE["window"]

    path = sorted((folder / "snapshots").glob("particles_*.vtkhdf"))[-1]
    with h5py.File(path) as file:
        height, stress = file["VTKHDF/Points"][:, 2], file["VTKHDF/PointData/stress_zz"][()]
    mass = len(height) * particle_mass(folder, len(height))
    weight = mass * GRAVITY
    wall = np.flatnonzero(bands["patch"] == 1)
    names = [f"cylinder.{n + 1}" for n in range(len(wall))]
    top = FLOOR + mass / (DENSITY * AREA)
    pressure = np.array([force(f"normal_impulse_{name}") for name in names]) / bands["area"][wall]
    shear = np.array([force(f"shear_impulse_{name}") for name in names])
    low, high = bands["low"][wall], bands["high"][wall]
    vertical = np.array([stress[(height >= a) & (height < b)].mean() if ((height >= a) & (height < b)).any() else 0.0
                         for a, b in zip(low, high)])
    filled = high <= top + 1e-9
    ratio = (pressure * bands["area"][wall])[filled].sum() / (vertical * bands["area"][wall])[filled].sum()
    length = DIAMETER / (4 * FRICTION * ratio)

    def janssen(z, length=length):
        return DENSITY * GRAVITY * length * (1 - np.exp(-np.maximum(top - z, 0) / length))

    floor = -force("impulse_floor_of_it_z")
    upward = -force("impulse_cylinder_z")
    middle = 0.5 * (low + high)
    mobilised = shear.sum() / (pressure * bands["area"][wall]).sum()
    rows = {"balance": (floor + upward) / weight - 1, "patches": shear.sum() / upward - 1,
            "mobilised": mobilised,
            "floor": floor / (janssen(FLOOR) * AREA) - 1,
            "floor-mobilised": floor / (janssen(FLOOR, DIAMETER / (4 * mobilised * ratio)) * AREA) - 1,
            "bands": np.abs(pressure - ratio * janssen(middle))[filled].max() / pressure.max()}
    profile = {"z": middle, "depth": top - middle, "pressure": pressure, "shear": shear / bands["area"][wall], "vertical": vertical,
               "janssen": janssen(middle), "filled": filled, "K": ratio, "L": length, "floor_share": floor / weight,
               "janssen_share": janssen(FLOOR) * AREA / weight, "particles": len(height)}
    return rows, profile


def particle_mass(folder, particles):
    """kg, from the impulse that gravity gave all of them at the end, when it is full."""
    series = series_of(folder)
    rate = np.polyfit(series["time"][-20:], series["impulse_gravity_z"][-20:], 1)[0]
    return -rate / GRAVITY / particles


def text_of(rows, profile):
    lines = ["%d particles. K = %.3f, L = %.1f mm. The floor bears %.3f of the weight; Janssen %.3f."
             % (profile["particles"], profile["K"], 1e3 * profile["L"], profile["floor_share"], profile["janssen_share"]), "",
             "| what | computed | value, tolerance | |", "|---|---|---|---|"]
    for name, value in rows.items():
        lines.append("| %s | %.4f | %g ± %g | %s |" % (REFERENCE[name]["says"], value, REFERENCE[name]["value"],
                                                     REFERENCE[name]["tolerance"], "met" if is_met(name, value) else "**not met**"))
    lines += ["", "| depth, mm | stress across the wall, Pa | K σ of Janssen | along the wall | mean vertical stress | Janssen |",
              "|---|---|---|---|---|---|"]
    for n in np.argsort(profile["depth"]):
        if profile["filled"][n]:
            lines.append("| %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |"
                         % (1e3 * profile["depth"][n], profile["pressure"][n], profile["K"] * profile["janssen"][n],
                            profile["shear"][n], profile["vertical"][n], profile["janssen"][n]))
    return "\n".join(lines) + "\n"


def is_met(name, value):
    return abs(value - REFERENCE[name]["value"]) <= REFERENCE[name]["tolerance"]


def draw(path, profile):
    import matplotlib
    matplotlib.use("Agg")
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(4.6, 3.8), layout="constrained")
    order = np.argsort(profile["z"])
    z = 1e3 * profile["z"][order]
    axes.plot(profile["pressure"][order], z, "o", label="across the wall")
    axes.plot(profile["shear"][order], z, "s", mfc="none", label="along the wall")
    axes.plot(profile["vertical"][order], z, "^", mfc="none", label="vertical, in the bed")
    axes.plot(profile["janssen"][order], z, "k-", lw=1, label="Janssen: σ, Kσ, μKσ")
    axes.plot(profile["K"] * profile["janssen"][order], z, "k-", lw=1)
    axes.plot(FRICTION * profile["K"] * profile["janssen"][order], z, "k-", lw=1)
    axes.set(xlabel="stress, Pa", ylabel="z, mm", xlim=(0, None))
    axes.legend(frameon=False)
    figure.savefig(path, dpi=150)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", default="build/talus")
    parser.add_argument("--out", type=Path, default=Path("results/janssen-cylinder"))
    parser.add_argument("--spacing", type=float, default=2.5)
    parser.add_argument("--markdown", type=Path)
    parser.add_argument("--picture", type=Path)
    options = parser.parse_args()
    if not (options.out / "summary.json").exists():
        subprocess.run([options.program, "run", HERE / "cylinder.toml", "--set", f"bed.spacing={options.spacing:g} mm", "--out",
                        options.out], check=True)
    rows, profile = measured(options.out)
    text = text_of(rows, profile)
    print(text, end="")
    if options.markdown:
        options.markdown.write_text(text, encoding="utf-8")
    if options.picture:
        draw(options.picture, profile)
    return 0 if all(is_met(name, value) for name, value in rows.items()) else 1


if __name__ == "__main__":
    sys.exit(main())
