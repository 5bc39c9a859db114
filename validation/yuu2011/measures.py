# SPDX-License-Identifier: Apache-2.0
"""The quantities of this study beside those of a summary. Estimators in full: reference.toml.

T is `analysis.averaging_time`, t the time from the opening of the gate, h the spacing of the particles at the start, D and
ρ_p the diameter and density of the grains, Q the mass that passes the outlet's plane per time. The *hopper* is what is above
the plate, the *bin* what is below it. Surfaces, angles and packing are those of docs/quantities.md; a value at a place is
interpolated by the kernel to the centre of the cell, three quarters of a spacing wide, that contains it.
"""
import numpy as np
from talus import curves, surfaces
from talus.continuum import continuum
from talus.curves import mean, quantile, ratio
from talus.fields import cell_centres
from talus.measures import NotEvaluated, Quantity, Window, once

QUASISTATIC = 1e-2     # inertial number, section 2.1
DENSE = 0.5            # packing from which stresses act, section 5.1
NEARLY_ALL = 0.999
IN_STREAM = 0.1        # packing of the cells that a stream passes, above
HARDLY_ANY = 0.01      # packing of open air
FOOT_PACKING = 0.15
REPOSE_PRINTED = 30    # deg
BEGINS_TO_INCLINE = 1  # deg
DEPTH_IN_SPACINGS = 3
CELLS_BESIDE_PLUG = 5
BETWEEN, ACROSS = ("from", "to"), ("height", "left", "right")


# ------------------------------------------------------------------------------------------------- numbers of snapshots
@once
def _number(run, n, number, place):
    return float(number(continuum(run).snapshot(n), **dict(place)))


def _value_at(number, run, window, place):
    """In the snapshot nearest the window's time; nan if the run ended more than half an interval before."""
    times, time = continuum(run).times, np.inf if window.at is None else window.at
    if len(times) == 0:
        return np.nan
    if np.isinf(time):
        return _number(run, len(times) - 1, number, _key(place))
    interval = times[-1] - times[-2] if len(times) > 1 else 0
    if time > times[-1] + 0.5 * interval:
        return np.nan
    return _number(run, curves.nearest_point(times, time), number, _key(place))


def _key(place):
    return tuple(sorted(place.items()))


def _values_of_snapshots(run, value):
    """Curve of value(n) of the snapshots from the gate's opening on, those that have one."""
    times = continuum(run).times
    after = np.flatnonzero(times >= 0)
    values = np.array([value(int(n)) for n in after], dtype=float)
    known = np.isfinite(values)
    return curves.Curve(times[after][known], values[known])


def _values_within(run, window, value):
    return curves.part(_values_of_snapshots(run, value), window.begin, window.end).value


def _curve_of(number, run, place):
    return _values_of_snapshots(run, lambda n: _number(run, n, number, _key(place)))


def _within(number, run, window, place):
    return curves.part(_curve_of(number, run, place), window.begin, window.end).value


def at(number):
    return lambda run, window, **place: _value_at(number, run, window, place)


def mean_of(number):
    return lambda run, window, **place: mean(_within(number, run, window, place))


def largest(values):
    return quantile(values, 1)


def largest_of(number):
    return lambda run, window, **place: largest(_within(number, run, window, place))


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


# ------------------------------------------------------------------------------------------------------------ discharge
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


# ----------------------------------------------------------------------------------------------------------- two runs
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


# ------------------------------------------------------------------------------------------------------------- surfaces
def surface_height_bin(s, **place):
    return surfaces.height_beside(s.bin_surface, s.of.middle, place["from"], place["to"])


def surface_height_hopper(s, **place):
    return surfaces.height_beside(s.hopper_surface, s.of.middle, place["from"], place["to"])


def surface_outward_angle_bin(s, **place):
    return np.degrees(surfaces.outward_angle(s.bin_surface, s.of.middle, place["from"], place["to"]))


