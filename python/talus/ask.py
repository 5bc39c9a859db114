# SPDX-License-Identifier: Apache-2.0
"""Asks the program what it alone knows: `talus answer`, JSON in and out. Here are the questions:

    plan        {"case", "settings", "groups": [{"folder", "settings"}], "members", "resume"}   members of an ensemble, checked
    begin       {"folder", "resume", "known"}                        whether a folder may be used, and makes it
    claim       {"folders", "files"}                                 makes folders, enters files into the list of Talus's own
    quantities  {"texts"}                                            "5 mm" -> {"value": 0.005, "unit": "m", "si": 0.005}
    measures    {}                                                   quantities of summaries: name, unit, may_be_missing
    numbers     {"runs": [{"folder", "questions"}]}                  quantities of runs over windows of time
    points      {"file"}                                             columns of points as CSV: name, unit, values
    material    {"file"}                                             true: a material file that a case may name
    yield-loci  {"file"}                                             yield loci of a shear tester, checked and evaluated
    wall-locus  {"file"}                                             points of a wall yield locus
    report      {"path", "title", "runs", "comparisons"}             the page of runs
"""
import json
import os
import shutil
import subprocess
from pathlib import Path

from talus.trouble import InputError, RunError


class ProgramFault(RunError):
    """The program ended with a `status` other than 0; the text is its message."""

    def __init__(self, status, said):
        super().__init__(said.removeprefix("talus: ").strip())
        self.status = status


def find_program(program=None):
    """The program: the one given, that of the variable TALUS, of the PATH, built in the checkout of this package, or
    installed with it (PREFIX/share/talus/python)."""
    above = Path(__file__).resolve().parents
    near = [above[n] / name for n, name in ((2, "build/talus"), (4, "bin/talus")) if n < len(above)]
    for candidate in (program, os.environ.get("TALUS"), shutil.which("talus"), *near):
        if candidate and Path(candidate).is_file():
            return Path(candidate).resolve()
    raise RunError("there is no program talus: name it by program=, the variable TALUS or the PATH, or build it (./run "
                   "--build-only)")


def find_project(name):
    """The path of the project's file of this name, such as "validation/yuu2011/reference.toml": here, where the program was
    built, or where it was installed. None if there is none."""
    above = find_program().parent.parent
    return next((path for path in (Path(name), above / name, above / "share/talus" / name) if path.is_file()), None)


def ask(question, **details):
    """The program's answer. Raises InputError with every problem, ProgramFault with its message."""
    done = subprocess.run([find_program(), "answer"], input=json.dumps({"question": question, **details}, default=str),
                          stdout=subprocess.PIPE, stderr=subprocess.PIPE, text=True, check=False)
    if done.returncode != 0:
        raise ProgramFault(done.returncode if done.returncode > 0 else 130, done.stderr)
    said = json.loads(done.stdout)
    if "problems" in said:
        raise InputError(said["problems"])
    return said["answer"]


def write(texts):
    """Replaces files whole, texts by path; where their folders keep lists of what Talus wrote, they are entered there."""
    ask("claim", folders=[], files=list(texts))
    for path, text in texts.items():
        part = Path(f"{path}.part")
        try:
            part.write_text(text, encoding="utf-8")
            part.replace(path)
        except OSError as error:
            part.unlink(missing_ok=True)
            raise RunError(f"{path}: cannot be written: {error.strerror}") from error
