# SPDX-License-Identifier: Apache-2.0
"""Heaps: the angle of one, and the friction of a law whose heap has an angle."""
import math
from pathlib import Path

import numpy as np

from talus.program import simulate

CASE = Path(__file__).resolve().parent / "inputs" / "heap.toml"
AGEING = 0.08   # friction that grains at rest have beyond that in flow: the law's own
SCATTER = 1.0   # degrees, of heaps that are poured again, by others, and of particles of another size
NEAR = 0.5      # degrees, how near the last heap must be
MOST_RUNS = 6
# A heap of 31.1 degrees has atan M = 28.0 degrees, one of 37.2 has 34.2: where the first heap begins.
KNOWN, OF, RISE = 31.1, 28.0, 0.98


def slope_of(positions, spacing):
    """Angle of a round heap's flanks, degrees: a line through the highest particles of rings from 0.2 to 0.8 of its foot, in twelve
    directions. The foot holds 98 % of the particles. \\param positions from the axis, m"""
    radius, direction = np.hypot(positions[:, 0], positions[:, 1]), np.arctan2(positions[:, 1], positions[:, 0])
    foot = np.quantile(radius, 0.98)
    ring = np.floor((radius - 0.2 * foot) / (2 * spacing)).astype(int)
    cell = (6 * (direction / np.pi + 1)).astype(int) % 12
    points = []
    for n in range(int(0.6 * foot / (2 * spacing))):
        for k in range(12):
            here = (ring == n) & (cell == k)
            if here.any():
                points.append((0.2 * foot + (2 * n + 1) * spacing, positions[here, 2].max()))
    return math.degrees(math.atan(-np.polyfit(*np.array(points).T, 1)[0]))


def settings_of(material, friction, density):
    """Of CASE for a material's file: a floor at least as rough as the grains, poured at the same volume a
    second whatever the bulk density, kg/m^3."""
    return {"grains.material": str(material), "walls.coefficient": max(0.5, round(friction, 6)),
            "inlet.1.rate": f"{40e-3 * density / 900:.6g} kg/s", "inlet.1.to": "6 s", "run.end": "6.5 s"}


def angle_of(run):
    """Degrees, of a run of that case, of the particles that rest."""
    last, box = run.snapshots[-1], run.case["box"]
    rest = np.linalg.norm(np.asarray(last["velocity"]), axis=1) < 0.01
    middle = [0.5 * box["width"], 0.5 * box["depth"], 0]
    return slope_of(np.asarray(last.positions)[rest] - middle, run.case["bed"]["spacing"])


def poured(case, folder, settings):
    """Pours a heap, or takes the one that is there. Returns its angle, degrees."""
    return angle_of(simulate(case, folder, settings, existing="resume"))


def friction_of(angle, heap_of, tell):
    """M and the ends of its interval, so that the heap of the law has an angle: by secants of M against the angle, from heaps that are
    near it. \\param angle degrees \\param heap_of function of (M, number of the run), returns the angle of its heap, degrees
    \\param tell function of (text)"""
    friction, found = math.tan(math.radians(OF + (angle - KNOWN) / RISE)), []
    while True:
        found.append((friction, heap_of(friction, len(found) + 1)))
        tell(f"heap {len(found)}: M = {friction:.4f}, {found[-1][1]:.2f} degrees of {angle:.4g}")
        found_near = sorted(found, key=lambda one: abs(one[1] - angle))
        if len(found) > 1:
            (m, a), (n, b) = found_near[:2]
            slope = (m - n) / (a - b) if abs(a - b) > 0.2 else math.radians(1) * (1 + m * m)
            slope = min(max(slope, 0.5 * math.radians(1)), 4 * math.radians(1))
        else:
            slope = math.radians(1) / RISE * (1 + friction**2)
        near, at = found_near[0]
        if abs(at - angle) <= NEAR or len(found) == MOST_RUNS:
            best = near + slope * (angle - at)
            return best, best - slope * SCATTER, best + slope * SCATTER
        friction = min(max(near + slope * (angle - at), 0.1), 1.5)
