# SPDX-License-Identifier: Apache-2.0
"""Snapshots of particles and of the air: VTKHDF files, a file a frame, of which only what is asked for is read."""
import re
from collections.abc import Mapping
from functools import cached_property
from pathlib import Path

import h5py
import numpy as np

from talus.column import Column
from talus.trouble import RunError, unknown


def _text(value):
    return value.decode() if isinstance(value, bytes) else str(value)


class _Frame(Mapping):
    """The columns of one file by name."""

    kind = None  # the VTKHDF type
    data = "PointData"  # where its columns are

    def __init__(self, path, number):
        self.path, self.number = Path(path), number
        self._read = {}
        with self._open() as file:
            self._columns = list(file["VTKHDF"][self.data])

    def _open(self):
        try:
            file = h5py.File(self.path, "r")
        except OSError as error:
            raise RunError(f"{self.path}: is no HDF5 file, or cannot be read: {error}") from error
        root = file.get("VTKHDF")
        if root is None or _text(root.attrs.get("Type", "")) != self.kind:
            file.close()
            raise RunError(f"{self.path}: holds no snapshot (VTKHDF of the type {self.kind})")
        return file

    def __getitem__(self, name):
        if name not in self._columns:
            raise unknown(self.path, "column", name, self._columns)
        if name not in self._read:
            with self._open() as file:
                data = file["VTKHDF"][self.data][name]
                self._read[name] = Column(self._shaped(data[()]), _text(data.attrs.get("units", "1")))
        return self._read[name]

    def __contains__(self, name):
        return name in self._columns

    def __iter__(self):
        return iter(self._columns)

    def __len__(self):
        return len(self._columns)

    @staticmethod
    def _shaped(values):
        return values

    def __repr__(self):
        return f"<{type(self).__name__} {self.number} at {self.time:.6g} s: {', '.join(self)}>"


#: The components of a symmetric tensor, a column each.
_TENSOR = ["_xx", "_yy", "_zz", "_xy", "_yz", "_zx"]


class _Sector:
    """A sector about an upright axis, from which the columns of the whole are made, copy by copy.
    \\param identities of particles in one copy"""

    def __init__(self, copies, axis, identities):
        self.copies, self.axis, self.identities = copies, np.asarray(axis), identities
        angle = 2 * np.pi * np.arange(copies) / copies
        self.turns = np.zeros((copies, 3, 3))
        self.turns[:, 0, 0] = self.turns[:, 1, 1] = np.cos(angle)
        self.turns[:, 1, 0] = np.sin(angle)
        self.turns[:, 0, 1] = -self.turns[:, 1, 0]
        self.turns[:, 2, 2] = 1

    def places(self, values):
        return self.axis + self.vectors(values - self.axis)

    def vectors(self, values):
        return np.einsum("kab,nb->kna", self.turns, values).reshape(-1, 3)

    def tensors(self, components):
        xx, yy, zz, xy, yz, zx = components
        tensor = np.stack([np.stack(row, -1) for row in ([xx, xy, zx], [xy, yy, yz], [zx, yz, zz])], -2)
        turned = np.einsum("kab,nbc,kdc->knad", self.turns, tensor, self.turns).reshape(-1, 3, 3)
        return [turned[:, a, b] for a, b in ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (2, 0))]

    def column(self, name, values):
        if values.ndim == 2 and values.shape[1] == 3:
            return self.vectors(values)
        repeated = np.tile(values, (self.copies,) + (1,) * (values.ndim - 1))
        if name != "identity" or self.identities == 0:
            return repeated
        of_copy = self.identities * np.repeat(np.arange(self.copies), len(values))
        return (repeated + of_copy) % (self.identities * self.copies)


class _Unstructured(_Frame):
    """A frame of points or cells, with its time and step among the file's fields."""

    kind = "UnstructuredGrid"

    @cached_property
    def time(self):
        with self._open() as file:
            return float(file["VTKHDF/FieldData/time"][0])

    @cached_property
    def step(self):
        with self._open() as file:
            return int(file["VTKHDF/FieldData/step"][0])


