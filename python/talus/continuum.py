# SPDX-License-Identifier: Apache-2.0
"""What a run of the continuum model is about: its box, the mass of its particles, and its snapshots with the fields that the
kernel makes of them. Boxes with at most one horizontal plate; other walls raise NotEvaluated."""
from functools import cached_property

import numpy as np

from talus.curves import Curve, curve, mean, nearest_point, part, quantile
from talus.fields import Box, Field, Grains, Plate, packing_section
from talus.measures import NotEvaluated, once
from talus.surfaces import Surface, free_surface

FACES = ("left", "right", "front", "rear", "floor", "top")
LAYERS_APART = 6  # spacings: a plate nearer to floor or top acts by other images


class Continuum:
    """A run with lengths in m, masses in kg and times from the opening of the gate in s."""

    def __init__(self, run):
        self.run, case = run, run.case
        if case.get("model") != "continuum":
            raise NotEvaluated("the run has no grains in a vessel")
        if "half_angle" in case.get("wedge", {}) or case.get("plates") or case.get("vessel") or "sector" in case["box"]:
            raise NotEvaluated("the vessel has other walls than a box and a plate")
        box, bed, grains = case["box"], case["bed"], case["grains"]
        self.width, self.depth, self.height = (float(box[name]) for name in ("width", "depth", "height"))
        self.faces = tuple(box[name] for name in FACES)
        plate = case.get("plate", {})
        self.plate = float(plate["height"]) if "height" in plate else None
        self.slit = tuple(float(plate.get(name, self.width / 2)) for name in ("slit_left", "slit_right"))
        self.spacing = float(bed["spacing"])
        self.grain_density, self.grain_diameter = float(grains["density"]), float(grains["diameter"])
        self.gravity = float(case["gravity"]["acceleration"])
        self.gate_time = run.gate_time if run.gate_time is not None else float(run.series["time"][-1])
        if self.plate is not None:
            apart = min(self.plate, self.height - self.plate if self.faces[5] != "open" else np.inf)
            if apart < LAYERS_APART * self.spacing or "open" in self.faces[:2]:
                raise NotEvaluated("the plate is not from wall to wall, or is near floor or top")

    @property
    def middle(self):
        return 0.5 * self.width

    @property
    def cell(self):
        """Edge of the cells in which values at places are taken: three quarters of a spacing, or so that a whole number of
        them fills the width."""
        return self.width / max(1.0, np.floor(self.width / (0.75 * self.spacing) + 0.5))

    @property
    def end(self):
        return float(self.run.series["time"][-1]) - self.gate_time

    @cached_property
    def averaging_time(self):
        """T of rates and loads."""
        time = self.run.case.get("analysis", {}).get("averaging_time")
        if time is None:
            raise NotEvaluated("the case gives no analysis.averaging_time")
        return float(time)

    @cached_property
    def particles(self):
        """Their number at the start; where masses differ, in those of bed.spacing."""
        first = self.run.snapshots[0]
        return float(first["mass_ratio"].sum()) if "mass_ratio" in first else len(first.positions)

    @cached_property
    def particle_mass(self):
        """Of the lattice of the bed, kg."""
        bed = self.run.case["bed"]
        if bed.get("file") or "beds" in self.run.case:
            raise NotEvaluated("the bed is not one lattice")
        extents = []
        for low, high, length in (("left", "right", self.width), ("front", "rear", self.depth)):
            extents.append(float(bed.get(high, length)) - float(bed.get(low, 0)))
        extents.append(float(bed["height"]))
        spacings = [length / max(1.0, np.floor(length / self.spacing + 0.5)) for length in extents]
        return float(bed["packing"]) * self.grain_density * float(np.prod(spacings))

    @property
    def mass(self):
        """Of all particles at the start, kg."""
        return self.particles * self.particle_mass

    def curve(self, column):
        """A column of the series; an empty curve if there is none."""
        series = self.run.series
        return curve(series["time"] - self.gate_time, series[column]) if column in series else curve([], [])

    @cached_property
    def times(self):
        """Of the snapshots."""
        return np.asarray(self.run.snapshots.times) - self.gate_time

    @cached_property
    def _snapshots(self):
        return {}

    def snapshot(self, number):
        """The ContinuumSnapshot of that place in the order of time."""
        if number not in self._snapshots:
            self._snapshots[number] = ContinuumSnapshot(self, self.run.snapshots.numbers[number])
        return self._snapshots[number]