def surface_inward_angle_hopper(s, **place):
    return -np.degrees(surfaces.outward_angle(s.hopper_surface, s.of.middle, place["from"], place["to"]))


def surface_swelling(s, beside, width):
    return surfaces.swelling(s.hopper_surface, s.of.middle, beside, width)


def swelling_above_flanks(s, **place):
    return surfaces.swelling_above_flanks(s.hopper_surface, s.of.middle, place["from"], place["to"], place["width"])


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
    return largest_fall(_curve_of(surface_inward_angle_hopper, run, place), 0.5 * continuum(run).averaging_time)


def angle_end_difference(run, window):
    return _at_in_table(run, "surface_angle_hopper", window) - _at_in_table(run, "repose_angle_hopper", window)


def inward_angle_end_difference(run, window, **place):
    return _value_at(surface_inward_angle_hopper, run, window, place) - _at_in_table(run, "repose_angle_hopper", window)


def repose(nearer):
    """Of the angles of repose of bin and hopper the one nearer to 30 degrees, or the other."""
    def angle(run, window):
        bin_angle, hopper = (_at_in_table(run, f"repose_angle_{where}", window) for where in ("bin", "hopper"))
        if np.isnan(bin_angle) or np.isnan(hopper):
            return np.fmax(bin_angle, hopper) if nearer else np.nan
        bin_is_nearer = abs(bin_angle - REPOSE_PRINTED) <= abs(hopper - REPOSE_PRINTED)
        return bin_angle if bin_is_nearer == nearer else hopper
    return angle


def foot_reach(s, height):
    """How far the layer on the bin's floor reaches from the middle, mean of left and right: to where the mean packing of the
    lowest `height` passes 0.15; nan where one side has none."""
    if s.section is None:
        return np.nan
    packing, x = s.section.value[s.section.z < height].mean(axis=0), s.section.x
    reach = []
    for away, of in ((s.of.middle - x[::-1], packing[::-1]), (x - s.of.middle, packing)):
        filled = (of >= FOOT_PACKING) & (away > 0)
        inner = np.flatnonzero(filled[:-1] & (of[1:] < FOOT_PACKING))
        ends = list(away[inner] + s.section.width * (of[inner] - FOOT_PACKING) / (of[inner] - of[inner + 1]))
        if filled[-1]:
            ends.append(away[-1] + 0.5 * s.section.width)
        reach.append(max(ends) if ends else np.nan)
    return 0.5 * sum(reach)


def foot_speed(run, window, height, **place):
    reach = curves.part(_curve_of(foot_reach, run, {"height": height}), window.begin, window.end)
    between = (reach.value >= place["from"]) & (reach.value <= place["to"])
    return curves.line(reach.time[between], reach.value[between])[1] if between.sum() > 2 else np.nan


# ------------------------------------------------------------------------------------------------------ stream, corners
def _is_free(s, height):
    """Whether the heap in the bin, left and right of what is below the outlet, is lower than a height."""
    if s.of.plate is None or s.section is None:
        return False
    x, z = s.bin_surface
    beside = (x < s.of.slit[0]) | (x > s.of.slit[1])
    return not (z[beside] > height).any()


def stream_width(s, free, **place):
    if not _is_free(s, free):
        return np.nan
    x, _, z = np.asarray(s.frame.positions).T
    inside = x[(z >= place["from"]) & (z < place["to"])]
    return quantile(inside, 0.95) - quantile(inside, 0.05)


def stream_narrowing(run, window, above_from, above_to, below_from, below_to):
    below, above = (mean(_within(stream_width, run, window, {"from": start, "to": end, "free": below_from}))
                    for start, end in ((below_from, below_to), (above_from, above_to)))
    return ratio(below, above)


def _mean_between(frame, values, start, end):
    z = np.asarray(frame.positions)[:, 2]
    return mean(values[(z > start) & (z < end)])


def stream_packing(s, **place):
    if not _is_free(s, place["from"]):
        return np.nan
    frame = s.frame
    return _mean_between(frame, np.asarray(frame["packing"]), place["from"], place["to"])


