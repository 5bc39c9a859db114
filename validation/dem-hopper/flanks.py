#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""How steep the hopper's flanks are and how fast they move, by depth below their surface: a table of runs of beads and
of Talus.

usage: flanks.py TIME RUN ...   TIME in s from the opening of the gate; RUN a folder of run.py, or of Talus, whose
                                particles are taken for spheres of their volume

Of what lies 4 to 20 mm from the walls, left and right together: mean speed, weighted with the volume, m/s, and the mean
height of the surface there, mm. The slope is that of the angle of repose (surfaces.py); at the plate: how fast the
lowest 1.5 mm move towards the slit, m/s.
"""
import sys
from pathlib import Path

import numpy as np
from fields import Section
from frames import DENSITY, DEPTH, FRAME, MASS, PLATE, WIDTH, Frame, Run
from surfaces import repose_angle, surface_heights

FROM, TO = 4e-3, 20e-3  # m from the walls
LOWEST = 1.5e-3  # m above the plate
DEPTHS = np.array([0, 3, 6, 10, 15, 20, 30]) * 1e-3


def of_talus(folder, time):
    """The particles of the snapshot nearest to a time as beads."""
    sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "python"))
    import talus
    run = talus.Run(folder)
    snapshot = min(run.snapshots, key=lambda s: abs(s.time - run.gate_time - time))
    x = snapshot.positions
    radius = np.full(len(x), (3 * MASS / DENSITY / len(x) / (4 * np.pi))**(1 / 3))
    return Frame(snapshot.time - run.gate_time, radius, x[:, 0], x[:, 2], np.asarray(snapshot["velocity"]),
                 np.zeros((len(x), 4))), DEPTH


def of_beads(folder, time):
    run = Run(folder)
    return run.frame(round(time / FRAME)), run.depth


def in_flank(x):
    from_wall = WIDTH / 2 - abs(x - WIDTH / 2)
    return (from_wall > FROM) & (from_wall < TO)


def speeds(frame, depth):
    """Slope in degrees and mean height, m, of the flanks' surface, and the mean speed in each of DEPTHS below it, m/s;
    nan where nothing lies."""
    section = Section(frame, depth)
    heights = surface_heights(section)[0]
    known = np.isfinite(heights)
    surface = np.interp(frame.x, section.x[known], heights[known])
    there = in_flank(frame.x) & (frame.z > PLATE)
    below, volume = (surface - frame.z)[there], frame.volume[there]
    flux, total = (np.histogram(below, DEPTHS, weights=w)[0]
                   for w in (volume * np.linalg.norm(frame.velocity, axis=1)[there], volume))
    with np.errstate(invalid="ignore"):
        return repose_angle(section, heights), np.nanmean(heights[in_flank(section.x)]), flux / total


def slip(frame):
    """Mean velocity towards the slit of the lowest grains on the plate beside the walls, m/s; nan if there are none."""
    there = in_flank(frame.x) & (frame.z > PLATE) & (frame.z < PLATE + LOWEST)
    inward = np.sign(WIDTH / 2 - frame.x) * frame.velocity[:, 0]
    return np.average(inward[there], weights=frame.volume[there]) if there.any() else np.nan


def main():
    if len(sys.argv) < 3:
        sys.exit(__doc__)
    time = float(sys.argv[1])
    depths = [f"{a * 1e3:g}-{b * 1e3:g} mm" for a, b in zip(DEPTHS, DEPTHS[1:])]
    print("| run | slope | surface, mm | " + " | ".join(depths) + " | at the plate |")
    print("|" + "---|" * (len(DEPTHS) + 3))
    for folder in map(Path, sys.argv[2:]):
        read = of_beads if (folder / "parameters.json").exists() else of_talus
        frame, depth = read(folder, time)
        slope, height, speed = speeds(frame, depth)
        cells = [folder.name, f"{slope:.1f}°", f"{height * 1e3:.1f}", *(f"{value:.3f}" for value in speed),
                 f"{slip(frame):.4f}"]
        print("| " + " | ".join(cells) + " |")


if __name__ == "__main__":
    main()
