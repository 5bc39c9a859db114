# SPDX-License-Identifier: Apache-2.0
"""Fields of particles of a continuum, made by the cubic spline kernel: packing, means and velocity gradients.

Walls act as in the model: by images of the particles in the mirror and periodic faces of the box and in a horizontal plate,
through whose slit alone both sides are visible to each other. Walls at an angle, vessels and sectors are not covered.
"""
from dataclasses import dataclass
from itertools import product
from typing import NamedTuple

import numpy as np

SUPPORT = 2  # of the kernel, over its smoothing length
MIRRORS = ("wall", "symmetry", "free-as-printed")
TINY = 1e-300
LEAST_MOMENT = 0.01  # determinant of the moment below which neighbours do not span the space
POINTS_AT_ONCE = 4000
WIDER = 1.25  # than the median smoothing length: particles that are looked for in cells of their own


def cubic_spline(distance, h):
    """W(r, h) in three dimensions with support 2 h, 1/m³ (Monaghan 1992)."""
    q = distance / h
    return (np.maximum(2 - q, 0)**3 - 4 * np.maximum(1 - q, 0)**3) / (4 * np.pi * h**3)


def cubic_spline_slope(distance, h):
    """(dW/dr)/r, 1/m⁵; finite at 0."""
    q = distance / h
    with np.errstate(divide="ignore", invalid="ignore"):
        shape = np.where(q > 1, np.maximum(2 - q, 0)**2 / q, 4 - 3 * q)
    return -3 / (4 * np.pi * h**5) * shape


def cubic_spline_line(distance, h):
    """Integral of W along a line at a distance from the centre, 1/m²."""
    def chord(a, s):
        """Half of the integral of (a - r)³ over the chord at distance s of the sphere r < a."""
        result = np.zeros(len(s))
        inside = s < a
        s = s[inside]
        y = np.sqrt((a - s) * (a + s))
        area = s**2 * np.log((y + a) / np.maximum(s, TINY))
        first, second = 0.5 * (y * a + area), s**2 * y + y**3 / 3
        third = 0.25 * y * a**3 + 0.75 * s**2 * first
        result[inside] = a**3 * y - 3 * a**2 * first + 3 * a * second - third
        return result
    s = distance / h
    return (chord(2, s) - 4 * chord(1, s)) / (2 * np.pi * h**2)


@dataclass(frozen=True)
class Grains:
    """Particles. SI."""

    position: np.ndarray          #: (n, 3)
    smoothing_length: np.ndarray  #: h
    volume: np.ndarray            #: with the voids
    solid_volume: np.ndarray      #: of the grains of each

    @classmethod
    def of_density(cls, position, density, mass, grain_density, smoothing_length=None, mass_ratio=1.0):
        """Particles of a bulk density each. \\param mass_ratio of their masses to `mass` \\param smoothing_length of all;
        None: of each (m/rho)^(1/3), of one lighter than `mass` that of `mass`"""
        density = np.asarray(density, dtype=float)
        ratio = np.broadcast_to(mass_ratio, density.shape)
        h = (np.cbrt(mass * np.maximum(1, ratio) / density) if smoothing_length is None
             else np.full(len(density), float(smoothing_length)))
        return cls(np.asarray(position, dtype=float), h, mass * ratio / density, mass * ratio / grain_density)


class Plate(NamedTuple):
    """A horizontal wall from side to side with a slit."""

    height: float
    slit: tuple = ()  #: from, to along x; empty while the gate is shut


class Image(NamedTuple):
    """Of a particle at x it stands at `sign * x + offset`; its velocity is `vector_sign * v`."""

    sign: np.ndarray
    offset: np.ndarray
    vector_sign: np.ndarray
    copy: tuple     #: per axis, 0: within the box
    in_plate: bool  #: it is the mirror image in the plate

    def position(self, x):
        return self.sign * x + self.offset