def stream_stress_share(s, **place):
    if not _is_free(s, place["from"]):
        return np.nan
    frame = s.frame
    stress = np.asarray(frame["stress_zz"])
    return ratio(_mean_between(frame, stress, place["from"], place["to"]),
                 _mean_between(frame, stress, s.of.plate, s.of.height))


def _steps(start, end, step):
    """start, start + step, ... below the end, as sums."""
    steps = [start]
    while steps[-1] < end:
        steps.append(steps[-1] + step)
    return np.array(steps[:-1])


def _packing_at(s, x, z):
    places = np.column_stack([x, np.full(len(x), 0.5 * s.of.depth), z])
    return s.field(s.frame).packing(cell_centres(places, s.of.cell))


def stream_packing_of_cells(s, **place):
    if not _is_free(s, place["from"]):
        return np.nan
    cell = s.of.cell
    z, x = np.meshgrid(_steps(place["from"], place["to"], cell), _steps(0.5 * cell, s.of.width, cell), indexing="ij")
    packing = _packing_at(s, x.ravel(), z.ravel())
    return mean(packing[packing > IN_STREAM])


def stream_stripes(s, **place):
    if not _is_free(s, place["from"]):
        return np.nan
    z = _steps(place["from"], place["to"], s.of.cell)
    along = _packing_at(s, np.full(len(z), s.of.middle), z)
    return curves.standard_deviation(along) / mean(along) if mean(along) > 0 else np.nan


def _mean_across(s, value, height, left, right):
    """Of what `value` makes of the centres of the cells from left to right at a height."""
    if s.of.plate is None or s.section is None:
        return np.nan
    x = _steps(left, right, s.of.cell)
    places = np.column_stack([x, np.full(len(x), 0.5 * s.of.depth), np.full(len(x), height)])
    return mean(value(cell_centres(places, s.of.cell)))


def hopper_velocity(s, height, left, right):
    frame = s.frame
    return _mean_across(s, lambda places: s.field(frame).packing_and_mean(places, frame["velocity"])[1][:, 2], height, left,
                        right)


def hopper_packing(s, height, left, right):
    return _mean_across(s, lambda places: s.field(s.frame).packing(places), height, left, right)


def _corners_over(s, bottom, size, compared):
    """Mean packing of the two squares of `size` at the bottom beside the side walls, over that of the cells of the same
    layer that `compared(from_side, z)` names, both without the outermost h/2."""
    section, margin = s.section, 0.5 * s.of.spacing
    above = section.z - bottom
    rows = ~((above < margin) | (above > size))
    from_side = np.minimum(section.x, s.of.width - section.x)
    packing, z = section.value[rows], section.z[rows]
    inner = from_side >= margin
    corners = packing[:, inner & (from_side <= size)]
    return ratio(mean(corners.ravel()), mean(packing[compared(from_side, z) & inner]))


def corner_packing_ratio(where):
    def over_layer(s, size):
        if s.section is None or (where == "hopper" and s.of.plate is None):
            return np.nan
        bottom, surface = (0.0, s.bin_surface) if where == "bin" else (s.of.plate, s.hopper_surface)
        return _corners_over(s, bottom, size,
                             lambda _, z: surface.z - z[:, None] > DEPTH_IN_SPACINGS * s.of.spacing)
    return over_layer


def corner_packing_over_middle_bin(s, size):
    if s.section is None:
        return np.nan
    return _corners_over(s, 0.0, size, lambda from_side, z: np.broadcast_to(from_side >= s.of.width / 3,
                                                                            (len(z), len(from_side))))


CORNER_RATIOS = {where: corner_packing_ratio(where) for where in ("hopper", "bin")}


