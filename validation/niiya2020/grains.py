# SPDX-License-Identifier: Apache-2.0
"""Which grains the pictures mark: heads (section 4.1 of the paper) and the surface of the front (section 4.3), as
estimator.heads, estimator.head_size and estimator.frontal_angle of reference.toml define them. tests/python/
test_niiya2020.py holds them against the numbers of the program on the same runs."""
from dataclasses import dataclass

import numpy as np

REACH = 4    # of a neighbour, in mean radii (Eq. 11)
SHARE = 1 / 4  # of the largest number, above which a grain belongs to a head
LEAST = 5    # grains of a head
STEP = 3     # reach of the walk along the front, in mean radii


def pairs(positions, reach):
    """Both ways, all i, j with |r_i - r_j| < reach and i != j."""
    first, second = [], []
    for begin in range(0, len(positions), 256):
        distance2 = ((positions[begin:begin + 256, None] - positions[None]) ** 2).sum(axis=2)
        i, j = np.nonzero(distance2 < reach * reach)
        first.append(i + begin), second.append(j)
    i, j = np.concatenate(first), np.concatenate(second)
    return i[i != j], j[i != j]


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
    """Of one head, m, and the four grains that it is measured between."""

    left: float      # y of the outermost edges
    right: float
    foremost: float  # x of the foremost edge, and of the most advanced point of the rear boundary
    inner: float
    grains: list

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
    return HeadSize(left, right, foremost, inner, [int(head[k]) for k in grains])


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