class Box:
    """A box from the origin whose faces ("wall", "symmetry", "free-as-printed", "periodic",
    "open") are given in the order left,
    right, front, rear, floor, top. \\param plate a Plate, or None"""

    def __init__(self, extent, faces, plate=None):
        self.extent, self.faces, self.plate = np.asarray(extent, dtype=float), tuple(faces), plate

    def images(self, reach):
        """All that can stand within `reach` of the box or of the plate, the particles themselves first."""
        axes = [self._along(axis, reach) for axis in range(3)]
        images = []
        for z, y, x in product(axes[2], axes[1], axes[0]):
            copy, sign, offset, vector_sign = zip(x, y, z)
            images.append(Image(np.array(sign), np.array(offset), np.array(vector_sign), copy, False))
        images.sort(key=lambda image: any(image.copy))
        if self.plate is not None:
            up = np.array([1.0, 1.0, -1.0])
            offset = np.array([0.0, 0.0, 2 * self.plate.height])
            images += [Image(up * i.sign, up * i.offset + offset, up * i.vector_sign, i.copy, True)
                       for i in images if i.copy[2] == 0]
        return images

    def _along(self, axis, reach):
        """(copy, sign, offset, sign of vectors) of the images along an axis: behind a mirror face, mirrored there last and
        in turn at both faces; behind a periodic one, shifted."""
        length, kinds = self.extent[axis], self.faces[2 * axis:2 * axis + 2]
        found = [(0, 1.0, 0.0, 1.0)]
        for side, direction in ((0, -1), (1, 1)):
            n = 1
            while (n - 1) * length <= reach:
                if kinds[0] == "periodic":
                    found.append((direction * n, 1.0, direction * n * length, 1.0))
                    n += 1
                    continue
                sign, offset, vector_sign = 1.0, 0.0, 1.0
                turns = [side if k % 2 == 1 else 1 - side for k in range(n, 0, -1)]
                if any(kinds[at] not in MIRRORS for at in turns):
                    break
                for at in turns:
                    sign, offset = -sign, 2 * at * length - offset
                    vector_sign = vector_sign if kinds[at] == "free-as-printed" else -vector_sign
                found.append((direction * n, sign, offset, vector_sign))
                n += 1
        return found

    def visible(self, start, end, in_plate):
        """Whether images at `end`, made by the plate where `in_plate`, are visible from `start`: places (x, z), each a pair
        of arrays."""
        if self.plate is None:
            return np.ones(len(start[0]), dtype=bool)
        height = self.plate.height
        meets = (start[1] >= height) != (end[1] >= height)
        n = np.flatnonzero(meets)
        x, z = start[0][n], start[1][n]
        meets[n] = self._is_solid(x + (height - z) / (end[1][n] - z) * (end[0][n] - x))
        return meets == in_plate

    def _is_solid(self, x):
        if len(self.plate.slit) == 0:
            return np.ones(len(x), dtype=bool)
        width = self.extent[0]
        if self.faces[0] == "periodic":
            x = np.mod(x, width)
        else:
            x = np.mod(x, 2 * width)
            x = np.where(x > width, 2 * width - x, x)
        return ~((x > self.plate.slit[0]) & (x < self.plate.slit[1]))


class Section:
    """Packing in the plane x, z as the mean over the depth, at the centres of cells: `value[row, column]`, `x`, `z`."""

    def __init__(self, extent, width, height):
        columns, rows = (max(1, int(np.floor(length / size + 0.5))) for length, size in zip(extent[::2], (width, height)))
        self.width, self.height = extent[0] / columns, extent[2] / rows  #: of a cell
        self.x = (np.arange(columns) + 0.5) * self.width
        self.z = (np.arange(rows) + 0.5) * self.height
        self.value = np.zeros((rows, columns))


