#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Beads that stick: which strength they have in steady shear (cohesive.in), whether that predicts a state that was held out and a
layer on a slope (incline.in with the same attraction), and what tension they bear.

usage: cohesion.py run FOLDER    cells, with LAMMPS (ten minutes on one core), to data/cohesion.csv
       cohesion.py slopes FOLDER layers (eight minutes), to data/cohesive-slopes.csv
       cohesion.py fit           alpha and kappa of a/sigma = kappa + alpha C, and what they predict
"""
import math

import numpy as np
from shear import HERE, engine, lammps, main, states, write_rows
from talus.beads import (COHESIVE_PRESSURE, GRAVITY, PLANE, SLOW, STILL, angles, cohesion_estimates, cohesive_friction,
                         cohesive_state, fit_friction, friction_between, strength)

CELLS, SLOPES = HERE / "data" / "cohesion.csv", HERE / "data" / "cohesive-slopes.csv"
ROLLING = 0.2
#: Attraction over pressure times d^2, packing before the pressure, strain of each side as the cell is pulled apart.
BONDS = ((0, 0.56, 0), (0.3, 0.56, 0.01), (0.6, 0.56, 0.01), (1, 0.56, 0), (2.5, 0.5, 0.01), (5, 0.56, 0))
HELD_OUT = 2.5
#: Layers: attraction over the weight of a bead, seed, slopes at first, in between and at last; settings of incline.in.
LAYERS = ((20, 1, 38, 26, 50), (20, 2, 38, 26, 0), (6, 1, 32, 22, 55))
LAYER = {"rolling": ROLLING, "thickness": 12, "length": 7, "width": 5, "time": 0.8}
AT_REST = 0.137  # beyond slow shear, of these beads without cohesion (incline.py, shear.py)


def tension(table):
    """The largest mean tension of pull.txt over the pressure of the shear before."""
    return -table[:, 3:6].mean(axis=1).min() / COHESIVE_PRESSURE


def run(folder):
    rows = []
    for bond, packing, pull in BONDS:
        place = folder / f"bond-{bond:g}"
        lammps(place, "cohesive.in", rolling=ROLLING, bond=bond, packing=packing, pull=pull)
        rows.append((bond, *cohesive_state(np.loadtxt(place / "cohesive.txt"), bond),
                     tension(np.loadtxt(place / "pull.txt")) if pull else math.nan))
    write_rows(CELLS, ("bond", "attraction_over_stress", "inertial_number", "friction", "packing", "tension_over_pressure"), rows)


def sticky(text):
    """incline.in with the attraction of cohesive.in, `energy` (N/m)."""
    text = text.replace("pair_style granular", "pair_style hybrid/overlay granular granular")
    text = text.replace("pair_coeff * * hooke", "pair_coeff * * granular 2 dmt 1 0 0.3 ${energy} tangential linear_nohistory 0 0 "
                        "damping velocity\npair_coeff * * granular 1 hooke")
    return text + "quit\n"


def slopes(folder):
    folder.mkdir(parents=True, exist_ok=True)
    script = (folder / "incline-cohesive.in").resolve()
    script.write_text(sticky(engine.script("incline.in").read_text(encoding="utf-8")), encoding="utf-8")
    rows = []
    for bond, seed, first, between, last in LAYERS:
        place = folder / f"bond-{bond:g}-s{seed}"
        energy = bond * 2500 * math.pi / 6 * 1e-9 * GRAVITY / (math.pi * 1e-3)
        lammps(place, script, energy=energy, seed=seed, to=between, up=last, **{"from": first}, **LAYER)
        stop = np.loadtxt(place / "stop.txt")
        found = angles(stop, np.loadtxt(place / "start.txt") if last else stop)
        rows.append((bond, seed, found[0], math.degrees(math.atan(friction_between(stop, SLOW, STILL, LAYER["time"]))), last,
                     found[-1] if last else math.nan))
    write_rows(SLOPES, ("bond", "seed", "thickness", "balanced_at_deg", "up_to_deg", "starts_at_deg"), rows)


def law():
    """mu_s, mu_2 and I_0 without cohesion."""
    s = states(ROLLING)
    return fit_friction(s["inertial_number"], s["friction"])[:3]


def slope_of(bond, friction, alpha, kappa):
    """At which tan(beta) = M (1 + kappa + alpha C), C the attraction over the pressure on the plane times d^2, degrees."""
    height, spread = LAYER["thickness"] + PLANE, 1.1  # incline.in: layers of its lattice, and 1.5 diameters that are the plane
    above = math.ceil(0.57 * height * spread**2 * 6 / math.pi) / spread**2 - 0.55 * PLANE * 6 / math.pi  # beads over an area d^2
    slope = 0.5
    for _ in range(100):
        slope = math.atan(friction * (1 + kappa + alpha * bond / (above * math.cos(slope))))
    return math.degrees(slope)


def fit():
    table = np.genfromtxt(CELLS, delimiter=",", names=True)
    over = strength(table["inertial_number"], table["friction"], law())
    print("| C wanted | C | friction | a/sigma | packing | tension over pressure |\n|---|---|---|---|---|---|")
    for row, x in zip(table, over):
        print(f"| {row['bond']:g} | {row['attraction_over_stress']:.2f} | {row['friction']:.3f} | {x:.3f} | {row['packing']:.3f} "
              f"| {row['tension_over_pressure']:.3f} |".replace("nan", ""))
    found = {}
    for name, used in (("all", table["bond"] > 0), ("without the one held out", (table["bond"] > 0) & (table["bond"] != HELD_OUT))):
        found[name] = cohesion_estimates(table["attraction_over_stress"][used], over[used])
        print(f"{name}: " + ", ".join(f"{key} {one.value:.3f} ({one.low:.3f} to {one.high:.3f})"
                                      for key, one in zip(("alpha", "kappa"), found[name])))
    [row] = table[table["bond"] == HELD_OUT]
    alpha, kappa = (one.value for one in found["without the one held out"])
    predicted = cohesive_friction(row["inertial_number"], kappa + alpha * row["attraction_over_stress"], law())
    print(f"held out, C = {HELD_OUT:g}: friction {row['friction']:.3f}, predicted {predicted:.3f}")
    alpha, kappa = (one.value for one in found["all"])
    slow = law()[0]
    for row in np.genfromtxt(SLOPES, delimiter=",", names=True):
        stops, starts = (slope_of(row["bond"], friction, alpha, kappa) for friction in (slow, slow + AT_REST))
        print(f"layer of {row['thickness']:.1f} diameters, bond number {row['bond']:g}, seed {row['seed']:g}: friction as it stops "
              f"{row['balanced_at_deg']:.1f} degrees, law {stops:.1f}; starts at {row['starts_at_deg']:.1f}, law {starts:.1f}")


if __name__ == "__main__":
    main(__doc__, fit, run=run, slopes=slopes)
