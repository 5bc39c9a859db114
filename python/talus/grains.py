# SPDX-License-Identifier: Apache-2.0
"""Grains of an avalanche: heads (Niiya, Awazu & Nishimori 2020, section 4.1), the surface of the front (section 4.3), the
thickness along the slope (section 3.3), as the estimators of validation/niiya2020/reference.toml define them. x points down
the slope, z away from it. Tests: tests/python/test_niiya2020.py."""
from dataclasses import dataclass
from itertools import product

import numpy as np

REACH = 4    # of a neighbour, in mean radii (Eq. 11)
SHARE = 1 / 4  # of the largest number, above which a grain belongs to a head
LEAST = 5    # grains of a head
STEP = 3     # reach of the walk along the front, in mean radii
COLUMN = 4           # length of a column along the slope, in mean radii
STRAGGLERS = 0.05    # share of the grains, the rearmost, that the rear does not reach back to
HEAD_SHARE = 0.5     # of the head's thickness, down to which columns behind it belong to it
UPPER_SHARE = 2 / 3  # of the head's thickness, above which a grain belongs to the upper head


def pairs(positions, reach):
    """Both ways, all i, j with |r_i - r_j| < reach and i != j, by cells of that edge."""
    positions = np.asarray(positions)
    cell = np.floor((positions - positions.min(axis=0)) / reach).astype(np.int64) + 1
    extent = cell.max(axis=0) + 2

    def key_of(cells):
        return (cells[:, 0] * extent[1] + cells[:, 1]) * extent[2] + cells[:, 2]

    order = np.argsort(key_of(cell), kind="stable")
    keys, numbers = key_of(cell)[order], np.arange(len(positions))
    first, second = [], []
    for along, across in product((-1, 0, 1), repeat=2):  # three cells in a row follow each other
        middle = key_of(cell + [along, across, 0])
        begin, end = np.searchsorted(keys, middle - 1, "left"), np.searchsorted(keys, middle + 1, "right")
        count = end - begin
        i = np.repeat(numbers, count)
        j = order[np.repeat(begin - np.cumsum(count) + count, count) + np.arange(len(i))]
        near = (((positions[i] - positions[j]) ** 2).sum(axis=1) < reach * reach) & (i != j)
        first.append(i[near])
        second.append(j[near])
    i, j = np.concatenate(first), np.concatenate(second)
    by_first = np.lexsort((j, i))
    return i[by_first], j[by_first]


def connected(count, i, j):
    """The least index of each grain's connected set."""
    label = np.arange(count)
    while True:
        least = label.copy()
        np.minimum.at(least, i, label[j])
        least = least[least]
        if (least == label).all():
            return label
        label = least


def sets_of(label, members, positions):
    """Index arrays of the sets, the one with most grains first (of equal ones the one farther down)."""
    sets = [members[label[members] == which] for which in np.unique(label[members])]
    return sorted(sets, key=lambda grains: (len(grains), positions[grains, 0].max()), reverse=True)


def find_heads(positions, radius, by="n'"):
    """The heads, largest first. \\param by "n'" (Eq. 11b, as the paper decides) or "n" (Eq. 11a, its Figure 8a)"""
    positions = np.asarray(positions)
    i, j = pairs(positions, REACH * radius)
    number = np.bincount(i, minlength=len(positions))
    if by == "n'":
        number = np.bincount(i, weights=number[j], minlength=len(positions))
    part = connected(len(positions), i, j)
    largest = np.zeros(len(positions))
    np.maximum.at(largest, part, number)
    largest = largest[part]  # of each grain's part
    inside = (largest > SHARE * number.max()) & (number > SHARE * largest)
    both = inside[i] & inside[j]
    label = connected(len(positions), i[both], j[both])
    return [head for head in sets_of(label, np.flatnonzero(inside), positions) if len(head) >= LEAST]


@dataclass
class HeadSize:
    """Of one head, m, and the four grains that it is measured between. `concavity`: how far the centre of the rear boundary is
    ahead of the rearmost edges left and right of the middle, over the thickness; nan if one side has no grain."""

    left: float      # y of the outermost edges
    right: float
    foremost: float  # x of the foremost edge, and of the most advanced point of the rear boundary
    inner: float
    grains: list
    concavity: float

    @property
    def width(self):
        return self.left - self.right

    @property
    def thickness(self):
        return self.foremost - self.inner


def head_size(positions, radii, head, radius):
    x, y = np.asarray(positions)[head, :2].T
    a = np.asarray(radii)[head]
    left, right, foremost = (y + a).max(), (y - a).min(), (x + a).max()
    centre = (left + right) / 2
    boundary = np.array([(x - a)[np.abs(y - yj) <= REACH * radius / 2].min() for yj in y])
    central = 4 * np.abs(y - centre) <= left - right
    inner = boundary[central].max() if central.any() else np.nan
    grains = [(y + a).argmax(), (y - a).argmin(), (x + a).argmax(), np.abs(x - a - inner).argmin()]
    sides = [(x - a)[side] for side in (y > centre, y < centre)]
    concavity = (inner - sum(side.min() for side in sides) / 2) / (foremost - inner) if all(map(len, sides)) else np.nan
    return HeadSize(left, right, foremost, inner, [int(head[k]) for k in grains], concavity)


def surface_walk(positions, radius):
    """The grains of the front's surface, from the foremost of the largest cluster upwards."""
    positions = np.asarray(positions)
    i, j = pairs(positions, REACH * radius)
    cluster = sets_of(connected(len(positions), i, j), np.arange(len(positions)), positions)[0]
    open_ = np.zeros(len(positions), dtype=bool)
    open_[cluster] = True
    at = cluster[np.lexsort((positions[cluster, 2], -positions[cluster, 0]))[0]]
    way = [at]
    while True:
        open_[at] = False
        d = positions - positions[at]
        distance2 = (d ** 2).sum(axis=1)
        near = np.flatnonzero(open_ & (distance2 < (STEP * radius) ** 2) & (d[:, 2] >= 0))
        if len(near) == 0:
            return np.array(way)
        at = near[np.lexsort((distance2[near], np.arctan2(d[near, 2], d[near, 0])))[0]]
        way.append(at)


def angle_of_line(positions, grains):
    """Of the line nearest to the grains (orthogonal regression) against the slope behind the front, rad."""
    x, z = (np.asarray(positions)[grains][:, [0, 2]] - np.asarray(positions)[grains][:, [0, 2]].mean(axis=0)).T
    direction = 0.5 * np.arctan2(2 * (x * z).sum(), (x * x).sum() - (z * z).sum())
    return np.pi - direction if direction > 0 else -direction


def thickness_profile(positions, radii, a):
    """Of an avalanche seen from the side: thickness of the columns counted backwards from the foremost centre to the one
    that holds the last grain which is no straggler, the column of each grain, and of the columns the crest (the thickest of
    the front half) and how many belong to the head."""
    x, z = positions[:, 0], positions[:, 2]
    column = ((x.max() - x) / (COLUMN * a)).astype(int)
    count = int((x.max() - np.quantile(x, STRAGGLERS)) / (COLUMN * a)) + 1
    thickness = np.zeros(count)
    within = column < count
    np.maximum.at(thickness, column[within], (z + radii)[within])
    crest = int(thickness[:(count + 1) // 2].argmax())
    thin = np.flatnonzero(thickness[crest + 1:] < HEAD_SHARE * thickness[crest])
    return thickness, column, crest, crest + 1 + (int(thin[0]) if len(thin) else count - crest - 1)
