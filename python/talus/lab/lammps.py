# SPDX-License-Identifier: Apache-2.0
"""Discrete elements: jobs of LAMMPS, each in a folder of its own, which is done or made again."""
import contextlib
import fcntl
import hashlib
import shutil
from pathlib import Path
from typing import NamedTuple

import talus
from talus.ask import ProgramFault
from talus.lab import jobs
from talus.lab.command import INTERRUPTED, NOT_MET, NUMERICAL
from talus.trouble import InputError, problem


class Job(NamedTuple):
    """A script with the variables that it takes; `cost` processor time, in any unit. Restarted from nothing, for LAMMPS on one
    process gives the same each time."""

    script: Path
    variables: dict
    folder: Path
    cost: float = 1

    @property
    def output(self):
        return self.folder.with_name(self.folder.name + ".out")

    @property
    def working_folder(self):
        return self.folder

    def is_done(self):
        return (self.folder / "done").exists()

    def begin_command(self):
        self.folder.mkdir(parents=True, exist_ok=True)
        words = [word for name, value in self.variables.items() for word in ("-var", name, f"{value:g}")]
        return ["lmp", "-in", str(self.script), "-log", "none", *words]

    def finish(self):
        (self.folder / "done").touch()
        self.output.unlink(missing_ok=True)


def script(name):
    """The path of an input of this package."""
    return Path(talus.__file__).resolve().parent / "inputs" / name


def job(folder, name, cost, **variables):
    """In a folder whose name changes with what the job depends on."""
    path = script(name)
    text = path.read_text(encoding="utf-8") + repr(sorted((key, f"{value:g}") for key, value in variables.items()))
    return Job(path, variables, Path(folder) / f"{path.stem}-{hashlib.sha256(text.encode()).hexdigest()[:12]}", cost)


@contextlib.contextmanager
def alone_in(folder):
    """While it lasts, no other command computes in the folder. Raises InputError if one does."""
    with open(Path(folder) / ".lock", "w", encoding="utf-8") as lock:
        try:
            fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
        except OSError as error:
            raise InputError([problem(folder, "another command computes in this folder", allowed="--out for another one")]) from error
        yield


def run(members, at_once, interruption=False, later=0):
    """Runs what is not done. \\param later cost of the jobs that are to follow. Raises ProgramFault if LAMMPS is not there, fails,
    or is interrupted."""
    if not shutil.which("lmp") and not all(one.is_done() for one in members):
        raise ProgramFault(NOT_MET, "discrete elements take LAMMPS, the program lmp (Debian: lammps)")
    result = jobs.run(members, at_once, interruption, later)
    if interruption:
        raise ProgramFault(INTERRUPTED, "interrupted; the same command goes on")
    if result.failed:
        raise ProgramFault(NUMERICAL, "\n".join(f"{one.folder}: LAMMPS failed: {one.reason}" for one in result.failed))
