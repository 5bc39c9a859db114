#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Runs of the hopper beside the beads of a discrete-element run: surfaces of hopper and bin, discharge, heaps, rest.

    python3 validation/yuu2011/laws/surfaces.py SURFACES.csv RUN ... [--profiles]

SURFACES.csv has the columns time_s, x_mm, hopper_surface_mm, bin_surface_mm, in cells of one width, each surface being
the bottom of the first cell, from below, whose packing is under 0.3. Here the same cells are filled with the runs'
particles, each spread evenly over a square of its own area. Prints a Markdown table, a line a run: the mean distance
of the surfaces beside the stream (x < 28 mm, x > 72 mm) at 0.2, 0.3 and 0.4 s, hopper and bin; the bin's surface at the
walls and in the middle, and the flank's slope; the discharge; and, at the end of the run, its own summary's heaps and
speed at rest; and how much the pressure alternates from particle to particle at 0.2 s. With --profiles the surfaces
themselves."""
import argparse
import csv
import math
import sys
from pathlib import Path

import numpy as np

sys.path.insert(0, str(Path(__file__).resolve().parents[3] / "python"))

from talus import Run  # noqa: E402

PLATE, WIDTH, EMPTY, PARTS = 100e-3, 100e-3, 0.3, 8
TIMES = (0.2, 0.3, 0.4)


def referee(path):
    """{(time, vessel): (x, height)}, in s and mm."""
    with open(path, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    found = {}
    for time in sorted({row["time_s"] for row in rows}, key=float):
        here = [row for row in rows if row["time_s"] == time]
        x = np.array([float(row["x_mm"]) for row in here])
        for vessel in ("hopper", "bin"):
            found[float(time), vessel] = x, np.array([float(row[f"{vessel}_surface_mm"]) for row in here])
    return found


class Surfaces:
    """The free surfaces of a run on cells of a given width."""

    def __init__(self, run, cell):
        self.run, self.cell, self.gate = run, cell, run.gate_time or 0.0
        case = run.case
        self.depth = float(case["box"]["depth"])
        bed, grains = case["bed"], case["grains"]
        solid = WIDTH * self.depth * float(bed["height"]) * float(bed["packing"])
        first = run.snapshots[0]
        self.solid = solid / len(first.positions)  # of a particle, m^3
        self.grain_density = float(grains["density"])

    def packing(self, snapshot):
        """Packing of cells along x and z, with every particle spread over the square of its own area."""
        places = np.asarray(snapshot.positions)
        side = np.sqrt(self.solid * self.grain_density / np.asarray(snapshot["density"]) / self.depth)
        parts = (np.arange(PARTS) + 0.5) / PARTS - 0.5
        x = (places[:, 0, None, None] + side[:, None, None] * parts[:, None]).clip(0, WIDTH * (1 - 1e-12))
        z = (places[:, 2, None, None] + side[:, None, None] * parts[None, :]).clip(0)
        # A particle on one side of the plate stays there.
        above = (places[:, 2] > PLATE)[:, None, None] & (abs(places[:, 0] - WIDTH / 2) > 20e-3)[:, None, None]
        below = (places[:, 2] <= PLATE)[:, None, None] & (abs(places[:, 0] - WIDTH / 2) > 20e-3)[:, None, None]
        z = np.where(above, z.clip(PLATE), np.where(below, z.clip(None, PLATE - 1e-9), z))
        x, z = np.broadcast_arrays(x, z)
        edges = np.arange(0, 0.25 + 1e-9, self.cell)
        count = np.histogram2d(x.ravel(), z.ravel(), [np.arange(0, WIDTH + 1e-9, self.cell), edges])[0]
        return count * self.solid / PARTS**2 / (self.cell**2 * self.depth)

    def around(self, time):
        """The last snapshot up to a time from the opening of the gate, the next one, and the share of the latter."""
        times = np.array([one.time for one in self.run.snapshots]) - self.gate
        if not times[0] <= time <= times[-1]:
            return None
        k = min(np.searchsorted(times, time, "right") - 1, len(times) - 2)
        return self.run.snapshots[k], self.run.snapshots[k + 1], (time - times[k]) / (times[k + 1] - times[k])

    def at(self, time):
        """(hopper, bin) in mm, one value a cell, that of the ground where there is nothing, in proportion between two
        snapshots."""
        around = self.around(time)
        if around is None:
            return None
        earlier, later, share = around
        return tuple((1 - share) * self._first_empty(self.packing(earlier), start) +
                     share * self._first_empty(self.packing(later), start) for start in (round(PLATE / self.cell), 0))

    def discharge(self, start, end):
        """Mass that passes the plate's height in a unit of time, of a hopper 5 mm deep, kg/s."""
        if self.around(end) is None:
            return math.nan
        passed = 0
        for time, sign in ((end, 1), (start, -1)):
            earlier, later, share = self.around(time)
            passed += sign * sum(part * np.sum(np.asarray(one.positions)[:, 2] < PLATE)
                                 for one, part in ((earlier, 1 - share), (later, share)))
        return passed * self.solid * self.grain_density * 5e-3 / self.depth / (end - start)

    def roughness(self, time):
        """How much the pressure alternates from particle to particle in the hopper: mean distance of a particle's from
        the mean of those within 1.5 spacings, over that mean, where it exceeds 100 Pa."""
        around = self.around(time)
        if around is None:
            return math.nan
        snapshot = around[0]
        places = np.asarray(snapshot.positions)[:, [0, 2]]
        pressure = sum(np.asarray(snapshot[f"stress_{axis}"]) for axis in ("xx", "yy", "zz")) / 3
        spacing = float(self.run.case["bed"]["spacing"])
        above = places[:, 1] > PLATE
        places, pressure = places[above], pressure[above]
        ratios = []
        for place, own in zip(places, pressure):
            near = ((places - place) ** 2).sum(axis=1) < (1.5 * spacing) ** 2
            mean = pressure[near].mean()
            if mean > 100:
                ratios.append(abs(own - mean) / mean)
        return np.mean(ratios) if ratios else math.nan

    def _first_empty(self, packing, start):
        empty = packing[:, start:] < EMPTY
        first = np.where(empty.any(axis=1), empty.argmax(axis=1), empty.shape[1])
        return (first + start) * self.cell * 1e3


