# SPDX-License-Identifier: Apache-2.0
"""The runs of the DEM reference: their vessel, their frames as hopper.in writes them, and what is in these without averages over
places: discharge and loads of the walls. Extensive numbers are of a slice 5 mm deep."""
import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

WIDTH, PLATE, TOP, DEPTH = 0.1, 0.1, 0.22, 5e-3  # m
DENSITY = 2500.0
MASS = 0.0625                 # kg in 5 mm
FRAME = 2e-3                  # s between frames


@dataclass
class Frame:
    """The beads at one time. SI; velocity a row a bead; stress: contact stress times volume, xx, yy, zz, xz, of each."""

    time: float
    radius: np.ndarray
    x: np.ndarray
    z: np.ndarray
    velocity: np.ndarray
    stress: np.ndarray

    @property
    def volume(self):
        return 4 / 3 * np.pi * self.radius**3


def read_frame(path, time):
    """A dump of LAMMPS with the columns radius x z vx vy vz and c_stress[1, 2, 3, 5]."""
    with open(path, encoding="ascii") as file:
        head = [file.readline() for _ in range(9)]
        columns = head[8].split()[2:]
        if columns != "radius x z vx vy vz c_stress[1] c_stress[2] c_stress[3] c_stress[5]".split():
            raise ValueError(f"{path}: other columns than hopper.in writes: {' '.join(columns)}")
        rows = np.loadtxt(file, ndmin=2)
    if len(rows) != int(head[3]):
        raise ValueError(f"{path}: {len(rows)} beads of {int(head[3])}")
    return Frame(time, rows[:, 0], rows[:, 1], rows[:, 2], rows[:, 3:6], -rows[:, 6:10])


@dataclass
class Run:
    """The folder of a run; frames are read when they are asked for."""

    folder: Path

    def __post_init__(self):
        self.name = self.folder.name
        self.parameters = json.loads((self.folder / "parameters.json").read_text(encoding="utf-8"))
        self.depth = self.parameters["depth"]
        steps = sorted(int(path.stem) for path in (self.folder / "frames").glob("*.txt"))
        if len(steps) < 2:
            raise ValueError(f"{self.folder}: has fewer than two frames")
        self.steps = {round(step / (steps[1] - steps[0])): step for step in steps}  # by number of the frame
        try:
            self.frame(max(self.steps))
        except (ValueError, IndexError):
            del self.steps[max(self.steps)]  # being written

    @property
    def is_hopper_alone(self):
        """Whether it goes on from another run without what had fallen below the plate (run.py --hopper-of)."""
        return "hopper-of" in self.parameters

    @property
    def end(self):
        return max(self.steps) * FRAME

    def frame(self, number):
        return read_frame(self.folder / "frames" / f"{self.steps[number]}.txt", number * FRAME)

    def reaches(self, time):
        return self.end > time - 1e-6

    def frames(self, start, stop):
        """The frames with start <= time <= stop."""
        return (self.frame(n) for n in sorted(self.steps) if start - 1e-6 <= n * FRAME <= stop + 1e-6)


def discharge(run):
    """Time and mass below the plate, of all frames, kg in 5 mm."""
    rows = []
    for number in sorted(run.steps):
        frame = run.frame(number)
        rows.append((frame.time, DENSITY * frame.volume[frame.z < PLATE].sum() * DEPTH / run.depth))
    return np.array(rows)


def rate(mass, start, stop):
    """Mean discharge over a time, kg/s."""
    return np.diff(np.interp([start, stop], mass[:, 0], mass[:, 1]))[0] / (stop - start) if mass[-1, 0] >= stop - 1e-6 \
        else np.nan


def wall_loads(run):
    """20 ms means of the forces of the walls on the grains in 5 mm, N: rows of time and left, right, floor, plate, each
    along x and z. A resumed run writes a file of its own; what it has counts."""
    latest = {}
    for path in sorted(run.folder.glob("walls.*.txt"), key=lambda path: int(path.stem.split(".")[1])):
        for row in np.loadtxt(path, ndmin=2):
            latest[round(row[0] / run.steps[1])] = row
    means = []
    for last in range(10, max(latest, default=0) + 1, 10):
        group = [latest[n][1:] for n in range(last - 9, last + 1) if n in latest]
        if len(group) == 10:
            means.append([(last - 5) * FRAME, *np.mean(group, axis=0) * DEPTH / run.depth])
    return np.array(means)
