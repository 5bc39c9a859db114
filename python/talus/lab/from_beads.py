# SPDX-License-Identifier: Apache-2.0
"""talus calibrate --grains: a material file from discrete elements of beads, periodic cells by LAMMPS (validation/bead-shear).

Cells are of one size and stiffness, for hard beads know no other lengths than their diameter. Dense packings come first: their
critical packing and friction say which states and slopes are to be computed. Beads that stick have cells of their own besides; all
else is that of the same beads without cohesion."""
import math
from pathlib import Path
from typing import NamedTuple

import numpy as np

from talus import beads as fits
from talus.ask import ask
from talus.lab import lammps
from talus.lab.command import Interruption, processors, say
from talus.lab.material_file import COHESION_STRAIN, SHEAR_PLANE, Material
from talus.powder import Estimate
from talus.trouble import RunError

# Standard deviations of seeds in validation/bead-shear: of b, of the friction that a layer needs to start, of a wall's over its value.
PEAK_SCATTER, START_SCATTER, WALL_SCATTER = 0.03, 0.03, 0.03
MAX_INERTIAL = 0.3  # up to which the law's packing falls
LOOSER = 0.04  # than the critical packing of beads that do not stick are cells of those that do, as they are laid


class Plan(NamedTuple):
    """What is computed. Packings of constant volume are less the critical one of the dense packings; lengths in diameters."""

    first: tuple       #: seeds of dense packings of 0.62
    denser: tuple      #: packing less the critical one, and seed
    states: tuple
    side: int          #: of the dense packings' boxes
    strain: float      #: at constant volume
    layer: dict        #: of incline.in
    layers: tuple      #: seeds
    blocks: tuple      #: seeds of layers on walls
    bonds: tuple       #: attraction over pressure times d^2 of beads that stick
    bonded: dict       #: of cohesive.in


FULL = Plan((1, 2), ((0.03, 1), (0.045, 1), (0.045, 2)),
            (-0.055, -0.045, -0.035, -0.025, -0.018, -0.012, -0.008, -0.003, 0.002, 0.02), 12, 2.5,
            {"thickness": 16, "length": 10, "width": 6, "time": 2}, (1, 2, 3), (1, 2, 3),
            (0.3, 0.6, 1, 2.5, fits.STICKIEST), {"side": 10, "strain": 2.5})
QUICK = Plan((1, 2), ((0.04, 3),), (-0.05, -0.035, -0.025, -0.015, -0.008, 0.02), 10, 2.0,
             {"thickness": 12, "length": 7, "width": 5, "time": 1}, (1, 2), (1,),
             (0.3, 1, 2.5, fits.STICKIEST), {"side": 8, "strain": 1.5})
BLOCK = {"smooth": 1, "thickness": 6, "up": 0, "time": 2}


def layer_settings(slow):
    """Slopes of layers that shear slowly with that friction, degrees: in flow, at rest, beyond what starts them."""
    slope = math.degrees(math.atan(slow))
    return {"from": round(slope + 2.5, 1), "to": round(max(slope - 2.5, 0.5), 1), "up": round(slope + 13, 1)}


def block_settings(slow, wall):
    """The same of a layer on a wall: it starts to slide, and stops."""
    first = max(math.degrees(math.atan(slow)) - 1.3, math.degrees(math.atan(wall)) + 4)
    return {"from": round(first, 1), "to": round(first - 24, 1), "muwall": wall}


