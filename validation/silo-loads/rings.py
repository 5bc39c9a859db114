#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes the positions of the bed of wheat-steel.toml in rings that follow cylinder and cone, a CSV file for `bed.file`.

    validation/silo-loads/rings.py rings.csv [SPACING in m]"""
import math
import sys

RADIUS, OUTLET, TRANSITION, BOTTOM, TOP, MIDDLE = 2.0, 0.5, 3.598, 1.0, 11.6, 2.2  # m, as in wheat-steel.toml


def rings(spacing):
    slope = (RADIUS - OUTLET) / (TRANSITION - BOTTOM)
    layers = math.floor((TOP - BOTTOM) / spacing + 1e-9)
    for layer in range(layers):
        z = BOTTOM + (layer + 0.5) * spacing
        in_cone = z < TRANSITION
        # Half a spacing from the wall, along its normal.
        r = (OUTLET + slope * (z - BOTTOM) if in_cone else RADIUS) - 0.5 * spacing * (math.hypot(1, slope) if in_cone else 1)
        ring = 0
        while r > 0.25 * spacing:
            count = max(1, round(2 * math.pi * r / spacing))
            for k in range(count):
                # Rings and layers are turned against each other.
                angle = 2 * math.pi * (k + 0.5 * (ring % 2) + 0.37 * layer) / count
                yield MIDDLE + r * math.cos(angle), MIDDLE + r * math.sin(angle), z
            r, ring = r - spacing, ring + 1
        if r > -0.25 * spacing:
            yield MIDDLE, MIDDLE, z


if __name__ == "__main__":
    if not 2 <= len(sys.argv) <= 3:
        sys.exit(__doc__)
    with open(sys.argv[1], "w", encoding="utf-8") as file:
        file.write("x [m],y [m],z [m]\n")
        file.writelines(f"{x:.6f},{y:.6f},{z:.6f}\n" for x, y, z in rings(float(sys.argv[2]) if len(sys.argv) > 2 else 0.2))
