# SPDX-License-Identifier: Apache-2.0
"""Fields of a section: packing, velocity and stress of beads, spread over the plane x, z or averaged over boxes.

Packing and velocity are sums over beads spread in x and z by a Gaussian of 2 mm, through the whole depth, with mirror images
at side walls and floor. Stress is that of Babic (1997, Int. J. Eng. Sci. 35, 523): over a box of volume V,
(1/V) sum over the beads in it of [half of each contact's force times branch + m v' v'], v' the velocity less the mean
velocity of the Gaussian at the bead; compression is positive. The contact part is LAMMPS's own (compute stress/atom).
"""
import numpy as np
from frames import DENSITY, TOP, WIDTH

CELL, SMOOTHING = 0.5e-3, 2e-3
HALF_WINDOW = 10e-3           # s, of profiles, about their times


class Section:
    """What is spread over the plane x, z by the Gaussian: values at the centres of cells, one row an x."""

    x = (np.arange(round(WIDTH / CELL)) + 0.5) * CELL
    z = (np.arange(round(TOP / CELL)) + 0.5) * CELL

    def __init__(self, frame, depth, smoothing=SMOOTHING):
        self._shares = _shares(frame.x, len(self.x)), _shares(frame.z, len(self.z))
        self._spread = [_gaussian(axis, size, smoothing) for axis, size in ((self.x, WIDTH), (self.z, None))]
        self.frame, self.depth = frame, depth
        self.packing = self.sum_of(frame.volume)

    def sum_of(self, values):
        """Of a number a bead: its sum over a unit of volume."""
        sums = np.zeros(len(self.x) * len(self.z))
        for column, across in self._shares[0]:
            for row, up in self._shares[1]:
                sums += np.bincount(column * len(self.z) + row, values * across * up, len(sums))
        return self._spread[0] @ sums.reshape(len(self.x), len(self.z)) @ self._spread[1].T / (CELL**2 * self.depth)

    def mean_of(self, values):
        """Of a number a bead: its mean weighted with the beads' volume; nan where there are none."""
        with np.errstate(invalid="ignore", divide="ignore"):
            return np.where(self.packing > 1e-6, self.sum_of(self.frame.volume * values) / self.packing, np.nan)

    def at_beads(self, values):
        """The values at the cells that the beads are in."""
        column = np.clip((self.frame.x / CELL).astype(int), 0, len(self.x) - 1)
        return values[column, np.clip((self.frame.z / CELL).astype(int), 0, len(self.z) - 1)]


def _shares(places, cells):
    """The two cells between whose centres each place lies, with its linear shares in them; beyond the last centres the
    outermost cell has all. What is above the top has none."""
    at = places / CELL - 0.5
    first = np.floor(at)
    known = (places < cells * CELL).astype(float)
    return [(np.clip(first + n, 0, cells - 1).astype(int), known * np.where(n, at - first, 1 - at + first)) for n in (0, 1)]


def _gaussian(places, size, width):
    """Weights that spread from each place to each, with mirror images at 0 and, if there is one, at `size`."""
    def kernel(images):
        return np.exp(-0.5 * ((places[:, None] - images[None, :]) / width)**2)
    weights = kernel(places) + kernel(-places)
    if size is not None:
        weights += kernel(2 * size - places)
    return weights * CELL / (width * np.sqrt(2 * np.pi))


def box_state(frame, section, x, z):
    """Mean packing and stresses (contact and kinetic; xx, yy, zz, xz, Pa) of a box and its mirror image."""
    mirrored = np.minimum(frame.x, WIDTH - frame.x)
    inside = (mirrored >= x[0]) & (mirrored < x[1]) & (frame.z >= z[0]) & (frame.z < z[1])
    volume = 2 * (x[1] - x[0]) * (z[1] - z[0]) * section.depth
    sign = np.where(frame.x < WIDTH / 2, 1, -1)  # of a shear stress in the mirror
    mean = np.stack([section.at_beads(section.mean_of(component)) for component in frame.velocity.T], axis=1)
    rest = (frame.velocity - mean)[inside]
    mass = DENSITY * frame.volume[inside]
    kinetic = [np.sum(mass * rest[:, a] * rest[:, b] * (1 if a == b else sign[inside]))
               for a, b in ((0, 0), (1, 1), (2, 2), (0, 2))]
    contact = [*frame.stress[inside, :3].sum(axis=0), (frame.stress[inside, 3] * sign[inside]).sum()]
    return frame.volume[inside].sum() / volume, np.array(contact) / volume, np.array(kinetic) / volume


def profile(run, time, height, columns=25):
    """Over cells of 4 mm by 6 mm and 20 ms: x, velocity upwards (weighted with volume) and packing."""
    edges = np.linspace(0, WIDTH, columns + 1)
    volume, flux, count = np.zeros(columns), np.zeros(columns), 0
    for frame in run.frames(time - HALF_WINDOW, time + HALF_WINDOW):
        here = abs(frame.z - height) < 3e-3
        volume += np.histogram(frame.x[here], edges, weights=frame.volume[here])[0]
        flux += np.histogram(frame.x[here], edges, weights=(frame.volume * frame.velocity[:, 2])[here])[0]
        count += 1
    packing = volume / (count * (edges[1] - edges[0]) * 6e-3 * run.depth)
    with np.errstate(invalid="ignore", divide="ignore"):
        return 0.5 * (edges[1:] + edges[:-1]), np.where(packing > 0.02, flux / volume, np.nan), packing
