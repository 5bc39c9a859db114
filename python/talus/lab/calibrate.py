# SPDX-License-Identifier: Apache-2.0
"""talus calibrate: a material file from a shear tester's loci, or from the angle of a poured heap."""
import math
from pathlib import Path

import numpy as np

from talus import heap, powder
from talus.ask import ask, find_project, write
from talus.lab.command import DONE, arguments, run_command, say
from talus.lab.reference import toml_text
from talus.trouble import InputError, problem

GAMMA_C, LOOSE, FASTER = 0.1, 0.94, 0.256
SHEAR_PLANE = "shear plane"


def quantity(text, option, unit, problems, low=0.0, high=math.inf):
    """SI; None if it is not given, or will not do, which is a problem then."""
    if text is None:
        return None
    [said] = ask("quantities", texts=[text])
    if said.get("unit") == unit and low < said["si"] < high:
        return said["si"]
    if unit == "deg":
        low, high = math.degrees(low), math.degrees(high)
    ends = f" between {low:g} and {high:g} {unit}" if high < math.inf else f" above {low:g} {unit}"
    problems.append(problem(f"{option} {text}", said.get("why") or "will not do", allowed=f"a quantity{ends}"))
    return None


class Material:
    """Lines of a material file."""

    def __init__(self, title):
        self.lines = ["# Written by talus calibrate. Values, the intervals of 95 % in which they lie, and where they are from.",
                      f"title = {toml_text(title)}"]

    def add(self, key, value, source, unit="", interval=None, **more):
        def text(number):
            return toml_text(f"{number:.6g} {unit}") if unit else f"{float(f'{number:.6g}')!r}"
        self.lines += ["", f"[{key}]", f"value = {value if isinstance(value, str) else text(value)}"]
        if interval:
            self.lines.append(f"range = [{text(interval[0])}, {text(interval[1])}]")
        self.lines.append(f"source = {toml_text(source)}")
        self.lines += [f"{name} = {toml_text(word)}" for name, word in more.items()]

    def add_friction(self, estimate, source):
        self.add("law.name", '"critical-state"', "Talus")
        key = "law.critical-state"
        self.add(f"{key}.static_friction", estimate.value, source, interval=(estimate.low, estimate.high), test=SHEAR_PLANE,
                 angle=f"{math.degrees(math.atan(float(f'{estimate.value:.6g}'))):.6g} deg")
        self.add(f"{key}.dynamic_friction", estimate.value + FASTER,
                 "not measured: as much above the friction of slow flow as in glass beads", test=SHEAR_PLANE)

    def add_packing(self, density, spread, grain_density, diameter, source):
        """\\param spread of the bulk density, or None"""
        packing = density / grain_density if grain_density else 0.6
        self.add("grains.density", grain_density or density / 0.6,
                 "as given" if grain_density else f"{source}, over a packing of 0.6: a choice; drag of air and speed of fast "
                 "flow depend on it", "kg/m3")
        if diameter:
            self.add("grains.diameter", diameter, "as given", "m")
        of_bed = tuple(end * packing / density for end in spread) if spread else None
        self.add("bed.packing", packing, f"{source}: {density:.4g} kg/m3", interval=of_bed)
        for key, share, why in (("critical_packing", 1.0, "that of the bed, which neither dilates nor compacts in flow"),
                                ("random_loose_packing", LOOSE, "0.94 of that, as of glass beads: not measured")):
            self.add(f"law.critical-state.{key}", share * packing, why)

    def text(self):
        return "\n".join(self.lines) + "\n"


def read_walls(words, problems):
    """Points by wall, of "steel=wall.csv"."""
    walls = {}
    for word in words:
        wall, equals, path = word.partition("=")
        if not equals or wall not in ("steel", "acrylic", "glass", "concrete"):
            problems.append(problem(f"--wall {word}", "names no wall", allowed="steel, acrylic, glass or concrete: "
                                    "steel=wall.csv"))
            continue
        try:
            walls[wall] = (path, np.array(ask("wall-locus", file=path)).T)
        except InputError as error:
            problems += error.problems
    return walls


