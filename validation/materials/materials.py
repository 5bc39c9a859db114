#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Pours a heap of a material, lets columns of it collapse, turns it in a drum, and puts what rests beside what was measured.

    validation/materials/materials.py [--material sand] [--only heap column] [--out results/validation-materials]
                                      [--threads N] [--markdown FILE] [--picture FILE]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py,
python3-scipy and python3-matplotlib."""
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path[:0] = [str(HERE.parent), str(HERE.parent / "drum")]
import study  # noqa: E402
import talus  # noqa: E402
from talus import heap  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
SETUP, BANDS = REFERENCE["setup"], REFERENCE["bands"]
MATERIALS = [name for name, band in BANDS.items() if isinstance(band, dict)]
SAYS = {"heap": "poured heap, degrees", "drum": "surface in a drum, degrees", "column-runout": "round column, a = {}, run-out",
        "column-height": "round column, a = {}, height", "channel-runout": "channel, a = {}, run-out",
        "channel-height": "channel, a = {}, height", "stray": "stray particles, largest share of a run"}
KINDS = ("heap", "column", "channel", "drum")


def row_of(material, name):
    """What table_of_numbers takes of a band."""
    what, _, ratio = name.rpartition("-")
    says = SAYS.get(name) or SAYS[what].format(ratio)
    low, high = BANDS[material].get(name) or BANDS[name]
    return {"says": f"{material}: {says}", "value": 0.5 * (low + high), "tolerance": 0.5 * (high - low)}


COMMON = [name for name in BANDS if name not in MATERIALS]
ROWS = {f"{material} {name}": row_of(material, name) for material in MATERIALS for name in (*COMMON, *BANDS[material])}


def spacing_of(kind, ratio):
    """Of the particles, mm."""
    of = SETUP["spacing"][kind]
    return of[f"{ratio:g}"] if isinstance(of, dict) else of


def runs_of(material, kinds=KINDS):
    """Kind, height over radius, folder and settings of each run of a material."""
    ratios = {"heap": [None], "drum": [None], "column": SETUP["columns"], "channel": SETUP["channels"]}
    size = {"column": SETUP["column_radius"], "channel": SETUP["channel_length"]}
    for kind in kinds:
        for ratio in ratios[kind]:
            spacing = f"{spacing_of(kind, ratio):g} mm"
            settings = {"grains.material": material, "bed.spacing": spacing}
            if kind in ("channel", "drum"):
                settings["box.depth"] = spacing
            if kind == "heap" and material in SETUP["heap_rate"]:
                settings["inlet.1.rate"] = SETUP["heap_rate"][material]
            if kind == "column":
                settings["walls.material"] = SETUP["floor"][material]
            if ratio:
                settings["bed.height"] = f"{1e3 * ratio * size[kind]:g} mm"
            folder = f"{material}/{kind}" + (f"-{ratio:g}" if ratio else "")
            if kind == "heap":
                for courant in SETUP["heap_courant"]:
                    yield kind, ratio, f"{folder}-{courant:g}", settings | {"integration.courant": courant}
            else:
                yield kind, ratio, folder, settings


def cases(options):
    for material in options.material:
        for kind, _, folder, settings in runs_of(material, options.only):
            yield heap.CASE if kind == "heap" else HERE / f"{kind}.toml", options.out / folder, settings


def deposit(x, spacing):
    """Which particles belong to the largest set that links shorter than two spacings make. \\param x places, m"""
    from scipy.sparse import coo_matrix
    from scipy.sparse.csgraph import connected_components
    from scipy.spatial import cKDTree
    pairs = cKDTree(x).query_pairs(2 * spacing, output_type="ndarray")
    _, part = connected_components(coo_matrix((np.ones(len(pairs)), pairs.T), (len(x), len(x))), directed=False)
    return part == np.bincount(part).argmax()


def stray_share(x, velocity, on, spacing):
    """Share of the particles that are farther than four spacings from the deposit, or faster than 10 mm/s."""
    from scipy.spatial import cKDTree
    away = cKDTree(x[on]).query(x)[0] > 4 * spacing
    return np.mean(away | (np.linalg.norm(velocity, axis=1) > 0.01))


def foot_of(radius, direction, spacing, directions):
    """Mean over directions of the largest distance from the axis, plus half a spacing, m. \\param direction rad"""
    cell = (directions * (direction % (2 * np.pi)) / (2 * np.pi)).astype(int) % directions
    return np.mean([radius[cell == k].max() for k in np.unique(cell)]) + 0.5 * spacing


def round_deposit(x, spacing, column):
    """Foot, height and whether each particle belongs to it. \\param x places, from the axis, m \\param column radius, m"""
    on = deposit(x, spacing)
    radius, direction = np.hypot(x[on, 0], x[on, 1]), np.arctan2(x[on, 1], x[on, 0])
    axis = radius < max(0.15 * column, 1.5 * spacing)
    return foot_of(radius, direction, spacing, 36), x[on, 2][axis].max() + 0.5 * spacing, on


def slope_of_heap(x, spacing):
    """Angle of the flanks, that of height over foot, both in degrees, and which particles belong to the heap. \\param x places, from
    the axis, m"""
    on = deposit(x, spacing)
    x = x[on]
    radius, direction = np.hypot(x[:, 0], x[:, 1]), np.arctan2(x[:, 1], x[:, 0])
    foot = foot_of(radius, direction, spacing, 12)
    ring = np.floor((radius - 0.2 * foot) / (2 * spacing)).astype(int)
    cell = (12 * (direction % (2 * np.pi)) / (2 * np.pi)).astype(int) % 12
    points = []
    for n in range(int(0.6 * foot / (2 * spacing))):
        for k in range(12):
            here = (ring == n) & (cell == k)
            if here.any():
                points.append((0.2 * foot + (2 * n + 1) * spacing, x[here, 2].max() + 0.5 * spacing))
    slope = np.polyfit(*np.array(points).T, 1)[0]
    height = x[radius < 3 * spacing, 2].max() + 0.5 * spacing
    return np.degrees(np.arctan(-slope)), np.degrees(np.arctan(height / foot)), on


def slope_of_mean(x):
    """Angle of a heap's flanks by all its particles, degrees: a line through twice their heights, whose mean at a distance from the
    axis is the surface there, from 0.2 to 0.8 of the foot of the cone of the same mean radius. \\param x places, from the axis, m"""
    radius = np.hypot(x[:, 0], x[:, 1])
    flank = (radius > 0.4 * radius.mean()) & (radius < 1.6 * radius.mean())
    return np.degrees(np.arctan(-np.polyfit(radius[flank], 2 * x[flank, 2], 1)[0]))


def angle_of_drum(run, spacing):
    import drum
    angles = []
    for snapshot in run.snapshots:
        if not 2 <= snapshot.time - run.gate_time <= 4.001:
            continue
        x = np.asarray(snapshot.positions)[:, [0, 2]] - 0.5 * run.case["box"]["width"]
        centre = x.mean(axis=0)
        guess = np.arctan2(-centre[0], -centre[1])
        angle, _ = drum.surface_of(x, spacing, guess, 0.6 * SETUP["drum_radius"])
        angles.append(np.degrees(abs(angle)))
    return np.mean(angles)


def measure_run(run, kind, ratio):
    """Numbers of a run by the end of their row's name, and its deposit's profile: distances and heights over the column's size."""
    spacing = 1e-3 * spacing_of(kind, ratio)
    if kind == "drum":
        return {"drum": angle_of_drum(run, spacing)}, None
    last = run.snapshots[-1]
    x, velocity = np.asarray(last.positions).copy(), np.asarray(last["velocity"])
    size = SETUP["column_radius"]
    if kind == "channel":
        size = SETUP["channel_length"]
        on = deposit(x, spacing)
        foot, height = x[on, 0].max() + 0.5 * spacing, x[on & (x[:, 0] < 0.15 * size), 2].max() + 0.5 * spacing
        distance = x[:, 0]
    else:
        x[:, :2] -= 0.5 * np.array([run.case["box"]["width"], run.case["box"]["depth"]])
        distance = np.hypot(x[:, 0], x[:, 1])
        if kind == "heap":
            angle, by_foot, on = slope_of_heap(x, spacing)
            return {"heap": angle, "by-foot": by_foot, "by-mean": slope_of_mean(x[on]),
                    "stray": stray_share(x, velocity, on, spacing)}, None
        foot, height, on = round_deposit(x, spacing, size)
    edges = np.arange(0, foot + spacing, 2 * spacing)
    ring = np.digitize(distance, edges)
    top = [x[on & (ring == n), 2].max(initial=0) + 0.5 * spacing for n in range(1, len(edges))]
    profile = (ratio, (edges[1:] - spacing) / size, np.array(top) / size)
    return {f"{kind}-runout-{ratio:g}": foot / size - 1, f"{kind}-height-{ratio:g}": height / size,
            "stray": stray_share(x, velocity, on, spacing)}, profile


