#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Runs cases whose answers are known, by the program alone, and puts what it computes beside them.

    validation/exact/exact.py [--program build/talus] [--out results/exact] [--only NAME ...] [--markdown FILE]

Prints a line a test: computed, exact, error, tolerance (reference.toml), met or not; writes the same as exact.json and
exact.csv into the folder. Exit status 1 if one is not met. Needs python3-numpy and python3-h5py."""
import argparse
import csv
import json
import math
import os
import subprocess
import sys
import time
import tomllib
from pathlib import Path

import h5py
import numpy as np

HERE = Path(__file__).resolve().parent
GRAVITY = 9.81


class Run:
    """A run's folder, read without the program's own readers."""

    def __init__(self, folder):
        self.folder = folder

    def quantity(self, name):
        return json.loads((self.folder / "summary.json").read_text())["quantities"][name]["value"]

    def series(self):
        with open(self.folder / "series.csv", encoding="utf-8") as file:
            rows = list(csv.reader(file))
        names = [name.split(" [")[0] for name in rows[0]]
        return dict(zip(names, np.array(rows[1:], dtype=float).T))

    def points(self, which):
        """The snapshot of that place in their order: its columns by name, "position" and "time" among them."""
        path = sorted((self.folder / "snapshots").glob("particles_*.vtkhdf"))[which]
        with h5py.File(path) as file:
            data = file["VTKHDF"]
            columns = {name: data["PointData"][name][()] for name in data["PointData"]}
            columns["position"] = data["Points"][()]
            columns["time"] = float(data["FieldData/time"][0])
        return columns

    def air(self, which):
        """Means over the layers of the air's cells: velocity along z, pressure, solid fraction, heights."""
        path = sorted((self.folder / "snapshots").glob("air_*.vtkhdf"))[which]
        with h5py.File(path) as file:
            data = file["VTKHDF"]
            at_points = "pressure" in data["PointData"]
            cells = data["PointData" if at_points else "CellData"]
            layers = cells["pressure"].shape[0]

            def mean(column):
                return np.asarray(column, dtype=float).reshape(layers, -1).mean(axis=1)

            spacing, origin = data.attrs["Spacing"][2], data.attrs["Origin"][2]
            return {"velocity": mean(cells["velocity"][..., 2]), "pressure": mean(cells["pressure"][()]),
                    "solid": mean(cells["solid_fraction"][()]), "z": origin + spacing * (np.arange(layers) + (0 if at_points else 0.5))}


class Runs:
    """Runs of the program, each once, whoever asks for it."""

    def __init__(self, program, out):
        self.program, self.out, self.done = program, out, {}

    def __call__(self, case, name=None, **settings):
        name = name or case
        if name not in self.done:
            path = HERE / "cases" / f"{case}.toml"
            if not path.exists():  # one of the project's own
                path = HERE.parents[1] / "cases" / f"{case}.toml"
            command = [self.program, "run", path, "--out", self.out / name, "--threads", "1"]
            for key, value in settings.items():
                command += ["--set", f"{key.replace('__', '.')}={value}"]
            result = subprocess.run(command, capture_output=True, text=True)
            if result.returncode:
                raise RuntimeError(f"{case}: exit status {result.returncode}: {result.stderr.strip()}")
            self.done[name] = Run(self.out / name)
        return self.done[name]


# The cloud ------------------------------------------------------------------------------------------------------------
STOKES = 2 / 9 * GRAVITY * (2500 - 970) * 1e-3 ** 2 / 1.0  # m/s, of a sphere alone


def abreast(r):
    """What a sphere adds to the fall of another beside it, r radii away."""
    return 0.75 / r * (1 + 2 / (3 * r * r))


def fall(runs, name):
    run = runs("spheres", name, particles__file=f"{name}.csv")
    first, last = run.points(0), run.points(-1)
    way = first["position"][:, 2] - last["position"][:, 2]
    return float(way.mean()) / last["time"] / STOKES


def pair_abreast(runs):
    return fall(runs, "pair"), 1 + abreast(3)


def pair_tandem(runs):
    return fall(runs, "tandem"), 1 + 0.75 / 3 * (2 - 4 / 27)


def triple(runs):
    return fall(runs, "triple"), 1 + 2 * abreast(4)


def ring(runs):
    return fall(runs, "ring"), 1 + sum(abreast(10 * math.sin(math.pi * j / 8)) for j in range(1, 8))


