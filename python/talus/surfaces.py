# SPDX-License-Identifier: Apache-2.0
"""The free surface of grains in a vessel: the height Z(x) at which the packing passes a level, and how it slopes."""
from typing import NamedTuple

import numpy as np

from talus.curves import line, mean

SURFACE_PACKING = 0.3  # half of a loose bed's


class Surface(NamedTuple):
    """A height at each x; nan where there is no surface."""

    x: np.ndarray
    z: np.ndarray

    def heights(self, start, end):
        """(x, z) of the finite heights with start <= x <= end."""
        there = (self.x >= start) & (self.x <= end) & np.isfinite(self.z)
        return self.x[there], self.z[there]

    def mean_height(self, start, end):
        return mean(self.heights(start, end)[1])


def free_surface(section, bottom, top, from_above, level=SURFACE_PACKING):
    """The Surface of a packing Section between two heights, linear between the centres of two rows.

    From above: the highest place with that packing, of a vessel above which nothing falls. From below: the first one above
    the bottom, so that grains in the air do not count; a column of grains up to the top, as a dense stream, has none."""
    inside = np.flatnonzero((section.z >= bottom) & (section.z <= top))
    z = np.full(len(section.x), np.nan)
    if len(inside) < 2:
        return Surface(section.x, z)
    packing, heights = section.value[inside], section.z[inside]
    grains = packing >= level
    passes = grains[:-1] & ~grains[1:]
    if from_above:
        has, row = passes.any(axis=0), len(passes) - 1 - passes[::-1].argmax(axis=0)
    else:
        has, row = grains[0] & passes.any(axis=0), passes.argmax(axis=0)
    column = np.flatnonzero(has)
    row = row[has]
    below, above = packing[row, column], packing[row + 1, column]
    z[has] = heights[row] + section.height * (below - level) / (below - above)
    return Surface(section.x, z)


def _slope(surface, start, end):
    """Of the line through the heights of a stretch; nan for fewer than three."""
    x, z = surface.heights(start, end)
    return line(x, z)[1] if len(x) > 2 else np.nan


def height_beside(surface, middle, start, end):
    """Mean height between two distances from the middle, left and right together; nan if there is none."""
    away = np.abs(surface.x - middle)
    return mean(surface.z[(away >= start) & (away <= end) & np.isfinite(surface.z)])


def outward_angle(surface, middle, start, end):
    """Angle at which the surface falls outwards between two distances from the middle: of the mean of the slopes of the
    lines left and right, rad. Of one side alone if the other has fewer than three heights."""
    falls = [_slope(surface, middle - end, middle - start), -_slope(surface, middle + start, middle + end)]
    known = [fall for fall in falls if not np.isnan(fall)]
    return float(np.arctan(np.mean(known))) if known else np.nan


def swelling(surface, middle, beside, width):
    """How much higher the middle is than the places `beside` to its left and right: means over `width` each, m."""
    left, centre, right = (surface.mean_height(x - 0.5 * width, x + 0.5 * width)
                           for x in (middle - beside, middle, middle + beside))
    return centre - 0.5 * (left + right)


def swelling_above_flanks(surface, middle, start, end, width):
    """How much higher the middle is, mean over `width`, than the mean of where the lines through the flanks, which lie
    between two distances from it, prolonged, have it, m; nan unless each flank has three heights."""
    prolonged = []
    for low, high in ((middle - end, middle - start), (middle + start, middle + end)):
        x, z = surface.heights(low, high)
        if len(x) < 3:
            return np.nan
        intercept, slope = line(x, z)
        prolonged.append(intercept + slope * middle)
    return surface.mean_height(middle - 0.5 * width, middle + 0.5 * width) - np.mean(prolonged)


def surface_angle(surface, middle):
    """The surface's slope as a whole, rad: of the mean of the sizes of the slopes of the lines left and right of the middle. Of
    one alone if the other has fewer than three heights."""
    rounding = 1e-9 * np.ptp(surface.x)  # a column in the middle belongs to both sides
    slopes = [abs(_slope(surface, -np.inf, middle + rounding)), abs(_slope(surface, middle - rounding, np.inf))]
    known = [slope for slope in slopes if not np.isnan(slope)]
    return float(np.arctan(np.mean(known))) if known else np.nan


class HeapSlope(NamedTuple):
    """A stretch of a surface that rises or falls all along, and dZ/dx of the line through its middle 80 % in x."""

    start: float
    end: float
    slope: float

    @property
    def length(self):
        return self.end - self.start

    @property
    def angle(self):
        """Against the horizontal, rad."""
        return float(np.arctan(abs(self.slope)))


def _smoothed(z):
    """Means over up to two neighbours on each side, as many on one as on the other, none of them beyond a gap."""
    means = np.array(z, dtype=float)
    for n in np.flatnonzero(np.isfinite(z)):
        for wide in (2, 1):
            window = z[n - wide:n + wide + 1] if n >= wide else z[:0]
            if len(window) == 2 * wide + 1 and np.isfinite(window).all():
                means[n] = window.mean()
                break
    return means


def heap_slopes(surface, least_length):
    """The slopes longer than `least_length` along x. Where they begin and end is decided on the 5-point mean of the heights
    (shorter near gaps and ends); the lines go through the heights themselves."""
    z, slopes, first = _smoothed(surface.z), [], 0
    while first + 1 < len(z):
        direction, last = z[first + 1] - z[first], first
        while last + 1 < len(z) and (z[last + 1] - z[last]) * direction > 0:  # of nan false: gaps end a stretch
            last += 1
        start, end = surface.x[first], surface.x[last]
        if end - start > least_length:
            margin = 0.1 * (end - start)
            slopes.append(HeapSlope(start, end, line(*surface.heights(start + margin, end - margin))[1]))
        first = max(last, first + 1)
    return slopes


def repose_angles(slopes, middle):
    """Of the longest slope left and right of the middle, and of the steepest of all, rad; nan where there is none."""
    def longest(some):
        return max(some, key=lambda slope: slope.length).angle if some else np.nan
    left = [slope for slope in slopes if 0.5 * (slope.start + slope.end) < middle]
    return (longest(left), longest([slope for slope in slopes if slope not in left]),
            max((slope.angle for slope in slopes), default=np.nan))