def jobs_of(plan, beads, folder):
    """The first jobs, and a function of the critical packing and friction that they have, which returns the others: (dense, states,
    layers, cells of beads that stick, blocks by the wall's name)."""
    contact = {"mu": beads.friction, "rolling": beads.rolling_friction, "restitution": beads.restitution, "spread": beads.spread}

    def dense(packing, seed):
        return lammps.job(folder, "dilate.in", plan.side**3 / 1000, packing=packing, seed=seed, side=plan.side, **contact)

    def others(critical, slow):
        beads_of_layer = plan.layer["thickness"] * plan.layer["length"] * plan.layer["width"] / 840
        return ([dense(round(min(critical + more, 0.638), 3), seed) for more, seed in plan.denser],
                [lammps.job(folder, "shear.in", plan.strain / 4, packing=round(critical + more, 4), strain=plan.strain, **contact)
                 for more in plan.states],
                [lammps.job(folder, "incline.in", 2 * beads_of_layer * plan.layer["time"], seed=seed, **plan.layer,
                            **layer_settings(slow), **contact) for seed in plan.layers],
                [lammps.job(folder, "cohesive.in", plan.bonded["side"]**3 * plan.bonded["strain"] / 1200, bond=bond, **plan.bonded,
                            packing=round(critical - LOOSER, 3), **contact) for bond in plan.bonds if beads.attraction],
                {wall: [lammps.job(folder, "incline.in", 1, seed=seed, **BLOCK, **block_settings(slow, friction), **contact)
                        for seed in plan.blocks] for wall, friction in beads.walls.items()})

    return [dense(0.62, seed) for seed in plan.first], others


def columns_of(jobs, table):
    return [np.loadtxt(one.folder / table) for one in jobs]


def dense_runs(jobs):
    """Strain, packing and friction of each."""
    return [np.array(fits.dilation(table)).T for table in columns_of(jobs, "dilate.txt")]


def run_all(plan, beads, folder, at_once):
    """Runs what is not done, and is alone in the folder while it does."""
    ask("claim", folders=[folder], files=[])
    with lammps.alone_in(folder):
        return run_in(plan, beads, folder, at_once)


def run_in(plan, beads, folder, at_once):
    """What was computed: runs of dense packings, rows of (packing, state), slopes at which layers start, or the largest tried,
    states of cohesive cells, and frictions by wall."""
    first, others = jobs_of(plan, beads, folder)
    interruption, rest = Interruption(), others(0.58, 0.4)
    members = [job for group in (*rest[:4], *rest[4].values()) for job in group]
    say(f"{len(first) + len(members)} runs by LAMMPS in {folder}, {at_once} at a time")
    lammps.run(first, at_once, interruption, sum(one.cost for one in members))
    found = np.mean([fits.fit_dilatancy(*run) for run in dense_runs(first)], axis=0)
    dense, states, layers, bonded, blocks = others(*found[2:])
    lammps.run([*layers, *(job for group in blocks.values() for job in group), *dense, *states, *bonded], at_once, interruption)
    starts = [fits.angles(*tables)[-1] for tables in zip(columns_of(layers, "stop.txt"), columns_of(layers, "start.txt"))]
    starts = [job.variables["up"] if math.isnan(slope) else slope for job, slope in zip(layers, starts)]
    walls = {wall: [fits.friction_between(table, *fits.SLIDES, BLOCK["time"]) for table in columns_of(group, "stop.txt")]
             for wall, group in blocks.items()}
    rows = np.array([(job.variables["packing"], *fits.state(table)) for job, table in zip(states, columns_of(states, "shear.txt"))])
    cells = [fits.cohesive_state(table, job.variables["bond"]) for job, table in zip(bonded, columns_of(bonded, "cohesive.txt"))]
    return dense_runs(first + dense), rows, starts, np.array(cells), walls


