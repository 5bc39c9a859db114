# SPDX-License-Identifier: Apache-2.0
"""Numbers that change with time: a curve, its part in a window, rates, extremes, spectra and periods.

A curve is a pair of arrays, values at increasing times. A rate is the difference of a cumulative curve over a length of time,
so that nothing is lost between data. Where a curve does not cover a window the result is nan, or an empty curve.
"""
from typing import NamedTuple

import numpy as np


class Curve(NamedTuple):
    """Values at increasing times, one per time."""

    time: np.ndarray
    value: np.ndarray


EMPTY = Curve(np.empty(0), np.empty(0))


def curve(time, value):
    return Curve(np.asarray(time, dtype=float), np.asarray(value, dtype=float))


def _at_or_before(time, bound):
    # Times are sums of steps: equal ones differ by rounding.
    return time <= bound + 1e-9 * np.abs(bound)


def part(of, start, end):
    """The part with start < t <= end; times that differ from a bound by rounding count as equal to it."""
    inside = ~_at_or_before(of.time, start) if np.isfinite(start) else of.time > start
    inside &= _at_or_before(of.time, end) if np.isfinite(end) else of.time <= end
    return Curve(of.time[inside], of.value[inside])


def value_at(of, time):
    """Values at times within the curve, linear between its points."""
    return np.interp(time, of.time, of.value)


def nearest_point(times, time):
    """The number of the time nearest to one; of two equally near the earlier."""
    return int(np.abs(np.asarray(times) - time).argmin())


def covers(of, start, end):
    """Whether the curve has data from `start` to `end`, but for rounding; of arrays an array."""
    if len(of.time) == 0:
        return np.zeros(np.broadcast(start, end).shape, dtype=bool)
    start, end = np.asarray(start, dtype=float), np.asarray(end, dtype=float)
    return (of.time[0] <= start + 1e-9 * np.abs(start)) & (end - 1e-9 * np.abs(end) <= of.time[-1])


def integral(of):
    """Integral from the first time on, by trapezoids."""
    areas = 0.5 * (of.value[1:] + of.value[:-1]) * np.diff(of.time)
    return Curve(of.time, np.append(0.0, np.cumsum(areas)) if len(of.time) else of.value)


def mean_rate(cumulative, start, end):
    """Mean over start..end of the rate whose integral the curve is."""
    if not covers(cumulative, start, end) or not end > start:
        return np.nan
    return (value_at(cumulative, end) - value_at(cumulative, start)) / (end - start)


def mean_rates(cumulative, length, every, start, end):
    """Means over `length`, one every `every`, each within start..end; their times are their centres."""
    count = int(np.floor((end - start - length) / every)) + 3 if end - start > 0 else 0
    first = start + np.arange(max(count, 0)) * every
    last = first + length
    whole = (last <= end + 1e-9 * np.abs(end)) & covers(cumulative, first, last)
    first, last = first[whole], last[whole]
    if len(first) == 0:
        return EMPTY
    return Curve(first + 0.5 * length, (value_at(cumulative, last) - value_at(cumulative, first)) / (last - first))


def drift(cumulative, length, start, end):
    """Slope of the line through the consecutive means over `length` within start..end, times (end - start), over their
    mean: the relative change of the rate."""
    if not covers(cumulative, start, end):
        return np.nan
    means = mean_rates(cumulative, length, length, start, end)
    return ratio(line(means.time, means.value)[1] * (end - start), mean(means.value))


def about_running_mean(of, length, start, end):
    """The curve less its own centred mean over `length`, at the data within start..end whose mean the curve covers before
    its first value that is not a number."""
    if len(of.time) == 0:
        return EMPTY
    sums, time = integral(of), of.time
    inside = (time > start) & (time <= end) & covers(sums, time - 0.5 * length, time + 0.5 * length)
    time = time[inside]
    means = (value_at(sums, time + 0.5 * length) - value_at(sums, time - 0.5 * length)) / length
    rest = of.value[inside] - means
    bad = np.flatnonzero(~np.isfinite(rest))
    until = bad[0] if len(bad) else len(rest)
    return Curve(time[:until], rest[:until])