def measure(options):
    numbers, found = {}, {"heaps": {}, "profiles": []}
    for material in options.material:
        stray, heaps = [], []
        for kind, ratio, folder, _ in runs_of(material, options.only):
            of, profile = measure_run(talus.Run(options.out / folder), kind, ratio)
            stray.append(of.pop("stray", 0))
            if kind == "heap":
                heaps.append((of.pop("heap"), of.pop("by-foot"), of.pop("by-mean")))
            if profile:
                found["profiles"].append((material, kind, *profile))
            numbers |= {f"{material} {name}": value for name, value in of.items()}
        if heaps:
            found["heaps"][material] = heaps
            numbers[f"{material} heap"] = np.mean([heap[0] for heap in heaps])
        numbers[f"{material} stray"] = max(stray)
    found["without-band"] = {name: numbers.pop(name) for name in list(numbers) if name not in ROWS}
    return numbers, found


def tell(numbers, found):
    lines = [study.table_of_numbers(ROWS, numbers)]
    for material, heaps in found["heaps"].items():
        angles, by_foot, by_mean = (", ".join(f"{angle:.1f}" for angle in of) for of in zip(*heaps))
        lines.append(f"{material}: heaps of {angles} degrees, by height over foot {by_foot}, by all particles {by_mean}.")
    for name, value in found["without-band"].items():
        lines.append(f"{name}, no band: {value:.3g}.")
    return "\n".join(lines) + "\n"


def draw(found):
    from matplotlib import pyplot as plt
    kinds = [kind for kind in ("column", "channel") if any(p[1] == kind for p in found["profiles"])]
    figure, panels = plt.subplots(1, max(len(kinds), 1), figsize=(4.6 * max(len(kinds), 1), 3.4), layout="constrained", squeeze=False)
    for panel, kind in zip(panels[0], kinds):
        for material, of, ratio, distance, height in found["profiles"]:
            if of == kind:
                panel.plot(distance, height, label=f"{material}, a = {ratio:g}")
        panel.set(xlabel="distance over the column's size", ylabel="height over the column's size", title=kind)
        panel.legend(frameon=False, fontsize=7)
    return figure


def add_options(parser):
    parser.add_argument("--material", nargs="+", choices=MATERIALS, default=MATERIALS, help="left out: all")
    parser.add_argument("--only", nargs="+", choices=KINDS, default=KINDS, help="left out: all")


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/validation-materials", ROWS, cases, measure, tell, draw,
                           add_options=add_options))
