#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""What the DEM reference's beads do when their shear turns back, when it stops, and when they are shaken (reverse.in, kick.in).

usage: settle.py run FOLDER    three reversals and one shaken packing with LAMMPS (about ten minutes on one core), to
                               data/reversal.csv and data/agitation.csv
       settle.py fit           a fabric tensor added to the law critical-state, with standard errors, and the table of the shaken
"""
import numpy as np
from shear import HERE, lammps, main, write_rows

REVERSAL, AGITATION = HERE / "data" / "reversal.csv", HERE / "data" / "agitation.csv"
ROLLING = 0.2
SEEDS, SHAKEN_SEEDS = (1, 2, 3), (1,)
STRAIN = 0.01          # of a row
KICKS = 8              # as in kick.in, of each strength
STEP = 0.002           # strain of a step of the law
#: What counts as one standard deviation of a packing and of a friction in the fit.
PACKING_ERROR, FRICTION_ERROR = 0.003, 0.03
NAMES = ("fabric_contraction", "fabric_strain", "fabric_friction", "dilatancy", "critical_packing", "static_friction",
         "dilatant_friction")


def means(table, key):
    return [table[key == place].mean(axis=0) for place in np.unique(key)]


def turned(folder):
    """Rows of one reversal: stage (0 forward, 1 at rest, 2 back), strain, packing, friction in the direction of shear."""
    rows = []
    for stage, name in enumerate(("forward", "stop", "back")):
        table = np.loadtxt(folder / f"{name}.txt")
        for _, strain, packing, xx, yy, _, xy, *_ in means(table, (table[:, 1] / STRAIN).astype(int)):
            centre = 0.5 * (xx + yy)
            friction = np.hypot(0.5 * (xx - yy), xy) / centre if stage < 2 else -xy / centre
            rows.append([stage, strain, packing, friction])
    return rows


def shaken(folder):
    """Rows: stage (0 shortening, 1 slower, 2 at rest, 3 kicks, 4 kicks ten times as strong), number, packing, xx/yy, zz/yy
    at its end."""
    rows = []
    for stage, name in enumerate(("squeeze", "slow-1e-2", "hold", "kicks", "hard")):
        table = np.loadtxt(folder / f"{name}.txt")
        parts = np.array_split(table, KICKS) if stage > 2 else [table]
        for number, part in enumerate(parts):
            packing, xx, yy, zz = part[-max(1, len(part) // 5):, 2:6].mean(axis=0)
            rows.append([stage, number, packing, xx / yy, zz / yy])
    return rows


def run(folder):
    rows = []
    for seed in SEEDS:
        lammps(folder / f"reverse-s{seed}", "reverse.in", rolling=ROLLING, seed=seed)
        rows += [[ROLLING, seed, *row] for row in turned(folder / f"reverse-s{seed}")]
    write_rows(REVERSAL, ("rolling", "seed", "stage", "strain", "packing", "friction"), rows)
    rows = []
    for seed in SHAKEN_SEEDS:
        lammps(folder / f"kick-s{seed}", "kick.in", rolling=ROLLING, seed=seed)
        rows += [[ROLLING, seed, *row] for row in shaken(folder / f"kick-s{seed}")]
    write_rows(AGITATION, ("rolling", "seed", "stage", "number", "packing", "xx_over_yy", "zz_over_yy"), rows)


def law(parameters, strains, packing, fabric, sense):
    """Packing and friction at strains of slow simple shear, and the fabric at the end: complex, its phase twice the angle
    to the direction of the shear's compression."""
    contraction, length, part, dilatancy, critical, friction, dilatant = parameters
    found, last = [], 0.0
    for strain in strains:
        steps = max(1, int((strain - last) / STEP))
        step = (strain - last) / steps
        for _ in range(steps):
            fabric = (fabric + (sense - fabric) * step / length) * np.exp(-1j * sense * step)
            missing = 1 - sense * fabric.real
            packing *= np.exp(-step * (dilatancy * (packing - critical) - contraction * missing / 2))
        last = strain
        found.append((packing, friction + dilatant * dilatancy * (packing - critical) - part * missing))
    return np.array(found).T, fabric


def misfit(parameters, runs):
    left = []
    for (forward, back) in runs:
        fabric = 0j
        for (strain, packing, friction), start, sense in ((forward, forward[1][0], 1), (back, forward[1][-5:].mean(), -1)):
            (lawful, strength), fabric = law(parameters, strain, start, fabric, sense)
            left += [(lawful - packing) / PACKING_ERROR, (strength - friction) / FRICTION_ERROR]
    return np.concatenate(left)


def least_squares(function, start):
    """Gauss and Newton's method, damped after Levenberg; the values and their standard errors."""
    values, damping = np.array(start, float), 1e-2
    left = function(values)
    for _ in range(60):
        jacobian = np.column_stack([(function(values + change) - left) / change.sum()
                                    for change in np.diag(1e-4 * np.abs(values))])
        square = jacobian.T @ jacobian
        trial = values - np.linalg.solve(square + damping * np.diag(np.diag(square)), jacobian.T @ left)
        moved = function(trial) if (trial > 0).all() else np.full_like(left, np.inf)
        if moved @ moved < left @ left:
            done = moved @ moved > (1 - 1e-7) * (left @ left)
            values, left, damping = trial, moved, damping / 5
            if done:
                break
        else:
            damping *= 5
    return values, np.sqrt(np.diag(np.linalg.inv(square)) * np.mean(left**2)), np.sqrt(np.mean(left**2))


def reversals():
    table = np.genfromtxt(REVERSAL, delimiter=",", names=True)
    return [[np.array([table[name][(table["seed"] == seed) & (table["stage"] == stage)]
                       for name in ("strain", "packing", "friction")]) for stage in (0, 2)]
            for seed in np.unique(table["seed"])]


def fit():
    values, errors, left = least_squares(lambda p: misfit(p, reversals()), (0.5, 0.3, 0.25, 8, 0.55, 0.48, 0.7))
    print(f"reversals, left {left:.2f} of packing {PACKING_ERROR} and friction {FRICTION_ERROR}: " +
          ", ".join(f"{name} {value:.3f} +- {error:.3f}" for name, value, error in zip(NAMES, values, errors)))
    table = np.genfromtxt(AGITATION, delimiter=",", names=True)
    for stage, number in np.unique(table[["stage", "number"]]):
        rows = table[(table["stage"] == stage) & (table["number"] == number)]
        print(f"stage {stage:.0f}, {number + 1:.0f}: packing {rows['packing'].mean():.4f}, "
              f"xx/yy {rows['xx_over_yy'].mean():.3f}, zz/yy {rows['zz_over_yy'].mean():.3f}")


if __name__ == "__main__":
    main(__doc__, fit, run=run)