def estimates_of(runs, rows, starts):
    """By key of the law, each an Estimate; the bulk stiffness over k/d as well, a number."""
    packing, inertial, friction, pressure = rows[:, :4].T
    hard = pressure < fits.SOFT
    if hard.sum() < 3 or len(rows) < 4:
        raise RunError("the beads jam at every packing that was tried: no line of packing against inertial number")
    dense = np.array([fits.fit_dilatancy(*run) for run in runs]).T
    of_friction = fits.friction_estimates(np.append(inertial, np.full(len(runs), fits.DENSE_INERTIAL)), np.append(friction, dense[3]))
    found = dict(zip(("static_friction", "dynamic_friction", "inertial_number"), of_friction))
    critical, fall, critical_error, fall_error = fits.fit_packing(inertial[hard], packing[hard])
    t = fits.student(hard.sum() - 2)
    steady = fits.mean_estimate(dense[2], 0.005)
    middle = 0.5 * (critical + steady.value)
    found["critical_packing"] = Estimate(middle, min(critical - t * critical_error, steady.low),
                                         max(critical + t * critical_error, steady.high))
    found["packing_slope"] = Estimate(max(fall, 0.0), max(fall - t * fall_error, 0.0), max(fall + t * fall_error, 0.0))
    found["random_loose_packing"] = middle - MAX_INERTIAL * found["packing_slope"].value
    found["dilatancy"] = fits.mean_estimate(dense[0], 0.1 * dense[0].mean())
    k, _, loose, slow = dense.mean(axis=1)
    found["dilatant_friction"] = fits.mean_estimate([fits.fit_peak(k, slow, loose, *run[1:]) for run in runs], PEAK_SCATTER)
    found["ageing_strength"] = fits.mean_estimate(np.tan(np.radians(starts)) - found["static_friction"].value, START_SCATTER)
    return found, fits.bulk_stiffness(packing, pressure)


def add_cohesion(found, sources, cells, beads, plan):
    """To what is found of beads that do not stick, and where it is from, a_0, kappa and the critical packing of those that do."""
    bond, inertial, friction, packing = cells.T
    slow, dry = found["static_friction"], found["critical_packing"].value
    law = [found[key].value for key in ("static_friction", "dynamic_friction", "inertial_number")]
    alpha, kappa = fits.cohesion_estimates(bond, fits.strength(inertial, friction, law), 0.5 * (slow.high - slow.low) / slow.value)
    per_area = beads.attraction / beads.diameter**2
    ends = (f"sheared steadily at constant pressure, their attraction {plan.bonds[0]:g} to {plan.bonds[-1]:g} times the pressure "
            "times the diameter squared")
    for key in sources:
        sources[key] += "; of these beads without cohesion"
    if alpha.value > 0:
        found["tensile_strength"] = Estimate(*(per_area * end for end in (alpha.value, alpha.low, alpha.high)))
        sources["tensile_strength"] = (f"{len(cells)} cells of beads that stick, {ends}: {alpha.value:.3g} ({alpha.low:.3g} to "
                                       f"{alpha.high:.3g}) of the attraction over the diameter squared")
    if kappa.value > 0:
        found["consolidation_strength"], sources["consolidation_strength"] = kappa, f"{len(cells)} cells of beads that stick, {ends}"
    nearest = np.abs(np.log(bond)).argmin()
    found["critical_packing"] = Estimate(packing[nearest], packing.min(), packing.max())
    found["random_loose_packing"] = packing[nearest] - MAX_INERTIAL * found["packing_slope"].value
    sources["random_loose_packing"] = f"the critical packing at an inertial number of {MAX_INERTIAL:g}, its slope without cohesion"
    sources["critical_packing"] = (f"a choice: of the cell whose attraction is {bond[nearest]:.2g} times the pressure times the diameter "
                                   f"squared; the range is that of {len(cells)} cells; {dry:.4g} without cohesion")
    if alpha.value > 0 or kappa.value > 0:
        found["cohesion_strain"], sources["cohesion_strain"] = COHESION_STRAIN, "a choice: the strain of a shear tester's peak"