def packing_section(grains, box, width, height):
    """The Section of cells about `width` by `height` that fill the box. Each particle is spread by its kernel, integrated
    along y: between mirror or periodic faces the exact mean."""
    section = Section(box.extent, width, height)
    if len(grains.position) == 0:
        return section
    reach = SUPPORT * grains.smoothing_length.max()
    wide = grains.smoothing_length > WIDER * np.median(grains.smoothing_length)
    rows, columns = section.value.shape
    for image in box.images(reach):
        if image.copy[1] != 0:  # in the line's integral already
            continue
        place, h = image.position(grains.position), grains.smoothing_length
        support = SUPPORT * h
        low = np.floor((place[:, ::2] - support[:, None]) / (section.width, section.height)).clip(0, (columns, rows))
        high = np.ceil((place[:, ::2] + support[:, None]) / (section.width, section.height)).clip(0, (columns, rows))
        low, count = low.astype(int), (high - low).astype(int)
        taken = (count > 0).all(axis=1)
        if image.in_plate:
            taken &= abs(place[:, 2] - box.plate.height) < support
        for group in (taken & ~wide, taken & wide):  # a few thin particles in a stream reach over many cells
            of = np.flatnonzero(group)
            if len(of) == 0:
                continue
            across, up = count[of].max(axis=0)
            column = np.minimum(low[of, 0, None] + np.arange(across), columns - 1)
            row = np.minimum(low[of, 1, None] + np.arange(up), rows - 1)
            squared = ((section.x[column] - place[of, 0, None])**2)[:, None, :] + (
                (section.z[row] - place[of, 2, None])**2)[:, :, None]
            n, k, m = np.nonzero((squared < (support[of]**2)[:, None, None])
                                 & (np.arange(across) < count[of, 0, None])[:, None, :]
                                 & (np.arange(up) < count[of, 1, None])[:, :, None])
            distance, column, row, n = np.sqrt(squared[n, k, m]), column[n, m], row[n, k], of[n]
            if box.plate is not None:
                seen = box.visible((section.x[column], section.z[row]), (place[n, 0], place[n, 2]), image.in_plate)
                n, row, column, distance = n[seen], row[seen], column[seen], distance[seen]
            section.value += np.bincount(row * columns + column, grains.solid_volume[n] * cubic_spline_line(distance, h[n]),
                                         rows * columns).reshape(rows, columns)
    section.value /= box.extent[1]
    return section


