#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The hopper of Yuu & Umekage (cases/yuu2011-hopper-vacuum.toml) between mirrors and between plates of a [[vessel]].

usage: agree.py FOLDER [--spacing MM] [--end S] [--threads N]

Runs what is not there yet into FOLDER, a section one particle deep, and prints the discharge and the heap of each run.
The scatter of a run is that of mirrored runs whose time steps differ by a few percent.
"""
import argparse
import sys
from pathlib import Path

import numpy as np

PROJECT = Path(__file__).resolve().parents[2]
sys.path.insert(0, str(PROJECT / "python"))
import talus  # noqa: E402

CASE = PROJECT / "cases/yuu2011-hopper-vacuum.toml"
ROOM = 10.0  # mm around the vessel, whose lower left corner is at (ROOM, ROOM)
BINS = 10  # of the profile of the heap
RUNS = {"mirrors": ("mirrors", 1.2), "mirrors, step x 0.97": ("mirrors", 1.164),
        "mirrors, step x 0.94": ("mirrors", 1.128), "vessel": ("vessel", 1.2), "vessel, step x 0.97": ("vessel", 1.164)}


def plate(name, start, edge, spacing, gate=False):
    """A plate seen edge on from `start` along `edge`, mm; it goes on beyond front and rear."""
    reach = 4 * spacing
    lengths = [[start[0] + ROOM, -reach, start[1] + ROOM], [edge[0], 0.0, edge[1]], [0.0, spacing + 2 * reach, 0.0]]
    values = [", ".join(f'"{x:.7g} mm"' for x in v) for v in lengths]
    lines = ["[[vessel]]", f'name = "{name}"', 'shape = "plate"', f"corner = [{values[0]}]", f"first_edge = [{values[1]}]",
             f"second_edge = [{values[2]}]"]
    return "\n".join(lines + (["gate = true"] if gate else [])) + "\n\n"


def vessel_case(spacing):
    """The case with its left and right walls, floor, plate and gate as plates of a vessel in a larger box."""
    text = CASE.read_text(encoding="utf-8")
    begin, end = text.index("[box]"), text.index("[gate]")
    box = (f'[box]\nwidth = "{100 + 2 * ROOM} mm"\ndepth = "{spacing:.7g} mm"\nheight = "{250 + ROOM} mm"\n'
           'left = "open"\nright = "open"\nfloor = "open"\n\n')
    walls = (plate("side_left", (0, 0), (0, 250), spacing) + plate("side_right", (100, 0), (0, 250), spacing) +
             plate("bottom", (0, 0), (100, 0), spacing) + plate("plate_left", (0, 100), (30, 0), spacing) +
             plate("plate_right", (70, 100), (30, 0), spacing) + plate("lid", (30, 100), (40, 0), spacing, gate=True))
    text = text[:begin] + box + walls + text[end:]
    return text.replace('[bed]\n', f'[bed]\nbottom = "{100 + ROOM} mm"\n')


def simulate(folder, name, kind, courant, options):
    out = folder / name.replace(", ", "-").replace(" ", "-")
    settings = {"bed.spacing": f"{options.spacing} mm", "integration.courant": courant, "run.end": f"{options.end} s",
                "output.snapshots": "10 ms", "output.series": "1 ms", "output.pictures": False, "output.report": False}
    case = CASE
    if kind == "vessel":
        case = folder / "vessel.toml"
        case.write_text(vessel_case(options.spacing), encoding="utf-8")
    else:
        settings["box.depth"] = f"{options.spacing} mm"
    return talus.simulate(case, out, settings, threads=options.threads, existing="resume")


def measures(run, kind, spacing):
    """Mass in the bin in time, its plateau rate, what stays above the plate, and the heap in bins across the box."""
    shift = ROOM * 1e-3 if kind == "vessel" else 0.0
    times, below = [], []
    for snapshot in run.snapshots:
        z = np.asarray(snapshot.positions)[:, 2] - shift
        times.append(snapshot.time - run.gate_time)
        below.append(np.mean(z < 0.1))
    times, below = np.array(times), np.array(below)
    mass = 1500 * 0.1 * 83.333333e-3  # kg by m of depth
    steady = (below > 0.1) & (below < 0.5)
    rate = np.polyfit(times[steady], below[steady], 1)[0] * mass
    x, z = (np.asarray(run.snapshots[-1].positions)[:, axis] - shift for axis in (0, 2))
    edges = np.linspace(0, 0.1, BINS + 1)
    heap = [z[(x >= a) & (x < b) & (z < 0.1)].max(initial=0.0) for a, b in zip(edges, edges[1:])]
    height = z[z < 0.1].mean()
    return {"rate": rate, "half": np.interp(0.5, below, times), "left": 1 - below[-1], "height": height,
            "heap": np.array(heap), "curve": (times, below)}


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--spacing", type=float, default=2.5, help="of the particles, mm")
    parser.add_argument("--end", type=float, default=0.8, help="s from the opening of the gate")
    parser.add_argument("--threads", type=int, default=1)
    options = parser.parse_args()
    options.folder.mkdir(parents=True, exist_ok=True)
    found = {}
    for name, (kind, courant) in RUNS.items():
        found[name] = measures(simulate(options.folder, name, kind, courant, options), kind, options.spacing)
    print("| run | discharge, kg/(s m) | half is out, s | stays above, % | mean height in the bin, mm | heap, mm |")
    print("|---|---|---|---|---|---|")
    for name, m in found.items():
        heap = " ".join(f"{1e3 * z:.0f}" for z in m["heap"])
        print(f"| {name} | {m['rate']:.2f} | {m['half']:.4f} | {100 * m['left']:.1f} | {1e3 * m['height']:.2f} | {heap} |")
    for first, second in (("mirrors", "mirrors, step x 0.97"), ("mirrors", "mirrors, step x 0.94"), ("mirrors", "vessel"),
                          ("mirrors", "vessel, step x 0.97"), ("vessel", "vessel, step x 0.97")):
        a, b = found[first], found[second]
        heap = np.sqrt(np.mean((a["heap"] - b["heap"]) ** 2))
        times = np.linspace(0, options.end, 200)
        curve = np.max(np.abs(np.interp(times, *a["curve"]) - np.interp(times, *b["curve"])))
        print(f"{first} / {second}: discharge {100 * (b['rate'] / a['rate'] - 1):+.1f} %, "
              f"bin's mass at most {100 * curve:.1f} % of all apart, heap {1e3 * heap:.2f} mm (root mean square)")


if __name__ == "__main__":
    main()