def material_of(name, beads, plan, computed):
    runs, rows, starts, cells, walls = computed
    found, bulk = estimates_of(runs, rows, starts)
    of = (f"beads of friction {beads.friction:g}, rolling friction {beads.rolling_friction:g}, restitution {beads.restitution:g}, "
          f"diameters within {beads.spread:g} of the mean")
    steady, dense = f"{len(rows)} states of steady shear at constant volume", f"{len(runs)} dense packings sheared at constant pressure"
    both = f"{steady} and the ends of {dense}"
    sources = {"static_friction": both, "dynamic_friction": both, "inertial_number": both, "packing_slope": steady,
               "critical_packing": f"mean of {steady} and of the ends of {dense}",
               "random_loose_packing": f"the critical packing at an inertial number of {MAX_INERTIAL:g}", "dilatancy": dense,
               "dilatant_friction": f"peaks of {dense}",
               "ageing_strength": f"{len(starts)} layers on a slope: {', '.join(f'{slope:.3g}' for slope in starts)} degrees as they start, "
                                  "or at most; beyond the static friction"}
    if beads.attraction:
        add_cohesion(found, sources, cells, beads, plan)
        of += f", attraction {beads.attraction:.4g} N"
    material = Material(f"{name}: {of}, by LAMMPS")
    material.add("grains.density", beads.density, "as given", "kg/m3")
    material.add("grains.diameter", beads.diameter, "as given", "m")
    material.add("bed.packing", found["critical_packing"].value, "a choice: that of slow flow, which neither dilates nor compacts")
    material.add("law.name", '"critical-state"', "Talus")
    for key, estimate in found.items():
        more = {"test": SHEAR_PLANE} if key in ("static_friction", "dynamic_friction") else {}
        unit = "Pa" if key == "tensile_strength" else ""
        value, interval = estimate, None
        if isinstance(estimate, Estimate):
            value, interval = max(estimate.value, 0.0), (max(estimate.low, 0.0), max(estimate.high, 0.0))
        by = "" if key == "cohesion_strain" else "; LAMMPS"
        material.add(f"law.critical-state.{key}", value, sources[key] + by, unit, interval, **more)
        say(f"{key} = {value:.4g}" + (f" ({interval[0]:.4g} to {interval[1]:.4g})" if interval else "") + f" {unit}".rstrip())
    material.add("law.critical-state.ageing_adds", "false", "beads that have rested have the peak of their packing, no more "
                 "(validation/bead-shear)")
    hard = beads.stiffness / beads.diameter
    stiff = "" if math.isnan(bulk) else f"; beads have a bulk modulus of {bulk * hard:.3g} Pa, cases that of their bed"
    low, high, why = 0.0, fits.SOFT * hard, f"{fits.SOFT:g} of the stiffness over the diameter: beyond, overlaps count{stiff}"
    if beads.attraction:
        low, loose = (beads.attraction / beads.diameter**2 / bond for bond in (plan.bonds[-1], plan.bonds[0]))
        if loose < high:
            high = loose
            why = f"loads under which the attraction is {plan.bonds[-1]:g} to {plan.bonds[0]:g} times load times diameter squared"
        else:
            why = f"from an attraction of {plan.bonds[-1]:g} times load times diameter squared to {why}"
    material.lines += ["", "[pressure]", f'range = ["{low:.4g} Pa", "{high:.4g} Pa"]', f'source = "{why}"']
    for wall, frictions in walls.items():
        known = [one for one in frictions if np.isfinite(one)]
        if not known:
            say(f"walls.{wall}: left out, for no layer slid along it and stopped")
            continue
        estimate, by = fits.mean_estimate(known, WALL_SCATTER * np.mean(known)), "; without cohesion" if beads.attraction else ""
        material.add(f"walls.{wall}", estimate.value, f"seeds of layers that slide on a flat wall of friction {beads.walls[wall]:g}: "
                     f"{len(known)}{by}; LAMMPS", interval=(max(estimate.low, 0.0), estimate.high))
        say(f"walls.{wall} = {estimate.value:.4g} ({estimate.low:.4g} to {estimate.high:.4g})")
    return material


def from_beads(options, beads):
    """The Material of a bead_file.Beads."""
    plan, out = QUICK if options.quick else FULL, Path(options.out)
    return material_of(out.stem, beads, plan, run_all(plan, beads, out.with_suffix(""), options.jobs or processors()))
