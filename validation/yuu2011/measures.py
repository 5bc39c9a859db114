# SPDX-License-Identifier: Apache-2.0
"""The quantities of this study beside those of a summary. Estimators in full: reference.toml.
One list of all of them, with their definitions: hence the length of this file.

T is `analysis.averaging_time`, t the time from the opening of the gate, h the spacing of the particles at the start,
D and ρ_p the diameter and density of the grains, Q the mass that passes the outlet's plane per time. The *hopper* is
above the plate, the *bin* below it. Surfaces, angles and packing are defined in docs/quantities.md; a value at a place is
interpolated by the kernel to the centre of the cell, three quarters of a spacing wide, that contains it.
"""
import air_numbers as air
import hopper_numbers as grains
import numpy as np
from talus import curves
from talus.continuum import (at, continuum, curve_of, largest, largest_of, mean_of, numbers_within, value_at_window,
                             values_within)
from talus.curves import mean, quantile, ratio
from talus.measures import NotEvaluated, Quantity, Window

REPOSE_PRINTED = 30    # deg
BEGINS_TO_INCLINE = 1  # deg
BETWEEN, ACROSS = ("from", "to"), ("height", "left", "right")


def _passed(run):
    """Integral of Q; particles are spread along z by the kernel."""
    return curves.integral(continuum(run).curve("discharge_rate"))


def _discharged(run):
    """Mass below the outlet, and what was taken away."""
    below, removed = continuum(run).curve("discharged_mass"), continuum(run).curve("removed_mass")
    return curves.Curve(below.time, below.value + removed.value) if len(removed.time) else below


def discharge_drift(run, window):
    return curves.drift(_passed(run), 0.5 * continuum(run).averaging_time, window.begin, window.end)


def discharge_fall(run, window):
    passed = _passed(run)
    return (curves.mean_rate(passed, window.begin, window.end)
            - curves.mean_rate(passed, 2 * window.begin - window.end, window.begin))


def discharge_share_of_largest(run, window):
    passed, of = _passed(run), continuum(run)
    means = curves.mean_rates(passed, window.end - window.begin, 0.05 * of.averaging_time, 0, of.end)
    return ratio(curves.mean_rate(passed, window.begin, window.end), means.value.max()) if len(means.time) else np.nan


def slit_velocity_fluctuation(run, window):
    rest = curves.about_running_mean(continuum(run).curve("slit_velocity"), continuum(run).averaging_time, window.begin,
                                     window.end)
    return curves.standard_deviation(rest.value)


def floor_arrival_first(run, _window, height):
    return curves.first_time_at_or_below(continuum(run).curve("lowest_z"), height)


def _fluctuating_part(run, column, window):
    """A hundred data in T over the window, or as much of it as there are grains at the place; none if that is not half."""
    of = continuum(run)
    whole = of.curve(column)
    empty = np.flatnonzero((whole.time > window.begin) & ~np.isfinite(whole.value))
    until = empty[0] if len(empty) else len(whole.time)
    filled = curves.Curve(whole.time[:until], whole.value[:until])
    if not curves.covers(filled, window.begin, 0.5 * (window.begin + window.end)):
        return curves.EMPTY
    return curves.at_equal_times(filled, 100 / of.averaging_time, window.begin, min(window.end, filled.time[-1]))


def period_of(column):
    def period(run, window):
        longest = continuum(run).averaging_time
        return curves.dominant_period(_fluctuating_part(run, column, window), 0.1 * longest, longest)
    return period


def crossing_period_of(column):
    def period(run, window):
        part = _fluctuating_part(run, column, window)
        return curves.crossing_period(
            curves.about_running_mean(part, continuum(run).averaging_time, window.begin, window.end))
    return period


def mean_over_members(of_two):
    """The mean over the members of two variants, the kth of one with the kth of the other; the fewer begin again."""
    def of_groups(groups, window):
        if len(groups) != 2 or not all(groups):
            raise NotEvaluated("needs the runs of two variants")
        first, second = groups
        return np.mean([of_two(first[k % len(first)], second[k % len(second)], window)
                        for k in range(max(len(first), len(second)))])
    return of_groups


def _means_in(run, window, until=np.inf):
    of = continuum(run)
    length = of.averaging_time
    return curves.mean_rates(_passed(run), length, 0.05 * length, window.begin, min(window.end, of.end, until))


