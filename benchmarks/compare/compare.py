#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Whole runs of the hopper beside LAMMPS, LIGGGHTS and OpenFOAM's twoPhaseEulerFoam, one thread each, in turn.

usage: compare.py FOLDER [--talus PROGRAM] [--seconds S] [--rounds N]

Each program first makes what its flow starts from (a settled bed), which is not counted, then computes --seconds of flow
after the opening of the gate. The processor time of that is what is compared, the least of --rounds. Prints a table, and
writes it to FOLDER/table.md. A program that is not there is left out and named.
"""
import argparse
import math
import os
import re
import resource
import shutil
import subprocess
import sys
from pathlib import Path

import openfoam_case

HERE = Path(__file__).resolve().parent
ROOT = HERE.parents[1]
DIAMETER, LAYERS = 2e-3, 4  # of the beads, m, and how many fit in the periodic slice: as many beads as Talus has particles
RESTITUTION, DENSITY = 0.8, 2500.0
ONE_THREAD = {**os.environ, "OMP_NUM_THREADS": "1"}


def execute(command, folder, log, environment=None):
    """Runs a program in a folder. Returns its processor time, s; ends all if it fails."""
    before = resource.getrusage(resource.RUSAGE_CHILDREN)
    with open(Path(folder) / log, "w", encoding="utf-8") as file:
        status = subprocess.run([str(part) for part in command], cwd=folder, env=environment or ONE_THREAD, stdout=file,
                                stderr=subprocess.STDOUT).returncode
    after = resource.getrusage(resource.RUSAGE_CHILDREN)
    if status:
        sys.exit(f"{command[0]}: exit status {status}; see {Path(folder) / log}")
    return after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime


class Talus:
    """A case, continued from its settled bed. Counted is the time loop, as the run's log has it: analysis, pictures and
    report at the end take some seconds whatever the length of the run."""

    def __init__(self, program, case, title, air):
        self.program, self.case, self.title, self.air = program, case, title, air

    def missing(self):
        return None if Path(self.program).exists() else f"{self.program} (cmake --build build)"

    def prepare(self, folder):
        execute([self.program, "run", ROOT / "cases" / f"{self.case}.toml", "--threads", 1, "--out", "settled", "--set",
                 "run.end=0.1 ms"], folder, "settle.log")
        execute([self.program, "check", ROOT / "cases" / f"{self.case}.toml"], folder, "check.log")
        scales = (folder / "check.log").read_text(encoding="utf-8")
        self.particles = int(re.search(r"^ *particles +(\d+)", scales, re.MULTILINE)[1])

    def measure(self, folder, seconds):
        shutil.rmtree(folder / "run", ignore_errors=True)
        shutil.copytree(folder / "settled", folder / "run")
        execute([self.program, "run", ROOT / "cases" / f"{self.case}.toml", "--threads", 1, "--out", "run", "--resume",
                 "--set", f"run.end={seconds} s"], folder, "run.log")
        log = (folder / "run/log.txt").read_text(encoding="utf-8")
        before, after = ((int(steps), float(time)) for steps, time in
                         re.findall(r"done: t = .*, (\d+) steps, .* ([\d.]+) s of processor", log))
        return after[1] - before[1], after[0] - before[0], self.particles


class Lammps:
    title, air = "LAMMPS, discrete elements", "none"

    def missing(self):
        return None if shutil.which("lmp") else "lmp (tools/install_packages referee)"

    def prepare(self, folder):
        run_lammps(folder / "settled", 0)

    def measure(self, folder, seconds):
        shutil.rmtree(folder / "run", ignore_errors=True)
        shutil.copytree(folder / "settled", folder / "run")
        time = run_lammps(folder / "run", seconds)
        return time, *last_loop((folder / "run/resumed.log").read_text(encoding="utf-8"))


def run_lammps(folder, end):
    folder.parent.mkdir(parents=True, exist_ok=True)
    options = ["--end", end] + ([] if folder.exists() else ["--diameter", DIAMETER, "--depth", LAYERS * DIAMETER])
    return execute([ROOT / "validation/dem-hopper/run.py", folder, *options], folder.parent, "run.log")


def last_loop(log):
    """Steps and atoms of the last run of a log of LAMMPS or LIGGGHTS that made a step."""
    loops = [(int(steps), int(atoms)) for steps, atoms in
             re.findall(r"Loop time of \S+ on \d+ procs for (\d+) steps with (\d+) atoms", log)]
    return next(loop for loop in reversed(loops) if loop[0] > 0)


class Liggghts:
    title, air = "LIGGGHTS, discrete elements", "none"

    def missing(self):
        return None if shutil.which("liggghts") else "liggghts (tools/install_packages compare)"

    def prepare(self, folder):
        if not shutil.which("lmp"):
            sys.exit("lmp makes the settled beads of LIGGGHTS: tools/install_packages referee")
        run_lammps(folder / "settled", 0)
        execute(["lmp", "-in", HERE / "beads.in", "-var", "restart", "settled/restart.settled"], folder, "beads.log")
        beads = [line.split() for line in (folder / "beads.txt").read_text(encoding="utf-8").split("id", 1)[1].splitlines()[1:]]
        depth = LAYERS * DIAMETER
        rows = "\n".join(f"{number} 1 {2 * float(radius):.9g} {DENSITY} {x} {float(y) % depth:.9g} {z}"
                         for number, radius, x, y, z in beads)
        (folder / "beads.data").write_text(
            f"settled beads\n\n{len(beads)} atoms\n1 atom types\n0 0.1 xlo xhi\n0 {depth} ylo yhi\n-0.002 0.26 zlo zhi\n\n"
            f"Atoms\n\n{rows}\n", encoding="utf-8")
        (folder / "plate.stl").write_text(plate(depth), encoding="utf-8")

    def measure(self, folder, seconds):
        # The springs and the step of validation/dem-hopper/hopper.in. LIGGGHTS's linear model takes the stiffness from a
        # Young's modulus and a velocity v: k = (16 R^1/2 Y/15)^(4/5) (m v²)^(1/5), R, m, Y those of the pair.
        stiffness, mass, radius = 1000 * DIAMETER / 1.25e-3, DENSITY * math.pi / 12 * DIAMETER**3, DIAMETER / 4
        pair_modulus = (stiffness / mass**0.2)**1.25 * 15 / 16 / math.sqrt(radius)
        beta = -math.log(RESTITUTION) / math.hypot(math.pi, math.log(RESTITUTION))
        step = math.pi / math.sqrt(stiffness / mass * (1 - beta**2)) / 20
        steps = round(seconds / step)
        time = execute(["liggghts", "-in", HERE / "liggghts.in", "-var", "modulus", 2 * pair_modulus, "-var", "skin",
                        0.15 * DIAMETER, "-var", "dt", step, "-var", "steps", steps], folder, "run.log")
        return time, *last_loop((folder / "run.log").read_text(encoding="utf-8"))


def plate(depth):
    """The plate as triangles, in the format of STL."""
    corners = [(left, right) for left, right in ((-0.01, 0.03), (0.07, 0.11))]
    facets = []
    for left, right in corners:
        a, b, c, d = ((x, y, 0.1) for x, y in ((left, -depth), (right, -depth), (right, 2 * depth), (left, 2 * depth)))
        facets += [(a, b, c), (a, c, d)]
    text = "".join("facet normal 0 0 1\nouter loop\n" + "".join(f"vertex {x} {y} {z}\n" for x, y, z in facet)
                   + "endloop\nendfacet\n" for facet in facets)
    return f"solid plate\n{text}endsolid plate\n"


class OpenFoam:
    """Steps under the solver's own bound, a Courant number of 0.5, which the slip of what little falls through the free air
    decides; with steps of 0.1 ms it ends on a negative temperature."""

    title, air = "OpenFOAM twoPhaseEulerFoam, two continua", "80 x 4 x 200 cells"
    longest = 0.02  # s; its steps take minutes

    def missing(self):
        return None if shutil.which("twoPhaseEulerFoam") else "twoPhaseEulerFoam (tools/install_packages compare)"

    # Debian's programs look for their settings there; they warn of a PWD that is not the folder they are started in.
    environment = {name: value for name, value in ONE_THREAD.items() if name != "PWD"} | {
        "WM_PROJECT_DIR": "/usr/share/openfoam"}

    def prepare(self, folder):
        pass

    def measure(self, folder, seconds):
        seconds = min(seconds, self.longest)
        shutil.rmtree(folder / "case", ignore_errors=True)
        openfoam_case.write(folder / "case", seconds)
        for tool in ("blockMesh", "setFields"):
            execute([tool], folder / "case", f"{tool}.log", self.environment)
        time = execute(["twoPhaseEulerFoam"], folder / "case", "run.log", self.environment)
        steps = len(re.findall(r"^Time = ", (folder / "case/run.log").read_text(encoding="utf-8"), re.MULTILINE))
        return time, steps, 64000


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder", type=Path)
    parser.add_argument("--talus", default=ROOT / "build/talus")
    parser.add_argument("--seconds", type=float, default=0.05)
    parser.add_argument("--rounds", type=int, default=1)
    options = parser.parse_args()
    # Programs are started in folders of their own.
    options.folder, options.talus = options.folder.resolve(), Path(options.talus).resolve()
    hopper = "yuu2011-hopper-"
    programs = {"talus-vacuum": Talus(options.talus, f"{hopper}vacuum", "Talus, continuum", "none"),
                "talus-vacuum-fast": Talus(options.talus, f"{hopper}vacuum-fast", "Talus, continuum, softer grains", "none"),
                "lammps": Lammps(), "liggghts": Liggghts(),
                "talus-air": Talus(options.talus, f"{hopper}air", "Talus, continuum", "80 x 4 x 200 cells"),
                "talus-air-fast": Talus(options.talus, f"{hopper}air-fast", "Talus, continuum, softer grains",
                                        "80 x 1 x 200 cells"),
                "openfoam": OpenFoam()}
    absent = {name: program.missing() for name, program in programs.items() if program.missing()}
    for name, reason in absent.items():
        print(f"{name}: left out, without {reason}", flush=True)
        del programs[name]
    for name, program in programs.items():
        folder = options.folder / name
        if folder.exists():
            sys.exit(f"{folder}: exists; take another folder")
        folder.mkdir(parents=True)
        print(f"{name}: making what it starts from", flush=True)
        program.prepare(folder)
    best = {}
    for turn in range(options.rounds):
        for name, program in programs.items():
            time, steps, elements = program.measure(options.folder / name, options.seconds)
            span = min(options.seconds, getattr(program, "longest", options.seconds))
            print(f"{name}: round {turn + 1}, {time:.1f} s of processor for {span} s, {steps} steps", flush=True)
            best[name] = min(best.get(name, (math.inf,)), (time / span, steps / span, elements, steps * elements / time))
    lines = ["| program | elements | air | steps a second | processor time a second | element steps a second | over Talus |",
             "|---|---|---|---|---|---|---|"]
    for name, (cost, rate, elements, speed) in best.items():
        program = programs[name]
        own = best.get("talus-vacuum" if program.air == "none" else "talus-air", (math.nan,))[0]
        lines.append(f"| {program.title} | {elements} | {program.air} | {rate:.0f} | {cost:.0f} s | {speed / 1e6:.2f}e6 "
                     f"| {cost / own:.2f} |")
    (options.folder / "table.md").write_text("\n".join(lines) + "\n", encoding="utf-8")
    print("\n".join(lines))


main()
