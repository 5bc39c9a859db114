# SPDX-License-Identifier: Apache-2.0
"""The tables of the DEM reference's runs: which numbers, where and when, and the CSV files that hold them."""
import csv

import numpy as np
from fields import HALF_WINDOW, Section, box_state, profile
from frames import FRAME, MASS, TOP, WIDTH, discharge, rate, wall_loads
from surfaces import band, foot_reach, foot_speed, outward_angle, repose_angle, surface_heights

HEIGHTS = 0.105, 0.12, 0.14, 0.16          # m, of profiles
TIMES = 0.1, 0.15, 0.2, 0.25, 0.3          # s, of profiles
PICTURES = 0.1, 0.16, 0.2, 0.3, 0.4        # s
PICTURE_CELL = 2e-3
BANDS = (0, 0.01), (0.01, 0.03), (0.03, 0.05), (0.022, 0.036), (0.036, 0.05)  # m from the middle, of surfaces
#: Boxes for packing and stress: x from and to (and their mirror images), z from and to, m; times, s.
BOXES = {"bed before": ((0.01, 0.05), (0.105, 0.15), (0.0,)),
         "hopper, corners": ((0.004, 0.024), (0.104, 0.12), (0.1, 0.2, 0.3)),
         "hopper, core": ((0.04, 0.05), (0.11, 0.13), (0.1, 0.2)),
         "stream": ((0.04, 0.05), (0.05, 0.09), (0.16, 0.2)),
         "bin, beside": ((0.006, 0.026), (0.004, 0.016), (0.2, 0.3, 0.4)),
         "bin, below": ((0.04, 0.05), (0.004, 0.016), (0.2, 0.3, 0.4))}


def write_rows(path, head, rows, mine):
    """A CSV file whose first column names a run. \\param mine runs whose rows are replaced; those of others stay, in
    front"""
    kept = []
    if path.exists():
        with open(path, encoding="utf-8", newline="") as file:
            kept = [row for row in list(csv.reader(file))[1:] if row[0] not in mine]
    with open(path, "w", encoding="utf-8", newline="") as file:
        csv.writer(file, lineterminator="\n").writerows([head, *kept, *rows])


class Tables:
    """The CSV files, each with a line of names and units; a line a row, of all runs one after the other."""

    HEADS = {"discharge": "run,time_s,mass_below_kg,rate_kg_per_s",
             "surfaces": "run,time_s,x_mm,hopper_mm,bin_mm",
             "profiles": "run,time_s,z_mm,x_mm,velocity_m_per_s,packing",
             "states": "run,time_s,place,packing,sxx_Pa,syy_Pa,szz_Pa,sxz_Pa,kinetic_share,sxx_over_szz",
             "foot": "run,time_s,left_mm,right_mm",
             "walls": "run,time_s,left_x_N,left_z_N,right_x_N,right_z_N,floor_x_N,floor_z_N,plate_x_N,plate_z_N",
             "numbers": "run,diameter_mm,rolling,seed,stiffness,quantity,place,time_s,unit,value"}

    def __init__(self):
        self.rows = {name: [] for name in self.HEADS}

    def add(self, name, *row):
        self.rows[name].append([f"{value:.5g}" if isinstance(value, (float, np.floating)) else value for value in row])

    def number(self, run, quantity, place, time, unit, value):
        p = run.parameters
        self.add("numbers", run.name, p["diameter"] * 1e3, p["rolling"], p["seed"], p["stiffness"], quantity, place, time,
                 unit, float(value))

    def write(self, folder):
        """Rows of other runs that the files hold already stay, in front."""
        folder.mkdir(parents=True, exist_ok=True)
        mine = {row[0] for rows in self.rows.values() for row in rows}
        for name, rows in self.rows.items():
            write_rows(folder / f"{name}.csv", self.HEADS[name].split(","), rows, mine)


def add_run(tables, run):
    """All that the tables have of a run; of a hopper alone its surface and its heap."""
    if not run.is_hopper_alone:
        add_discharge(tables, run)
        add_foot(tables, run)
    every_20_ms = [number for number in sorted(run.steps) if number % 10 == 0]
    for number in every_20_ms:
        add_frame(tables, run, run.frame(number), is_last=number == every_20_ms[-1])
    if run.is_hopper_alone:
        return
    add_profiles(tables, run)
    for row in wall_loads(run):
        tables.add("walls", run.name, *row)


def add_discharge(tables, run):
    mass = discharge(run)
    for time in np.arange(0, run.end + 1e-6, 0.02):
        tables.add("discharge", run.name, time, np.interp(time, *mass.T),
                   rate(mass, max(time - 0.01, 0), time + 0.01))
    for start, stop in ((0.05, 0.1), (0.1, 0.15), (0.15, 0.2), (0.1, 0.2)):
        tables.number(run, "discharge_rate_plateau", "", f"{start:g}-{stop:g}", "kg/s", rate(mass, start, stop))
    for time in (0.1, 0.2, 0.3, 0.4):
        if run.reaches(time):
            tables.number(run, "discharged_fraction", "", f"{time:g}", "1", np.interp(time, *mass.T) / MASS)


