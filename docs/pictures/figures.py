#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The figures of the pages of theory that are no picture of a run.

usage: docs/pictures/figures.py [FOLDER]     the folder of this script if not given
"""
import sys
from pathlib import Path

import numpy as np
from matplotlib import pyplot as plt
from matplotlib.patches import Circle

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))
import talus.draw as draw  # noqa: E402

BLUE, ORANGE, GREEN, GREY = "#0072b2", "#d55e00", "#009e73", "#7d8a99"


def stokes_flow(x, y):
    """Velocity around a sphere of radius 1 that a force along x pulls at speed 1 (Stokes 1851; Batchelor 1967, 4.9)."""
    distance = np.hypot(x, y)
    r = np.maximum(distance, 1)
    along = 0.75 / r + 0.25 / r**3
    radial = (0.75 / r - 0.75 / r**3) * x / r**2
    u, v = along + radial * x, radial * y
    inside = distance < 1
    return np.where(inside, 1, u), np.where(inside, 0, v)


def pair_speed(distance):
    """Speed of two equal spheres of radius 1 that the same force pulls, over that of one alone (Eqs 3 and 4a of Niiya et
    al. 2020): one behind the other, and side by side."""
    return 1 + 1.5 / distance - 1 / distance**3, 1 + 0.75 / distance + 0.5 / distance**3


def mobility(folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.6), width_ratios=[1.35, 1])
    x, y = np.meshgrid(np.linspace(-6, 6, 241), np.linspace(-4, 4, 161))
    u, v = stokes_flow(x, y)
    colours = left.pcolormesh(x, y, np.hypot(u, v), cmap="viridis", vmin=0, vmax=1, shading="gouraud", rasterized=True)
    some = np.s_[8::16, 8::16]
    left.quiver(x[some], y[some], u[some], v[some], color="white", scale=16, width=0.004)
    left.add_patch(Circle((0, 0), 1, facecolor="white", edgecolor="black"))
    left.annotate("", (0.85, 0), (-0.75, 0), arrowprops={"arrowstyle": "-|>", "color": ORANGE, "lw": 2})
    left.set(aspect="equal", xlabel="distance along the force, radii", ylabel="across, radii", xlim=(-6, 6), ylim=(-4, 4))
    figure.colorbar(colours, ax=left, label="speed of the fluid / speed of the grain", shrink=0.85)
    apart = np.linspace(2, 12, 201)
    for speed, colour, style, name in zip(pair_speed(apart), (BLUE, ORANGE), ("-", "--"), ("one behind the other", "side by side")):
        right.plot(apart, speed, style, color=colour, label=name)
    right.axhline(1, color=GREY, lw=0.8)
    right.set(xlabel="distance of the centres, radii", ylabel="speed of two grains / of one alone", ylim=(0.95, 1.7))
    right.legend(frameon=False)
    draw.save(figure, folder / "mobility.png")


def cubic_spline(q):
    """Monaghan's kernel in space in units of h, Eq. 15 of Yuu & Umekage 2011."""
    return np.where(q < 1, 1 - 1.5 * q**2 + 0.75 * q**3, np.where(q < 2, 0.25 * (2 - q)**3, 0)) / np.pi


def parcels(folder):
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), width_ratios=[1, 1.15])
    spacing, grain = 1.667, 0.2  # mm
    random = np.random.default_rng(1)
    step = grain * 1.08
    places = np.arange(-4.2, 4.2, step)
    x, y = (axis.ravel() + random.normal(0, 0.02, axis.size) for axis in np.meshgrid(places, places))
    for place in zip(x, y):
        left.add_patch(Circle(place, grain / 2, facecolor="#d8d2c4", edgecolor="none"))
    for i in range(-3, 4):
        for k in range(-3, 4):
            left.plot(i * spacing, k * spacing, ".", color=BLUE, ms=7)
    left.add_patch(Circle((0, 0), 2 * spacing, facecolor="none", edgecolor=ORANGE, lw=1.6))
    left.plot(0, 0, ".", color=ORANGE, ms=11)
    left.set(aspect="equal", xlim=(-4.1, 4.1), ylim=(-4.1, 4.1), xlabel="mm", ylabel="mm")
    q = np.linspace(0, 2.4, 200)
    right.plot(q * spacing, cubic_spline(q) / cubic_spline(0), color=ORANGE, label="kernel $W$")
    lattice = np.arange(-3, 4)
    apart = np.sqrt(sum(axis**2 for axis in np.meshgrid(lattice, lattice, lattice)).ravel())
    distance, count = np.unique(np.round(apart[apart <= 2], 6), return_counts=True)
    share = count * cubic_spline(distance)
    right.bar(distance * spacing, share / share.sum(), width=0.12, color=BLUE, label="share of the sum in a bed at rest")
    right.set(xlabel="distance from the particle, mm", ylabel="over its value at 0; share", ylim=(0, 1.05), xlim=(-0.15, 4))
    right.legend(frameon=False)
    draw.save(figure, folder / "particles-and-grains.png")


def main():
    folder = Path(sys.argv[1]) if len(sys.argv) > 1 else HERE
    with draw.style():
        mobility(folder)
        parcels(folder)


if __name__ == "__main__":
    main()