def ring_kept(runs):
    fall(runs, "ring")
    radius = [np.hypot(*runs("spheres", "ring").points(k)["position"][:, :2].T) for k in (0, -1)]
    return float(np.abs(radius[1] / radius[0] - 1).max()), 0


def reversal(runs):
    there = runs("reversal", "there")
    first, last = there.points(0), there.points(-1)
    places = runs.out / "reversal.csv"
    places.write_text("x [m],y [m],z [m]\n" + "".join(f"{x!r},{y!r},{z!r}\n" for x, y, z in last["position"].tolist()))
    back = runs("spheres", "back", particles__file=places.resolve(), fluid__mobility="zuk-2014",
                gravity__direction="[0, 0, 1]", integration__max_step=0.01, integration__tolerance=1e3,
                run__end=f"{last['time'] * (1 - 1e-9)!r} s")
    end = back.points(-1)
    assert abs(end["time"] / last["time"] - 1) < 1e-12, "another time"
    assert np.linalg.norm(last["position"] - first["position"], axis=1).min() > 3e-3, "nothing has moved"
    return float(np.linalg.norm(end["position"] - first["position"], axis=1).max()) / 1e-3, 0


# The continuum --------------------------------------------------------------------------------------------------------
def by_identity(points, name):
    return points[name][np.argsort(points["identity"])]


def thrown_place(runs):
    run = runs("thrown")
    first, last = run.points(0), run.points(-1)
    t = last["time"]
    exact = by_identity(first, "position") + np.array([0.4, 0, 0.8]) * t + np.array([0, 0, -0.5 * GRAVITY]) * t * t
    return float(np.abs(by_identity(last, "position") - exact).max()) / (0.8 * t), 0


def jet(runs):
    run = runs("jet")
    last = run.points(-1)
    aside = last["position"][:, 0] - 0.12
    turned = np.abs(aside) > 0.03
    assert turned.sum() > 0.3 * len(aside), "the jet has not been turned"
    return float((np.sign(aside) * last["velocity"][:, 0])[turned].mean()), 1


WAVE_SPEED = math.sqrt(2e6 / 1500)


def pressure_wave(runs):
    series = runs("pressure-wave").series()
    t, p = series["time"], series["momentum_z"]
    signs = np.nonzero(p[:-1] * p[1:] < 0)[0]
    zeros = t[signs] - p[signs] * (t[signs + 1] - t[signs]) / (p[signs + 1] - p[signs])
    return float(2 * (zeros[1] - zeros[0])), 2 * 0.4 / WAVE_SPEED


def pressure_wave_load(runs):
    series = runs("pressure-wave").series()
    window = [f * 0.4 / WAVE_SPEED for f in (0.1, 0.9)]
    impulse = np.interp(window, series["time"], series["impulse_top_z"])
    return float((impulse[1] - impulse[0]) / (window[1] - window[0]) / (20e-3 * 10e-3)), 1500 * WAVE_SPEED * 0.01


def last_20_ms(series, column):
    end = series["time"][-1]
    impulse = np.interp([end - 20e-3, end], series["time"], series[column])
    return float(impulse[1] - impulse[0]) / 20e-3


def bed_weight(runs):
    run = runs("static-bed", run__end="25 ms")
    return -last_20_ms(run.series(), "impulse_floor_z") / (1500 * 0.085 * 20e-3 * 2.5e-3 * GRAVITY), 1


def bed_profile(runs):
    points = runs("static-bed", run__end="25 ms").points(-1)
    z = points["position"][:, 2]
    middle = np.abs(z - 0.0425) < 2.6e-3  # two layers: stresses that alternate between them do not count
    return float(points["stress_zz"][middle].mean() / (1500 * GRAVITY * (0.085 - z[middle]).mean())), 1


def at_yield(mu):
    return (1 - mu / math.sqrt(3)) / (1 + 2 * mu / math.sqrt(3))


def bed_at_yield(runs):
    return runs("static-bed", run__end="25 ms").quantity("stress_ratio_settled"), at_yield(0.28)


def bed_at_yield_damping(runs):
    return runs("static-bed", "static-bed-damped", settle__damping_time="0.6 ms").quantity(
        "stress_ratio_settled"), at_yield(0.28)


def printed_stress(runs):
    run = runs("static-bed", "static-bed-printed", sph__stress_form="printed")
    return run.quantity("floor_stress_settled"), 1500 * 0.085 * GRAVITY / 0.6


