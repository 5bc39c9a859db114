# SPDX-License-Identifier: Apache-2.0
"""Tables of a run: series.csv and those in analysis/, whose first line is `name [unit],name [unit],...`."""
import re
from pathlib import Path

import numpy as np

from talus.column import Column
from talus.trouble import RunError, unknown

HEADING = re.compile(r"(.+) \[(.*)\]\Z")


class Table:
    """Columns by name: `table["time"]`, `table.units["time"]`, `list(table)`, `len(table)` rows."""

    def __init__(self, path):
        self.path = Path(path)
        try:
            # A run that goes on may be in the middle of a line: only what ends with a line break is whole.
            text = self.path.read_text(encoding="utf-8")
        except OSError as error:
            raise RunError(f"{path}: cannot be read: {error.strerror}") from error
        lines = text[:text.rfind("\n") + 1].splitlines()
        headings = [HEADING.match(heading) for heading in lines[0].split(",")] if lines else [None]
        if not all(headings):
            raise RunError(f"{path}: is no table of Talus: its first line must be `name [unit],name [unit],...`")
        self.units = {heading[1]: heading[2] for heading in headings}
        rows = []
        for number, line in enumerate(lines[1:], 2):
            try:
                rows.append([float(field) for field in line.split(",")])
            except ValueError as error:
                raise RunError(f"{path}:{number}: {error}") from error
            if len(rows[-1]) != len(headings):
                raise RunError(f"{path}:{number}: has {len(rows[-1])} numbers for {len(headings)} columns")
        self._values = np.array(rows, dtype=float).reshape(len(rows), len(headings))

    def __getitem__(self, name):
        if name not in self.units:
            raise unknown(self.path, "column", name, self.units)
        return Column(self._values[:, list(self.units).index(name)], self.units[name])

    def __contains__(self, name):
        return name in self.units

    def __iter__(self):
        return iter(self.units)

    def __len__(self):
        return len(self._values)

    def to_pandas(self, index=None):
        """A DataFrame; its attrs["units"] are the units by name. \\param index name of the column that is the index"""
        import pandas  # only here: the rest does without
        frame = pandas.DataFrame(self._values, columns=list(self.units))
        frame.attrs["units"] = dict(self.units)
        return frame if index is None else frame.set_index(index)

    def to_xarray(self, index="time"):
        """A Dataset over the column `index`; units as attributes of the variables."""
        import xarray
        along = xarray.Variable(index, np.asarray(self[index]), {"units": self.units[index]})
        return xarray.Dataset({name: (index, np.asarray(self[name]), {"units": unit}) for name, unit in self.units.items()
                               if name != index}, coords={index: along})

    def __repr__(self):
        return f"<Table {self.path}: {len(self)} rows of {', '.join(f'{n} [{u}]' for n, u in self.units.items())}>"
