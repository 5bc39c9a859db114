# SPDX-License-Identifier: Apache-2.0
"""Surfaces of a section: their heights and slopes, and the foot of the layer on the floor.

A surface is where the smoothed packing passes 0.3, half of a bed's: in the hopper the highest such place, in the bin the
lowest, if there is packing above 0.3 below it; none where a dense stream reaches the plate. Talus's own measures
(src/analysis/free_surface.hpp) ask for the same.
"""
import numpy as np
from fields import CELL
from frames import PLATE, WIDTH

LEVEL = 0.3                   # packing on a surface
SPACING = WIDTH / 60          # of the places where a surface is taken for its slopes: that of the case's particles
FOOT_HEIGHT, FOOT_PACKING = 5e-3, 0.15


def surface_heights(section):
    """Heights of the surface of hopper and bin at section.x, m; nan where there is none."""
    hopper, bin_ = (np.full(len(section.x), np.nan) for _ in range(2))
    plate = np.searchsorted(section.z, PLATE)
    for column, packing in enumerate(section.packing):
        grains = packing >= LEVEL
        last = np.flatnonzero(grains[plate:-1] & ~grains[plate + 1:])
        if len(last):
            hopper[column] = _crossing(section.z, packing, plate + last[-1])
        first = np.flatnonzero(~grains[1:plate])
        if grains[0] and len(first):
            bin_[column] = _crossing(section.z, packing, first[0])
    return hopper, bin_


def _crossing(z, packing, row):
    return z[row] + CELL * (packing[row] - LEVEL) / (packing[row] - packing[row + 1])


def band(x, heights, start, stop):
    """Mean height between two distances from the middle, both sides; nan if there is none on either."""
    away = abs(x - WIDTH / 2)
    there = (away >= start) & (away <= stop) & np.isfinite(heights)
    return heights[there].mean() if there.any() else np.nan


def outward_angle(x, heights, start, stop):
    """Angle at which a surface falls outwards between two distances from the middle, degrees: of the mean slope of the
    lines through the heights left and right of it. Below 0 where it rises towards the walls."""
    slopes = []
    for side in (-1, 1):
        away = side * (x - WIDTH / 2)
        there = (away >= start) & (away <= stop) & np.isfinite(heights)
        if there.sum() > 2:
            slopes.append(-np.polyfit(away[there], heights[there], 1)[0])
    return np.degrees(np.arctan(np.mean(slopes))) if slopes else np.nan


def foot_reach(section):
    """How far the layer on the floor reaches, m from the middle, left and right: the outermost place where the packing of
    the lowest 5 mm passes 0.15; nan where there is none."""
    layer = section.packing[:, section.z < FOOT_HEIGHT].mean(axis=1)
    reach = []
    for away, packing in ((WIDTH / 2 - section.x[::-1], layer[::-1]), (section.x - WIDTH / 2, layer)):
        n = np.flatnonzero((packing >= FOOT_PACKING) & (away > 0))
        if not len(n):
            reach.append(np.nan)
        elif n[-1] + 1 == len(packing):
            reach.append(WIDTH / 2)
        else:
            n = n[-1]
            reach.append(away[n] + CELL * (packing[n] - FOOT_PACKING) / (packing[n] - packing[n + 1]))
    return reach


def foot_speed(time, reach, start=0.025, stop=0.045):
    """Slope of the line through the reach against time, from its first value past `start` to its last before `stop`, in
    m/s; nan if fewer than three values lie between them."""
    time, reach = np.asarray(time), np.asarray(reach)
    there = (reach >= start) & (reach <= stop)
    return np.polyfit(time[there], reach[there], 1)[0] if there.sum() > 2 else np.nan


def heap_slopes(x, heights, least):
    """The stretches longer than `least` along which the 5-point mean rises or falls all along, as (from, to, angle in
    degrees of the line through their middle 80 %): src/analysis/free_surface.hpp."""
    means = np.full(len(x), np.nan)
    for n in range(len(x)):
        for wide in (2, 1, 0):
            if n >= wide and n + wide < len(x) and np.isfinite(heights[n - wide:n + wide + 1]).all():
                means[n] = heights[n - wide:n + wide + 1].mean()
                break
    slopes, first, signs = [], 0, np.sign(np.diff(means))
    while first < len(signs):
        last = first
        while last < len(signs) and signs[last] == signs[first] != 0:
            last += 1
        length = x[last] - x[first]
        if length > least:
            inner = (x >= x[first] + 0.1 * length) & (x <= x[last] - 0.1 * length)
            slopes.append((x[first], x[last], np.degrees(np.arctan(abs(np.polyfit(x[inner], heights[inner], 1)[0])))))
        first = max(last, first + 1)
    return slopes


def repose_angle(section, heights):
    """Mean over left and right of the angle of the longest slope, degrees; nan where there is none."""
    x = (np.arange(round(WIDTH / SPACING)) + 0.5) * SPACING
    known = np.isfinite(heights)
    taken = np.interp(x, section.x, np.where(known, heights, 0))
    taken[np.interp(x, section.x, known.astype(float)) < 1 - 1e-9] = np.nan
    longest = {}
    for start, stop, angle in heap_slopes(x, taken, 10 * SPACING):
        side = (start + stop) / 2 < WIDTH / 2
        longest[side] = max(longest.get(side, (0, 0)), (stop - start, angle))
    return np.mean([angle for _, angle in longest.values()]) if longest else np.nan
