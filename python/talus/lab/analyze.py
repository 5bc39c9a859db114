# SPDX-License-Identifier: Apache-2.0
"""talus analyze FILE --as NAME: what is measured of one set of points, whoever made it. x points down the slope, y to its left,
z away from it; of a heap z is up."""
import json
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from talus.ask import ask
from talus.curves import mean, quantile, standard_deviation
from talus.fields import Box, Field, Grains, packing_section
from talus.grains import (COLUMN, REACH, UPPER_SHARE, angle_of_line, find_heads, head_size, pairs, surface_walk,
                          thickness_profile)
from talus.lab.command import DONE, arguments, run_command, say
from talus.samples import anderson_darling, skewness
from talus.snapshots import ParticleSnapshot
from talus.surfaces import free_surface, heap_slopes, repose_angles, surface_angle
from talus.trouble import InputError, nearest, problem

LAYER_ON_SLOPE = 2          # mean radii: the first layer of grains
MIN_SLOPE = 20            # mean radii: ten spacings, as in the hopper
ROOM = 6                    # mean radii above the highest point, so that the surface has an end
FARTHEST_OVER_RADIUS = 1e6  # of two points, so that a grid of cells can hold them


class Points(NamedTuple):
    """`columns` are (unit, values) by name; `radii` those of the file, or else the mean radius `a`."""

    name: str
    columns: dict
    position: np.ndarray
    radii: np.ndarray
    a: float

    @property
    def velocity(self):
        return self.columns["velocity"][1] if "velocity" in self.columns else None

    @property
    def from_the_side(self):
        return self.position * [1, 0, 1]

    def numbers(self, name):
        """The unit and numbers of a column: of a vector its length, or a component by NAME_x."""
        known = {}
        for column, (unit, values) in self.columns.items():
            if values.ndim == 1:
                known[column] = unit, values
            else:
                known[column] = unit, np.linalg.norm(values, axis=1)
                known |= {f"{column}_{axis}": (unit, values[:, k]) for k, axis in enumerate("xyz"[:values.shape[1]])}
        if name not in known:
            what = f"{self.name} has no such column" if name else "missing"
            raise InputError([problem(f"--column {name or ''}", what, allowed=", ".join(known),
                                      near=nearest(name or "", known))])
        return known[name][0], np.asarray(known[name][1], dtype=float)


def _columns(path):
    if Path(path).suffix == ".csv":
        return {column["name"]: (column["unit"], np.array(column["values"], dtype=float))
                for column in ask("points", file=path)}
    snapshot = ParticleSnapshot(path, 0)
    return {"position": ("m", np.asarray(snapshot.positions, dtype=float)),
            **{name: (snapshot[name].units, np.asarray(snapshot[name])) for name in snapshot}}


def points_of(name, columns, mean_radius=None, needs_radius=True):
    """Raises InputError if there are no points, if a place is not finite or a radius not above 0, or if neither the points nor
    the caller give a radius that is needed."""
    faults, position = [], columns["position"][1]
    radii, a = np.empty(0), mean_radius
    if len(position) == 0:
        faults.append(problem(name, "holds no points", allowed="at least one"))
    if "radius" in columns:
        radii = columns["radius"][1]
        if not (np.isfinite(radii) & (radii > 0)).all():
            faults.append(problem(name, "has radii that are not above 0", allowed="radii above 0"))
        a = mean_radius or mean(radii)
    elif mean_radius:
        radii = np.full(len(position), mean_radius)
    elif needs_radius:
        faults.append(problem(name, "has no column 'radius'", allowed='--radius, such as "5 mm"'))
    if not faults and a and not (np.linalg.norm(position - position[0], axis=1) < FARTHEST_OVER_RADIUS * a).all():
        faults.append(problem(name, "has places that are not finite, or a million radii apart",
                              allowed="see --radius, and the units"))
    if faults:
        raise InputError(faults)
    return Points(name, columns, position, radii, a)


# ------------------------------------------------------------------------------------------------------------- measures
# Each returns quantities {name: (unit, value)}, and of a table the columns {name: unit} and the rows.

def heads(points, *_):
    columns = {"particles": "1", "width": "m", "thickness": "m", "aspect_ratio": "1", "concavity": "1"}
    rows = []
    for head in find_heads(points.position, points.a):
        size = head_size(points.position, points.radii, head, points.a)
        rows.append([len(head), size.width, size.thickness, size.width / size.thickness, size.concavity])
    largest = rows[0] if rows else [0] + 4 * [math.nan]
    return {"head_count": ("1", len(rows)), **{f"head_{name}": (unit, value) for (name, unit), value
                                               in zip(columns.items(), largest)}}, columns, rows