class ParticleSnapshot(_Unstructured):
    """Particles at one time: `positions` (n, 3), `time`, `step`, and the columns by name, a row a particle.

    Of a run with box.sector the file holds the sector once, and this the whole: all `copies` of it, one after the other,
    places, vectors and tensors turned about the axis. `positions[: len(positions) // copies]` is the sector.
    """

    @cached_property
    def positions(self):
        with self._open() as file:
            places = file["VTKHDF/Points"][()]
        return Column(places if self._sector is None else self._sector.places(places), "m")

    @property
    def copies(self):
        """Of the sector that the file holds; 1: it holds the whole."""
        return 1 if self._sector is None else self._sector.copies

    @cached_property
    def _sector(self):
        with self._open() as file:
            fields = file.get("VTKHDF/FieldData", {})
            if "sector_copies" not in fields:
                return None
            return _Sector(int(fields["sector_copies"][0]), fields["sector_axis"][0], int(fields["sector_identities"][0]))

    def __getitem__(self, name):
        if self._sector is None or name in self._read or name not in self._columns:
            return super().__getitem__(name)
        base, ending = name[:-3], name[-3:]
        with self._open() as file:
            data = file["VTKHDF/PointData"]
            units = _text(data[name].attrs.get("units", "1"))
            if ending in _TENSOR and all(base + component in self._columns for component in _TENSOR):
                values = self._sector.tensors([data[base + component][()] for component in _TENSOR])[_TENSOR.index(ending)]
            else:
                values = self._sector.column(name, data[name][()])
        self._read[name] = Column(values, units)
        return self._read[name]


    def to_xarray(self, names=None):
        """A Dataset over `particle` (the identities, if there are any, rising) with `position` and the columns; vectors
        over `axis` too. \\param names of the columns; all if left out"""
        import xarray  # only here: the rest does without
        order = np.argsort(self["identity"], kind="stable") if "identity" in self else np.arange(len(self.positions))
        identity = np.asarray(self["identity"])[order] if "identity" in self else order
        columns = {"position": self.positions} | {name: self[name] for name in (names or self) if name != "identity"}
        return xarray.Dataset(
            {name: (("particle", "axis")[:values.ndim], np.asarray(values)[order], {"units": values.units})
             for name, values in columns.items()},
            coords={"particle": identity, "axis": list("xyz"), "time": ((), self.time, {"units": "s"})})


class AirSnapshot(_Frame):
    """The air at one time, on cells: a column has the shape `shape` = (nx, ny, nz), a vector (nx, ny, nz, 3).
    `x`, `y`, `z` are the centres of the cells, `spacing` their edges, m."""

    kind = "ImageData"

    @cached_property
    def _head(self):
        with self._open() as file:
            return {name: np.array(value) for name, value in file["VTKHDF"].attrs.items() if name != "Type"}

    @property
    def time(self):
        return float(self._head["time"][0])

    @property
    def step(self):
        return int(self._head["step"][0])

    @property
    def shape(self):
        return tuple(int(n) for n in self._head["cells"])

    @property
    def spacing(self):
        return Column(self._head["Spacing"], "m")

    def _centres(self, axis):
        count, spacing = self.shape[axis], self._head["Spacing"][axis]
        first = self._head["Origin"][axis] + (0.5 * spacing if count == 1 else 0)
        return Column(first + spacing * np.arange(count), "m")

    x = property(lambda self: self._centres(0))
    y = property(lambda self: self._centres(1))
    z = property(lambda self: self._centres(2))

    def _shaped(self, values):
        nx, ny, nz = self.shape  # the file has z first, and an only cell at both of its faces
        return np.ascontiguousarray(np.moveaxis(values[:nz, :ny, :nx], (0, 1, 2), (2, 1, 0)))

    def to_xarray(self, names=None):
        """A Dataset over `x`, `y`, `z`, the centres of the cells; vectors over `axis` too. \\param names as above"""
        import xarray
        columns = {name: self[name] for name in (names or self)}
        return xarray.Dataset(
            {name: (("x", "y", "z", "axis")[:values.ndim], np.asarray(values), {"units": values.units})
             for name, values in columns.items()},
            coords={"axis": list("xyz"), "time": ((), self.time, {"units": "s"})} |
                   {name: (name, np.asarray(getattr(self, name)), {"units": "m"}) for name in "xyz"})

    def layer(self, name, y=None):
        """A column over x and z, (nx, nz[, 3]): in the cells at the depth `y`, or in the middle of the depth."""
        j = self.shape[1] // 2 if y is None else int(np.abs(self.y - y).argmin())
        return self[name][:, j]


