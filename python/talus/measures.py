# SPDX-License-Identifier: Apache-2.0
"""The quantities of a study, for which a paper's table asks and no other run: validation/STUDY/measures.py.

Such a file defines

    QUANTITIES = {"name": Quantity(unit="1", text="its definition", place=("from", "to"), of=function)}

with `function(run, window, **place) -> float` of a `talus.Run`, a `Window` in the time unit of the study and lengths in m
by name; `function(groups, window)` of the members of each variant where the quantity is `together`. What has no value
is nan; `NotEvaluated` says that the runs do not allow to ask for one, and why. `mean(runs)`, if the file has it, makes the
mean of the members of an ensemble, of which quantities are taken as of a run (`from = "curves"`).

    python3 -m talus.measures --table STUDY_FOLDER        prints the quantities as a table in Markdown

`answers` answers the questions of a comparison (talus.lab.evaluation).
"""
import argparse
import functools
import importlib.util
import math
import sys
from concurrent.futures import ProcessPoolExecutor
from dataclasses import dataclass
from pathlib import Path
from typing import Callable, NamedTuple

from talus.run import Run
from talus.trouble import RunError


class NotEvaluated(Exception):
    """The runs do not allow to evaluate a quantity; the text says why."""


class Window(NamedTuple):
    """Of time: the data nearest to `at` (inf: the end of the run), of two the earlier; or those with begin < t <= end."""

    at: float | None = None
    begin: float = 0.0
    end: float = math.inf


@dataclass(frozen=True)
class Quantity:
    unit: str                     #: SI; "deg" for angles, "1" for numbers
    text: str
    of: Callable
    place: tuple = ()             #: names of the lengths that a row has to bring
    together: bool = False        #: of the members of several variants, not of a run
    may_be_missing: bool = False  #: members that have no such number are left out while they are the fewer


class Measures:
    """The file measures.py of a study's folder."""

    def __init__(self, folder):
        path = Path(folder).resolve() / "measures.py"
        if not path.is_file():
            raise RunError(f"{path}: no such file")
        spec = importlib.util.spec_from_file_location("measures_of_" + path.parent.name.replace("-", "_"), path)
        self.module = importlib.util.module_from_spec(spec)
        sys.path.insert(0, str(path.parent))  # a study's files import each other
        try:
            spec.loader.exec_module(self.module)
        finally:
            sys.path.remove(str(path.parent))
        self.quantities = self.module.QUANTITIES

    def mean(self, runs):
        """The mean of the members, as a run; of a single one itself."""
        if hasattr(self.module, "mean"):
            return self.module.mean(runs)
        if len(runs) != 1:
            raise NotEvaluated("these runs have no mean")
        return runs[0]


@functools.cache
def measures_of(folder):
    """The Measures of a study's folder, read once: measures_of(Path(__file__).parent.parent / "yuu2011").module"""
    return Measures(folder)


def once(function):
    """Decorates function(run, ...): its values are kept with the run, one for each set of further arguments."""
    @functools.wraps(function)
    def remembered(run, *arguments):
        memory = run.__dict__.setdefault("_once", {})
        if (function, arguments) not in memory:
            memory[function, arguments] = function(run, *arguments)
        return memory[function, arguments]
    return remembered


def table(quantities):
    """The quantities as rows of Markdown."""
    lines = ["| name | unit | definition | place |", "|---|---|---|---|"]
    for name, quantity in quantities.items():
        text = quantity.text.replace("|", "\\|")
        lines.append(f"| `{name}` | {quantity.unit} | {text} | {', '.join(quantity.place)} |")
    return "\n".join(lines)


