#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Twelve short cases as hashes of their results: values of the series and the snapshots in their order, names left out.

    tools/hash_cases.py build/talus                 a hash for each case
    tools/hash_cases.py build/talus OTHER/talus     both programs: bitwise identical, or the largest relative difference

Timings are left out. The exit status is 1 if a case differs. Hashes hold for one instruction set."""
import csv
import hashlib
import pathlib
import subprocess
import sys
import tempfile

import h5py
import numpy as np

CASES = pathlib.Path(__file__).resolve().parents[1] / "cases"
SOON = {"settle.damping_time": "1 ms", "settle.speed": "1 m/s", "settle.duration": "0.2 ms"}
COARSE_HOPPER = {"bed.spacing": "5 mm", "run.end": "8 ms", "output.snapshots": "2 ms", "output.series": "0.2 ms"}

# name: (case, what differs in the short run)
SHORT = {
    "hopper, vacuum": ("yuu2011-hopper-vacuum", {**COARSE_HOPPER, **SOON}),
    "hopper, vacuum, single precision": ("yuu2011-hopper-vacuum-fast", {**COARSE_HOPPER, **SOON}),
    "hopper, air": ("yuu2011-hopper-air", {**COARSE_HOPPER, **SOON, "air.cell": "5 mm"}),
    "hopper, midpoint rule, strain from displacements": (
        "yuu2011-hopper-printed", {"bed.spacing": "5 mm", "run.end": "0.1 ms", "output.snapshots": "0.02 ms",
                                   "output.series": "0.002 ms", **SOON}),
    "wedge": ("wedge-hopper", {"bed.height": "60 mm", "run.end": "4 ms", "output.snapshots": "2 ms", **SOON}),
    "silo of round walls": ("silo-cone", {"bed.spacing": "5 mm", "run.end": "8 ms", "output.snapshots": "2 ms", **SOON}),
    "sector of a silo": ("silo-cone-sector", {"bed.spacing": "4 mm", "run.end": "8 ms", "output.snapshots": "2 ms", **SOON}),
    "silo of triangles": ("silo-square", {"bed.spacing": "6 mm", "run.end": "8 ms", "output.snapshots": "2 ms", **SOON}),
    "drum": ("drum", {"bed.spacing": "6 mm", "run.end": "8 ms", "output.snapshots": "2 ms", **SOON}),
    "chute with inlet and removal": ("chute-bend", {"bed.spacing": "4 mm", "run.end": "60 ms", "output.snapshots": "20 ms"}),
    "cloud in a plane": ("niiya2020-circle", {"particles.count": "300", "run.end": "1 ms", "output.snapshots": "0.2 ms"}),
    "cloud in space, single precision": ("avalanche-3d", {"particles.count": "2000", "run.end": "0.1 ms",
                                                          "output.snapshots": "0.02 ms"}),
}


def run(program, folder, case, settings):
    """Values of a run, a list of arrays: columns of the series, then columns of each snapshot."""
    words = [program, "run", CASES / f"{case}.toml", "--out", folder, "--threads", "2", "--set", "output.pictures=false",
             "--set", "output.report=false"]
    for key, value in settings.items():
        words += ["--set", f"{key}={value}"]
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, check=False)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}: exit status {done.returncode}\n{done.stderr[-2000:]}")
    with open(folder / "series.csv", newline="", encoding="utf-8") as file:
        rows = list(csv.reader(file))[1:]
    found = [np.array(column, dtype=float) for column in zip(*rows)]
    for path in sorted((folder / "snapshots").glob("*.vtkhdf")):
        with h5py.File(path, "r") as file:
            data = []
            file.visititems(lambda name, item, data=data: data.append(item[()]) if isinstance(item, h5py.Dataset) else None)
        found += [np.asarray(column) for column in data if np.asarray(column).dtype.kind in "fiu"]
    return found


def hash_of(values):
    """Independent of the order in which names sort: hashes of the columns, sorted."""
    columns = sorted(hashlib.sha256(np.ascontiguousarray(column).tobytes()).hexdigest() for column in values)
    return hashlib.sha256("".join(columns).encode()).hexdigest()[:16]


def difference(one, other):
    """Largest difference of two runs over the largest size in the column; infinite if they have other shapes."""
    if len(one) != len(other):
        return float("inf")
    largest = 0.0
    for a, b in zip(one, other):
        if a.shape != b.shape or np.any(np.isfinite(a) != np.isfinite(b)):
            return float("inf")
        both = np.isfinite(a)
        scale = np.max(np.abs(a[both]), initial=0)
        if scale > 0:
            largest = max(largest, np.max(np.abs(np.subtract(a[both], b[both], dtype=float))) / scale)
    return largest


def main():
    programs = [pathlib.Path(word).resolve() for word in sys.argv[1:]]
    if len(programs) not in (1, 2):
        sys.exit(__doc__)
    differs = False
    with tempfile.TemporaryDirectory() as scratch:
        for number, (name, (case, settings)) in enumerate(SHORT.items()):
            runs = [run(program, pathlib.Path(scratch) / f"{number}-{which}", case, settings)
                    for which, program in enumerate(programs)]
            hashes = [hash_of(values) for values in runs]
            line = f"{name:<50} {hashes[0]}"
            if len(runs) == 2 and hashes[0] != hashes[1]:
                differs = True
                line += f" {hashes[1]}  differs by {difference(*runs):.1e}"
            elif len(runs) == 2:
                line += "  bitwise identical"
            print(line, flush=True)
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main())