def discharge_ratio_at_max(first, second, window):
    means, half = _means_in(first, window), 0.5 * continuum(first).averaging_time
    if len(means.time) == 0 or np.isnan(means.value).any():
        return np.nan
    time = means.time[means.value.argmax()]
    return ratio(means.value.max(), curves.mean_rate(_passed(second), time - half, time + half))


def discharge_share_larger(first, second, window):
    end = min(continuum(first).end, continuum(second).end)
    one, other = (_means_in(run, window, end).value for run in (first, second))
    return np.mean(one > other) if len(one) and len(one) == len(other) else np.nan


def discharge_difference(first, second, window):
    shares = []
    for run in (first, second):
        of, mass = continuum(run), _discharged(run)
        shares.append(curves.Curve(mass.time, mass.value / of.mass))
    end = min(window.end, continuum(first).end, continuum(second).end)
    every = 0.05 * continuum(first).averaging_time
    times = window.begin + np.arange(int(np.floor((end - window.begin) / every)) + 2) * every
    times = times[times <= end]
    times = times[curves.covers(shares[0], times, times) & curves.covers(shares[1], times, times)]
    one, other = (curves.value_at(share, times) for share in shares)
    return np.nanmax(np.abs(one - other)) if len(times) else np.nan


def _column_of_snapshots(run, name):
    """A number of all snapshots from the program's own table, without those before the opening of the gate."""
    table = run.table("snapshots")
    if name not in table:
        return curves.EMPTY
    time, value = np.asarray(table["time"]), np.asarray(table[name])
    known = (time >= 0) & np.isfinite(value)
    return curves.Curve(time[known], value[known])


def _at_in_table(run, name, window):
    """The same at a window's time: the value of the nearest snapshot, nan where it has none."""
    table = run.table("snapshots")
    if name not in table or len(table) == 0:
        return np.nan
    times, time = np.asarray(table["time"]), np.inf if window.at is None else window.at
    if np.isinf(time):
        return float(table[name][-1])
    interval = times[-1] - times[-2] if len(times) > 1 else 0
    return np.nan if time > times[-1] + 0.5 * interval else float(table[name][curves.nearest_point(times, time)])


def largest_fall(angle, length):
    """Largest by which an angle, means over `length`, lies below an earlier value of itself, once it has passed 1 degree."""
    first = np.flatnonzero(angle.value > BEGINS_TO_INCLINE)
    if len(first) == 0:
        return np.nan
    first = first[0]
    later = curves.part(angle, angle.time[first], np.inf)
    groups = np.floor(later.time / length)
    means = np.array([later.value[groups == group].mean() for group in np.unique(groups)])
    peaks = np.maximum.accumulate(np.append(angle.value[first], means))[1:]
    return float((peaks - means).max(initial=0.0))


def angle_largest_fall(run, _window):
    return largest_fall(_column_of_snapshots(run, "surface_angle_hopper"), 0.5 * continuum(run).averaging_time)


def inward_angle_largest_fall(run, _window, **place):
    return largest_fall(curve_of(grains.surface_inward_angle_hopper, run, place), 0.5 * continuum(run).averaging_time)


def angle_end_difference(run, window):
    return _at_in_table(run, "surface_angle_hopper", window) - _at_in_table(run, "repose_angle_hopper", window)


def inward_angle_end_difference(run, window, **place):
    angle = value_at_window(grains.surface_inward_angle_hopper, run, window, place)
    return angle - _at_in_table(run, "repose_angle_hopper", window)


def repose(nearer):
    """Of the angles of repose of bin and hopper the one nearer to 30 degrees, or the other."""
    def angle(run, window):
        bin_angle, hopper = (_at_in_table(run, f"repose_angle_{where}", window) for where in ("bin", "hopper"))
        if np.isnan(bin_angle) or np.isnan(hopper):
            return np.fmax(bin_angle, hopper) if nearer else np.nan
        bin_is_nearer = abs(bin_angle - REPOSE_PRINTED) <= abs(hopper - REPOSE_PRINTED)
        return bin_angle if bin_is_nearer == nearer else hopper
    return angle


def foot_speed(run, window, height, **place):
    reach = curves.part(curve_of(grains.foot_reach, run, {"height": height}), window.begin, window.end)
    between = (reach.value >= place["from"]) & (reach.value <= place["to"])
    return curves.line(reach.time[between], reach.value[between])[1] if between.sum() > 2 else np.nan


def stream_narrowing(run, window, above_from, above_to, below_from, below_to):
    below, above = (mean(numbers_within(grains.stream_width, run, window, {"from": start, "to": end, "free": below_from}))
                    for start, end in ((below_from, below_to), (above_from, above_to)))
    return ratio(below, above)