def add_foot(tables, run):
    """Its reach until it is at both walls."""
    reach = []
    for frame in run.frames(0.14, 0.24):
        reach.append((frame.time, *foot_reach(Section(frame, run.depth))))
        tables.add("foot", run.name, *(value * scale for value, scale in zip(reach[-1], (1, 1e3, 1e3))))
        if min(reach[-1][1:]) == WIDTH / 2:
            break
    reach = np.array(reach)
    if len(reach):
        tables.number(run, "foot_speed", "25-45 mm from the middle", "", "m/s",
                      foot_speed(reach[:, 0], reach[:, 1:].mean(axis=1)))


def add_frame(tables, run, frame, is_last):
    """Surfaces and states at a time; of the last one the angles of repose."""
    section = Section(frame, run.depth)
    hopper, bin_ = surface_heights(section)
    if run.is_hopper_alone:
        bin_[:] = np.nan
    for at in range(3, len(section.x), 4):
        x = section.x[at - 1:at + 1].mean()
        tables.add("surfaces", run.name, frame.time, x * 1e3, hopper[at - 1:at + 1].mean() * 1e3,
                   bin_[at - 1:at + 1].mean() * 1e3)
    if round(frame.time, 6) in (0.1, 0.2, 0.3, 0.4):
        for vessel, heights in (("hopper", hopper), ("bin", bin_)):
            for a, b in BANDS:
                tables.number(run, f"surface_height_{vessel}", f"{a * 1e3:g}-{b * 1e3:g} mm from the middle",
                              f"{frame.time:g}", "mm", band(section.x, heights, a, b) * 1e3)
        tables.number(run, "surface_outward_angle_bin", "22-50 mm from the middle", f"{frame.time:g}", "deg",
                      outward_angle(section.x, bin_, 0.022, 0.05))
    for place, (x, z, times) in BOXES.items():
        if any(abs(frame.time - t) < 1e-6 for t in times):
            packing, contact, kinetic = box_state(frame, section, x, z)
            s = contact + kinetic
            with np.errstate(invalid="ignore", divide="ignore"):
                share, ratio = kinetic[:3].sum() / s[:3].sum(), s[0] / s[2]
            tables.add("states", run.name, frame.time, place, packing, *s, share, ratio)
            tables.number(run, "packing", place, f"{frame.time:g}", "1", packing)
            tables.number(run, "stress_ratio", place, f"{frame.time:g}", "1", ratio)
    if is_last:
        tables.number(run, "repose_angle_hopper", "", f"{frame.time:g}", "deg", repose_angle(section, hopper))
        if not run.is_hopper_alone:
            tables.number(run, "repose_angle_bin", "", f"{frame.time:g}", "deg", repose_angle(section, bin_))


def add_profiles(tables, run):
    for time in TIMES:
        if not run.reaches(time + HALF_WINDOW):
            continue
        for height in HEIGHTS:
            x, velocity, packing = profile(run, time, height)
            for row in zip(x * 1e3, velocity, packing):
                tables.add("profiles", run.name, time, height * 1e3, *row)
            middle = velocity[abs(x - WIDTH / 2) <= 0.02]
            if np.isfinite(middle).all():
                tables.number(run, "hopper_velocity", f"z = {height * 1e3:g} mm, x = 30-70 mm", f"{time:g}", "m/s",
                              middle.mean())


def write_pictures(folder, run):
    """A file a run of packing and mean speed in cells of 2 mm, at the times of the pictures; empty cells are left out."""
    edges = [np.arange(round(size / PICTURE_CELL) + 1) * PICTURE_CELL for size in (WIDTH, TOP)]
    with open(folder / f"picture-{run.name}.csv", "w", encoding="utf-8") as file:
        file.write("time_s,x_mm,z_mm,packing,speed_m_per_s\n")
        for time in PICTURES:
            if not run.reaches(time):
                continue
            frame = run.frame(round(time / FRAME))
            speed = np.linalg.norm(frame.velocity, axis=1)
            volume, flux = (np.histogram2d(frame.x, frame.z, edges, weights=w)[0]
                            for w in (frame.volume, frame.volume * speed))
            for i, k in np.argwhere(volume > 0):
                file.write(f"{time:g},{(edges[0][i] + PICTURE_CELL / 2) * 1e3:g},{(edges[1][k] + PICTURE_CELL / 2) * 1e3:g},"
                           f"{volume[i, k] / (PICTURE_CELL**2 * run.depth):.2g},{flux[i, k] / volume[i, k]:.2g}\n")
