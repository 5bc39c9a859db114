# SPDX-License-Identifier: Apache-2.0
"""The material files that talus calibrate writes."""
import math

from talus.ask import ask
from talus.lab.reference import toml_text
from talus.trouble import problem

#: Of glass beads: dynamic less static friction, random loose packing over the critical one.
FASTER, LOOSE = 0.256, 0.94
COHESION_STRAIN = 0.1  # of a shear tester's peak
SHEAR_PLANE = "shear plane"
WALLS = ("steel", "acrylic", "glass", "concrete")


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
        self.warnings = []

    def warn(self, text):
        """Of what the values do not hold for; \\param text one line"""
        self.warnings.append(text)
        self.lines.insert(1, f"# Warning: {text}.")

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