def answers(measures, questions, jobs=1):
    """To each question {"quantity", "of": "each" | "curves" | "values" | "together", "window", "place", "groups": [[folder, ...], ...]}
    {"values": [[...], ...], "missing": [reason, ...]}: a list and a reason a group; of "each" a value a member, else one.
    """
    units = [unit for n, question in enumerate(questions) for unit in _units(measures, n, question)]
    tasks = {}  # units with the same first run together: it is read once, and forgotten after them
    for unit in units:
        tasks.setdefault(unit.groups[0][0], []).append(unit)
    if jobs > 1 and len(tasks) > 1:
        folder = Path(measures.module.__file__).parent
        with ProcessPoolExecutor(min(jobs, len(tasks))) as pool:
            done = list(pool.map(_values_in_process, [folder] * len(tasks), tasks.values()))
    else:
        done = [_values(measures, task) for task in tasks.values()]

    counts = [1 if question["of"] == "together" else len(question["groups"]) for question in questions]
    result = [{"values": [[] for _ in range(count)], "missing": [""] * count} for count in counts]
    for task, values in zip(tasks.values(), done):
        for unit, (value, reason) in zip(task, values):
            result[unit.question]["values"][unit.group].append(value)
            result[unit.question]["missing"][unit.group] = result[unit.question]["missing"][unit.group] or reason
    return result


class _Unit(NamedTuple):
    """What one call of a quantity's function makes."""

    question: int
    group: int
    quantity: str
    of: str
    window: Window
    place: tuple
    groups: tuple


def _units(measures, number, question):
    quantity = measures.quantities[question["quantity"]]
    window = Window(question["window"]["at"], question["window"]["from"], question["window"]["to"])
    groups = [tuple(group) for group in question["groups"]]
    place = tuple(sorted(question["place"].items()))

    def unit(group, of, folders):
        return _Unit(number, group, question["quantity"], of, window, place, folders)

    if question["of"] == "together":
        return [unit(0, "together", tuple(groups))] if groups and all(groups) else []
    if question["of"] == "values":
        return [unit(n, "together", (group,)) for n, group in enumerate(groups) if group]
    if question["of"] == "curves":
        return [unit(n, "together" if quantity.together else "curves", (group,)) for n, group in enumerate(groups) if group]
    return [unit(n, "each", ((folder,),)) for n, group in enumerate(groups) for folder in group]


def _values(measures, units):
    runs = {}

    def run(folder):
        if folder not in runs:
            runs[folder] = Run(folder)
        return runs[folder]

    values = []
    for unit in units:
        quantity, reason, value = measures.quantities[unit.quantity], "", None
        members = [[run(folder) for folder in group] for group in unit.groups]
        try:
            if quantity.together != (unit.of == "together"):
                raise NotEvaluated(f"{unit.quantity} is of {'several runs together' if quantity.together else 'one run'}")
            if unit.of == "together":
                value = float(quantity.of(members, unit.window, **dict(unit.place)))
            else:
                one = measures.mean(members[0]) if unit.of == "curves" else members[0][0]
                value = float(quantity.of(one, unit.window, **dict(unit.place)))
        except (NotEvaluated, RunError) as error:
            reason = str(error)
        values.append((value, reason))
    return values


def _values_in_process(folder, units):
    return _values(measures_of(folder), units)


def faults(measures, questions):
    """What is wrong with the questions themselves: the number, the key and the texts of each fault."""
    found = []
    for number, question in enumerate(questions):
        name, quantity = question["quantity"], measures.quantities.get(question["quantity"])
        if quantity is None:
            found.append({"question": number, "key": "quantity"})
            continue
        if question["unit"] not in (None, quantity.unit):
            found.append({"question": number, "key": "unit", "what": f"is not that of {name}", "allowed": quantity.unit})
        for length in quantity.place:
            if length not in question["place"]:
                found.append({"question": number, "key": "place", "what": f"{name} needs {length}",
                               "allowed": 'lengths, such as "120 mm"'})
        for length in question["place"]:
            if length not in quantity.place:
                found.append({"question": number, "key": "place", "what": f"{name} takes no {length}",
                               "allowed": ", ".join(quantity.place) or "no place"})
    return found


def main():
    parser = argparse.ArgumentParser(prog="python3 -m talus.measures", description="prints the quantities of a study as a table")
    parser.add_argument("--table", metavar="STUDY_FOLDER", required=True, help="folder with measures.py")
    print(table(measures_of(parser.parse_args().table).quantities))
    return 0


if __name__ == "__main__":
    from talus.measures import main as main_of_package  # the module that measures.py of a study imports, not __main__
    sys.exit(main_of_package())