def of_gradients(component, statistic):
    def over_snapshots(run, window):
        return statistic(values_within(run, window, lambda n: grains.gradient_numbers(run, n)[component]))
    return over_snapshots


def cell_gradient(component, probability):
    def over_snapshots(run, window):
        return largest(values_within(run, window, lambda n: quantile(grains.cell_gradients(run, n)[component], probability)))
    return over_snapshots


def vortex_product(where, filled=False):
    """Product of the circulations left and right over the sum of their squares: below 0 for a pair of opposite sense."""
    def product(run, window):
        a, b = (value_at_window(air.CIRCULATIONS[where, half, filled], run, window, {}) for half in ("left", "right"))
        return ratio(a * b, a * a + b * b)
    return product


def vortex_reversal(filled=False):
    """Sign of the product of two circulations of the hopper's left half: in its open cells at the window's end, and in those
    cells at its beginning. Below 0 where the vortex has turned."""
    def reversal(run, window):
        before = value_at_window(air.CIRCULATIONS["hopper", "left", filled], run, Window(at=window.begin), {})
        after = value_at_window(air.CIRCULATIONS["hopper", "left", False], run, Window(at=window.end), {})
        return ratio(before * after, abs(before * after))
    return reversal


def wall_seconds(run, _window):
    return float(run.summary["wall_seconds"])


_PROBE = "an eighth of its width above the middle of the outlet"
_SPECTRUM = f"period of {{}} {_PROBE}: values at a hundred times in T, line removed, Hann window, zero-padded four " \
            "times; of the highest peak of the power between T/10 and T"
_CROSSINGS = f"{{}} {_PROBE} less its centred mean over T: mean time between its passages upwards through 0"
_PROBED = {"density": "ρ_b", "velocity": "u_z", "stress": "τ_zz", "strain": "the strain that the law remembers"}