def packing_max_outside_impact(s, distance):
    """Of the particles farther than `distance` from where the stream strikes: the stretch below the slit, as high as the
    bin's surface there (the median; of the whole surface where the stream hides it; the floor before there is one)."""
    start, end = s.of.slit if s.of.plate is not None else (0.0, 0.0)
    heights = s.bin_surface.heights(start, end)[1]
    if len(heights) == 0:
        heights = s.bin_surface.heights(0, s.of.width)[1]
    height = np.median(heights) if len(heights) else 0.0
    frame = s.frame
    x, _, z = np.asarray(frame.positions).T
    away = np.hypot(np.maximum(np.maximum(start - x, 0), x - end), z - height)
    return quantile(np.asarray(frame["packing"])[away > distance], NEARLY_ALL)


# ---------------------------------------------------------------------------------------------------- stresses and rates
def stress_ratio_where_dense(s):
    frame = s.frame
    dense = np.asarray(frame["packing"]) > DENSE
    across, upright = (np.asarray(frame[name])[dense].sum() for name in ("stress_xx", "stress_zz"))
    return across / upright if upright > 0 else np.nan


def _share_of_slow_flow(s, frame, rate):
    """Share with I below 10⁻² of the particles under a pressure that are not below the outlet."""
    pressure = sum(np.asarray(frame[f"stress_{axis}"]) for axis in ("xx", "yy", "zz")) / 3
    taken = pressure > 0
    if s.of.plate is not None:
        x, _, z = np.asarray(frame.positions).T
        taken &= (z > s.of.plate) | (x < s.of.slit[0]) | (x > s.of.slit[1])
    inertial = np.asarray(rate)[taken] * s.of.grain_diameter * np.sqrt(s.of.grain_density / pressure[taken])
    return mean(inertial < QUASISTATIC)


def inertial_share_of_bearing(s):
    frame = s.frame
    return _share_of_slow_flow(s, frame, frame["shear_rate"])


@once
def _of_gradients(run, n):
    """(share of slow flow with the largest |∂u_i/∂x_j + ∂u_j/∂x_i|, i ≠ j, as shear rate, and the 99.9th percentiles of
    the particles' largest |∂u_i/∂x_j|, i ≠ j and i = j, times (D/g)^½, where packing is above 0.5)."""
    s = continuum(run).snapshot(n)
    frame = s.frame
    if len(frame.positions) == 0:
        return np.nan, np.nan, np.nan
    gradient = s.field(frame).velocity_gradients(frame["velocity"])
    rates = np.abs(gradient + gradient.transpose(0, 2, 1))[:, (0, 1, 2), (1, 2, 0)].max(axis=1)
    sizes = np.sqrt(s.of.grain_diameter / s.of.gravity) * np.abs(gradient[np.asarray(frame["packing"]) > DENSE])
    normal = np.eye(3, dtype=bool)
    return (_share_of_slow_flow(s, frame, rates), *(quantile(sizes[:, part].max(axis=1), NEARLY_ALL)
                                                    if len(sizes) else np.nan for part in (~normal, normal)))


def of_gradients(component, statistic):
    def over_snapshots(run, window):
        return statistic(_values_within(run, window, lambda n: _of_gradients(run, n)[component]))
    return over_snapshots


@once
def _cell_gradients(run, n):
    """(shear, normal), largest of each cell, times (D/g)^½: central differences of the velocities at the centres of the
    cells above the plate, in the middle of the depth, whose packing and whose neighbours' is above 0.5."""
    of = continuum(run)
    s, bottom, cell = of.snapshot(n), of.plate or 0.0, of.cell
    frame = s.frame
    if len(frame.positions) == 0:
        return np.empty(0), np.empty(0)
    columns, rows = int(of.width / cell + 0.5), int((of.height - bottom) / cell + 0.5)
    z, x = np.meshgrid(bottom + (np.arange(rows) + 0.5) * cell, (np.arange(columns) + 0.5) * cell, indexing="ij")
    places = np.column_stack([x.ravel(), np.full(x.size, 0.5 * of.depth), z.ravel()])
    packing, velocity = s.field(frame).packing_and_mean(places, frame["velocity"])
    velocity[~(packing > DENSE)] = np.nan
    u = velocity.reshape(rows, columns, 3)
    unit = np.sqrt(of.grain_diameter / of.gravity) / (2 * cell)
    along_x, along_z = u[1:-1, 2:] - u[1:-1, :-2], u[2:, 1:-1] - u[:-2, 1:-1]
    known = np.isfinite(along_x + along_z + u[1:-1, 1:-1]).all(axis=2)
    along_x, along_z = unit * np.abs(along_x[known]), unit * np.abs(along_z[known])
    return np.maximum(along_x[:, 2], along_z[:, 0]), np.maximum(along_x[:, 0], along_z[:, 2])


