# SPDX-License-Identifier: Apache-2.0
"""talus calibrate: a material file from a shear tester's loci, from the angle of a poured heap, or from beads."""
import math
import tempfile
from pathlib import Path

import numpy as np

from talus import heap, powder
from talus.ask import ask, write
from talus.lab.bead_file import read_beads
from talus.lab.command import DONE, arguments, run_command, say
from talus.lab.from_beads import from_beads
from talus.lab.material_file import COHESION_STRAIN, WALLS, Material, quantity
from talus.trouble import InputError, problem


def read_walls(words, problems):
    """Points by wall, of "steel=wall.csv"."""
    walls = {}
    for word in words:
        wall, equals, path = word.partition("=")
        if not equals or wall not in WALLS:
            problems.append(problem(f"--wall {word}", "names no wall", allowed=f"{', '.join(WALLS)}: steel=wall.csv"))
            continue
        try:
            walls[wall] = (path, np.array(ask("wall-locus", file=path)).T)
        except InputError as error:
            problems += error.problems
    return walls


def warn_of_strength(loci, friction, strength, growth, material):
    """Where the loci are stronger than the fit at their sigma_1, by more than they scatter and 5 %: what a design by it misses."""
    angle = math.atan(friction)
    circle = (1 + friction**2) * (1 + math.sin(angle))  # sigma_1 + a over the load + a
    majors, measured = np.array([(locus["major"], locus["strength"]) for locus in loci if locus["strength"] > 0]).reshape(-1, 2).T
    if len(majors) < 2:
        return
    load = np.maximum((majors - (circle - 1) * strength) / (circle + (circle - 1) * growth), 0)
    share = 2 * friction * math.cos(angle) / (1 - math.sin(angle)) * (strength + growth * load) / measured
    if 1 - np.mean(share) > max(np.std(share, ddof=1), 0.05):
        material.warn(f"at the loci's sigma_1 the fit has {100 * np.mean(share):.0f} % of their f_c: outlets and ratholes of a design by it "
                      "are too small, on the unsafe side; measured outlets may arch where it has none that does")


def table_of_loci(loci, friction, strength, growth):
    """What each locus says beside the fit, Pa."""
    lines = [f"{'consolidation':>14}{'angle':>8}{'fit':>7}{'f_c':>11}{'fit':>11}{'sigma_1':>11}{'fit':>11}{'ff_c':>7}"
             f"{'fit':>7}{'off points':>12}", f"{'Pa':>14}{'deg':>8}{'deg':>7}{'Pa':>11}{'Pa':>11}{'Pa':>11}{'Pa':>11}"]
    angle = math.atan(friction)
    for locus in loci:
        bond = strength + growth * locus["consolidation"]
        f_c = 2 * friction * bond * math.cos(angle) / (1 - math.sin(angle))
        major = (locus["consolidation"] + bond) * (1 + friction**2) * (1 + math.sin(angle)) - bond
        points = np.array(locus["points"])
        off = np.sqrt(np.mean((friction * (points[:, 0] + bond) / points[:, 1] - 1) ** 2))
        ratio = locus["major"] / locus["strength"] if locus["strength"] > 0 else math.inf
        lines.append(f"{locus['consolidation']:14.4g}{math.degrees(locus['angle']):8.1f}{math.degrees(angle):7.1f}"
                     f"{locus['strength']:11.4g}{f_c:11.4g}{locus['major']:11.4g}{major:11.4g}{ratio:7.3g}"
                     f"{major / f_c if f_c else math.inf:7.3g}{100 * off:10.1f} %")
    return "\n".join(lines)


def from_shear_cell(options, grain_density, diameter, problems):
    loci, walls = [], read_walls(options.wall, problems)
    try:
        loci = ask("yield-loci", file=options.shear_cell)
    except InputError as error:
        problems += error.problems
    densities = [locus["bulk_density"] for locus in loci if locus["bulk_density"]]
    given = quantity(options.bulk_density, "--bulk-density", "kg/m3", problems)
    if loci and not densities and not options.bulk_density:
        problems.append(problem("--bulk-density", "missing: the file has no column bulk_density", allowed='such as "620 kg/m3"'))
    if problems:
        raise InputError(problems)
    points = np.array([(locus["consolidation"], *point) for locus in loci for point in locus["points"]])
    friction, strength, growth = powder.fit_loci(*points.T)
    name = Path(options.shear_cell).name
    source = f"{len(loci)} yield loci, {len(points)} points of failure: {name}; least squares, interval of 95 %"
    material = Material(f"{Path(options.out).stem}: by the yield loci of {name}")
    density = given or float(np.mean(densities))
    if grain_density and grain_density <= density:
        raise InputError([problem(f"--grain-density {options.grain_density}", f"is no more than the bulk density of {density:.4g} kg/m3",
                                  allowed="the true density of the grains, above that")])
    material.add_packing(density, None if given else (min(densities), max(densities)), grain_density, diameter,
                         "as given" if given else f"mean after pre-shear, {name}")
    material.add_friction(friction, source)
    key = "law.critical-state"
    material.add(f"{key}.ageing_strength", 0.0, "the loci hold what grains have that were sheared")
    if strength.value > 0:
        material.add(f"{key}.tensile_strength", strength.value, source, "Pa", (strength.low, strength.high))
    if growth.value > 0:
        material.add(f"{key}.consolidation_strength", growth.value, source, interval=(growth.low, growth.high))
    if strength.value > 0 or growth.value > 0:
        material.add(f"{key}.cohesion_strain", COHESION_STRAIN, "a choice: the strain of a shear tester's peak")
    most = max(locus["consolidation"] for locus in loci)
    material.lines += ["", "[pressure]", f'range = ["0 Pa", "{most:.6g} Pa"]', f'source = "the largest consolidation of {name}"']
    for wall, (path, data) in walls.items():
        on_wall, adhesion = powder.fit_wall(*data)
        material.add(f"walls.{wall}", on_wall.value,
                     f"{len(data.T)} points of {Path(path).name}; besides an adhesion of {adhesion.value:.3g} Pa ({adhesion.low:.3g} to "
                     f"{adhesion.high:.3g}): walls.adhesion", interval=(on_wall.low, on_wall.high),
                     **({"adhesion": f"{adhesion.value:.6g} Pa"} if adhesion.value > 0 else {}))
    warn_of_strength(loci, friction.value, strength.value, growth.value, material)
    say(table_of_loci(loci, friction.value, strength.value, growth.value))
    for label, estimate, unit in (("friction M", friction, ""), ("tensile_strength", strength, " Pa"),
                                  ("consolidation_strength", growth, "")):
        say(f"{label} = {estimate.value:.4g}{unit} ({estimate.low:.4g} to {estimate.high:.4g}{unit})")
    return material