def table_of_loci(loci, friction, strength, growth):
    """What each locus says beside the fit, Pa."""
    lines = [f"{'consolidation':>14}{'angle':>8}{'fit':>7}{'f_c':>9}{'fit':>8}{'sigma_1':>10}{'fit':>8}{'ff_c':>7}{'fit':>6}"
             f"{'off points':>12}", f"{'Pa':>14}{'deg':>8}{'deg':>7}{'Pa':>9}{'Pa':>8}{'Pa':>10}{'Pa':>8}"]
    angle = math.atan(friction)
    for locus in loci:
        bond = strength + growth * locus["consolidation"]
        f_c = 2 * friction * bond * math.cos(angle) / (1 - math.sin(angle))
        major = (locus["consolidation"] + bond) * (1 + friction**2) * (1 + math.sin(angle)) - bond
        points = np.array(locus["points"])
        off = np.sqrt(np.mean((friction * (points[:, 0] + bond) / points[:, 1] - 1) ** 2))
        ratio = locus["major"] / locus["strength"] if locus["strength"] > 0 else math.inf
        lines.append(f"{locus['consolidation']:14.4g}{math.degrees(locus['angle']):8.1f}{math.degrees(angle):7.1f}"
                     f"{locus['strength']:9.4g}{f_c:8.4g}{locus['major']:10.4g}{major:8.4g}{ratio:7.3g}"
                     f"{major / f_c if f_c else math.inf:6.3g}{100 * off:10.1f} %")
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
        material.add(f"{key}.cohesion_strain", GAMMA_C, "a choice: the strain of a shear tester's peak")
    most = max(locus["consolidation"] for locus in loci)
    material.lines += ["", "[pressure]", f'range = ["0 Pa", "{most:.6g} Pa"]', f'source = "the largest consolidation of {name}"']
    for wall, (path, data) in walls.items():
        on_wall, adhesion = powder.fit_wall(*data)
        material.add(f"walls.{wall}", on_wall.value,
                     f"{len(data.T)} points of {Path(path).name}; besides an adhesion of {adhesion.value:.3g} Pa ({adhesion.low:.3g} to "
                     f"{adhesion.high:.3g}): walls.adhesion", interval=(on_wall.low, on_wall.high))
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
    case = find_project("validation/materials/heap.toml")
    if case is None:
        problems.append(problem("validation/materials/heap.toml", "is not there: run the command in the project's folder"))
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
        return heap.poured(case, folder / f"heap_{number}", heap.settings_of(candidate.resolve(), friction, density))

    return material_of(powder.Estimate(*heap.friction_of(degrees, heap_of, say)))


def main():
    options = arguments(texts=("shear-cell", "repose", "bulk-density", "grain-density", "diameter", "out"), lists=("wall",))
    problems = []
    if (options.shear_cell is None) == (options.repose is None):
        problems.append(problem("talus calibrate", "takes one of --shear-cell and --repose", allowed="--shear-cell data.csv, or --repose "
                                "34deg"))
        raise InputError(problems)
    if options.repose and options.wall:
        problems.append(problem("--wall", "takes --shear-cell", allowed="none with --repose"))
    if not options.out.endswith(".toml"):
        problems.append(problem(f"--out {options.out}", "has another ending", allowed="a file that ends in .toml"))
    grain_density = quantity(options.grain_density, "--grain-density", "kg/m3", problems)
    diameter = quantity(options.diameter, "--diameter", "m", problems)
    make = from_shear_cell if options.shear_cell else from_heap
    material = make(options, grain_density, diameter, problems)
    write({options.out: material.text()})
    say(f"Material: {options.out}; in a case grains.material = \"{options.out}\"")
    return DONE


if __name__ == "__main__":
    run_command(main)
