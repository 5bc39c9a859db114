#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A round column of discrete beads (beads_column.in), measured as materials.py measures the law's columns.

usage: beads.py run FOLDER [--radius N] [--floor bumps]   with LAMMPS, each rolling friction of reference.toml
       beads.py law FOLDER                                column.toml with the law's numbers for these beads
       beads.py measure FOLDER                            the runs in it, to data/beads_column.csv
       beads.py table                                     data/beads_column.csv in Markdown, with the bands

A run that is done is not made again. About a quarter of an hour a run on one core."""
import argparse
import csv
import json
import os
import subprocess
from pathlib import Path

import materials
import numpy as np
import talus

TABLE = materials.HERE / "data" / "beads_column.csv"
DIAMETER = 1.25e-3  # m, as in beads_column.in
BEADS = materials.REFERENCE["beads"]
#: Columns of the table by what they are called in Markdown; those of the settings first.
COLUMNS = {"radius": "r0/d", "rolling": "rolling friction", "floor": "floor", "settled_with": "friction in filling",
           "seed": "seed", "beads": "beads", "aspect": "a", "packing": "packing", "runout": "run-out",
           "height": "height", "slope": "slope, degrees", "runout_99": "run-out of 99 % of the mass", "stray": "stray"}
FLOORS = {"flat": 0, "bumps": 1}


def lammps(folder, settings):
    """Runs beads_column.in in a folder of its own, unless that was done."""
    done = folder / "settings.json"
    if done.exists():
        return
    (folder / "frames").mkdir(parents=True, exist_ok=True)
    command = ["lmp", "-in", materials.HERE / "beads_column.in", "-log", "lammps.log", "-screen", "none"]
    for name in ("radius", "rolling", "seed"):
        command += ["-var", name, f"{settings[name]:g}"]
    command += ["-var", "musettle", f"{settings['settled_with']:g}", "-var", "bumps", str(FLOORS[settings["floor"]])]
    subprocess.run(command, cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"}, check=True)
    done.write_text(json.dumps(settings) + "\n", encoding="utf-8")


def frames(folder):
    """Files of the frames in the order of time."""
    return sorted((folder / "frames").glob("*.txt"), key=lambda path: int(path.stem))


def read(path):
    """Radii, places and velocities of the beads of a frame, SI."""
    table = np.loadtxt(path, skiprows=9)
    return table[:, 0], table[:, 1:4], table[:, 4:7]


def measure(first, last, radius):
    """Numbers of a column by their names in COLUMNS. \\param first, last what read() gives, when the tube goes and at
    rest \\param radius of the column, m"""
    r, x, _ = first
    height = 2 * np.average(x[:, 2], weights=r ** 3)
    packing = np.sum(4 / 3 * np.pi * r ** 3) / (np.pi * radius ** 2 * height)
    r, x, velocity = last
    foot, top, on = materials.round_deposit(x, DIAMETER, radius)
    order = np.argsort(np.hypot(*x[:, :2].T))
    mass = np.cumsum(r[order] ** 3)
    share = np.hypot(*x[order[np.searchsorted(mass, 0.99 * mass[-1])], :2])
    return {"beads": len(first[0]), "aspect": height / radius, "packing": packing, "runout": foot / radius - 1,
            "height": top / radius, "slope": materials.slope_of_heap(x, DIAMETER)[0], "runout_99": share / radius - 1,
            "stray": materials.stray_share(x, velocity, on, DIAMETER)}


def run(options):
    for rolling in options.rolling:
        settings = {"radius": options.radius, "rolling": rolling, "floor": options.floor,
                    "settled_with": options.settled_with, "seed": options.seed}
        lammps(options.folder / "-".join(f"{name}-{value}" for name, value in settings.items()), settings)


def law(options):
    """Prints run-out, height, slope and strays of the law's columns."""
    for name, numbers in BEADS["law"].items():
        settings = {"grains.material": "glass-beads", "bed.spacing": f"{materials.spacing_of('column', 1.0):g} mm",
                    "bed.height": "60 mm", "bed.packing": BEADS["packing"],
                    "grains.diameter": f"{1e3 * materials.SETUP['column_radius'] / BEADS['radius']:.6g} mm"}
        settings |= {f"law.critical-state.{key}": value for key, value in numbers.items()}
        run_ = talus.simulate(materials.HERE / "column.toml", options.folder / f"law-{name}", settings, threads=1,
                              existing="resume", program=options.program)
        of, _ = materials.measure_run(run_, "column", 1.0)
        box = run_.case["box"]
        x = np.asarray(run_.snapshots[-1].positions) - 0.5 * np.array([box["width"], box["depth"], 0])
        slope, _, _ = materials.slope_of_heap(x, 1e-3 * materials.spacing_of("column", 1.0))
        print(f"| {name} | {of['column-runout-1']:.3f} | {of['column-height-1']:.3f} | {slope:.1f} | "
              f"{of['stray']:.3g} |")


