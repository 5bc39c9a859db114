# SPDX-License-Identifier: Apache-2.0
"""Numbers of one snapshot of the hopper, functions(ContinuumSnapshot, **place); nan where they have no meaning. Lengths of a
place in m."""
import numpy as np
from talus import curves, surfaces
from talus.continuum import continuum
from talus.curves import mean, quantile, ratio
from talus.fields import cell_centres
from talus.measures import once

QUASISTATIC = 1e-2  # inertial number, section 2.1
DENSE = 0.5         # packing from which stresses act, section 5.1
NEARLY_ALL = 0.999
IN_STREAM = 0.1     # packing of the cells that a stream passes, above
FOOT_PACKING = 0.15
DEPTH_IN_SPACINGS = 3


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
def gradient_numbers(run, n):
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


@once
def cell_gradients(run, n):
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
