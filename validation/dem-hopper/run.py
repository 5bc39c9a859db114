#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs hopper.in with LAMMPS (Debian's package lammps): one run of the DEM reference in a folder of its own.

usage: run.py FOLDER [--diameter M] [--seed N] [--rolling MU] [--end S] ...
       run.py FOLDER --hopper-of RUN [--end S]

A folder with a checkpoint is resumed, to a later --end if one is given; its other options are then those that it was
begun with. With --hopper-of the run goes on from the newest checkpoint of another one without what has fallen below the
plate, which what lies on the plate does not feel: heaps of fine beads come to rest at a tenth of the cost.

On one core about 8 million bead steps a second. With --processes the box is divided along its width, by MPI; sums are
then in another order, so that the beads part from those of one process.
"""
import argparse
import json
import os
import shutil
import subprocess
import sys
from pathlib import Path

HERE = Path(__file__).resolve().parent
MASS, DENSITY = 12.5, 2500.0  # kg of grains per m of depth: 62.5 g in 5 mm; kg/m³
FRAME = 2e-3  # s
#: Names of the variables of hopper.in and what they are, in SI.
OPTIONS = {"diameter": ("d", 1.25e-3, "mean diameter of the beads, m"),
           "depth": ("depth", None, "of the periodic slice, m; left out: four diameters"),
           "seed": ("seed", 1, "of places and diameters"),
           "friction": ("mu", 0.5, "bead on bead"),
           "wall-friction": ("muwall", 0.3, "bead on wall"),
           "rolling": ("rolling", 0.0, "rolling friction; 0: none"),
           "stiffness": ("stiffness", 1.0, "of the springs, times 1000 N/m at 1.25 mm"),
           "restitution": ("restitution", 0.8, "of two beads"),
           "end": ("end", 0.5, "s from the opening of the gate")}


def newest_checkpoint(folder):
    """The newest of a run's restart files; None if there is none."""
    found = [path for path in folder.glob("restart.*") if path.stat().st_size > 0]
    return max(found, key=lambda path: path.stat().st_mtime, default=None)


def arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    for name, (_, initial, text) in OPTIONS.items():
        parser.add_argument(f"--{name}", type=int if name == "seed" else float, help=f"{text} (initially {initial})")
    parser.add_argument("--hopper-of", type=Path, help="a run, whose hopper this one begins with")
    parser.add_argument("--processes", type=int, default=1, help="that share the beads")
    return vars(parser.parse_args())


def begin_with_hopper_of(other, folder):
    """A new folder with the newest checkpoint and the parameters of another run."""
    checkpoint = newest_checkpoint(other)
    if not checkpoint:
        sys.exit(f"{other}: has no checkpoint to go on from")
    (folder / "frames").mkdir(parents=True, exist_ok=True)
    shutil.copy(HERE / "hopper.in", folder)
    shutil.copy(checkpoint, folder / "restart.begin")
    parameters = json.loads((other / "parameters.json").read_text(encoding="utf-8"))
    (folder / "parameters.json").write_text(json.dumps({**parameters, "hopper-of": other.name}, indent=1) + "\n",
                                            encoding="utf-8")


def main():
    given = arguments()
    folder, processes, other = given.pop("folder"), given.pop("processes"), given.pop("hopper_of")
    if other and not newest_checkpoint(folder):
        begin_with_hopper_of(other, folder)
    given = {name.replace("_", "-"): value for name, value in given.items() if value is not None}
    checkpoint, record = newest_checkpoint(folder), folder / "parameters.json"
    if checkpoint:
        parameters = json.loads(record.read_text(encoding="utf-8"))
        changed = [name for name, value in given.items() if name != "end" and value != parameters[name]]
        if changed:
            sys.exit(f"{folder}: was begun with other values of {', '.join(changed)}; take another folder")
        parameters["end"] = given.get("end", parameters["end"])
    else:
        parameters = {name: given.get(name, initial) for name, (_, initial, _) in OPTIONS.items()}
        parameters["depth"] = parameters["depth"] or 4 * parameters["diameter"]
        (folder / "frames").mkdir(parents=True, exist_ok=True)
        shutil.copy(HERE / "hopper.in", folder)
    record.write_text(json.dumps(parameters, indent=1) + "\n", encoding="utf-8")
    if not shutil.which("lmp"):
        sys.exit("lmp: not found; Debian's package is called lammps")
    if processes > 1 and not shutil.which("mpirun"):
        sys.exit("mpirun: not found; Debian's package is called openmpi-bin")
    beads = MASS * parameters["depth"] / (DENSITY * 0.5236 * 1.01 * parameters["diameter"]**3)
    print(f"{beads:.0f} beads{', those above the plate' if 'hopper-of' in parameters else ''}; "
          f"progress in {folder}/{'resumed' if checkpoint else 'lammps'}.log", flush=True)
    shared = ["mpirun", "--oversubscribe", "-np", str(processes)] if processes > 1 else []
    command = [*shared, "lmp", "-in", "hopper.in", "-screen", "none", "-log", "lammps.log"]
    for name, (variable, _, _) in OPTIONS.items():
        command += ["-var", variable, f"{parameters[name]:.10g}"]
    if checkpoint:
        command[command.index("lammps.log")] = "resumed.log"
        command += ["-var", "resumed", "1", "-var", "restart", checkpoint.name]
    if "hopper-of" in parameters:
        command += ["-var", "alone", "1"]
    sys.exit(subprocess.run(command, cwd=folder, env={**os.environ, "OMP_NUM_THREADS": "1"}).returncode)


main()