def janssen(runs):
    run = runs("janssen-silo", output__pictures="false")
    series, points = run.series(), run.points(-1)
    wall, rub = abs(last_20_ms(series, "impulse_left_x")), abs(last_20_ms(series, "impulse_left_z"))
    floor = -last_20_ms(series, "impulse_floor_z")
    width, depth, density, height = 30e-3, 2.5e-3, 1500, 0.15
    # K: the force on a wall over the integral of the mean vertical stress along it.
    vertical = float(points["stress_zz"].mean()) * height * depth
    used, ratio = rub / wall, wall / vertical
    length = width / (2 * used * ratio)
    return floor / (density * width * depth * height * GRAVITY), length / height * (1 - math.exp(-height / length))


AIR_DENSITY, AIR_VISCOSITY, BEAD = 101325 / (287.05 * 293.15), 1.82e-5, 200e-6
# Cunningham's, with a mean free path of (mu/p) (pi R T/2)^(1/2): 1.0009.
SLIP = 1 + 1.257 * 2 * AIR_VISCOSITY / 101325 * math.sqrt(0.5 * math.pi * 287.05 * 293.15) / BEAD


def drag_coefficient(law, solid, slip):
    """beta, kg/(m^3 s), of Eqs 20-21 of Yuu & Umekage 2011, or of Ergun 1952."""
    void = 1 - solid
    if law == "ergun-wen-yu":
        return (150 * solid ** 2 * AIR_VISCOSITY / (void * BEAD ** 2 * SLIP) + 1.75 * solid * AIR_DENSITY * slip / BEAD)
    reynolds = BEAD * slip * AIR_DENSITY / AIR_VISCOSITY
    stokes = 18 * AIR_VISCOSITY * solid / BEAD ** 2
    return stokes * (1 + 0.15 * reynolds ** 0.687) * (3.8 - 5.4 / void + 2.6 / void ** 2) / SLIP


def gradient(law, solid, superficial):
    """Pa/m: -Phi dP/dz = beta u, the superficial velocity being Phi u."""
    void = 1 - solid
    return drag_coefficient(law, solid, superficial / void) * superficial / void ** 2


PRINTED, ERGUN = "schiller-naumann+umekage-yuu", "ergun-wen-yu"


def flow(runs, law, pressure):
    """Of a bed under that pressure from below: superficial velocity, gradient within, void fraction, floor force over
    the weight."""
    run = runs("fixed-bed", f"fixed-bed-{'ergun' if law == ERGUN else 'printed'}-{pressure}", air__drag=law,
               air__floor_pressure=f"{pressure} Pa", run__end="20 ms")
    air = run.air(-1)
    inside = (air["z"] > 10e-3) & (air["z"] < 40e-3)
    solid = float(air["solid"][inside].mean())
    slope = -np.polyfit(air["z"][inside], air["pressure"][inside], 1)[0]
    force = -last_20_ms(run.series(), "impulse_floor_z") / (1500 * GRAVITY * 5e-3 * 1.25e-3 * 50e-3)
    # Above the bed there is nothing but air: its velocity is the superficial one.
    return float(air["velocity"][air["z"] > 60e-3].mean()), float(slope), solid, force


def fixed(runs, law):
    superficial, slope, solid, _ = flow(runs, law, 300)
    return slope, gradient(law, solid, superficial)


def fluidised(runs, law):
    """The floor's force falls with the pressure drop, and that with the velocity: followed to where it is nothing."""
    states = [flow(runs, law, pressure) for pressure in (500, 600, 700)]
    velocity = np.polyval(np.polyfit([s[3] for s in states], [s[0] for s in states], 2), 0)
    solid = states[-1][2]
    low, high = 0.0, 1.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if gradient(law, solid, middle) < solid * 2500 * GRAVITY else (low, middle)
    return float(velocity), low


def fixed_bed(runs):
    return fixed(runs, PRINTED)


def fixed_bed_ergun(runs):
    return fixed(runs, ERGUN)


def fluidisation(runs):
    return fluidised(runs, PRINTED)


def fluidisation_ergun(runs):
    return fluidised(runs, ERGUN)