def cell_gradient(component, probability):
    def over_snapshots(run, window):
        return largest(_values_within(run, window, lambda n: quantile(_cell_gradients(run, n)[component], probability)))
    return over_snapshots


# ------------------------------------------------------------------------------------------------------------------ air
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


def vortex_product(where, filled=False):
    """Product of the circulations left and right over the sum of their squares: below 0 for a pair of opposite sense."""
    def product(run, window):
        a, b = (_value_at(CIRCULATIONS[where, half, filled], run, window, {}) for half in ("left", "right"))
        return ratio(a * b, a * a + b * b)
    return product


def vortex_reversal(filled=False):
    """Sign of the product of two circulations of the hopper's left half: in its open cells at the window's end, and in those
    cells at its beginning. Below 0 where the vortex has turned."""
    def reversal(run, window):
        before = _value_at(CIRCULATIONS["hopper", "left", filled], run, Window(at=window.begin), {})
        after = _value_at(CIRCULATIONS["hopper", "left", False], run, Window(at=window.end), {})
        return ratio(before * after, abs(before * after))
    return reversal


def wall_seconds(run, _window):
    return float(run.summary["wall_seconds"])


_PROBE = "an eighth of its width above the middle of the outlet"
_SPECTRUM = f"period of {{}} {_PROBE}: values at a hundred times in T, line removed, Hann window, zero-padded four times; of the " \
            "highest peak of the power between T/10 and T"
_CROSSINGS = f"{{}} {_PROBE} less its centred mean over T: mean time between its passages upwards through 0"
_PROBED = {"density": "ρ_b", "velocity": "u_z", "stress": "τ_zz", "strain": "the strain that the law remembers"}