@once
def continuum(run):
    """The Continuum of a run."""
    return Continuum(run)


class ContinuumSnapshot:
    """One snapshot: sections and surfaces are kept, columns are read when they are asked for."""

    def __init__(self, of, number):
        self.of, self._number = of, number
        self.time = of.run.snapshots[number].time - of.gate_time

    @property
    def frame(self):
        """The columns; not kept, as a run has many."""
        return self.of.run.snapshots[self._number]

    @property
    def air(self):
        """The AirSnapshot at the same time; None if there is none."""
        return self.of.run.air[self._number] if self._number in self.of.run.air.numbers else None

    @property
    def box(self):
        of = self.of
        plate = None if of.plate is None else Plate(of.plate, of.slit if self.time >= 0 else ())
        return Box((of.width, of.depth, of.height), of.faces, plate)

    def grains(self, frame):
        of, sph = self.of, self.of.run.case["sph"]
        length = None
        if sph["smoothing"] == "fixed":
            length = np.cbrt(of.particle_mass / (float(of.run.case["bed"]["packing"]) * of.grain_density))
        return Grains.of_density(frame.positions, frame["density"], of.particle_mass, of.grain_density, length,
                                 frame["mass_ratio"] if "mass_ratio" in frame else 1.0)

    def field(self, frame):
        """The Field of its particles."""
        return Field(self.grains(frame), self.box)

    @cached_property
    def section(self):
        """Packing in cells of a spacing by half a spacing, mean over the depth; None without particles."""
        frame = self.frame
        if len(frame.positions) == 0:
            return None
        return packing_section(self.grains(frame), self.box, self.of.spacing, 0.5 * self.of.spacing)

    @cached_property
    def bin_surface(self):
        """Of what is below the plate; without a plate of all."""
        return self._surface(0.0, self.of.height if self.of.plate is None else self.of.plate, False)

    @cached_property
    def hopper_surface(self):
        """Of what is above the plate; empty without one."""
        return self._surface(self.of.plate, self.of.height, True) if self.of.plate is not None else NO_SURFACE

    def _surface(self, bottom, top, from_above):
        return NO_SURFACE if self.section is None else free_surface(self.section, bottom, top, from_above)


NO_SURFACE = Surface(np.empty(0), np.empty(0))


# A number of a snapshot is a function(ContinuumSnapshot, **place) -> float, nan where it has no meaning.
@once
def number_of_snapshot(run, n, number, place):
    return float(number(continuum(run).snapshot(n), **dict(place)))


def value_at_window(number, run, window, place):
    """In the snapshot nearest the window's time; nan if the run ended more than half an interval before."""
    times, time = continuum(run).times, np.inf if window.at is None else window.at
    if len(times) == 0:
        return np.nan
    if np.isinf(time):
        return number_of_snapshot(run, len(times) - 1, number, _key(place))
    interval = times[-1] - times[-2] if len(times) > 1 else 0
    if time > times[-1] + 0.5 * interval:
        return np.nan
    return number_of_snapshot(run, nearest_point(times, time), number, _key(place))


def _key(place):
    return tuple(sorted(place.items()))


def values_of_snapshots(run, value):
    """Curve of value(n) of the snapshots from the gate's opening on, those that have one."""
    times = continuum(run).times
    after = np.flatnonzero(times >= 0)
    values = np.array([value(int(n)) for n in after], dtype=float)
    known = np.isfinite(values)
    return Curve(times[after][known], values[known])


def values_within(run, window, value):
    return part(values_of_snapshots(run, value), window.begin, window.end).value


def curve_of(number, run, place):
    return values_of_snapshots(run, lambda n: number_of_snapshot(run, n, number, _key(place)))


def numbers_within(number, run, window, place):
    return part(curve_of(number, run, place), window.begin, window.end).value


def at(number):
    return lambda run, window, **place: value_at_window(number, run, window, place)


def mean_of(number):
    return lambda run, window, **place: mean(numbers_within(number, run, window, place))


def largest(values):
    return quantile(values, 1)


def largest_of(number):
    return lambda run, window, **place: largest(numbers_within(number, run, window, place))