def beside(x):
    return (x < 28) | (x > 72)


def distance(x, a, b):
    """Mean distance beside the stream, mm, where the beads have a surface."""
    there = beside(x) & np.isfinite(a) & np.isfinite(b)
    return np.abs(a - b)[there].mean() if there.any() else math.nan


def flank(x, height):
    """Slope of the bin's surface from the walls to the stream, degrees: lines fitted to both flanks, their mean."""
    slopes = []
    for side in ((x < 28), (x > 72)):
        there = side & np.isfinite(height)
        if there.sum() > 3:
            slopes.append(abs(np.polyfit(x[there], height[there], 1)[0]))
    return math.degrees(math.atan(np.mean(slopes))) if slopes else math.nan


def shown(value, form=".1f"):
    return "-" if value is None or not np.isfinite(value) else format(value, form)


def describe(name, hopper, bins, x, reference, discharge, ends):
    cells = [name]
    for vessel, mine in (("hopper", hopper), ("bin", bins)):
        if reference is None:
            cells.append("")
            continue
        cells.append(" / ".join(shown(distance(x, mine[t], reference[t, vessel][1]) if mine[t] is not None else None)
                                for t in TIMES))
    walls, middle = (x < 8) | (x > 92), (x > 44) & (x < 56)
    for place in (walls, middle):
        cells.append(" / ".join(shown(np.nanmean(bins[t][place]) if bins[t] is not None and
                                      np.isfinite(bins[t][place]).any() else None, ".0f") for t in TIMES))
    cells.append(" / ".join(shown(flank(x, bins[t]) if bins[t] is not None else None, ".0f") for t in TIMES))
    cells.append(discharge)
    return "| " + " | ".join(cells + ends) + " |"


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("referee", type=Path)
    parser.add_argument("runs", nargs="+", type=Path)
    parser.add_argument("--profiles", action="store_true", help="print the surfaces too")
    options = parser.parse_args()
    reference = referee(options.referee)
    x = reference[0.2, "bin"][0]
    cell = (x[1] - x[0]) * 1e-3
    print("Hopper and bin: mean distance from the beads' surface, mm; walls, middle: height of the bin's surface, mm; flank:"
          " its slope, degrees; all at 0.2 / 0.3 / 0.4 s. Discharge through the slit of 5 mm, kg/s, 0.1 to 0.2 s.\n")
    print("| run | hopper | bin | walls | middle | flank | discharge | heap in the bin, hopper | rest, mm/s |"
          " largest packing | roughness |")
    print("|---|---|---|---|---|---|---|---|---|---|---|")
    hopper, bins = ({t: reference[t, vessel][1] for t in TIMES} for vessel in ("hopper", "bin"))
    print(describe("beads", hopper, bins, x, None, "", ["", "", "", ""]))
    for folder in options.runs:
        run = Run(folder)
        surfaces = Surfaces(run, cell)
        at = {t: surfaces.at(t) for t in TIMES}
        hopper, bins = ({t: at[t] and at[t][k] for t in TIMES} for k in (0, 1))
        rate = surfaces.discharge(0.1, 0.2)
        summary = run.summary

        def quantity(name):
            return float(summary[name]) if name in summary else math.nan

        end = run.snapshots[-1].time - surfaces.gate > 0.9
        ends = [f"{shown(quantity('repose_angle_bin'))}, {shown(quantity('repose_angle_hopper'))}" if end else "-",
                shown(1e3 * quantity("quiescent_speed"), ".2f") if end else "-", shown(quantity("packing_max"), ".3f"), shown(surfaces.roughness(0.2), ".2f")]
        print(describe(folder.name, hopper, bins, x, reference, shown(rate, ".3f"), ends))
        if options.profiles:
            for t in TIMES:
                if at[t]:
                    print(f"<!-- {folder.name} {t}: hopper {at[t][0].tolist()} bin {at[t][1].tolist()} -->")


if __name__ == "__main__":
    main()
