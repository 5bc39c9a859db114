# SPDX-License-Identifier: Apache-2.0
"""A case as the program resolved it, and the walls that follow from it."""
import re

import numpy as np

from talus.column import Value

QUANTITY = re.compile(r"([-+]?(?:\d+\.?\d*|\.\d+)(?:[eE][-+]?\d+)?) (\S.*)\Z")


def with_units(value):
    """A case's tables with every quantity ("0.005 m") as a Value; other text and numbers stay."""
    if isinstance(value, dict):
        return {key: with_units(item) for key, item in value.items()}
    if isinstance(value, list):
        return [with_units(item) for item in value]
    quantity = QUANTITY.match(value) if isinstance(value, str) else None
    return Value(float(quantity[1]), quantity[2]) if quantity else value


def walls(case, top=None, shut=False):
    """The walls of a continuum case in the plane x, z as lines ((x, z), (x, z)), m: solid faces of the box up to `top`,
    and plates without their openings, as after the gate has opened. A cloud's case has none. \\param shut with what the
    gates shut"""
    box = case.get("box")
    if not box:
        return []
    width, height = box["width"], min(box["height"], np.inf if top is None else top)
    faces = {"floor": ((0, 0), (width, 0)), "left": ((0, 0), (0, height)), "right": ((width, 0), (width, height)),
             "top": ((0, height), (width, height))}
    lines = [line for face, line in faces.items() if box.get(face, "wall") == "wall" and not (face == "top" and top)]
    plate = case.get("plate", {})
    if "height" in plate:
        lines += _plate((0, plate["height"]), (width, plate["height"]),
                        [] if shut else [plate.get("slit_left", width / 2), plate.get("slit_right", width / 2)])
    wedge = case.get("wedge", {})
    if "half_angle" in wedge:
        beside = (width - wedge["outlet"]) / 2
        rise = beside / np.tan(np.deg2rad(wedge["half_angle"]))
        for side, outlet in ((0, beside), (width, width - beside)):
            lines.append(((side, wedge["height"] + rise), (outlet, wedge["height"])))
        if shut:
            lines.append(((beside, wedge["height"]), (width - beside, wedge["height"])))
    for plate in case.get("plates", {}).values():
        gated = shut and "opens_after" in plate
        lines += _plate(plate["from"], plate["to"], [] if gated else plate.get("openings", []))
    return [tuple(tuple(float(x) for x in point) for point in line) for line in lines]


def _plate(start, end, openings):
    """What is left of a plate between its openings, which are given along it in pairs."""
    start, end = np.array(start, dtype=float), np.array(end, dtype=float)
    length = np.linalg.norm(end - start)
    places = [0.0, *map(float, openings), length]
    return [(start + (end - start) * a / length, start + (end - start) * b / length)
            for a, b in zip(places[::2], places[1::2]) if b > a]