QUANTITIES = {
    "stress_ratio_where_dense": Quantity(
        "1", "Σ τ_xx over Σ τ_zz of the particles with packing above 0.5, where stresses act",
        at(grains.stress_ratio_where_dense)),
    "discharge_rate_drift": Quantity(
        "1", "slope of the line through the means of Q over T/2 times the length of the window, over their mean",
        discharge_drift),
    "discharge_rate_fall": Quantity(
        "kg/s", "mean of Q over the window less that over as long a time before", discharge_fall),
    "discharge_rate_share_of_largest": Quantity(
        "1", "mean of Q over the window, over the largest mean over as long a time", discharge_share_of_largest),
    "discharge_rate_ratio_at_max": Quantity(
        "1", "ratio of the discharges of two runs at the time of the first one's largest mean over T",
        mean_over_members(discharge_ratio_at_max), together=True),
    "discharge_rate_share_larger": Quantity(
        "1", "share of the means over T in which the first of two runs discharges more",
        mean_over_members(discharge_share_larger), together=True),
    "discharge_resolution_difference": Quantity(
        "1", "largest difference of the discharged shares of two runs at equal times, one every T/20",
        mean_over_members(discharge_difference), together=True),
    "slit_velocity_fluctuation": Quantity(
        "m/s", "standard deviation of u_z in the middle of the outlet about its centred mean over T",
        slit_velocity_fluctuation),
    "floor_arrival_first_time": Quantity(
        "s", "first time at which a particle's centre is lower than `height`", floor_arrival_first, ("height",)),
    "repose_angle_nearer": Quantity(
        "deg", "of bin and hopper the angle of repose nearer to 30 degrees", repose(True)),
    "repose_angle_other": Quantity(
        "deg", "of bin and hopper the angle of repose farther from 30 degrees", repose(False)),
    "surface_height_bin": Quantity(
        "m", "mean height of the bin's surface at distances between `from` and `to` from the middle, left and "
        "right together", at(grains.surface_height_bin), BETWEEN),
    "surface_height_hopper": Quantity(
        "m", "mean height of the hopper's surface at distances between `from` and `to` from the middle, left "
        "and right together", at(grains.surface_height_hopper), BETWEEN),
    "surface_outward_angle_bin": Quantity(
        "deg", "angle at which the bin's surface falls towards the walls between distances `from` and `to` from "
        "the middle: of the mean of the slopes of two lines, left and right; negative where it rises towards them",
        at(grains.surface_outward_angle_bin), BETWEEN),
    "surface_inward_angle_hopper": Quantity(
        "deg", "angle at which the hopper's surface falls towards the middle between distances `from` and `to` "
        "from it: of the mean of the slopes of two lines, left and right; negative where it falls towards the walls",
        at(grains.surface_inward_angle_hopper), BETWEEN),
    "surface_inward_angle_largest_fall": Quantity(
        "deg", "as surface_angle_largest_fall, of surface_inward_angle_hopper", inward_angle_largest_fall, BETWEEN),
    "surface_inward_angle_end_difference": Quantity(
        "deg", "surface_inward_angle_hopper less repose_angle_hopper", inward_angle_end_difference, BETWEEN),
    "surface_angle_largest_fall": Quantity(
        "deg", "largest by which surface_angle_hopper lies below an earlier value, means over T/2, once it has "
        "passed 1 degree", angle_largest_fall),
    "surface_angle_end_difference": Quantity(
        "deg", "surface_angle_hopper less repose_angle_hopper", angle_end_difference),
    "surface_swelling": Quantity(
        "m", "height of the hopper's surface in the middle less that `beside` it, means over `width`, mean over "
        "the window", mean_of(grains.surface_swelling), ("beside", "width")),
    "swelling_above_flanks": Quantity(
        "m", "height of the hopper's surface in the middle, mean over `width`, less where the lines through it "
        "between distances `from` and `to` from the middle, prolonged, have it, mean over the window",
        mean_of(grains.swelling_above_flanks), ("from", "to", "width")),
    "foot_speed": Quantity(
        "m/s", "slope of the line through the foot's reach, one each snapshot, against time, while it is "
        "between `from` and `to`; reach: distance from the middle, mean of left and right, at which the mean "
        "packing of the lowest `height` of the bin passes 0.15", foot_speed, ("height", "from", "to")),
    "packing_max_outside_impact": Quantity(
        "1", "99.9th percentile of the packing of the particles farther than `distance` from where the stream "
        "strikes the bin's surface, largest over the snapshots; of a part of the particles, so that it may be above "
        "packing_max", largest_of(grains.packing_max_outside_impact), ("distance",)),
    **{f"period_{name}": Quantity("s", _SPECTRUM.format(text), period_of(f"probe_{name}"))
       for name, text in _PROBED.items()},
    **{f"crossing_period_{name}": Quantity("s", _CROSSINGS.format(text), crossing_period_of(f"probe_{name}"))
       for name, text in _PROBED.items()},
    "inertial_share_of_bearing": Quantity(
        "1", "share with inertial number below 10⁻² of the particles under a pressure that are not below the "
        "outlet, mean over the window", mean_of(grains.inertial_share_of_bearing)),
    "inertial_share_of_bearing_in_shear": Quantity(
        "1", "as inertial_share_of_bearing, with the largest |∂u_i/∂x_j + ∂u_j/∂x_i|, i ≠ j, as shear rate",
        of_gradients(0, mean)),
    "velocity_gradient_shear_percentile": Quantity(
        "1", "as velocity_gradient_shear_max, the 99.9th percentile over the particles in place of the largest",
        of_gradients(1, largest)),
    "velocity_gradient_normal_percentile": Quantity(
        "1", "as velocity_gradient_normal_max, the 99.9th percentile over the particles in place of the largest",
        of_gradients(2, largest)),
    "cell_gradient_shear_max": Quantity(
        "1", "(D/g)^½ times the largest |∂u_x/∂z| or |∂u_z/∂x| above the outlet, central differences of "
        "velocities averaged over cells of three quarters of a spacing with packing above 0.5, largest over the "
        "snapshots", cell_gradient(0, 1)),
    "cell_gradient_normal_max": Quantity(
        "1", "as cell_gradient_shear_max, of |∂u_x/∂x| or |∂u_z/∂z|", cell_gradient(1, 1)),
    "cell_gradient_shear_percentile": Quantity(
        "1", "as cell_gradient_shear_max, the 99.9th percentile over the cells in place of the largest",
        cell_gradient(0, grains.NEARLY_ALL)),
    "cell_gradient_normal_percentile": Quantity(
        "1", "as cell_gradient_normal_max, the 99.9th percentile over the cells in place of the largest",
        cell_gradient(1, grains.NEARLY_ALL)),
    "hopper_velocity": Quantity(
        "m/s", "mean of u_z from `left` to `right` at `height`", at(grains.hopper_velocity), ACROSS),
    "hopper_packing": Quantity(
        "1", "mean packing from `left` to `right` at `height`", at(grains.hopper_packing), ACROSS),
    "stream_narrowing": Quantity(
        "1", "width of the stream (5th to 95th percentile of the mass in x) from `below_from` to `below_to` "
        "over that from `above_from` to `above_to`, each the mean over the snapshots in which the heap beside it is "
        "lower than that", stream_narrowing, ("above_from", "above_to", "below_from", "below_to")),
    "stream_packing": Quantity(
        "1", "mean packing of the stream's particles from `from` to `to`, while the heap is lower",
        at(grains.stream_packing), BETWEEN),
    "stream_packing_of_cells": Quantity(
        "1", "mean packing of the cells of three quarters of a spacing from `from` to `to`, in the middle of "
        "the depth, in which it is above 0.1, while the heap is lower", at(grains.stream_packing_of_cells), BETWEEN),
    "stream_stress_share": Quantity(
        "1", "mean τ_zz of the stream's particles from `from` to `to`, while the heap is lower, over that of "
        "the grains above the outlet", at(grains.stream_stress_share), BETWEEN),
    "stream_stripes": Quantity(
        "1", "standard deviation of the packing along the middle of the stream from `from` to `to`, over its "
        "mean", at(grains.stream_stripes), BETWEEN),
    "corner_packing_ratio_hopper": Quantity(
        "1", "mean packing of the squares of `size` in the hopper's two bottom corners over that of the layer "
        "deeper than 3 h, without the outermost h/2", at(grains.CORNER_RATIOS["hopper"]), ("size",)),
    "corner_packing_ratio_bin": Quantity("1", "the same in the bin", at(grains.CORNER_RATIOS["bin"]), ("size",)),
    "corner_packing_over_middle_bin": Quantity(
        "1", "mean packing of the squares of `size` in the bin's two bottom corners over that of the middle "
        "third of the layer of that height, without the outermost h/2",
        at(grains.corner_packing_over_middle_bin), ("size",)),
    "wall_seconds": Quantity("s", "wall time of the whole run, as its summary says", wall_seconds),
    "drag_to_weight": Quantity(
        "1", "upward drag of the air on the grains (Eq. 20, without the pressure's part) over their weight, of "
        "the cells of the air's grid from `left` to `right` at `height`", at(air.drag_to_weight), ACROSS),
    "air_pressure_drop_height": Quantity(
        "m", "z of the largest size of dP/dz (central differences) at `x`, from `from` to `to`",
        at(air.air_pressure_drop_height), ("x", *BETWEEN)),
    "air_pressure_gradient_at_drop": Quantity(
        "Pa/m", "dP/dz at air_pressure_drop_height", at(air.air_pressure_gradient_at_drop), ("x", *BETWEEN)),
    "air_pressure_outside_inside": Quantity(
        "Pa", "at `height` the mean pressure where packing < 0.01, less the mean where packing > 0.1",
        at(air.air_pressure_outside_inside), ("height",)),
    "air_velocity_within_plug": Quantity(
        "m/s", "mean u_z of the air at `height` where the grains' −u_z is above half its largest value there",
        at(air.air_velocity_within_plug), ("height",)),
    "air_velocity_beside_plug": Quantity(
        "m/s", "largest mean u_z of the air over five cells at `height` beside the grains of "
        "air_velocity_within_plug", at(air.air_velocity_beside_plug), ("height",)),
    "air_velocity_slowness": Quantity(
        "1", "speed of the air within the moving grains over that of the grains",
        at(air.air_velocity_slowness), ("height",)),
    "air_vortex_product_bin": Quantity(
        "1", "circulation of the left half of the bin times that of the right one over the sum of their "
        "squares; circulation: integral of ∂u_x/∂z − ∂u_z/∂x over the cells with packing below 0.01",
        vortex_product("bin")),
    "air_vortex_product_hopper": Quantity(
        "1", "air_vortex_product_bin of the two halves of the hopper", vortex_product("hopper")),
    "air_vortex_product_bed": Quantity(
        "1", "air_vortex_product_hopper over the cells with packing above 0.1: within the grains",
        vortex_product("hopper", filled=True)),
    "air_vortex_reversal_hopper": Quantity(
        "1", "circulation of the hopper's left half at the beginning of the window times that at its end, over "
        "its size", vortex_reversal()),
    "air_vortex_reversal_bed": Quantity(
        "1", "circulation within the grains of the hopper's left half at the beginning of the window times that "
        "above them at its end, over its size", vortex_reversal(filled=True)),
}