def front(points, *_):
    x, on_slope = points.position[:, 0], points.position[:, 2] < LAYER_ON_SLOPE * points.a
    found = {"front_x": ("m", x.max()), "front_on_slope_x": ("m", x[on_slope].max() if on_slope.any() else math.nan)}
    if points.velocity is not None:
        found["front_velocity_x"] = "m/s", points.velocity[x.argmax(), 0]
    return found, {}, []


def frontal_angle(points, *_):
    position = points.from_the_side
    walk = surface_walk(position, points.a)
    x, z = (position[walk] - position[walk].mean(axis=0))[:, ::2].T
    has_direction = len(walk) >= 3 and ((x * z).sum() != 0 or (x * x).sum() != (z * z).sum())
    angle = math.degrees(angle_of_line(position, walk)) if has_direction else math.nan
    return {"frontal_angle": ("deg", angle), "surface_particles": ("1", len(walk))}, {}, []


def head_tail(points, *_):
    position = points.from_the_side
    thickness, column, crest, head_columns = thickness_profile(position, points.radii, points.a)
    rear = quantile(thickness[(len(thickness) + 1) // 2:], 0.5)
    found = {"front_rear_thickness_ratio": ("1", np.divide(thickness[crest], rear)), "front_thickness": ("m", thickness[crest]),
             "rear_thickness": ("m", rear), "head_length": ("m", COLUMN * points.a * head_columns)}
    if points.velocity is not None:
        in_head, upper = column < head_columns, position[:, 2] > UPPER_SHARE * thickness[crest]
        for name, part in (("head_upper", in_head & upper), ("head_lower", in_head & ~upper), ("tail", ~in_head)):
            found[f"{name}_velocity_x"] = "m/s", mean(points.velocity[part, 0])
    return found, {}, []


def neighbours(points, *_):
    i, j = pairs(points.position, REACH * points.a)
    direct = np.bincount(i, minlength=len(points.position))
    indirect = np.bincount(i, weights=direct[j], minlength=len(points.position))
    return {"neighbours_mean": ("1", mean(direct)), "neighbours_max": ("1", direct.max()),
            "indirect_neighbours_mean": ("1", mean(indirect)), "indirect_neighbours_max": ("1", indirect.max())}, {}, []


def histogram(points, column, bins):
    unit, numbers = points.numbers(column)
    found = {"count": ("1", len(numbers)), "mean": (unit, mean(numbers)),
             "standard_deviation": (unit, standard_deviation(numbers)), "least": (unit, numbers.min()),
             "median": (unit, quantile(numbers, 0.5)), "largest": (unit, numbers.max()), "skewness": ("1", skewness(numbers)),
             "normality_p_value": ("1", anderson_darling(numbers)[1])}
    if not numbers.max() > numbers.min():  # equal values fill no bins
        return found, {}, []
    width = (numbers.max() - numbers.min()) / bins
    count = np.bincount(np.minimum(((numbers - numbers.min()) / width).astype(int), bins - 1), minlength=bins)
    rows = [[numbers.min() + (n + 0.5) * width, count[n], count[n] / (len(numbers) * width)] for n in range(bins)]
    return found, {"middle": unit, "count": "1", "density": "1" if unit == "1" else f"1/({unit})"}, rows


def layers(points, column, bins):
    """Means over layers of equal height between the lowest and the highest point, with the mean height of their points and
    their number; layers without points are left out."""
    unit, values = points.numbers(column)
    z = points.position[:, 2]
    thickness = (z.max() - z.min()) / bins
    layer = np.minimum(((z - z.min()) / thickness).astype(int), bins - 1) if thickness > 0 else np.zeros(len(z), dtype=int)
    count, height, total = (np.bincount(layer, weights=of, minlength=bins) for of in (None, z, values))
    rows = [[height[n] / count[n], total[n] / count[n], count[n]] for n in range(bins) if count[n]]
    return {"mean": (unit, mean(values))}, {"z": "m", column: unit, "points": "1"}, rows


class _Heap:
    """Each point a sphere of the mean radius, z up, on a floor under the lowest one, between walls beside the outermost, under
    an open top; y is averaged over. The free surface is where the packing, deposited by the kernel, is half of the median at
    the points."""

    def __init__(self, points):
        a = points.a
        low, high = points.position.min(axis=0) - a, points.position.max(axis=0) + [a, a, a + ROOM * a]
        box = Box(high - low, ("wall", "wall", "symmetry", "symmetry", "wall", "open"))
        count, place = len(points.position), points.position - low
        spheres = Grains(place, np.full(count, 2 * a), np.full(count, 8 * a**3), np.full(count, math.pi / 6 * 8 * a**3))
        self.at_points = Field(spheres, box).packing(place)
        self.packing = packing_section(spheres, box, 2 * a, a)
        self.packing.x, self.packing.z = self.packing.x + low[0], self.packing.z + low[2]
        self.surface = free_surface(self.packing, low[2], high[2], True, 0.5 * quantile(self.at_points, 0.5))
        self.middle = 0.5 * (low[0] + high[0])


def surface(points, *_):
    heap = _Heap(points)
    heights = heap.surface.z[np.isfinite(heap.surface.z)]
    return {"surface_z_max": ("m", quantile(heights, 1)), "surface_z_mean": ("m", mean(heights)),
            "surface_angle": ("deg", math.degrees(surface_angle(heap.surface, heap.middle)))}, {
                "x": "m", "surface_z": "m"}, list(zip(*heap.surface))


def repose(points, *_):
    heap = _Heap(points)
    slopes = heap_slopes(heap.surface, MIN_SLOPE * points.a)
    left, right, steepest = (math.degrees(angle) for angle in repose_angles(slopes, heap.middle))
    both = mean([angle for angle in (left, right) if not math.isnan(angle)])
    return {"repose_angle": ("deg", both), "repose_angle_left": ("deg", left), "repose_angle_right": ("deg", right),
            "repose_angle_steepest": ("deg", steepest)}, {"from": "m", "to": "m", "angle": "deg"}, [
                [slope.start, slope.end, math.degrees(slope.angle)] for slope in slopes]


def packing(points, *_):
    heap = _Heap(points)
    return {"packing_median": ("1", quantile(heap.at_points, 0.5)),
            "packing_percentile_99_9": ("1", quantile(heap.at_points, 0.999)), "packing_max": ("1", heap.at_points.max())}, {
                "z": "m", "packing": "1"}, list(zip(heap.packing.z, heap.packing.value.mean(axis=1)))


MEASURES = {"heads": heads, "front": front, "frontal-angle": frontal_angle, "head-tail": head_tail, "neighbours": neighbours,
            "repose": repose, "surface": surface, "packing": packing, "layers": layers, "histogram": histogram}


# -------------------------------------------------------------------------------------------------------------- command

def to_text(quantities, columns, rows):
    lines = [f"{name:32} {value:.6g}" + ("" if unit == "1" else f" {unit}") for name, (unit, value) in quantities.items()]
    if rows:
        lines += ["", "".join(f"{name if unit == '1' else f'{name} [{unit}]':>20}" for name, unit in columns.items())]
        lines += ["".join(f"{value:>20.6g}" for value in row) for row in rows]
    return "\n".join(lines)


def to_json(file, name, quantities, columns, rows):
    """What is not finite is null."""
    def number(value):
        return float(value) if math.isfinite(value) else None
    return json.dumps({"file": str(file), "as": name,
                       "quantities": {key: {"value": number(value), "unit": unit} for key, (unit, value) in quantities.items()},
                       "table": [dict(zip(columns, map(number, row))) for row in rows]}, indent=2)


def _read_radius(text, faults):
    if text is None:
        return None
    [length] = ask("quantities", texts=[text])
    if length.get("unit") == "m" and length["si"] > 0:
        return length["si"]
    what = length.get("why") or ("is not above 0" if length["unit"] == "m" else "is not a length (unit missing?)")
    faults.append(problem(f"--radius {text}", what, allowed='a length, above 0 mm, such as "5 mm"'))
    return None


def main():
    options = arguments("file", texts=("as", "radius", "column"), numbers=("bins",), flags=("json",))
    name, faults, columns = getattr(options, "as"), [], {}
    if name not in MEASURES:
        what = "is not known" if name else "missing: a file of points can be looked at in many ways"
        faults.append(problem(f"--as {name}" if name else "--as", what, allowed=", ".join(MEASURES),
                              near=nearest(name or "", MEASURES)))
    radius = _read_radius(options.radius, faults)
    try:
        columns = _columns(options.file)
    except InputError as error:
        faults += error.problems
    if faults:
        raise InputError(faults)
    points = points_of(options.file, columns, radius, needs_radius=name != "histogram")
    with np.errstate(divide="ignore", invalid="ignore"):
        measured = MEASURES[name](points, options.column, options.bins or 20)
    say(to_json(options.file, name, *measured) if options.json else to_text(*measured))
    return DONE


if __name__ == "__main__":
    run_command(main)
