# SPDX-License-Identifier: Apache-2.0
"""Numbers of the air in one snapshot of the hopper, functions(ContinuumSnapshot, **place); nan without air, or without an
outlet that it passes. Lengths of a place in m."""
import numpy as np
from talus.curves import mean, ratio

IN_STREAM = 0.1    # packing of the cells that a stream passes, above
HARDLY_ANY = 0.01  # packing of open air
CELLS_BESIDE_PLUG = 5


class AirLayer:
    """The cells of the air in the middle of the depth: columns over x and z."""

    def __init__(self, air):
        self._air, self.x, self.z = air, np.asarray(air.x), np.asarray(air.z)
        self.spacing = np.asarray(air.spacing)

    def __getitem__(self, name):
        return np.asarray(self._air.layer(name), dtype=float)

    def whole(self, name):
        return np.asarray(self._air[name], dtype=float)

    def cell(self, axis, place):
        """The number along x (0) or z (2) of the cell that holds a place."""
        centres = self.x if axis == 0 else self.z
        low = centres[0] - 0.5 * self.spacing[axis]
        return int(np.clip(np.floor((place - low) / self.spacing[axis]), 0, len(centres) - 1))


def with_air(number):
    """A number of a snapshot with its AirLayer; nan where there is no air, or no outlet that it passes."""
    def of_snapshot(s, **place):
        air = s.air if s.of.plate is not None else None
        return np.nan if air is None else number(s, AirLayer(air), **place)
    return of_snapshot


@with_air
def drag_to_weight(s, air, height, left, right):
    k, across = air.cell(2, height), ~((air.x < left) | (air.x > right))
    weight = air.whole("solid_fraction")[across, :, k].sum() * s.of.grain_density * s.of.gravity
    return air.whole("drag")[across, :, k, 2].sum() / weight if weight > 0 else np.nan


def _steepest_pressure(air, x, start, end):
    """(z, dP/dz) of the largest size of dP/dz in the column at x; nan if there is no cell."""
    pressure, z = air["pressure"][air.cell(0, x)], air.z[1:-1]
    gradient = (pressure[2:] - pressure[:-2]) / (2 * air.spacing[2])
    inside = (z > start) & (z < end)
    if not inside.any():
        return np.nan, np.nan
    largest = np.abs(gradient[inside]).argmax()
    return z[inside][largest], gradient[inside][largest]


@with_air
def air_pressure_drop_height(_, air, x, **place):
    return _steepest_pressure(air, x, place["from"], place["to"])[0]


@with_air
def air_pressure_gradient_at_drop(_, air, x, **place):
    return _steepest_pressure(air, x, place["from"], place["to"])[1]


@with_air
def air_pressure_outside_inside(_, air, height):
    k = air.cell(2, height)
    pressure, packing = air["pressure"][:, k], air["solid_fraction"][:, k]
    return mean(pressure[packing < HARDLY_ANY]) - mean(pressure[packing > IN_STREAM])


def _plug(air, height):
    """At a height: velocities of air and grains along z, and the cells where grains fall at more than half of their
    largest speed there."""
    k = air.cell(2, height)
    falling = -air["grain_velocity"][:, k, 2]
    fastest = max(falling.max(), 0)
    return air["velocity"][:, k, 2], falling, np.flatnonzero(falling > 0.5 * fastest) if fastest > 0 else np.empty(0, int)


@with_air
def air_velocity_within_plug(_, air, height):
    velocity, _, plug = _plug(air, height)
    return mean(velocity[plug])


@with_air
def air_velocity_slowness(_, air, height):
    velocity, falling, plug = _plug(air, height)
    return ratio(abs(mean(velocity[plug])), mean(falling[plug]))


@with_air
def air_velocity_beside_plug(_, air, height):
    velocity, _, plug = _plug(air, height)
    if len(plug) == 0:
        return np.nan
    means = np.convolve(velocity, np.full(CELLS_BESIDE_PLUG, 1 / CELLS_BESIDE_PLUG), "valid")
    first = np.arange(len(means))
    beside = means[(first + CELLS_BESIDE_PLUG <= plug[0]) | (first > plug[-1])]
    return beside.max() if len(beside) else np.nan


def circulation(air, left, right, bottom, top, filled=False):
    """Integral of the curl du_x/dz - du_z/dx over the cells within a rectangle that are open, or filled, m²/s: central
    differences within the rectangle, one-sided at its rim."""
    i_from, k_from = air.cell(0, left), air.cell(2, bottom)
    i_to = i_from + np.searchsorted(air.x[i_from:], right)
    k_to = k_from + np.searchsorted(air.z[k_from:], top)
    if i_to - i_from < 2 or k_to - k_from < 2:
        return 0.0
    u, packing = (air[name][i_from:i_to, k_from:k_to] for name in ("velocity", "solid_fraction"))
    taken = packing > IN_STREAM if filled else packing < HARDLY_ANY
    return float((_difference(u[..., 0].T, air.spacing[2]).T - _difference(u[..., 2], air.spacing[0]))[taken].sum()
                 * air.spacing[0] * air.spacing[2])


def _difference(values, spacing):
    """Central differences along the first axis, one-sided at the ends."""
    change = np.empty_like(values)
    change[1:-1] = (values[2:] - values[:-2]) / (2 * spacing)
    change[0], change[-1] = (values[1] - values[0]) / spacing, (values[-1] - values[-2]) / spacing
    return change


def _circulation_of(where, half, filled=False):
    @with_air
    def of_half(s, air):
        middle, plate = s.of.middle, s.of.plate
        left, right = (0, middle) if half == "left" else (middle, s.of.width)
        bottom, top = (0, plate) if where == "bin" else (plate, s.of.height)
        return circulation(air, left, right, bottom, top, filled)
    return of_half


CIRCULATIONS = {(where, half, filled): _circulation_of(where, half, filled)
                for where in ("bin", "hopper") for half in ("left", "right") for filled in (False, True)}
