# SPDX-License-Identifier: Apache-2.0
"""Drives the program: runs, sweeps and new cases from Python. What it leaves is read as any other run."""
import ctypes
import json
import os
import signal
import subprocess
from pathlib import Path

import numpy as np

from talus.ask import find_program
from talus.column import Column, Value
from talus.run import Run, find_runs
from talus.trouble import RunError, unknown

STATUSES = {1: "a comparison is not met", 2: "bad case or usage", 3: "numerical failure", 4: "file trouble",
            130: "interrupted after a checkpoint"}


class ProgramError(RunError):
    """The program ended with another status than 0: `status`, and `said`, what it printed to stderr."""

    def __init__(self, arguments, status, said):
        super().__init__(f"talus {' '.join(arguments)}: {STATUSES.get(status, f'exit status {status}')}\n{said.strip()}")
        self.status, self.said = status, said


def ends_with_this_process():
    """What subprocess takes as preexec_fn, so that a process gets SIGTERM as soon as this one is no more."""
    parent, libc = os.getpid(), ctypes.CDLL(None)

    def before():
        libc.prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG
        if os.getppid() != parent:
            os._exit(126)

    return before


def simulate(case, out, settings=None, *, threads=None, existing="refuse", program=None):
    """Runs a case into the folder `out` and returns its Run.

    \\param settings overrides, by key: {"run.end": "0.5 s", "bed.packing": 0.58}
    \\param existing what to do with a run that is there: "refuse"; "resume", which goes on with it, adds nothing to one that
           is done, and refuses one of another case; "overwrite"
    Raises ProgramError with what the program says is wrong.
    """
    if existing not in ("refuse", "resume", "overwrite"):
        raise ValueError(f'existing="{existing}": refuse, resume or overwrite')
    if existing == "resume" and not (Path(out) / "manifest.json").is_file():
        existing = "refuse"
    arguments = ["run", str(case), "--out", str(out), *_settings("--set", settings)]
    if threads is not None:
        arguments += ["--threads", str(threads)]
    if existing != "refuse":
        arguments.append(f"--{existing}")
    _call(arguments, program)
    return Run(out)


def sweep(case, out, vary=None, settings=None, *, members=20, jobs=None, resume=False, program=None):
    """Runs every combination of the varied keys, `members` seeds of each, and returns the Sweep.

    \\param vary values by key: {"slope.angle": ["30 deg", "50 deg"], "particles.radius": ["4 mm", "5 mm"]}
    """
    vary = {key: [_text(value) for value in values] for key, values in (vary or {}).items()}
    arguments = ["ensemble", str(case), "--out", str(out), "--members", str(members), *_settings("--set", settings)]
    for key, values in vary.items():
        arguments += ["--vary", f"{key}={','.join(values)}"]
    if jobs is not None:
        arguments += ["--jobs", str(jobs)]
    if resume:
        arguments.append("--resume")
    _call(arguments, program)
    return Sweep(out)


def new(kind, path, *, overwrite=False, program=None, **answers):
    """Writes a case as `talus new KIND` does and returns its path: new("hopper", "my.toml", outlet="20 mm", air=True)."""
    arguments = ["new", kind, "-o", str(path)]
    for name, value in answers.items():
        option = "--" + name.replace("_", "-")
        if value is True:
            arguments.append(option)
        elif value is not False and value is not None:
            arguments += [option, _text(value)]
    _call([*arguments, *(["--overwrite"] if overwrite else [])], program)
    return Path(path)


class Sweep:
    """The folder of an ensemble: `keys` and `quantities` (names), `groups` (names), `sweep["front_speed_max"]` (the means,
    one a group), `sweep.deviation(...)`, `sweep["slope.angle"]` (the values that were set), `runs(group)`."""

    def __init__(self, folder):
        self.folder = Path(folder)
        try:
            self._groups = json.loads((self.folder / "sweep.json").read_text(encoding="utf-8"))
        except OSError as error:
            raise RunError(f"{self.folder}: is not the folder of a sweep: {error.strerror}: sweep.json") from error
        self.groups = [group["group"] for group in self._groups]
        self.keys = list(self._groups[0].get("settings", {}))
        self.quantities = list(dict.fromkeys(name for group in self._groups for name in group["quantities"]))

    def __getitem__(self, name):
        if name in self.keys:
            settings = [group["settings"][name] for group in self._groups]
            if all("value" in setting for setting in settings):
                return Column([setting["value"] for setting in settings], settings[0]["unit"] or "1")
            return [setting["text"] for setting in settings]
        return self._of_quantity(name, "mean")

    def texts(self, key):
        """The values of a varied key as they were given, one a group."""
        return [group["settings"][key]["text"] for group in self._groups]

    def deviation(self, quantity):
        """Standard deviations over the members, one a group; nan of a single member."""
        return self._of_quantity(quantity, "standard_deviation")

    def runs(self, group):
        """The members of a group."""
        if group not in self.groups:
            raise unknown(self.folder, "group", group, self.groups)
        return find_runs(self.folder / group)

    def to_pandas(self):
        """A row a group: the varied keys, then the means, and NAME_deviation where there are several members."""
        import pandas  # only here: the rest does without
        columns = {key: self[key] for key in self.keys} | {name: self[name] for name in self.quantities}
        for name in self.quantities:
            if not np.isnan(self.deviation(name)).all():
                columns[f"{name}_deviation"] = self.deviation(name)
        frame = pandas.DataFrame({name: np.asarray(values) for name, values in columns.items()}, index=self.groups)
        frame.attrs["units"] = {name: values.units for name, values in columns.items() if hasattr(values, "units")}
        return frame

    def _of_quantity(self, name, what):
        if name not in self.quantities:
            raise unknown(self.folder, "quantity", name, [*self.keys, *self.quantities])
        entries = [group["quantities"].get(name, {}) for group in self._groups]
        unit = next(entry["unit"] for entry in entries if entry)
        return Column([entry.get(what, np.nan) for entry in entries], unit)

    def __repr__(self):
        return f"<Sweep {self.folder}: {len(self.groups)} groups over {', '.join(self.keys) or 'no key'}>"


def _text(value):
    """A value as a case has it."""
    if isinstance(value, Value):
        return f"{float(value)!r} {value.units}" if value.units != "1" else repr(float(value))
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(f'"{v}"' if isinstance(v, str) else _text(v) for v in value) + "]"
    return str(value)


def _settings(option, settings):
    return [word for key, value in (settings or {}).items() for word in (option, f"{key}={_text(value)}")]


def _call(arguments, program):
    done = subprocess.run([find_program(program), *arguments], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True, check=False, preexec_fn=ends_with_this_process())
    if done.returncode != 0:
        said = done.stderr if done.returncode != 3 or done.stderr.strip() else done.stdout
        raise ProgramError(arguments, done.returncode, said)
    return done.stdout
