#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Beads of LAMMPS as a folder that `talus picture`, `talus movie`, python/talus and ParaView read like that of a run.

usage: as_run.py RUN FOLDER [--every 10]

RUN is a folder of run.py; FOLDER gets snapshots of the beads (places, velocities, radii; every 10th frame, 20 ms, if not
said otherwise), and the walls and the gate of cases/yuu2011-hopper-vacuum.toml. The dumps hold no place along the slit:
all beads are put into the middle of the depth.
"""
import argparse
import json
import re
from pathlib import Path

import h5py
import numpy as np

import frames as referee

CASE = Path(__file__).resolve().parents[2] / "cases/yuu2011-hopper-vacuum.toml"
QUANTITY = re.compile(r'"([0-9.]+) ([mu])([ms])"')  # in thousandths or millionths of a metre or a second
VERTEX = 1  # VTK's number of a cell that is one point


def case_text():
    """The case of the hopper in SI, as in every manifest; nothing uses its bed and its law, which are not those of beads."""
    return QUANTITY.sub(lambda q: f'"{float(q[1]) * {"m": 1e-3, "u": 1e-6}[q[2]]:.12g} {q[3]}"', CASE.read_text("utf-8"))


def write_snapshot(path, frame):
    """A file of VTKHDF 1.0, as src/io/vtkhdf.cpp writes it: unstructured, every bead a vertex."""
    count = len(frame.x)
    points = np.column_stack([frame.x, np.full(count, 0.5 * referee.DEPTH), frame.z])
    with h5py.File(path, "w") as file:
        root = file.create_group("VTKHDF")
        root.attrs["Version"] = np.array([1, 0])
        root.attrs.create("Type", np.bytes_("UnstructuredGrid"))
        for name in ("NumberOfPoints", "NumberOfCells", "NumberOfConnectivityIds"):
            root[name] = np.array([count])
        root["Connectivity"], root["Offsets"] = np.arange(count), np.arange(count + 1)
        root["Types"] = np.full(count, VERTEX, np.uint8)
        for group, name, values, unit in (("", "Points", points, "m"), ("FieldData/", "TimeValue", [frame.time], "s"),
                                          ("FieldData/", "time", [frame.time], "s"),
                                          ("PointData/", "velocity", frame.velocity, "m/s"),
                                          ("PointData/", "radius", frame.radius, "m")):
            root[group + name] = np.asarray(values, float)
            root[group + name].attrs.create("units", np.bytes_(unit))


def write(run, folder, every):
    """The folder of a run of beads. \\returns how many snapshots it has"""
    snapshots = folder / "snapshots"
    snapshots.mkdir(parents=True)
    numbers = [number for number in sorted(run.steps) if number % every == 0]
    files = []
    for n, number in enumerate(numbers):
        frame = run.frame(number)
        name = f"particles_{n:04d}.vtkhdf"
        write_snapshot(snapshots / name, frame)
        files.append({"name": name, "time": frame.time})
    (snapshots / "particles.hdf.series").write_text(json.dumps({"file-series-version": "1.0", "files": files}, indent=2))
    # The gate opens at the first frame, at time 0.
    rows = "".join(f"{file['time']:.9g},0\n" for file in files)
    (folder / "series.csv").write_text("time [s],gate_time [s]\n" + rows, encoding="utf-8")
    manifest = {"program": "talus", "version": "", "revision": "", "compiler": "", "libraries": {},
                "machine": {"processor": "", "cores": 1, "system": ""}, "started": "", "threads": 1,
                "instruction_set": "", "seed": run.parameters["seed"], "fingerprint": "beads of LAMMPS",
                "case": case_text()}
    (folder / "manifest.json").write_text(json.dumps(manifest, indent=2), encoding="utf-8")
    return len(files)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run", type=Path)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--every", type=int, default=10, help="frames of 2 ms between two snapshots (initially 10)")
    given = parser.parse_args()
    if given.folder.exists():
        parser.error(f"{given.folder} is there already")
    count = write(referee.Run(given.run), given.folder, given.every)
    print(f"{count} snapshots in {given.folder}")


if __name__ == "__main__":
    main()