QUANTITIES = {
    "stress_ratio_where_dense": Quantity(
        "1", "Σ τ_xx over Σ τ_zz of the particles with packing above 0.5, where stresses act", at(stress_ratio_where_dense)),
    "discharge_rate_drift": Quantity(
        "1", "slope of the line through the means of Q over T/2 times the length of the window, over their mean",
        discharge_drift),
    "discharge_rate_fall": Quantity("kg/s", "mean of Q over the window less that over as long a time before", discharge_fall),
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
    "repose_angle_nearer": Quantity("deg", "of bin and hopper the angle of repose nearer to 30 degrees", repose(True)),
    "repose_angle_other": Quantity("deg", "of bin and hopper the angle of repose farther from 30 degrees", repose(False)),
    "surface_height_bin": Quantity(
        "m", "mean height of the bin's surface at distances between `from` and `to` from the middle, left and right together",
        at(surface_height_bin), BETWEEN),
    "surface_height_hopper": Quantity(
        "m", "mean height of the hopper's surface at distances between `from` and `to` from the middle, left and right "
        "together", at(surface_height_hopper), BETWEEN),
    "surface_outward_angle_bin": Quantity(
        "deg", "angle at which the bin's surface falls towards the walls between distances `from` and `to` from the middle: of "
        "the mean of the slopes of two lines, left and right; negative where it rises towards them",
        at(surface_outward_angle_bin), BETWEEN),
    "surface_inward_angle_hopper": Quantity(
        "deg", "angle at which the hopper's surface falls towards the middle between distances `from` and `to` from it: of the "
        "mean of the slopes of two lines, left and right; negative where it falls towards the walls",
        at(surface_inward_angle_hopper), BETWEEN),
    "surface_inward_angle_largest_fall": Quantity(
        "deg", "as surface_angle_largest_fall, of surface_inward_angle_hopper", inward_angle_largest_fall, BETWEEN),
    "surface_inward_angle_end_difference": Quantity(
        "deg", "surface_inward_angle_hopper less repose_angle_hopper", inward_angle_end_difference, BETWEEN),
    "surface_angle_largest_fall": Quantity(
        "deg", "largest by which surface_angle_hopper lies below an earlier value, means over T/2, once it has passed 1 degree",
        angle_largest_fall),
    "surface_angle_end_difference": Quantity(
        "deg", "surface_angle_hopper less repose_angle_hopper", angle_end_difference),
    "surface_swelling": Quantity(
        "m", "height of the hopper's surface in the middle less that `beside` it, means over `width`, mean over the window",
        mean_of(surface_swelling), ("beside", "width")),
    "swelling_above_flanks": Quantity(
        "m", "height of the hopper's surface in the middle, mean over `width`, less where the lines through it between "
        "distances `from` and `to` from the middle, prolonged, have it, mean over the window",
        mean_of(swelling_above_flanks), ("from", "to", "width")),
    "foot_speed": Quantity(
        "m/s", "slope of the line through the foot's reach, one each snapshot, against time, while it is between `from` and "
        "`to`; reach: distance from the middle, mean of left and right, at which the mean packing of the lowest `height` of "
        "the bin passes 0.15", foot_speed, ("height", "from", "to")),
    "packing_max_outside_impact": Quantity(
        "1", "99.9th percentile of the packing of the particles farther than `distance` from where the stream strikes the "
        "bin's surface, largest over the snapshots; of a part of the particles, so that it may be above packing_max",
        largest_of(packing_max_outside_impact), ("distance",)),
    **{f"period_{name}": Quantity("s", _SPECTRUM.format(text), period_of(f"probe_{name}"))
       for name, text in _PROBED.items()},
    **{f"crossing_period_{name}": Quantity("s", _CROSSINGS.format(text), crossing_period_of(f"probe_{name}"))
       for name, text in _PROBED.items()},
    "inertial_share_of_bearing": Quantity(
        "1", "share with inertial number below 10⁻² of the particles under a pressure that are not below the outlet, mean "
        "over the window", mean_of(inertial_share_of_bearing)),
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
        "1", "(D/g)^½ times the largest |∂u_x/∂z| or |∂u_z/∂x| above the outlet, central differences of velocities averaged "
        "over cells of three quarters of a spacing with packing above 0.5, largest over the snapshots", cell_gradient(0, 1)),
    "cell_gradient_normal_max": Quantity("1", "as cell_gradient_shear_max, of |∂u_x/∂x| or |∂u_z/∂z|", cell_gradient(1, 1)),
    "cell_gradient_shear_percentile": Quantity(
        "1", "as cell_gradient_shear_max, the 99.9th percentile over the cells in place of the largest",
        cell_gradient(0, NEARLY_ALL)),
    "cell_gradient_normal_percentile": Quantity(
        "1", "as cell_gradient_normal_max, the 99.9th percentile over the cells in place of the largest",
        cell_gradient(1, NEARLY_ALL)),
    "hopper_velocity": Quantity("m/s", "mean of u_z from `left` to `right` at `height`", at(hopper_velocity), ACROSS),
    "hopper_packing": Quantity("1", "mean packing from `left` to `right` at `height`", at(hopper_packing), ACROSS),
    "stream_narrowing": Quantity(
        "1", "width of the stream (5th to 95th percentile of the mass in x) from `below_from` to `below_to` over that from "
        "`above_from` to `above_to`, each the mean over the snapshots in which the heap beside it is lower than that",
        stream_narrowing, ("above_from", "above_to", "below_from", "below_to")),
    "stream_packing": Quantity(
        "1", "mean packing of the stream's particles from `from` to `to`, while the heap is lower", at(stream_packing), BETWEEN),
    "stream_packing_of_cells": Quantity(
        "1", "mean packing of the cells of three quarters of a spacing from `from` to `to`, in the middle of the depth, in "
        "which it is above 0.1, while the heap is lower", at(stream_packing_of_cells), BETWEEN),
    "stream_stress_share": Quantity(
        "1", "mean τ_zz of the stream's particles from `from` to `to`, while the heap is lower, over that of the grains above "
        "the outlet", at(stream_stress_share), BETWEEN),
    "stream_stripes": Quantity(
        "1", "standard deviation of the packing along the middle of the stream from `from` to `to`, over its mean",
        at(stream_stripes), BETWEEN),
    "corner_packing_ratio_hopper": Quantity(
        "1", "mean packing of the squares of `size` in the hopper's two bottom corners over that of the layer deeper than 3 h, "
        "without the outermost h/2", at(CORNER_RATIOS["hopper"]), ("size",)),
    "corner_packing_ratio_bin": Quantity("1", "the same in the bin", at(CORNER_RATIOS["bin"]), ("size",)),
    "corner_packing_over_middle_bin": Quantity(
        "1", "mean packing of the squares of `size` in the bin's two bottom corners over that of the middle third of the layer "
        "of that height, without the outermost h/2", at(corner_packing_over_middle_bin), ("size",)),
    "wall_seconds": Quantity("s", "wall time of the whole run, as its summary says", wall_seconds),
    "drag_to_weight": Quantity(
        "1", "upward drag of the air on the grains (Eq. 20, without the pressure's part) over their weight, of the cells of the "
        "air's grid from `left` to `right` at `height`", at(drag_to_weight), ACROSS),
    "air_pressure_drop_height": Quantity(
        "m", "z of the largest size of dP/dz (central differences) at `x`, from `from` to `to`", at(air_pressure_drop_height),
        ("x", *BETWEEN)),
    "air_pressure_gradient_at_drop": Quantity(
        "Pa/m", "dP/dz at air_pressure_drop_height", at(air_pressure_gradient_at_drop), ("x", *BETWEEN)),
    "air_pressure_outside_inside": Quantity(
        "Pa", "at `height` the mean pressure where packing < 0.01, less the mean where packing > 0.1",
        at(air_pressure_outside_inside), ("height",)),
    "air_velocity_within_plug": Quantity(
        "m/s", "mean u_z of the air at `height` where the grains' −u_z is above half its largest value there",
        at(air_velocity_within_plug), ("height",)),
    "air_velocity_beside_plug": Quantity(
        "m/s", "largest mean u_z of the air over five cells at `height` beside the grains of air_velocity_within_plug",
        at(air_velocity_beside_plug), ("height",)),
    "air_velocity_slowness": Quantity(
        "1", "speed of the air within the moving grains over that of the grains", at(air_velocity_slowness), ("height",)),
    "air_vortex_product_bin": Quantity(
        "1", "circulation of the left half of the bin times that of the right one over the sum of their squares; circulation: "
        "integral of ∂u_x/∂z − ∂u_z/∂x over the cells with packing below 0.01", vortex_product("bin")),
    "air_vortex_product_hopper": Quantity(
        "1", "air_vortex_product_bin of the two halves of the hopper", vortex_product("hopper")),
    "air_vortex_product_bed": Quantity(
        "1", "air_vortex_product_hopper over the cells with packing above 0.1: within the grains",
        vortex_product("hopper", filled=True)),
    "air_vortex_reversal_hopper": Quantity(
        "1", "circulation of the hopper's left half at the beginning of the window times that at its end, over its size",
        vortex_reversal()),
    "air_vortex_reversal_bed": Quantity(
        "1", "circulation within the grains of the hopper's left half at the beginning of the window times that above them at "
        "its end, over its size", vortex_reversal(filled=True)),
}
