# SPDX-License-Identifier: Apache-2.0
"""Runs of the continuum model that are made in memory, with known numbers, for the tests of what is measured on them."""
import numpy as np

SECONDS = {"time": "s"}


def case(width, depth, height, spacing, plate=None, slit=(), packing=0.6, bed_height=None, **tables):
    """A case with a box and a plate, as the program resolves it."""
    made = {"model": "continuum",
            "box": {"width": width, "depth": depth, "height": height, "left": "wall", "right": "wall",
                    "front": "symmetry", "rear": "symmetry", "floor": "wall", "top": "open"},
            "plate": {} if plate is None else {"height": plate, "slit_left": slit[0], "slit_right": slit[1]},
            "grains": {"density": 2500.0, "diameter": 200e-6}, "gravity": {"acceleration": 9.8},
            "bed": {"packing": packing, "spacing": spacing, "height": bed_height or spacing},
            "sph": {"smoothing": "local"}, "analysis": {"averaging_time": 20e-3}}
    return made | tables


class Frame(dict):
    """Columns of particles at one time. Left out: at rest, without stress, as dense as a bed of that packing."""

    def __init__(self, positions, time=0.0, packing=0.6, grain_density=2500.0, **columns):
        self.positions, self.time = np.asarray(positions, dtype=float).reshape(-1, 3), time
        count = len(self.positions)
        super().__init__(velocity=np.zeros((count, 3)), packing=np.full(count, packing),
                         density=np.full(count, packing * grain_density), shear_rate=np.zeros(count),
                         **{f"stress_{axis}": np.zeros(count) for axis in ("xx", "yy", "zz")})
        self.update({name: np.asarray(values, dtype=float) for name, values in columns.items()})


class Air(dict):
    """Columns over cells from the origin, (nx, ny, nz[, 3]); left out: at rest, without grains."""

    def __init__(self, shape, spacing, time=0.0):
        self.shape, self.spacing, self.time = shape, np.array(spacing), time
        self.x, self.y, self.z = ((np.arange(n) + 0.5) * d for n, d in zip(shape, spacing))
        super().__init__({name: np.zeros((*shape, 3)) for name in ("velocity", "grain_velocity", "drag")} |
                         {name: np.zeros(shape) for name in ("pressure", "solid_fraction")})

    @property
    def centres(self):
        """x and z of every cell."""
        x, _, z = np.meshgrid(self.x, self.y, self.z, indexing="ij")
        return x, z

    def layer(self, name):
        return self[name][:, self.shape[1] // 2]


class _Frames:
    def __init__(self, frames):
        self._frames = list(frames)
        self.numbers = list(range(len(self._frames)))
        self.times = np.array([frame.time for frame in self._frames])

    def __len__(self):
        return len(self._frames)

    def __getitem__(self, number):
        return self._frames[number]


class Series(dict):
    """Columns of a table."""

    def __init__(self, **columns):
        super().__init__({name: np.asarray(values, dtype=float) for name, values in columns.items()})

    def __len__(self):
        return len(next(iter(self.values()), ()))


class RunInMemory:
    """What talus.Run offers, of frames, a series and tables that are given. Times are those of the run."""

    def __init__(self, of_case, frames=(), series=None, gate_time=0.0, air=(), **tables):
        self.case, self.gate_time = of_case, gate_time
        self.snapshots, self.air = _Frames(frames), _Frames(air)
        self.series = series if series is not None else Series(time=[0.0, gate_time + 10.0])
        self.summary, self._tables = {}, tables

    def table(self, name):
        return self._tables[name]


def lattice(width, depth, bottom, top, h, is_there=lambda x, z: x == x):
    """The points of a lattice of spacing h that fill a box between two heights, those taken by is_there(x, z)."""
    counts = [int(length / h + 0.5) for length in (width, depth, top - bottom)]
    x, y, z = (axis.ravel() for axis in np.meshgrid(*((np.arange(n) + 0.5) * h for n in counts), indexing="ij"))
    there = is_there(x, bottom + z)
    return np.column_stack([x, y, bottom + z])[there]