def bead(runs):
    velocity = -float(runs("bead").points(-1)["velocity"][0, 2])
    low, high = 0.0, 10.0
    for _ in range(60):
        middle = 0.5 * (low + high)
        pull = 3 * math.pi * AIR_VISCOSITY * BEAD * middle * (
            1 + 0.15 * (BEAD * middle * AIR_DENSITY / AIR_VISCOSITY) ** 0.687) / SLIP
        low, high = (middle, high) if pull < math.pi / 6 * BEAD ** 3 * 2500 * GRAVITY else (low, middle)
    return velocity, low


# The air by itself ----------------------------------------------------------------------------------------------------
def taylor_green(runs):
    series = runs("taylor-green", output__pictures="false").series()
    time, energy = series["time"], series["kinetic_energy"]
    # exp(-nu (k_x^2 + k_z^2) t) is the decay of the velocity, of which the energy is the square.
    return float(energy[-1] / energy[0]), math.exp(-2 * 0.01 * 2 * (2 * math.pi) ** 2 * (time[-1] - time[0]))


def cavity(runs, name):
    return runs("cavity", output__pictures="false").quantity(name)


def cavity_least_u(runs):
    return cavity(runs, "middle_u_min"), -0.2140424


def cavity_least_w(runs):
    return cavity(runs, "middle_w_min"), -0.2538030


def cavity_largest_w(runs):
    return cavity(runs, "middle_w_max"), 0.1795728


# What is printed ------------------------------------------------------------------------------------------------------
def evaluate(name, reference, runs):
    begun = time.monotonic()
    try:
        computed, exact = globals()[name.replace("-", "_")](runs)
    except (RuntimeError, AssertionError, KeyError, FileNotFoundError) as error:
        return {"test": name, **reference, "error": None, "met": False, "failed": str(error) or repr(error)}
    error = abs(computed - exact) / (abs(exact) or 1)
    return {"test": name, **reference, "computed": computed, "exact": exact, "error": error,
            "met": bool(error <= reference["tolerance"]), "seconds": time.monotonic() - begun}


def line(row, form="{:22} {:>14} {:>14} {:>10} {:>9}  {}"):
    if row["error"] is None:
        return form.format(row["test"], "-", "-", "-", f"{row['tolerance']:g}", "failed: " + row["failed"])
    return form.format(row["test"], f"{row['computed']:.8g}", f"{row['exact']:.8g}", f"{row['error']:.2g}",
                       f"{row['tolerance']:g}", "met" if row["met"] else "NOT MET")


def markdown(rows):
    text = "| test | what | computed | exact | error | tolerance | |\n|---|---|---|---|---|---|---|\n"
    for row in rows:
        text += line({**row, "test": f"`{row['test']}`"},
                     "| {} | " + f"{row['says']}; {row['source']}" + " | {} | {} | {} | {} | {} |\n")
    return text


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", type=Path, default=HERE.parents[1] / "build" / "talus")
    parser.add_argument("--out", type=Path, default=Path("results/exact"), help="folder of the runs; must not be there")
    parser.add_argument("--only", nargs="+", metavar="NAME", help="these tests alone")
    parser.add_argument("--markdown", type=Path, help="also write the table to this file")
    options = parser.parse_args()
    reference = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
    names = options.only or list(reference)
    if unknown := [name for name in names if name not in reference]:
        parser.error(f"no such test: {', '.join(unknown)}; there are {', '.join(reference)}")
    if not os.access(options.program, os.X_OK):
        parser.error(f"{options.program} is no program; ./run --build-only leaves it at build/talus")
    if options.out.exists():
        parser.error(f"{options.out} is there already; another --out")
    options.out.mkdir(parents=True)
    runs = Runs(options.program, options.out)
    print(f"{'test':22} {'computed':>14} {'exact':>14} {'error':>10} {'tolerance':>9}")
    rows = []
    for name in names:
        rows.append(evaluate(name, reference[name], runs))
        print(line(rows[-1]), flush=True)
    met = sum(row["met"] for row in rows)
    print(f"{met} met, {len(rows) - met} not met")
    (options.out / "exact.json").write_text(json.dumps(rows, indent=2) + "\n")
    with open(options.out / "exact.csv", "w", encoding="utf-8", newline="") as file:
        table = csv.DictWriter(file, ["test", "computed", "exact", "error", "tolerance", "met"], extrasaction="ignore")
        table.writeheader()
        table.writerows(rows)
    if options.markdown:
        options.markdown.write_text(markdown(rows), encoding="utf-8")
    return 0 if met == len(rows) else 1


if __name__ == "__main__":
    sys.exit(main())