class WallSnapshot(_Unstructured):
    """The walls of a vessel at one time, as triangles: a column has a row for each. `points` (n, 3), `corners` (m, 3) numbers
    of points, `middles`, `normals` (m, 3) and `areas` of the triangles. The loads are those of the field to which a triangle
    belongs, two spacings wide."""

    data = "CellData"

    @cached_property
    def points(self):
        with self._open() as file:
            return Column(file["VTKHDF/Points"][()], "m")

    @cached_property
    def corners(self):
        with self._open() as file:
            return file["VTKHDF/Connectivity"][()].reshape(-1, 3)

    @cached_property
    def _spanned(self):
        a, b, c = (np.asarray(self.points)[self.corners[:, n]] for n in range(3))
        return 0.5 * np.cross(b - a, c - a)

    @property
    def middles(self):
        return Column(np.asarray(self.points)[self.corners].mean(axis=1), "m")

    @property
    def normals(self):
        return Column(self._spanned / np.linalg.norm(self._spanned, axis=1)[:, None], "1")

    @property
    def areas(self):
        return Column(np.linalg.norm(self._spanned, axis=1), "m2")


class Snapshots:
    """The snapshots of one kind of a run: `snapshots[12]` is that of number 12 (of its file), `snapshots[-1]` the last,
    `snapshots.at(0.2)` the one nearest in time; to be iterated over in the order of time."""

    def __init__(self, folder, kind, frame):
        self.folder, self._kind, self._frame = Path(folder), kind, frame
        name = re.compile(kind + r"_(\d{4,})\.vtkhdf\Z")
        found = (name.match(path.name) for path in self.folder.glob(kind + "_*.vtkhdf"))
        self.numbers = sorted(int(match[1]) for match in found if match)
        self._times = {}  # of what was looked at: files are renamed into place whole and do not change

    def __len__(self):
        return len(self.numbers)

    def __iter__(self):
        return (self._load(number) for number in self.numbers)

    def __getitem__(self, number):
        if not isinstance(number, (int, np.integer)):
            raise TypeError(f"a snapshot is asked for by its number, not by {number!r}; by time: .at(time)")
        self._need_some()
        if number < 0 and -number <= len(self.numbers):
            number = self.numbers[number]
        if number not in self.numbers:
            raise RunError(f"{self.folder}: there is no snapshot {number} of the {self._kind}; there are "
                           f"{self.numbers[0]} to {self.numbers[-1]} ({len(self)} of them)")
        return self._load(number)

    def at(self, time):
        """The snapshot nearest to a time of the run, s (of equally near ones the first)."""
        self._need_some()
        return self._load(self.numbers[int(np.abs(self.times - time).argmin())])

    @property
    def times(self):
        """Of all snapshots, s."""
        for number in self.numbers:
            if number not in self._times:
                self._times[number] = self._load(number).time
        return Column([self._times[number] for number in self.numbers], "s")

    def to_xarray(self, names=None):
        """All of them as one Dataset over `time`; particles are joined by their identities, nan where one is missing."""
        import xarray
        self._need_some()
        return xarray.concat([frame.to_xarray(names) for frame in self], "time", join="outer")

    def _need_some(self):
        if not self.numbers:
            raise RunError(f"{self.folder}: holds no snapshots of the {self._kind}")

    def _load(self, number):
        return self._frame(self.folder / f"{self._kind}_{number:04d}.vtkhdf", number)

    def __repr__(self):
        return f"<{len(self)} snapshots of the {self._kind} in {self.folder}>"
