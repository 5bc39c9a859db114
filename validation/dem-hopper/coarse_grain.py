#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Fields, surfaces and numbers of the referee's runs, from the frames that hopper.in writes, as small CSV files.

usage: coarse_grain.py RUN_FOLDER ... [--out data] [--pictures RUN ...]

Averages. Packing and velocity are sums over beads spread in x and z by a Gaussian of 2 mm, through the whole depth, with
mirror images at side walls and floor. Stress is that of Babic (1997, Int. J. Eng. Sci. 35, 523): over a box of volume V,
(1/V) sum over the beads in it of [half of each contact's force times branch + m v' v'], v' the velocity less the mean
velocity of the Gaussian at the bead; compression is positive. The contact part is LAMMPS's own (compute stress/atom).
All extensive numbers are of a slice 5 mm deep.

A surface is where the smoothed packing passes 0.3, half of a bed's: in the hopper the highest such place, in the bin the
lowest, if there is packing above 0.3 below it; none where a dense stream reaches the plate. Talus's own measures
(src/analysis/free_surface.hpp) ask for the same. Everything is tested on beads at known places in
tests/python/test_dem_hopper.py.
"""
import argparse
import csv
import json
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np

WIDTH, PLATE, TOP, DEPTH = 0.1, 0.1, 0.22, 5e-3  # m
SLIT = 0.03, 0.07
DENSITY, GRAVITY = 2500.0, 9.8
MASS = 0.0625                 # kg in 5 mm
FRAME = 2e-3                  # s between frames
CELL, SMOOTHING = 0.5e-3, 2e-3
LEVEL = 0.3                   # packing on a surface
SPACING = WIDTH / 60          # of the places where a surface is taken for its slopes: that of the case's particles
HEIGHTS = 0.105, 0.12, 0.14, 0.16          # m, of profiles
TIMES = 0.1, 0.15, 0.2, 0.25, 0.3          # s, of profiles
PICTURES = 0.1, 0.16, 0.2, 0.3, 0.4        # s
PICTURE_CELL = 2e-3
HALF_WINDOW = 10e-3                        # s, about them
BANDS = (0, 0.01), (0.01, 0.03), (0.03, 0.05), (0.022, 0.036), (0.036, 0.05)  # m from the middle, of surfaces
FOOT_HEIGHT, FOOT_PACKING = 5e-3, 0.15
#: Boxes for packing and stress: x from and to (and their mirror images), z from and to, m; times, s.
BOXES = {"bed before": ((0.01, 0.05), (0.105, 0.15), (0.0,)),
         "hopper, corners": ((0.004, 0.024), (0.104, 0.12), (0.1, 0.2, 0.3)),
         "hopper, core": ((0.04, 0.05), (0.11, 0.13), (0.1, 0.2)),
         "stream": ((0.04, 0.05), (0.05, 0.09), (0.16, 0.2)),
         "bin, beside": ((0.006, 0.026), (0.004, 0.016), (0.2, 0.3, 0.4)),
         "bin, below": ((0.04, 0.05), (0.004, 0.016), (0.2, 0.3, 0.4))}


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
        self.steps = {round(step / steps[1]): step for step in steps}  # by number of the frame; the first is 0
        try:
            self.frame(max(self.steps))
        except (ValueError, IndexError):
            del self.steps[max(self.steps)]  # being written

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


class Section:
    """What is spread over the plane x, z by the Gaussian: values at the centres of cells, one row an x."""

    x = (np.arange(round(WIDTH / CELL)) + 0.5) * CELL
    z = (np.arange(round(TOP / CELL)) + 0.5) * CELL

    def __init__(self, frame, depth, smoothing=SMOOTHING):
        self._shares = _shares(frame.x, len(self.x)), _shares(frame.z, len(self.z))
        self._spread = [_gaussian(axis, size, smoothing) for axis, size in ((self.x, WIDTH), (self.z, None))]
        self.frame, self.depth = frame, depth
        self.packing = self.sum_of(frame.volume)

    def sum_of(self, values):
        """Of a number a bead: its sum over a unit of volume."""
        sums = np.zeros(len(self.x) * len(self.z))
        for column, across in self._shares[0]:
            for row, up in self._shares[1]:
                sums += np.bincount(column * len(self.z) + row, values * across * up, len(sums))
        return self._spread[0] @ sums.reshape(len(self.x), len(self.z)) @ self._spread[1].T / (CELL**2 * self.depth)

    def mean_of(self, values):
        """Of a number a bead: its mean weighted with the beads' volume; nan where there are none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(self.packing > 1e-6, self.sum_of(self.frame.volume * values) / self.packing, np.nan)

    def at_beads(self, values):
        """The values at the cells that the beads are in."""
        column = np.clip((self.frame.x / CELL).astype(int), 0, len(self.x) - 1)
        return values[column, np.clip((self.frame.z / CELL).astype(int), 0, len(self.z) - 1)]


def _shares(places, cells):
    """The two cells between whose centres each place lies, with its linear shares in them; beyond the last centres the
    outermost cell has all. What is above the top has none."""
    at = places / CELL - 0.5
    first = np.floor(at)
    known = (places < cells * CELL).astype(float)
    return [(np.clip(first + n, 0, cells - 1).astype(int), known * np.where(n, at - first, 1 - at + first)) for n in (0, 1)]


def _gaussian(places, size, width):
    """Weights that spread from each place to each, with mirror images at 0 and, if there is one, at `size`."""
    def kernel(images):
        return np.exp(-0.5 * ((places[:, None] - images[None, :]) / width)**2)
    weights = kernel(places) + kernel(-places)
    if size is not None:
        weights += kernel(2 * size - places)
    return weights * CELL / (width * np.sqrt(2 * np.pi))


def surfaces(section):
    """Heights of the surface of hopper and bin at section.x, m; nan where there is none."""
    hopper, bin_ = (np.full(len(section.x), np.nan) for _ in range(2))
    plate = np.searchsorted(section.z, PLATE)
    for column, packing in enumerate(section.packing):
        grains = packing >= LEVEL
        last = np.flatnonzero(grains[plate:-1] & ~grains[plate + 1:])
        if len(last):
            hopper[column] = _crossing(section.z, packing, plate + last[-1])
        first = np.flatnonzero(~grains[1:plate])
        if grains[0] and len(first):
            bin_[column] = _crossing(section.z, packing, first[0])
    return hopper, bin_


def _crossing(z, packing, row):
    return z[row] + CELL * (packing[row] - LEVEL) / (packing[row] - packing[row + 1])


def band(x, heights, start, stop):
    """Mean height between two distances from the middle, both sides; nan if there is none on either."""
    away = abs(x - WIDTH / 2)
    there = (away >= start) & (away <= stop) & np.isfinite(heights)
    return heights[there].mean() if there.any() else np.nan


def outward_angle(x, heights, start, stop):
    """Angle at which a surface falls outwards between two distances from the middle, degrees: of the mean slope of the
    lines through the heights left and right of it. Below 0 where it rises towards the walls."""
    slopes = []
    for side in (-1, 1):
        away = side * (x - WIDTH / 2)
        there = (away >= start) & (away <= stop) & np.isfinite(heights)
        if there.sum() > 2:
            slopes.append(-np.polyfit(away[there], heights[there], 1)[0])
    return np.degrees(np.arctan(np.mean(slopes))) if slopes else np.nan


def foot_reach(section):
    """How far the layer on the floor reaches, m from the middle, left and right: the outermost place where the packing of
    the lowest 5 mm passes 0.15; nan where there is none."""
    layer = section.packing[:, section.z < FOOT_HEIGHT].mean(axis=1)
    reach = []
    for away, packing in ((WIDTH / 2 - section.x[::-1], layer[::-1]), (section.x - WIDTH / 2, layer)):
        n = np.flatnonzero((packing >= FOOT_PACKING) & (away > 0))
        if not len(n):
            reach.append(np.nan)
        elif n[-1] + 1 == len(packing):
            reach.append(WIDTH / 2)
        else:
            n = n[-1]
            reach.append(away[n] + CELL * (packing[n] - FOOT_PACKING) / (packing[n] - packing[n + 1]))
    return reach


def foot_speed(time, reach, start=0.025, stop=0.045):
    """Slope of the line through the reach against time, from its first value past `start` to its last before `stop`, in
    m/s; nan if fewer than three values lie between them."""
    time, reach = np.asarray(time), np.asarray(reach)
    there = (reach >= start) & (reach <= stop)
    return np.polyfit(time[there], reach[there], 1)[0] if there.sum() > 2 else np.nan


def heap_slopes(x, heights, least):
    """The stretches longer than `least` along which the 5-point mean rises or falls all along, as (from, to, angle in
    degrees of the line through their middle 80 %): src/analysis/heap_slopes.hpp."""
    means = np.full(len(x), np.nan)
    for n in range(len(x)):
        for wide in (2, 1, 0):
            if n >= wide and n + wide < len(x) and np.isfinite(heights[n - wide:n + wide + 1]).all():
                means[n] = heights[n - wide:n + wide + 1].mean()
                break
    slopes, first, signs = [], 0, np.sign(np.diff(means))
    while first < len(signs):
        last = first
        while last < len(signs) and signs[last] == signs[first] != 0:
            last += 1
        length = x[last] - x[first]
        if length > least:
            inner = (x >= x[first] + 0.1 * length) & (x <= x[last] - 0.1 * length)
            slopes.append((x[first], x[last], np.degrees(np.arctan(abs(np.polyfit(x[inner], heights[inner], 1)[0])))))
        first = max(last, first + 1)
    return slopes


def repose_angle(section, heights):
    """Mean over left and right of the angle of the longest slope, degrees; nan where there is none."""
    x = (np.arange(round(WIDTH / SPACING)) + 0.5) * SPACING
    known = np.isfinite(heights)
    taken = np.interp(x, section.x, np.where(known, heights, 0))
    taken[np.interp(x, section.x, known.astype(float)) < 1 - 1e-9] = np.nan
    longest = {}
    for start, stop, angle in heap_slopes(x, taken, 10 * SPACING):
        side = (start + stop) / 2 < WIDTH / 2
        longest[side] = max(longest.get(side, (0, 0)), (stop - start, angle))
    return np.mean([angle for _, angle in longest.values()]) if longest else np.nan


def box_state(frame, section, x, z):
    """Mean packing and stresses (contact and kinetic; xx, yy, zz, xz, Pa) of a box and its mirror image."""
    mirrored = np.minimum(frame.x, WIDTH - frame.x)
    inside = (mirrored >= x[0]) & (mirrored < x[1]) & (frame.z >= z[0]) & (frame.z < z[1])
    volume = 2 * (x[1] - x[0]) * (z[1] - z[0]) * section.depth
    sign = np.where(frame.x < WIDTH / 2, 1, -1)  # of a shear stress in the mirror
    mean = np.stack([section.at_beads(section.mean_of(component)) for component in frame.velocity.T], axis=1)
    rest = (frame.velocity - mean)[inside]
    mass = DENSITY * frame.volume[inside]
    kinetic = [np.sum(mass * rest[:, a] * rest[:, b] * (1 if a == b else sign[inside]))
               for a, b in ((0, 0), (1, 1), (2, 2), (0, 2))]
    contact = [*frame.stress[inside, :3].sum(axis=0), (frame.stress[inside, 3] * sign[inside]).sum()]
    return frame.volume[inside].sum() / volume, np.array(contact) / volume, np.array(kinetic) / volume


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


def profile(run, time, height, columns=25):
    """Over cells of 4 mm by 6 mm and 20 ms: x, velocity upwards (weighted with volume) and packing."""
    edges = np.linspace(0, WIDTH, columns + 1)
    volume, flux, count = np.zeros(columns), np.zeros(columns), 0
    for frame in run.frames(time - HALF_WINDOW, time + HALF_WINDOW):
        here = abs(frame.z - height) < 3e-3
        volume += np.histogram(frame.x[here], edges, weights=frame.volume[here])[0]
        flux += np.histogram(frame.x[here], edges, weights=(frame.volume * frame.velocity[:, 2])[here])[0]
        count += 1
    packing = volume / (count * (edges[1] - edges[0]) * 6e-3 * run.depth)
    with np.errstate(invalid="ignore", divide="ignore"):
        return 0.5 * (edges[1:] + edges[:-1]), np.where(packing > 0.02, flux / volume, np.nan), packing


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


class Tables:
    """The CSV files, each with a line of names and units; a line a row, of all runs one after the other."""

    HEADS = {"discharge": "run,time_s,mass_below_kg,rate_kg_per_s",
             "surfaces": "run,time_s,x_mm,hopper_mm,bin_mm",
             "profiles": "run,time_s,z_mm,x_mm,velocity_m_per_s,packing",
             "states": "run,time_s,place,packing,sxx_Pa,syy_Pa,szz_Pa,sxz_Pa,kinetic_share,sxx_over_szz",
             "foot": "run,time_s,left_mm,right_mm",
             "walls": "run,time_s,left_x_N,left_z_N,right_x_N,right_z_N,floor_x_N,floor_z_N,plate_x_N,plate_z_N",
             "numbers": "run,diameter_mm,rolling,seed,stiffness,quantity,place,time_s,unit,value"}

    def __init__(self):
        self.rows = {name: [] for name in self.HEADS}

    def add(self, name, *row):
        self.rows[name].append([f"{value:.5g}" if isinstance(value, (float, np.floating)) else value for value in row])

    def write(self, folder):
        folder.mkdir(parents=True, exist_ok=True)
        for name, rows in self.rows.items():
            with open(folder / f"{name}.csv", "w", encoding="utf-8", newline="") as file:
                writer = csv.writer(file, lineterminator="\n")
                writer.writerow(self.HEADS[name].split(","))
                writer.writerows(rows)


def add_run(tables, run):
    def number(quantity, place, time, unit, value):
        p = run.parameters
        tables.add("numbers", run.name, p["diameter"] * 1e3, p["rolling"], p["seed"], p["stiffness"], quantity, place,
                   time, unit, float(value))

    mass = discharge(run)
    for time in np.arange(0, run.end + 1e-6, 0.02):
        tables.add("discharge", run.name, time, np.interp(time, *mass.T),
                   rate(mass, max(time - 0.01, 0), time + 0.01))
    for start, stop in ((0.05, 0.1), (0.1, 0.15), (0.15, 0.2), (0.1, 0.2)):
        number("discharge_rate_plateau", "", f"{start:g}-{stop:g}", "kg/s", rate(mass, start, stop))
    for time in (0.1, 0.2, 0.3, 0.4):
        if run.reaches(time):
            number("discharged_fraction", "", f"{time:g}", "1", np.interp(time, *mass.T) / MASS)

    reach = []
    for frame in run.frames(0.14, 0.24):
        reach.append((frame.time, *foot_reach(Section(frame, run.depth))))
        tables.add("foot", run.name, *(value * scale for value, scale in zip(reach[-1], (1, 1e3, 1e3))))
        if min(reach[-1][1:]) == WIDTH / 2:
            break
    reach = np.array(reach)
    if len(reach):
        number("foot_speed", "25-45 mm from the middle", "", "m/s",
               foot_speed(reach[:, 0], reach[:, 1:].mean(axis=1)))

    for n in range(0, max(run.steps) + 1, 10):
        frame = run.frame(n)
        section = Section(frame, run.depth)
        hopper, bin_ = surfaces(section)
        for at in range(3, len(section.x), 4):
            x = section.x[at - 1:at + 1].mean()
            tables.add("surfaces", run.name, frame.time, x * 1e3, hopper[at - 1:at + 1].mean() * 1e3,
                       bin_[at - 1:at + 1].mean() * 1e3)
        if round(frame.time, 6) in (0.1, 0.2, 0.3, 0.4):
            for vessel, heights in (("hopper", hopper), ("bin", bin_)):
                for a, b in BANDS:
                    number(f"surface_height_{vessel}", f"{a * 1e3:g}-{b * 1e3:g} mm from the middle", f"{frame.time:g}",
                           "mm", band(section.x, heights, a, b) * 1e3)
            number("surface_outward_angle_bin", "22-50 mm from the middle", f"{frame.time:g}", "deg",
                   outward_angle(section.x, bin_, 0.022, 0.05))
        for place, (x, z, times) in BOXES.items():
            if any(abs(frame.time - t) < 1e-6 for t in times):
                packing, contact, kinetic = box_state(frame, section, x, z)
                s = contact + kinetic
                with np.errstate(invalid="ignore", divide="ignore"):
                    share, ratio = kinetic[:3].sum() / s[:3].sum(), s[0] / s[2]
                tables.add("states", run.name, frame.time, place, packing, *s, share, ratio)
                number("packing", place, f"{frame.time:g}", "1", packing)
                number("stress_ratio", place, f"{frame.time:g}", "1", ratio)
        if n == max(run.steps) // 10 * 10:
            number("repose_angle_hopper", "", f"{frame.time:g}", "deg", repose_angle(section, hopper))
            number("repose_angle_bin", "", f"{frame.time:g}", "deg", repose_angle(section, bin_))

    for time in TIMES:
        if not run.reaches(time + HALF_WINDOW):
            continue
        for height in HEIGHTS:
            x, velocity, packing = profile(run, time, height)
            for row in zip(x * 1e3, velocity, packing):
                tables.add("profiles", run.name, time, height * 1e3, *row)
            middle = velocity[abs(x - WIDTH / 2) <= 0.02]
            if np.isfinite(middle).all():
                number("hopper_velocity", f"z = {height * 1e3:g} mm, x = 30-70 mm", f"{time:g}", "m/s", middle.mean())
    for row in wall_loads(run):
        tables.add("walls", run.name, *row)


def write_pictures(folder, run):
    """A file a run of packing and mean speed in cells of 2 mm, at the times of the pictures; empty cells are left out."""
    edges = [np.arange(round(size / PICTURE_CELL) + 1) * PICTURE_CELL for size in (WIDTH, TOP)]
    with open(folder / f"picture-{run.name}.csv", "w", encoding="utf-8") as file:
        file.write("time_s,x_mm,z_mm,packing,speed_m_per_s\n")
        for time in PICTURES:
            if not run.reaches(time):
                continue
            frame = run.frame(round(time / FRAME))
            speed = np.linalg.norm(frame.velocity, axis=1)
            volume, flux = (np.histogram2d(frame.x, frame.z, edges, weights=w)[0]
                            for w in (frame.volume, frame.volume * speed))
            for i, k in np.argwhere(volume > 0):
                file.write(f"{time:g},{(edges[0][i] + PICTURE_CELL / 2) * 1e3:g},{(edges[1][k] + PICTURE_CELL / 2) * 1e3:g},"
                           f"{volume[i, k] / (PICTURE_CELL**2 * run.depth):.2g},{flux[i, k] / volume[i, k]:.2g}\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument("--pictures", nargs="*", default=[], metavar="RUN", help="names of runs to be shown as pictures")
    parser.add_argument("--out", type=Path, default=Path(__file__).resolve().parent / "data")
    given = parser.parse_args()
    tables = Tables()
    given.out.mkdir(parents=True, exist_ok=True)
    for folder in given.folders:
        try:
            run = Run(folder)
            add_run(tables, run)
            if run.name in given.pictures:
                write_pictures(given.out, run)
        except (OSError, ValueError) as error:
            sys.exit(f"{error}")
    tables.write(given.out)


if __name__ == "__main__":
    main()