class Field:
    """What the kernel makes of particles at any place: sums over them and their images."""

    def __init__(self, grains, box):
        self.grains, self.box = grains, box
        h = grains.smoothing_length
        reach = SUPPORT * h.max() if len(h) else 0.0
        places, sources, numbers = [], [], []
        self._images = box.images(reach) if len(h) else []
        for number, image in enumerate(self._images):
            place = image.position(grains.position)
            near = ((place > -reach) & (place < box.extent + reach)).all(axis=1) | (not any(image.copy))
            if image.in_plate:
                near &= abs(place[:, 2] - box.plate.height) < reach
            places.append(place[near])
            sources.append(np.flatnonzero(near))
            numbers.append(np.full(near.sum(), number))
        self._place = np.ascontiguousarray(np.concatenate(places).T) if places else np.empty((3, 0))
        self._source = np.concatenate(sources) if sources else np.empty(0, dtype=int)
        self._number = np.concatenate(numbers) if numbers else np.empty(0, dtype=int)
        self._in_plate = np.array([image.in_plate for image in self._images], dtype=bool)[self._number]
        self._h = h[self._source]
        # A few thin particles in a stream would make wide cells for all.
        wide = self._h > WIDER * np.median(h) if len(h) else np.empty(0, dtype=bool)
        self._groups = [group for group in (np.flatnonzero(~wide), np.flatnonzero(wide)) if len(group)]

    def _pairs(self, points, own=None):
        """Chunks of (points, entries, differences of their places (3, n), distances): entries whose kernel reaches the points
        and that are visible from there. \\param own smoothing lengths of the points, which reach out too; None: the
        entries' alone count"""
        points = np.ascontiguousarray(points.T)
        for first in range(0, points.shape[1], POINTS_AT_ONCE):
            some = points[:, first:first + POINTS_AT_ONCE]
            found = []
            for group in self._groups:
                reach = SUPPORT * self._h[group].max()
                if own is not None:
                    reach = 0.5 * reach + own[first:first + POINTS_AT_ONCE].max()
                n, k = _candidates(some, self._place[:, group], reach)
                k = group[k]
                length = SUPPORT * self._h[k] if own is None else own[first + n] + self._h[k]
                difference = np.stack([self._place[axis, k] - some[axis, n] for axis in range(3)])
                squared = (difference**2).sum(axis=0)
                near = squared < length**2
                n, k = n[near], k[near]
                seen = self.box.visible(some[::2, n], self._place[::2, k], self._in_plate[k])
                near = np.flatnonzero(near)[seen]
                found.append((n[seen] + first, k[seen], difference[:, near], np.sqrt(squared[near])))
            if found:
                yield tuple(np.concatenate(arrays, axis=-1) for arrays in zip(*found))

    def _vectors(self, column, entries):
        signs = np.array([image.vector_sign for image in self._images])
        number, source = self._number[entries], self._source[entries]
        return np.stack([signs[:, axis][number] * column[:, axis][source] for axis in range(3)])

    def packing(self, points):
        """At places (n, 3): the sum of solid volume times kernel."""
        total = np.zeros(len(points))
        for n, k, _, distance in self._pairs(points):
            total += np.bincount(n, self.grains.solid_volume[self._source[k]] * cubic_spline(distance, self._h[k]), len(points))
        return total

    def packing_and_mean(self, points, column):
        """At places (n, 3): the packing, and the mean of a column of vectors weighted by volume times kernel; nan where
        there are no particles."""
        column = np.asarray(column, dtype=float)
        kernels, weights, sums = np.zeros(len(points)), np.zeros(len(points)), np.zeros((len(points), 3))
        for n, k, _, distance in self._pairs(points):
            kernel = cubic_spline(distance, self._h[k])
            weight = self.grains.volume[self._source[k]] * kernel
            vectors = weight * self._vectors(column, k)
            kernels += np.bincount(n, self.grains.solid_volume[self._source[k]] * kernel, len(points))
            weights += np.bincount(n, weight, len(points))
            for axis in range(3):
                sums[:, axis] += np.bincount(n, vectors[axis], len(points))
        with np.errstate(invalid="ignore", divide="ignore"):
            return kernels, np.where(weights > 0, 1 / weights, np.nan)[:, None] * sums

    def velocity_gradients(self, velocity):
        """du_i/dx_j at every particle, (n, 3, 3), 1/s: corrected so that it is exact for linear fields (Randles & Libersky
        1996, Eq. 58), uncorrected where the neighbours do not span the space."""
        velocity, x = np.asarray(velocity, dtype=float), self.grains.position
        h, count = self.grains.smoothing_length, len(x)
        moment, sums = np.zeros((count, 3, 3)), np.zeros((count, 3, 3))
        for n, k, d, distance in self._pairs(x, own=h):
            weight = -self.grains.volume[self._source[k]] * cubic_spline_slope(distance, 0.5 * (h[n] + self._h[k]))
            change = self._vectors(velocity, k) - velocity.T[:, n]
            for i, j in product(range(3), range(3)):
                sums[:, i, j] += np.bincount(n, weight * change[i] * d[j], count)
                if i <= j:
                    moment[:, i, j] += np.bincount(n, weight * d[i] * d[j], count)
        for i, j in ((1, 0), (2, 0), (2, 1)):
            moment[:, i, j] = moment[:, j, i]
        spanned = np.linalg.det(moment) > LEAST_MOMENT
        sums[spanned] = sums[spanned] @ np.linalg.inv(moment[spanned])
        return sums


def _candidates(points, places, reach):
    """Numbers of points and of places, (3, n) each, that may lie within `reach` of each other in x and z, by cells of that
    edge."""
    low = np.minimum(points[::2].min(axis=1), places[::2].min(axis=1))[:, None]
    cell_of_point, cell_of_place = (np.floor((of[::2] - low) / reach).astype(int) + 1 for of in (points, places))
    columns = max(cell_of_point[0].max(), cell_of_place[0].max()) + 2
    key = cell_of_place[0] + columns * cell_of_place[1]
    order = np.argsort(key, kind="stable")
    key = key[order]
    numbers, found = [], []
    for up in (-1, 0, 1):  # three cells in a row follow each other
        middle = cell_of_point[0] + columns * (cell_of_point[1] + up)
        first, last = np.searchsorted(key, middle - 1, "left"), np.searchsorted(key, middle + 1, "right")
        length = last - first
        number = np.repeat(np.arange(len(length)), length)
        within = np.arange(length.sum()) - np.repeat(np.cumsum(length) - length, length)
        numbers.append(number)
        found.append(order[first[number] + within])
    return np.concatenate(numbers), np.concatenate(found)


def cell_centres(places, cell):
    """The centres of the cubic cells, numbered from the origin, that hold places; a place on a face, but for rounding,
    belongs to the cell above."""
    return (np.floor(np.asarray(places) / cell + 1e-9) + 0.5) * cell