def first_time_at_or_below(of, level):
    """The first time at which the curve, linear between its points, is at or below the level; nan if it never is."""
    below = np.flatnonzero(of.value <= level)
    if len(below) == 0:
        return np.nan
    n = below[0]
    if n == 0:
        return float(of.time[0])
    share = (of.value[n - 1] - level) / (of.value[n - 1] - of.value[n])
    return float(of.time[n - 1] + share * (of.time[n] - of.time[n - 1]))


def at_equal_times(of, rate, start, end):
    """The curve at times 1/rate apart from `start` to `end`; empty if it does not cover them."""
    if not covers(of, start, end):
        return EMPTY
    time = start + np.arange(int(np.floor((end - start) * rate * (1 + 1e-9))) + 1) / rate
    return Curve(time, value_at(of, time))


def power_spectrum(of, lowest, highest):
    """Power of a curve at equal times after removal of its least-squares line, with a Hann window, at frequencies a quarter
    of its own resolution apart (zero-padded four times): (frequencies, power); a sinusoid of amplitude A has a peak of A²/4."""
    count = len(of.time)
    if count < 4:
        raise ValueError("a spectrum needs four data")
    interval = (of.time[-1] - of.time[0]) / (count - 1)
    intercept, slope = line(of.time, of.value)
    number = np.arange(count)
    window = 0.5 - 0.5 * np.cos(2 * np.pi * number / count)
    tapered = window * (of.value - intercept - slope * of.time)
    step = 1 / (4 * count * interval)
    multiples = np.arange(np.ceil(lowest / step), np.floor(highest / step * (1 + 1e-15)) + 1)
    frequency = multiples[multiples * step <= highest] * step
    phase = 2 * np.pi * frequency[:, None] * interval * number
    return frequency, ((np.cos(phase) @ tapered)**2 + (np.sin(phase) @ tapered)**2) / window.sum()**2


def dominant_period(of, shortest, longest):
    """Period of the highest peak of the power between two periods; nan if there is none: a value above its neighbours."""
    if len(of.time) < 4:
        return np.nan
    frequency, power = power_spectrum(of, 1 / longest, 1 / shortest)
    inner = power[1:-1]
    peaks = np.flatnonzero((inner > 0) & (inner > power[:-2]) & (inner >= power[2:])) + 1
    return float(1 / frequency[peaks[power[peaks].argmax()]]) if len(peaks) else np.nan


def crossing_period(of):
    """Mean time between the upward crossings of zero, linear between the data; nan for fewer than two. Rice's mean period
    of a broad spectrum: S. O. Rice, Bell Syst. Tech. J. 23, 282 (1944), section 3.3."""
    before, now = of.value[:-1], of.value[1:]
    up = np.flatnonzero((before < 0) & (now >= 0))
    if len(up) < 2:
        return np.nan
    ends = up[[0, -1]]
    times = of.time[ends] + before[ends] / (before[ends] - now[ends]) * (of.time[ends + 1] - of.time[ends])
    return float((times[1] - times[0]) / (len(up) - 1))


def ratio(a, b):
    """a over b; inf or nan where b is 0."""
    with np.errstate(divide="ignore", invalid="ignore"):
        return float(np.divide(a, b))


def mean(values):
    """nan of none."""
    return float(np.mean(values)) if len(values) else np.nan


def standard_deviation(values):
    """With n - 1; nan of fewer than two."""
    return float(np.std(values, ddof=1)) if len(values) > 1 else np.nan


def quantile(values, probability):
    """Linear between order statistics (Hyndman & Fan 1996, type 7); nan of none."""
    return float(np.quantile(values, probability)) if len(values) else np.nan


def line(x, y):
    """(intercept, slope) of the least-squares line; nan where all x are equal."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if len(x) == 0:
        return np.nan, np.nan
    from_mean = x - x.mean()
    scatter = from_mean @ from_mean
    if not scatter > 0:
        return np.nan, np.nan
    slope = float(from_mean @ (y - y.mean()) / scatter)
    return float(y.mean() - slope * x.mean()), slope