def measure_all(options):
    rows = []
    for path in options.folder.glob("*/settings.json"):
        settings = json.loads(path.read_text(encoding="utf-8"))
        of = frames(path.parent)
        numbers = measure(read(of[0]), read(of[-1]), settings["radius"] * DIAMETER)
        rows.append(settings | {name: f"{value:.5g}" for name, value in numbers.items()})
    TABLE.parent.mkdir(exist_ok=True)
    with open(TABLE, "w", encoding="utf-8", newline="") as out:
        writer = csv.DictWriter(out, COLUMNS, lineterminator="\n")
        writer.writeheader()
        writer.writerows(sorted(rows, key=lambda row: [row[name] for name in list(COLUMNS)[:5]]))


def for_small_beads(rows, name):
    """Value and standard error of a number as d/r0 goes to 0: a line through the runs. \\param rows of the table, of
    beads and floors that are the same"""
    share = 1 / np.array([float(row["radius"]) for row in rows])
    line, errors = np.polyfit(share, [float(row[name]) for row in rows], 1, cov=True)
    return line[1], np.sqrt(errors[1, 1])


def table(_):
    """In bold: outside of the band."""
    with open(TABLE, encoding="utf-8") as file:
        rows = list(csv.DictReader(file))
    print("| " + " | ".join(COLUMNS.values()) + " |\n|" + "---|" * len(COLUMNS))
    for row in rows:
        cells = dict(row)
        for name in ("runout", "height"):
            low, high = materials.BANDS[f"column-{name}-1"]
            if not low <= float(row[name]) <= high:
                cells[name] = f"**{row[name]}**"
        print("| " + " | ".join(cells.values()) + " |")
    alike = [row for row in rows if (row["rolling"], row["floor"], row["settled_with"]) == ("0.1", "bumps", "0.15")]
    if len(alike) > 3:
        for name in ("runout", "height"):
            value, error = for_small_beads(alike, name)
            print(f"{COLUMNS[name]} of small beads, rolling friction 0.1, floor of beads: {value:.3f} +- {error:.3f}")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = parser.add_subparsers(required=True)
    part = parts.add_parser("run")
    part.add_argument("folder", type=Path)
    part.add_argument("--radius", type=int, default=BEADS["radius"], help="in diameters")
    part.add_argument("--rolling", type=float, nargs="+", default=BEADS["rolling"], help="friction")
    part.add_argument("--settled-with", type=float, default=0.15, help="friction while the tube is filled")
    part.add_argument("--seed", type=int, default=1)
    part.add_argument("--floor", choices=FLOORS, default="flat")
    part.set_defaults(do=run)
    part = parts.add_parser("law")
    part.add_argument("folder", type=Path)
    part.add_argument("--program", help="left out: as talus.find_program says")
    part.set_defaults(do=law)
    part = parts.add_parser("measure")
    part.add_argument("folder", type=Path)
    part.set_defaults(do=measure_all)
    parts.add_parser("table").set_defaults(do=table)
    options = parser.parse_args()
    options.do(options)
