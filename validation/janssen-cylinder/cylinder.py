#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the cylinder and puts its loads beside Janssen's.

    validation/janssen-cylinder/cylinder.py [--out results/janssen-cylinder] [--threads N] [--spacing MM]
                                            [--markdown FILE] [--picture FILE]

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
DENSITY, GRAVITY, DIAMETER, FRICTION, FLOOR = 1500.0, 9.81, 0.03, 0.3, 0.01  # SI
AREA = np.pi * DIAMETER ** 2 / 4


def cases(options):
    spacing = {"bed.spacing": f"{options.spacing:g} mm"}
    drawn = REFERENCE["drawn"]
    return [(HERE / "cylinder.toml", options.out, spacing),
            (HERE / "cylinder.toml", options.out / "drawn",
             spacing | {"vessel.1.slide": drawn["slide"], "run.end": drawn["end"], "output.series": "1 ms"})]


def load(run, window, snapshots):
    """Rows of the reference, without the prefix of an experiment, and profiles.
    \\param window of the forces before the end of the run, s \\param snapshots whose stress is taken"""
    series, bands = run.series, run.table("wall_loads")
    time = series["time"]

    def force(column):
        return (series[column][-1] - np.interp(time[-1] - window, time, series[column])) / window

    weight = -np.polyfit(time[-20:], series["impulse_gravity_z"][-20:], 1)[0]  # at the end, when gravity is full
    mass = weight / GRAVITY
    wall = np.flatnonzero(bands["patch"] == 1)
    names = [f"cylinder.{n + 1}" for n in range(len(wall))]
    top = FLOOR + mass / (DENSITY * AREA)
    pressure = np.array([force(f"normal_impulse_{name}") for name in names]) / bands["area"][wall]
    shear = np.array([force(f"shear_impulse_{name}") for name in names])
    low, high = bands["low"][wall], bands["high"][wall]

    def mean_stress(snapshot):
        height, stress = np.asarray(snapshot.positions)[:, 2], snapshot["stress_zz"]
        within = [(height >= a) & (height < b) for a, b in zip(low, high)]
        return [stress[band].mean() if band.any() else 0.0 for band in within]

    vertical = np.mean([mean_stress(snapshot) for snapshot in snapshots], axis=0)
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
               "janssen_share": janssen(FLOOR) * AREA / weight, "particles": len(run.snapshots[-1].positions)}
    return rows, profile


def measure(options):
    run = talus.Run(options.out)
    rows, at_rest = load(run, REFERENCE["window"], [run.snapshots[-1]])
    run, window = talus.Run(options.out / "drawn"), REFERENCE["drawn"]["window"]
    end = run.snapshots[-1].time
    of_drawn, drawn = load(run, window, [s for s in run.snapshots if s.time > end - window])
    return rows | {f"drawn-{name}": of_drawn[name] for name in ("balance", "mobilised", "floor", "bands")}, (at_rest, drawn)


def tell(rows, profiles):
    lines = [study.table_of_numbers(REFERENCE, rows, digits=4).rstrip()]
    for title, profile in zip(("At rest", "The tube drawn up"), profiles):
        lines += ["", "%s: %d particles, K = %.3f, L = %.1f mm. The floor bears %.3f of the weight; Janssen %.3f."
                  % (title, profile["particles"], profile["K"], 1e3 * profile["L"], profile["floor_share"], profile["janssen_share"]),
                  "", "| depth, mm | stress across the wall, Pa | K σ of Janssen | along the wall | mean vertical stress | Janssen |",
                  "|---|---|---|---|---|---|"]
        for n in np.argsort(profile["depth"]):
            if profile["filled"][n]:
                lines.append("| %.0f | %.0f | %.0f | %.0f | %.0f | %.0f |"
                             % (1e3 * profile["depth"][n], profile["pressure"][n], profile["K"] * profile["janssen"][n],
                                profile["shear"][n], profile["vertical"][n], profile["janssen"][n]))
    return "\n".join(lines) + "\n"


def draw(profiles):
    from matplotlib import pyplot as plt
    figure, both = plt.subplots(1, 2, figsize=(7.6, 3.8), sharex=True, sharey=True, layout="constrained")
    for title, profile, axes in zip(("at rest", "tube drawn up by 20 mm/s"), profiles, both):
        order = np.argsort(profile["z"])
        z = 1e3 * profile["z"][order]
        axes.plot(profile["pressure"][order], z, "o", label="across the wall")
        axes.plot(profile["shear"][order], z, "s", mfc="none", label="along the wall")
        axes.plot(profile["vertical"][order], z, "^", mfc="none", label="vertical, in the bed")
        axes.plot(profile["janssen"][order], z, "k-", lw=1, label="Janssen: σ, Kσ, μKσ")
        axes.plot(profile["K"] * profile["janssen"][order], z, "k-", lw=1)
        axes.plot(FRICTION * profile["K"] * profile["janssen"][order], z, "k-", lw=1)
        axes.set(xlabel="stress, Pa", title=title, xlim=(0, None))
    both[0].set(ylabel="z, mm")
    both[0].legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/janssen-cylinder", REFERENCE, cases, measure, tell, draw,
                           spacing=2.5))