def from_heap(options, grain_density, diameter, problems):
    angle = quantity(options.repose, "--repose", "deg", problems, math.radians(18), math.radians(42))
    density = quantity(options.bulk_density, "--bulk-density", "kg/m3", problems)
    if options.bulk_density is None:
        problems.append(problem("--bulk-density", "missing", allowed='such as "620 kg/m3"'))
    if problems:
        raise InputError(problems)
    degrees, folder = math.degrees(angle), Path(options.out).with_suffix("")

    def material_of(friction):
        material = Material(f"{Path(options.out).stem}: by a heap of {degrees:.4g} degrees")
        material.add_packing(density, None, grain_density, diameter, "as given")
        material.add_friction(friction, f"a poured heap of {degrees:.4g} degrees, inverted by heaps of the law itself; interval by "
                              f"{heap.SCATTER:g} degree more or less")
        material.add("law.critical-state.ageing_strength", heap.AGEING, "not measured: the law's own; a heap does not tell it from "
                     "the friction")
        material.lines += ["", "[pressure]", 'range = ["0 Pa", "5 kPa"]', 'source = "a heap; a choice"']
        return material

    def heap_of(friction, number):
        candidate = folder / f"heap_{number}.toml"
        ask("claim", folders=[folder], files=[])
        write({candidate: material_of(powder.Estimate(friction, friction, friction)).text()})
        return heap.poured(heap.CASE, folder / f"heap_{number}", heap.settings_of(candidate.resolve(), friction, density))

    return material_of(powder.Estimate(*heap.friction_of(degrees, heap_of, say)))


def check(material, options, entrance):
    """Raises InputError, with the data, if the program would refuse the file."""
    with tempfile.TemporaryDirectory() as folder:
        file = Path(folder) / Path(options.out).name
        file.write_text(material.text(), encoding="utf-8")
        try:
            ask("material", file=file)
        except InputError as error:
            raise InputError([problem(f"--{entrance.replace('_', '-')} {getattr(options, entrance)}", "gives a material that no case takes: "
                                      + one.replace(f"{folder}/", "")) for one in error.problems]) from error


ENTRANCES = {"shear_cell": ("wall", "bulk_density", "grain_density", "diameter"), "repose": ("bulk_density", "grain_density", "diameter"),
             "grains": ("jobs", "quick")}


def main():
    options = arguments(texts=("shear-cell", "repose", "grains", "bulk-density", "grain-density", "diameter", "out"), lists=("wall",),
                        numbers=("jobs",), flags=("quick",))
    problems, given = [], [name for name in ENTRANCES if getattr(options, name) is not None]
    if len(given) != 1:
        problems.append(problem("talus calibrate", "takes one of --shear-cell, --repose and --grains", allowed="--shear-cell data.csv, "
                                "--repose 34deg or --grains beads.toml"))
        raise InputError(problems)
    for name in dict.fromkeys(name for names in ENTRANCES.values() for name in names):
        if getattr(options, name) and name not in ENTRANCES[given[0]]:
            takers = [f"--{taker.replace('_', '-')}" for taker, names in ENTRANCES.items() if name in names]
            problems.append(problem(f"--{name.replace('_', '-')}", f"takes {' or '.join(takers)}",
                                    allowed=f"none with --{given[0].replace('_', '-')}"))
    if not options.out.endswith(".toml"):
        problems.append(problem(f"--out {options.out}", "has another ending", allowed="a file that ends in .toml"))
    grain_density = quantity(options.grain_density, "--grain-density", "kg/m3", problems)
    diameter = quantity(options.diameter, "--diameter", "m", problems)
    if options.grains:
        try:
            beads = read_beads(options.grains)
        except InputError as error:
            problems += error.problems
        if problems:
            raise InputError(problems)
        material = from_beads(options, beads)
    else:
        make = from_shear_cell if options.shear_cell else from_heap
        material = make(options, grain_density, diameter, problems)
    check(material, options, given[0])
    write({options.out: material.text()})
    for warning in material.warnings:
        say(f"Warning: {warning}")
    say(f"Material: {options.out}; in a case grains.material = \"{options.out}\"")
    return DONE


if __name__ == "__main__":
    run_command(main)
