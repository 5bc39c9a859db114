# SPDX-License-Identifier: Apache-2.0
"""A run's folder."""
import json
import tomllib
from functools import cached_property
from pathlib import Path

import numpy as np

from talus.case import with_units
from talus.column import Value
from talus.snapshots import AirSnapshot, ParticleSnapshot, Snapshots, WallSnapshot
from talus.table import Table
from talus.trouble import RunError, unknown


class Run:
    """What a run has left in its folder so far; files are read when they are asked for.

    `manifest` (as written), `case` (resolved: tables of values with units, by key), `status`, `summary` (quantities with
    units, by name), `key_results`, `series` (a Table), `snapshots`, `air` and `walls` (Snapshots), `table("front_speed")` (of analysis/).
    """

    def __init__(self, folder):
        self.folder = Path(folder)
        if not self.folder.is_dir():
            raise RunError(f"{folder}: no such folder")
        if not (self.folder / "manifest.json").is_file():
            raise RunError(f"{folder}: is not the folder of a run: there is no manifest.json")

    @cached_property
    def manifest(self):
        return self._json("manifest.json")

    @cached_property
    def case(self):
        try:
            return with_units(tomllib.loads(self.manifest["case"]))
        except (KeyError, tomllib.TOMLDecodeError) as error:
            raise RunError(f"{self.folder / 'manifest.json'}: holds no case: {error}") from error

    @cached_property
    def _summary(self):
        return self._json("summary.json")

    @property
    def status(self):
        """"running", "done", "interrupted" or "failed"."""
        return self._summary["status"]

    @cached_property
    def summary(self):
        """Quantities by name; nan where the run had none to give."""
        quantities = self._summary["quantities"].items()
        return _Named(self.folder / "summary.json", "quantity",
                      ((name, Value(np.nan if q["value"] is None else q["value"], q["unit"])) for name, q in quantities))

    @property
    def key_results(self):
        """What the run answers, in words and with units: (value, analytical estimate or "") by title."""
        lines = self._summary.get("key_results", [])
        return {line["title"]: (line["value"], line.get("estimate", "")) for line in lines}

    @cached_property
    def series(self):
        return Table(self.folder / "series.csv")

    def table(self, name):
        """A table of analysis/, by its name without `.csv`."""
        path = self.folder / "analysis" / f"{name}.csv"
        if not path.is_file():
            known = sorted(p.stem for p in path.parent.glob("*.csv"))
            raise unknown(path.parent, "table", name, known)
        return Table(path)

    @cached_property
    def snapshots(self):
        return Snapshots(self.folder / "snapshots", "particles", ParticleSnapshot)

    @cached_property
    def air(self):
        return Snapshots(self.folder / "snapshots", "air", AirSnapshot)

    @property
    def walls(self):
        """Of a vessel, with the loads on them."""
        return Snapshots(self.folder / "snapshots", "walls", WallSnapshot)

    def write_element_loads(self, path):
        """Loads on the walls of a vessel by triangle, as .csv or .vtk (talus.element_loads)."""
        from talus.element_loads import write_element_loads
        write_element_loads(self, path)

    @cached_property
    def gate_time(self):
        """When the gate opened, in the run's time; the end of the series if it has not. None without a gate."""
        if "gate_time" not in self.series or len(self.series) == 0:
            return None
        last = float(self.series["gate_time"][-1])
        return last if last >= 0 else float(self.series["time"][-1])

    def _json(self, name):
        path = self.folder / name
        try:
            return json.loads(path.read_text(encoding="utf-8"))
        except OSError as error:
            raise RunError(f"{path}: cannot be read: {error.strerror}") from error
        except json.JSONDecodeError as error:
            raise RunError(f"{path}:{error.lineno}: is no JSON: {error.msg}") from error

    def __repr__(self):
        return f"<Run {self.folder}>"


class _Named(dict):
    def __init__(self, path, kind, items):
        super().__init__(items)
        self._path, self._kind = path, kind

    def __missing__(self, name):
        raise unknown(self._path, self._kind, name, self)


def find_runs(folder):
    """Every run at or below a folder, in the order of their paths."""
    folder = Path(folder)
    if not folder.is_dir():
        raise RunError(f"{folder}: no such folder")
    return [Run(path.parent) for path in sorted(folder.rglob("manifest.json"))]
