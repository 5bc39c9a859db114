#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""A round column of discrete beads (beads_column.in), measured as materials.py measures the law's columns.

usage: beads.py run FOLDER [--radius N] [--floor bumps]   with LAMMPS, one run for each rolling friction of reference.toml
       beads.py measure FOLDER                            the runs in it, to data/beads_column.csv
       beads.py table                                     data/beads_column.csv in Markdown, with the bands

A run that is done is not made again. About a quarter of an hour a run on one core."""
import argparse
import csv
import json
import subprocess
from pathlib import Path

import materials
import numpy as np

TABLE = materials.HERE / "data" / "beads_column.csv"
DIAMETER = 1.25e-3  # m, as in beads_column.in
COLUMNS = ("radius", "seed", "rolling", "floor", "beads", "aspect", "packing", "runout", "height", "runout_99", "stray")
FLOORS = {"flat": 0, "bumps": 1}


def lammps(folder, settings):
    """Runs beads_column.in in a folder of its own, unless that was done."""
    if (folder / "settings.json").exists():
        return
    (folder / "frames").mkdir(parents=True, exist_ok=True)
    words = [word for name, value in settings.items() for word in ("-var", name, f"{value:g}")]
    subprocess.run(["lmp", "-in", materials.HERE / "beads_column.in", "-log", "lammps.log", "-screen", "none", *words],
                   cwd=folder, check=True)
    (folder / "settings.json").write_text(json.dumps(settings) + "\n", encoding="utf-8")


def frames(folder):
    """Files of the frames in the order of time."""
    return sorted((folder / "frames").glob("*.txt"), key=lambda path: int(path.stem))


def read(path):
    """Radii, places and velocities of the beads of a frame, SI."""
    table = np.loadtxt(path, skiprows=9)
    return table[:, 0], table[:, 1:4], table[:, 4:7]


def measure(first, last, radius):
    """Numbers of a column by the names in COLUMNS. \\param first, last what read() gives, at the removal of the tube and at
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
            "height": top / radius, "runout_99": share / radius - 1,
            "stray": materials.stray_share(x, velocity, on, DIAMETER)}


def run(options):
    for rolling in materials.REFERENCE["beads"]["rolling"]:
        name = f"r{rolling:g}-{options.radius:g}-{options.floor}-s{options.seed}"
        lammps(options.folder / name, {"rolling": rolling, "radius": options.radius, "bumps": FLOORS[options.floor],
                                       "seed": options.seed})


def measure_all(options):
    rows = []
    for path in sorted(options.folder.glob("*/settings.json")):
        settings = json.loads(path.read_text(encoding="utf-8"))
        of = frames(path.parent)
        numbers = measure(read(of[0]), read(of[-1]), settings["radius"] * DIAMETER)
        rows.append({**settings, "floor": "bumps" if settings["bumps"] else "flat", **numbers})
    TABLE.parent.mkdir(exist_ok=True)
    with open(TABLE, "w", encoding="utf-8", newline="") as out:
        writer = csv.writer(out, lineterminator="\n")
        writer.writerow(COLUMNS)
        for row in sorted(rows, key=lambda row: [row[name] for name in COLUMNS[:4]]):
            writer.writerow([value if isinstance(value, str) else f"{value:.4g}" for value in (row[name] for name in COLUMNS)])


def table(_):
    """In bold: outside of the band."""
    def cell(name, value):
        low, high = materials.BANDS[f"column-{name}-1"]
        return f"{value:.3f}" if low <= value <= high else f"**{value:.3f}**"

    print("| rolling friction | r0/d | floor | seed | beads | a | packing | run-out | of 99 % of the mass | height | stray |")
    print("|" + "---|" * 11)
    with open(TABLE, encoding="utf-8") as file:
        for row in csv.DictReader(file):
            print(f"| {row['rolling']} | {row['radius']} | {row['floor']} | {row['seed']} | {row['beads']} | "
                  f"{float(row['aspect']):.3f} | {float(row['packing']):.3f} | {cell('runout', float(row['runout']))} | "
                  f"{float(row['runout_99']):.3f} | {cell('height', float(row['height']))} | {row['stray']} |")


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parts = parser.add_subparsers(required=True)
    part = parts.add_parser("run")
    part.add_argument("folder", type=Path)
    part.add_argument("--radius", type=float, default=materials.REFERENCE["beads"]["radius"], help="in diameters")
    part.add_argument("--seed", type=int, default=1)
    part.add_argument("--floor", choices=FLOORS, default="flat")
    part.set_defaults(do=run)
    part = parts.add_parser("measure")
    part.add_argument("folder", type=Path)
    part.set_defaults(do=measure_all)
    parts.add_parser("table").set_defaults(do=table)
    options = parser.parse_args()
    options.do(options)
