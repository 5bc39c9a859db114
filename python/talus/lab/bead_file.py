# SPDX-License-Identifier: Apache-2.0
"""The file of beads that talus calibrate --grains reads."""
import math
from dataclasses import dataclass, field

from talus import beads as fits
from talus.ask import ask
from talus.lab.material_file import WALLS
from talus.lab.toml_reader import TomlReader
from talus.trouble import InputError, nearest

#: With units, in which they are given; plain numbers with the ends of what is allowed.
QUANTITIES = {"diameter": ("m", "1.25 mm"), "density": ("kg/m3", "2500 kg/m3"), "stiffness": ("N/m", "1000 N/m")}
NUMBERS = {"spread": (0.05, 0.2), "friction": (0.0, 2.0), "rolling_friction": (0.0, 1.0), "restitution": (0.1, 0.99)}
#: What holds beads together is given by one of these: the work of adhesion w of two beads (twice the surface energy of one surface)
#: in JKR's pull-off force F_c = 3/2 pi w R_eff, R_eff of beads of the mean diameter d/4; or F_c over the weight of a bead.
COHESIVE = ("surface_energy", "bond_number")
FORMER = {"cohesion": "bond_number", "adhesion": "surface_energy"}


@dataclass
class Beads:
    """Spheres, SI. Diameters are uniform within `spread` of the mean; `stiffness` of the linear springs between them."""

    diameter: float
    density: float
    stiffness: float
    spread: float
    friction: float
    rolling_friction: float
    restitution: float
    attraction: float = 0.0  #: F_c of two beads of the mean diameter, N
    walls: dict = field(default_factory=dict)  #: coefficient of friction on each, by its name


def read_beads(path):
    """Raises InputError with every problem of the file."""
    reader = TomlReader(path)
    beads, line = reader.file.get("beads"), reader.line_of("[beads]")
    for name in reader.file:
        if name not in ("beads", "walls", "title"):
            reader.fault(reader.line_of(f"[{name}]"), name, "is no table of a file of beads", allowed="beads, walls",
                         near=nearest(name, ("beads", "walls")))
    if not isinstance(beads, dict):
        reader.fault(0, "beads", "missing", allowed="a table [beads]")
        raise InputError(reader.problems)
    _check_names(reader, beads, line)
    values = {name: _number(reader, beads, line, name, *ends) for name, ends in NUMBERS.items()}
    values |= {name: _quantity(reader, beads, line, name, *unit) for name, unit in QUANTITIES.items()}
    values["attraction"] = _attraction(reader, beads, line, values)
    walls, given = {}, reader.file.get("walls", {})
    if not isinstance(given, dict):
        reader.fault(0, "walls", "is of another type", allowed=f"tables [walls.{WALLS[0]}] with friction")
        given = {}
    for wall, table in given.items():
        at = reader.line_of(f"[walls.{wall}]") or reader.line_of("[walls]")
        if wall not in WALLS:
            reader.fault(at, f"walls.{wall}", "is no wall of a material", allowed=", ".join(WALLS), near=nearest(wall, WALLS))
        elif not isinstance(table, dict):
            reader.fault(at, wall, "is of another type", allowed=f"a table [walls.{wall}] with friction")
        else:
            for name in table.keys() - {"friction"}:
                reader.fault(at, name, "is no key of a wall", allowed="friction", near=nearest(name, ["friction"]))
            walls[wall] = _number(reader, table, at, "friction", 0.0, 2.0)
    if reader.problems:
        raise InputError(reader.problems)
    return Beads(**values, walls=walls)


def _check_names(reader, beads, line):
    known = [*QUANTITIES, *NUMBERS, *COHESIVE]
    for name in beads:
        if name not in known:
            reader.fault(line, name, "is no key of beads", allowed=", ".join(known), near=FORMER.get(name) or nearest(name, known))


def _attraction(reader, beads, line, values):
    """Newtons; 0 of beads that do not stick."""
    given = [key for key in COHESIVE if key in beads]
    if len(given) > 1:
        reader.fault(line, given[1], f"is given besides {given[0]}", allowed="one of the two")
    diameter, density, stiffness = (values[key] or math.nan for key in ("diameter", "density", "stiffness"))
    newtons = {"surface_energy": 3 * math.pi / 8 * diameter, "bond_number": math.pi / 6 * density * fits.GRAVITY * diameter**3}
    value = 0.0
    for key in given:
        most = fits.STICKIEST * fits.SOFT * stiffness * diameter / newtons[key]  # beyond, overlaps count under every load
        value = (_energy if key == "surface_energy" else _bond_number)(reader, beads, line, most if most > 0 else math.inf)
    return value * newtons[given[-1]] if given else 0.0


def _up_to(most):
    return f"from 0 to {most:.3g}" if most < math.inf else "from 0 on"


def _why_not(text, value, most):
    return f"{text} will not do" + (": overlaps would count under every load" if value > most else "")


def _bond_number(reader, beads, line, most):
    allowed, before = f"a number {_up_to(most)}: the force that parts two beads over their weight", len(reader.problems)
    value = reader.get(beads, line, "bond_number", (int, float), allowed)
    if len(reader.problems) == before and not 0 <= value <= most:
        reader.fault(line, "bond_number", _why_not(f"{value:g}", value, most), allowed=allowed)
    return float(value)


def _energy(reader, beads, line, most):
    allowed, before = f'the work of adhesion of two beads, {_up_to(most)} J/m2: "0.05 J/m2"', len(reader.problems)
    text = reader.get(beads, line, "surface_energy", str, allowed)
    if len(reader.problems) > before:
        return 0.0
    [said] = ask("quantities", texts=[text])
    value = said["si"] if said.get("unit") == "N/m" else -1.0
    if 0 <= value <= most:
        return value
    reader.fault(line, "surface_energy", said.get("why") or _why_not(f'"{text}"', value, most), allowed=allowed)
    return 0.0


def _number(reader, table, line, key, low, high):
    allowed, before = f"a number from {low:g} to {high:g}", len(reader.problems)
    value = reader.get(table, line, key, (int, float), allowed)
    if len(reader.problems) == before and not low <= value <= high:
        reader.fault(line, key, f"{value:g} will not do", allowed=allowed)
    return float(value)


def _quantity(reader, table, line, key, unit, example):
    allowed, before = f'a quantity above 0 {unit}: "{example}"', len(reader.problems)
    text = reader.get(table, line, key, str, allowed)
    if len(reader.problems) > before:
        return None
    [said] = ask("quantities", texts=[text])
    if said.get("unit") == unit and said["si"] > 0:
        return said["si"]
    reader.fault(line, key, said.get("why") or f'"{text}" will not do', allowed=allowed)
    return None
