#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Short cases on several processes: their checkpoints, series and snapshots hash as those of one process.

    tools/hash_ranks.py build [--ranks 1,2,3,5,8] [--threads 1,2] [--cases wedge,drum]

`build` holds talus and talus-mpi. The exit status is 1 if a run differs from that of talus, if a process ever owns less
than 5 % of the particles, or if in no run of a case a particle changes its process."""
import argparse
import hashlib
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy as np

import hash_cases

SOON, COARSE_HOPPER = hash_cases.SOON, hash_cases.COARSE_HOPPER

# Grains of several sizes that fall through an outlet, splitting above it and merging below.
FALLING = {"levels.count": "1", "levels.distance": "4 mm", "gate.opens": "from-the-start",
           "bed.velocity": '["0 m/s", "0 m/s", "-1 m/s"]'}

# The twelve cases of hash_cases, so long that particles change process, and what they leave out.
CASES = hash_cases.SHORT | {
    "hopper, midpoint rule, strain from displacements": (
        "yuu2011-hopper-printed", {"bed.spacing": "5 mm", "run.end": "20 ms", "output.snapshots": "10 ms",
                                   "output.series": "1 ms", **SOON}),
    "periodic box": ("yuu2011-hopper-vacuum", {**COARSE_HOPPER, **SOON, "box.left": "periodic", "box.right": "periodic",
                                               "box.front": "periodic", "box.rear": "periodic", "run.end": "4 ms"}),
    "shared air": (
        "yuu2011-hopper-air", {**COARSE_HOPPER, **SOON, "air.cell": "1.25 mm", "run.end": "2 ms", "output.series": "0.4 ms"}),
    "shared air in a silo": (
        "silo-cone", {"bed.spacing": "5 mm", "run.end": "4 ms", "output.snapshots": "2 ms", **SOON, "air.enabled": "true",
                      "air.cell": "2.5 mm"}),
    "cohesive grains": ("silo-cone", {"bed.spacing": "5 mm", "run.end": "8 ms", "output.snapshots": "2 ms", **SOON,
                                      "law.critical-state.tensile_strength": "20 Pa",
                                      "law.critical-state.consolidation_strength": "0.1",
                                      "sph.stress_regularisation": "0.5", "walls.adhesion": "10 Pa"}),
    "silo of three sizes": ("silo-cone", {"bed.spacing": "3 mm", "run.end": "16 ms", "output.snapshots": "4 ms", **FALLING,
                                          "levels.count": "2"}),
    "sector of two sizes": ("silo-cone-sector", {"bed.spacing": "2 mm", "run.end": "16 ms", "output.snapshots": "4 ms",
                                                 "removal.below": "48 mm", "box.sector": "60 deg", **FALLING}),
    "cloud in a plane": ("niiya2020-circle", {"particles.count": "1500", "run.end": "0.4 ms",
                                              "output.snapshots": "0.1 ms"}),
    "cloud, spectral sum": ("niiya2020-circle", {"particles.count": "1500", "run.end": "0.4 ms",
                                                 "output.snapshots": "0.1 ms", "fluid.sum": "spectral"}),
}

# As many processes as are asked for, on whatever cores there are.
MPIRUN = ["mpirun", "--oversubscribe", "--bind-to", "none", "--mca", "mpi_yield_when_idle", "1", "--mca", "btl", "self,vader",
          "--mca", "btl_vader_single_copy_mechanism", "none"]
ENVIRONMENT = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
NOT_OF_THE_RUN = {"run/wall_seconds", "run/cpu_seconds"}


def start(ranks, words, **options):
    """Runs a program on so many processes; by itself for None."""
    words = [str(word) for word in words]
    if ranks is not None:
        words = MPIRUN + ["-n", str(ranks)] + words
    return subprocess.run(words, capture_output=True, text=True, check=False, env=ENVIRONMENT, **options)


def newest_checkpoint(folder):
    """The path of the one with the larger sequence number."""
    def sequence(path):
        with open(path, "rb") as file:
            return int(file.read(512).split(b"sequence ")[1].split(b"\n")[0])

    return max(folder.glob("checkpoint_?.h5"), key=sequence)


def hash_of_checkpoint(path):
    """Of every entry but clocks, in the order of their names."""
    digest = hashlib.sha256()
    with h5py.File(path, "r") as file:
        names = []
        file.visit(names.append)
        for name in sorted(names):
            if not isinstance(file[name], h5py.Dataset) or name in NOT_OF_THE_RUN or name.startswith("run/sum"):
                continue
            values = np.ascontiguousarray(file[name][()])
            digest.update(f"{name} {values.shape} {values.dtype}".encode() + values.tobytes())
    return digest.hexdigest()[:16]


def words_of_run(program, folder, case, settings, threads):
    """The command line of a run."""
    words = [program, "run", hash_cases.CASES / f"{case}.toml", "--out", folder, "--threads", threads, "--set",
             "output.pictures=false", "--set", "output.report=false"]
    for key, value in settings.items():
        words += ["--set", f"{key}={value}"]
    return words


def hash_of_run(ranks, build, folder, case, settings, threads=1):
    """Of its last checkpoint, its series and its snapshots; of talus for None processes."""
    program = build / ("talus" if ranks is None else "talus-mpi")
    done = start(ranks, words_of_run(program, folder, case, settings, threads))
    if done.returncode != 0:
        return f"exit status {done.returncode}: {done.stderr[-2000:]}"
    digest = hashlib.sha256((folder / "series.csv").read_bytes())
    for path in sorted((folder / "snapshots").glob("*.vtkhdf")):
        digest.update(path.read_bytes())
    return f"{hash_of_checkpoint(newest_checkpoint(folder))} {digest.hexdigest()[:16]}"


def sharing_of(folder):
    """Of a run on several processes: the least share of the particles that one of them owned, and how many particles
    changed their process, since the run began or was last resumed. Of a cloud, of which each has all grains: None."""
    text = (folder / "log.txt").read_text()
    if "each has all grains" in text:
        return None
    said = re.findall(r"each owned ([\d.]+) to .* (\d+) changed their process", text)[-1]
    return float(said[0]) / 100, int(said[1])


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("build", type=pathlib.Path)
    parser.add_argument("--ranks", default="1,2,3,5,8")
    parser.add_argument("--threads", default="1")
    parser.add_argument("--cases", help="names, or beginnings of them")
    given = parser.parse_args()
    wanted = tuple(given.cases.split(",")) if given.cases else ("",)
    differs = False
    with tempfile.TemporaryDirectory() as scratch:
        for which, (name, (case, settings)) in enumerate(CASES.items()):
            if not name.startswith(wanted):
                continue
            folder = pathlib.Path(scratch) / "run"
            runs = [(None, 1)] + [(int(n), int(t)) for n in given.ranks.split(",") for t in given.threads.split(",")]
            expected, changed, parted = None, 0, False
            line = f"{name:<50}"
            for number, (ranks, threads) in enumerate(runs):
                of_run = folder.with_name(f"{case}-{which}-{number}")
                found = hash_of_run(ranks, given.build.resolve(), of_run, case, settings, threads)
                expected = expected or found
                line += f" {found}" if ranks is None else f"  {ranks}x{threads} {'same' if found == expected else found}"
                differs = differs or found != expected
                if ranks and ranks > 1 and found == expected:
                    sharing = sharing_of(of_run)
                    parted = parted or sharing is not None
                    if sharing:
                        changed += sharing[1]
                        if sharing[0] < 0.05:
                            line, differs = f"{line} (one owned {100 * sharing[0]:.1f} %)", True
            if parted:
                line += f"  {changed} changed their process"
            print(line, flush=True)
            differs = differs or (parted and changed == 0)
    return 1 if differs else 0


if __name__ == "__main__":
    sys.exit(main())
