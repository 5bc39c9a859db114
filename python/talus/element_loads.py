# SPDX-License-Identifier: Apache-2.0
"""The loads on a vessel's walls by element of their surface, for programs of structural analysis: what the run found, beside what
EN 1991-4 has there."""
from pathlib import Path

import numpy as np

from talus.trouble import RunError

AS_FOUND = ("pressure_at_rest", "shear_at_rest", "pressure_in_flow", "shear_in_flow", "pressure_largest")
OF_CODE = ("en_pressure_filling", "en_shear_filling", "en_pressure_discharge", "en_shear_discharge", "en_pressure_discharge_lower")
SHARES = (0.1, 0.5)  # of what leaves: the window in flow of analysis/wall_loads.csv


def window(run):
    """Two times of snapshots of the walls: the outermost while 10 to 50 % of what leaves in all leave; where that has fewer than two,
    the opening of the gate and the last snapshot."""
    times, gate = np.asarray(run.walls.times), run.gate_time
    flow = times[times >= gate] if gate is not None else times[:0]
    if len(flow) and "discharge_rate" in run.series:
        time, rate = np.asarray(run.series["time"]), np.asarray(run.series["discharge_rate"])
        left = np.concatenate([[0], np.cumsum(0.5 * (rate[1:] + rate[:-1]) * np.diff(time))])
        if left[-1] > 0:
            share = np.interp(flow, time, left) / left[-1]
            within = flow[(share >= SHARES[0]) & (share <= SHARES[1])]
            if len(within) > 1:
                return float(within[0]), float(within[-1])
    return (float(gate), float(flow[-1])) if len(flow) else (None, None)


def received(run, time, name):
    """A load in flow times the time since the opening, of each triangle at the time of a snapshot, Pa s."""
    return np.asarray(run.walls.at(time)[name]) * max(0.0, time - run.gate_time)


def element_loads(run):
    """Of each triangle of the last snapshot of the walls, (values, unit) by name: those that the run found, means in flow over
    window(), the maximum over T/2; and characteristic loads of EN 1991-4 at its height, nan where the code has none. Shear is a vector,
    along the wall."""
    walls = run.walls[-1]
    columns = {name: (np.asarray(walls[name]), walls[name].units) for name in ("patch", *AS_FOUND)}
    begin, end = window(run)
    for name in ("pressure_in_flow", "shear_in_flow"):
        values, unit = columns[name]
        if begin is not None and end > begin:
            values = (received(run, end, name) - received(run, begin, name)) / (end - begin)
        else:
            values = np.full_like(values, np.nan)
        columns[name] = values, unit
    return columns | _of_code(run, walls)


def _of_code(run, walls):
    found = {name: (np.full(len(walls.corners), np.nan), "Pa") for name in OF_CODE}
    try:
        loads = run.table("wall_loads")
    except RunError:
        return found
    patch, height = np.asarray(walls["patch"]) + 1, np.asarray(walls.middles)[:, 2]
    for number in np.unique(np.asarray(loads["patch"])):
        of_patch, rows = patch == number, np.asarray(loads["patch"]) == number
        middle = 0.5 * np.asarray(loads["low"] + loads["high"])[rows]
        top = np.asarray(loads["high"])[rows]
        for name, (values, _) in found.items():
            given = np.asarray(loads[name])[rows]
            there = np.isfinite(given)
            if there.any():  # above the highest band with a load there is no bed
                reached = height[of_patch] <= top[there].max() * (1 + 1e-9) + 1e-12
                values[of_patch] = np.where(reached, np.interp(height[of_patch], middle[there], given[there]), np.nan)
    return found


def sides_of_bed(run, walls):
    """1 of triangles whose normal points to the bed, by the nearest of its particles at the start, else -1."""
    first = next((s for s in run.snapshots if len(s.positions)), None)
    if first is None:
        return np.ones(len(walls.corners))
    places = np.asarray(first.positions)[::max(1, len(first.positions) // 5000)]
    middles, normals = np.asarray(walls.middles), np.asarray(walls.normals)
    nearest = np.array([((places - middle) ** 2).sum(axis=1).argmin() for middle in middles])
    return np.where(((places[nearest] - middles) * normals).sum(axis=1) < 0, -1.0, 1.0)


def write_element_loads(run, path):
    """As CSV, a row a triangle with its middle, normal and area, or as VTK (legacy), by the ending of the path: .csv or .vtk. Normals,
    and the order of a triangle's corners, point into the bed: a pressure p is a force -p times normal and area on the wall."""
    path, walls, columns = Path(path), run.walls[-1], element_loads(run)
    sides = sides_of_bed(run, walls)
    if path.suffix == ".csv":
        given = {"": (walls.middles, "m"), "normal": (sides[:, None] * walls.normals, "1"), "area": (walls.areas, "m2")} | columns
        flat = {}
        for name, (values, unit) in given.items():
            parts = [(name, values)] if values.ndim == 1 else [(f"{name}_{axis}".lstrip("_"), values[:, n]) for n, axis in enumerate("xyz")]
            flat |= {f"{part} [{unit}]": np.asarray(column, dtype=float) for part, column in parts}
        np.savetxt(path, np.column_stack(list(flat.values())), fmt="%.9g", delimiter=",", header=",".join(flat), comments="")
    elif path.suffix == ".vtk":
        _write_vtk(path, walls, np.where(sides[:, None] > 0, walls.corners, walls.corners[:, ::-1]), columns)
    else:
        raise RunError(f"{path}: loads are written as .csv or .vtk")


def _write_vtk(path, walls, corners, columns):
    """Binary, as its readers know no nan in text. Source: VTK File Formats, simple legacy formats,
    https://docs.vtk.org/en/latest/vtk_file_formats/vtk_legacy_file_format.html"""
    count = len(corners)

    def block(heading, values, kind=">f8"):
        return f"{heading}\n".encode() + np.ascontiguousarray(values, dtype=kind).tobytes() + b"\n"

    polygons = np.column_stack([np.full(count, 3), corners])
    parts = [b"# vtk DataFile Version 3.0\nloads on the walls, SI units\nBINARY\nDATASET POLYDATA\n",
             block(f"POINTS {len(walls.points)} double", walls.points),
             block(f"POLYGONS {count} {4 * count}", polygons, ">i4"), f"CELL_DATA {count}\n".encode()]
    for name, (values, _) in columns.items():
        parts.append(block(f"SCALARS {name} double 1\nLOOKUP_TABLE default" if values.ndim == 1 else f"VECTORS {name} double", values))
    path.write_bytes(b"".join(parts))
