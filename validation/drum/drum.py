#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs the drum and puts surface and velocities beside those of the experiment.

    validation/drum/drum.py [--out results/validation-drum] [--threads N] [--spacing MM] [--markdown FILE] [--picture FILE]

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
AXIS, RADIUS, SPIN = 0.13, 0.12, 1.214749  # m, m, rad/s


def cases(options):
    spacing = f"{options.spacing:g} mm"
    return [(HERE / "drum.toml", options.out, {"bed.spacing": spacing, "box.depth": spacing})]


def turned(x, angle):
    """Along a surface that falls by `angle` to +x, and across it."""
    c, s = np.cos(angle), np.sin(angle)
    return np.stack([c * x[:, 0] - s * x[:, 1], s * x[:, 0] + c * x[:, 1]], axis=1)


def surface_of(x, spacing, angle=0.0, half_chord=REFERENCE["half_chord"]):
    """Angle by which the surface falls to +x, rad, and its distance from the axis, m. \\param x places, from the axis, m"""
    edges = np.arange(-half_chord, half_chord + 1e-9, 2 * spacing)
    middle = 0.5 * (edges[1:] + edges[:-1])
    for _ in range(20):
        t = turned(x, angle)
        bins = np.digitize(t[:, 0], edges) - 1
        top = np.array([t[bins == n, 1].max() for n in range(len(middle))]) + 0.5 * spacing
        slope, level = np.polyfit(middle, top, 1)
        angle -= np.arctan(slope)
        if abs(slope) < 1e-4:
            break
    return angle, level


def measure(options):
    run = talus.Run(options.out)
    spacing = 1e-3 * options.spacing
    begin, end = REFERENCE["window"]
    frames = []
    for snapshot in run.snapshots:
        if not begin <= snapshot.time - run.gate_time <= end + 1e-3:
            continue
        x = np.asarray(snapshot.positions)[:, [0, 2]] - AXIS
        frames.append((snapshot.time - run.gate_time, x, np.asarray(snapshot["velocity"])[:, [0, 2]]))
    centre = np.mean([x.mean(axis=0) for _, x, _ in frames], axis=0)
    guess = np.arctan2(-centre[0], -centre[1])  # a surface that falls to +x has its beads on the other side
    surfaces = np.array([surface_of(x, spacing, guess) for _, x, _ in frames])
    angle, level = surfaces.mean(axis=0)
    downhill = np.sign(angle)
    along, distance = [], []
    for _, x, u in frames:
        t, v = turned(x, angle), turned(u, angle)
        beside = np.abs(t[:, 0]) < REFERENCE["beside"]
        distance.append(t[beside, 1])
        along.append(downhill * v[beside, 0])
    distance, along = np.concatenate(distance), np.concatenate(along)

    def velocity(at):
        near = [along[np.abs(distance - d) < REFERENCE["near"]] for d in at]
        return np.array([some.mean() if len(some) else np.nan for some in near])

    measured = {"distance": 1e-3 * np.array(REFERENCE["profile"]["distance"]),
                "velocity": np.array(REFERENCE["profile"]["velocity"])}
    at = np.arange(level - spacing, -RADIUS, -1e-3)
    profile = velocity(at)
    first = np.flatnonzero(profile < 0)[0]  # downwards from the surface
    rest = np.interp(0, profile[[first, first - 1]], at[[first, first - 1]])
    deep = np.arange(-0.11, -0.0799, 2e-3)
    apart = velocity(measured["distance"]) - measured["velocity"]
    numbers = {"angle": np.degrees(abs(angle)), "rest": -1e3 * rest,
               "profile-deviation": np.sqrt(np.mean(apart ** 2)) / measured["velocity"].max(),
               "turning": np.mean(velocity(deep) / (SPIN * deep)) - 1}
    found = {"angles": np.degrees(np.abs(surfaces[:, 0])), "centre": np.degrees(abs(guess)), "at": at, "profile": profile,
             "measured": measured, "here": velocity(measured["distance"]), "last": frames[-1], "angle": angle, "level": level,
             "particles": len(frames[-1][1])}
    return numbers, found


def tell(numbers, found):
    angles = found["angles"]
    lines = ["%d particles. Angle of the %d snapshots %.1f ± %.1f degrees (standard deviation); by the centre of mass %.1f. The "
             "surface is %.1f mm from the axis." % (found["particles"], len(angles), angles.mean(), angles.std(ddof=1),
                                                    found["centre"], -1e3 * found["level"]),
             "", study.table_of_numbers(REFERENCE, numbers),
             "| below the axis, mm | velocity along the surface, m/s | experiment |", "|---|---|---|"]
    for n in range(0, len(found["here"]), 3):
        lines.append("| %.0f | %.3f | %.3f |" % (-1e3 * found["measured"]["distance"][n], found["here"][n],
                                               found["measured"]["velocity"][n]))
    return "\n".join(lines) + "\n"


def draw(found):
    from matplotlib import pyplot as plt
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.4, 3.9), layout="constrained")
    _, x, u = found["last"]
    dots = left.scatter(1e3 * x[:, 0], 1e3 * x[:, 1], c=np.hypot(*u.T), s=5, cmap="viridis")
    figure.colorbar(dots, ax=left, label="speed, m/s", shrink=0.8)
    left.add_patch(plt.Circle((0, 0), 1e3 * RADIUS, fill=False, color="0.3"))
    s = np.array([-1, 1]) * REFERENCE["half_chord"] * 1.6
    c, si = np.cos(found["angle"]), np.sin(found["angle"])
    left.plot(1e3 * (c * s + si * found["level"]), 1e3 * (-si * s + c * found["level"]), "k--", lw=1)
    left.set(aspect="equal", xlabel="x, mm", ylabel="z, mm")
    right.plot(found["profile"], -1e3 * found["at"], "-", label="Talus")
    right.plot(found["measured"]["velocity"], -1e3 * found["measured"]["distance"], "kx", label="Alizadeh et al. 2013")
    deep = np.array([0.03, RADIUS])
    right.plot(-SPIN * deep, 1e3 * deep, ":", color="0.5", label="turning with the drum")
    right.set(xlabel="velocity along the surface, m/s", ylabel="below the axis, mm", ylim=(1e3 * RADIUS, 25))
    right.legend(frameon=False)
    return figure


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/validation-drum", REFERENCE, cases, measure, tell, draw, spacing=2))
