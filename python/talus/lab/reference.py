# SPDX-License-Identifier: Apache-2.0
"""The reference of a study: what a paper prints, written down in validation/*/reference.toml with estimator, window and
criterion before anything is compared with it. And the finished runs below a folder, whoever made them, sorted to its cases."""
import json
import math
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

from talus.ask import ask, find_project
from talus.lab.toml_reader import TomlReader
from talus.trouble import InputError, RunError, nearest, problem

KEYS = {"id", "number", "quantity", "case", "radius", "variant", "needs_air", "estimator", "from", "statistic", "window",
        "place", "printed", "unit", "criterion", "source"}
#: From what a number is made: of each member, of the members' series together, of the values of all members in one sample, of
#: several variants of the case together, of the case alone.
FROM = {"each": "each", "curves": "curves", "values": "values", "radii": "variants", "variants": "variants", "case": "case"}
STATISTICS = ("mean", "median", "standard_deviation", "ratio", "difference")
OF_TWO = ("ratio", "difference")
CRITERIA = "between, value and within, above, below, sign or reported"
ROUNDING = 1e-6  # between a value as it is written in a reference and in a resolved case: that prints 8 digits or more


def number(value):
    return value if isinstance(value, (int, float)) and not isinstance(value, bool) else None


@dataclass(frozen=True)
class Criterion:
    """`kind` between (first <= value <= second), within (|value - first| <= second), above, below, positive, negative or
    reported, which counts neither way."""

    kind: str = "reported"
    first: float = 0
    second: float = 0

    def verdict(self, value):
        """\\param value None: not evaluated; nan: it has no value, and is not met"""
        if self.kind == "reported":
            return "reported"
        if value is None:
            return "not evaluated"
        met = {"between": self.first <= value <= self.second, "within": abs(value - self.first) <= self.second,
               "above": value > self.first, "below": value < self.first, "positive": value > 0, "negative": value < 0}
        return "met" if met[self.kind] else "not met"

    def verdict_of_all(self, values):
        """Not met if it is not met in one, met if it is met in all that are there."""
        verdicts = {self.verdict(value) for value in values}
        return "reported" if self.kind == "reported" else next(
            (verdict for verdict in ("not met", "met") if verdict in verdicts), "not evaluated")

    def __str__(self):
        if self.kind == "between":
            return f"{self.first:g}" + (f" to {self.second:g}" if self.second != self.first else "")
        return {"within": f"{self.first:g} ± {self.second:g}", "above": f"> {self.first:g}",
                "below": f"< {self.first:g}"}.get(self.kind, self.kind)


@dataclass
class Variant:
    """What a variant of a case changes in it, and by which of these keys a run is known to be of it."""

    label: str
    settings: dict
    told_by: dict


@dataclass
class Case:
    name: str
    file: str = ""                             #: in cases/
    where: dict = field(default_factory=dict)  #: what a run of this case has
    variants: list = field(default_factory=list)


@dataclass
class Row:
    """A quantity, where and when, and the criterion that its value meets or not; a value a variant, one alone of "variants"."""

    line: int
    id: str = ""
    number: int = 0            #: of the group of rows it belongs to
    quantity: str = ""
    case: str = ""
    variants: tuple = ()
    of: str = "each"           #: a value of FROM
    statistic: str = "mean"
    window: tuple = (None, 0.0, math.inf)  #: at, from, to, in the time unit of the study
    place: dict = field(default_factory=dict)
    printed: str = ""
    unit: str = ""
    criterion: Criterion = Criterion()
    source: str = ""
    of_study: bool = False     #: the quantity is one of the study's measures.py, not of the program's list


@dataclass
class Reference:
    path: Path
    study: str = ""
    title: str = ""
    source: str = ""
    members: int = 1
    quick: dict = field(default_factory=dict)  #: members, variants, settings: what reproduce --quick runs
    cases: list = field(default_factory=list)
    rows: list = field(default_factory=list)
    measures: Path | None = None               #: folder of the study's measures.py


def toml_text(value):
    """A value as --set takes it."""
    return json.dumps(value, ensure_ascii=False)


class _Reader(TomlReader):
    def __init__(self, path, with_rows):
        super().__init__(path, None if with_rows else "\n[[row]]")
        self.lengths = {}

    def name(self, table, line, key, names):
        text = self.get(table, line, key)
        if text in names:
            return text
        self.fault(line, key, f'"{text}" is not known', allowed=", ".join(names))
        return next(iter(names))


def _labels(table):
    return table.get("variant", table.get("radius", {}))


def _read_case(reader, name, table):
    case = Case(name, reader.get(table, reader.line_of(f"[case.{name}]"), "file"), table.get("where", {}))
    told_by = table.get("told_by")
    for label, settings in _labels(table).items():
        told = {key: value for key, value in settings.items() if told_by is None or key in told_by}
        case.variants.append(Variant(label, settings, told))
    return case


def _read_criterion(reader, table, line):
    criterion = table.get("criterion")
    if not isinstance(criterion, dict):
        reader.fault(line, "criterion", "missing", allowed=CRITERIA)
        return Criterion()

    def value(key):
        return float(reader.get(criterion, line, key, (int, float), "a number", "criterion"))

    between = criterion.get("between")
    if isinstance(between, list) and len(between) == 2 and None not in map(number, between):
        return Criterion("between", *map(float, between))
    if "value" in criterion:
        return Criterion("within", value("value"), value("within"))
    for kind in ("above", "below"):
        if kind in criterion:
            return Criterion(kind, value(kind))
    if criterion.get("sign") in ("+", "-"):
        return Criterion("positive" if criterion["sign"] == "+" else "negative")
    if criterion.get("reported") is not True:
        reader.fault(line, "criterion", "is none that can be evaluated", allowed=CRITERIA)
    return Criterion()


def _read_window(reader, table, line):
    window = table.get("window", {})
    times = {"at": None, "from": 0.0, "to": math.inf}
    for key in times.keys() & window.keys():
        if window[key] == "end":
            times[key] = math.inf
        elif number(window[key]) is None:
            reader.fault(line, "window", "is not a time", allowed='a number of a/v_s, or "end"')
        else:
            times[key] = float(window[key])
    return tuple(times.values())


def _read_place(reader, table, line):
    place = {}
    for key, text in table.get("place", {}).items():
        length = reader.lengths.get(text, {})
        if length.get("unit") == "m":
            place[key] = length["si"]
        else:
            reader.fault(line, "place", f"{key} is not a length (unit missing?)", allowed='lengths, such as "120 mm"')
    return place


def _read_row(reader, table, line):
    for key in table.keys() - KEYS:
        reader.fault(line, key, "unknown key", near=nearest(key, sorted(KEYS)))
    printed = table.get("printed", 0.0)
    row = Row(line, id=reader.get(table, line, "id"), number=reader.get(table, line, "number", int, "a whole number"),
              quantity=reader.get(table, line, "quantity"), case=reader.get(table, line, "case"),
              variants=tuple(_labels(table) or ()), unit=reader.get(table, line, "unit"),
              printed=printed if isinstance(printed, str) else f"{printed}".removesuffix(".0"),
              source=reader.get(table, line, "source"))
    reader.get(table, line, "estimator")
    row.of = FROM[reader.name(table, line, "from", FROM)] if "from" in table else "each"
    row.statistic = reader.name(table, line, "statistic", STATISTICS) if "statistic" in table else "mean"
    row.criterion = _read_criterion(reader, table, line)
    row.window, row.place = _read_window(reader, table, line), _read_place(reader, table, line)
    return row


def _check_measure(reader, row, known, has_study):
    """The measure of a row and its unit; those of a study are checked by it."""
    together = row.of in ("curves", "values") or (row.of == "variants" and row.statistic not in OF_TWO)
    if together and not has_study:
        reader.fault(row.line, "from", "takes several runs together, which only a study measures",
                     allowed="a measures.py beside the file")
    row.of_study = has_study and (row.quantity not in known or together)
    if row.of_study:
        return
    if row.quantity not in known:
        reader.fault(row.line, "quantity", f'there is no quantity "{row.quantity}"', allowed="a name of docs/quantities.md",
                     near=nearest(row.quantity, known))
        return
    unit = "1" if row.statistic == "ratio" else known[row.quantity]["unit"]
    if row.unit != unit:
        reader.fault(row.line, "unit", f"is not that of {row.quantity}", allowed=unit)
    for length in row.place:
        reader.fault(row.line, "place", f"{row.quantity} takes no {length}", allowed="no place")


def _measures_of(path, study):
    """The folder of the study's measures.py: the reference's, or that of the study in validation/."""
    if (Path(path).parent / "measures.py").is_file():
        return Path(path).parent
    found = find_project(Path("validation") / Path(study).name / "measures.py")
    return found.parent if found else None


def read_reference(path, with_rows=True):
    """Raises RunError if it cannot be read, InputError with every problem. \\param with_rows false: its cases alone, to see
    whether runs are of them"""
    reader = _Reader(path, with_rows)
    file = reader.file
    reference = Reference(Path(path), *(reader.get(file, 0, key) for key in ("study", "title", "source")),
                          members=file.get("members", 1), quick=file.get("quick", {}))
    if reference.quick and not reference.quick.get("variants"):
        reader.fault(reader.line_of("[quick]"), "quick", "has no variants", allowed="labels of variants")
    reference.cases = [_read_case(reader, name, table) for name, table in file.get("case", {}).items()]
    if not with_rows:
        return reference
    reference.measures = _measures_of(path, reference.study)
    texts = sorted({str(text) for row in file.get("row", []) for text in row.get("place", {}).values()})
    reader.lengths = dict(zip(texts, ask("quantities", texts=texts) if texts else []))
    known = {measure["name"]: measure for measure in ask("measures")}
    ids = set()
    for count, table in enumerate(file.get("row", [])):
        row = _read_row(reader, table, reader.line_of("[[row]]", count))
        reference.rows.append(row)
        if row.id in ids:
            reader.fault(row.line, "id", f'"{row.id}" stands twice')
        ids.add(row.id)
        _check_measure(reader, row, known, reference.measures is not None)
        case = next((case for case in reference.cases if case.name == row.case), None)
        if case is None:
            reader.fault(row.line, "case", f"there is no [case.{row.case}]")
        for label in row.variants if case else ():
            if label not in (variant.label for variant in case.variants):
                reader.fault(row.line, "variant", f'[case.{row.case}] has no variant "{label}"')
        if not row.variants:
            reader.fault(row.line, "variant", "missing", allowed="labels of the case's variants")
    if not reference.rows:
        reader.fault(0, "row", "there are no rows", allowed="[[row]] tables")
    if reader.problems:
        raise InputError(reader.problems)
    return reference


# ----------------------------------------------------------------------------------------------------------- found runs

@dataclass
class Found:
    """The runs of one variant of one case, in the order of their seeds."""

    case: str
    variant: str
    folders: list


def _flat(table, before=""):
    for key, value in table.items():
        yield from _flat(value, f"{before}{key}.") if isinstance(value, dict) else [(before + key, value)]


def _finished_runs(folder):
    """(seed, folder, case) of each, by key."""
    runs = []
    for path in Path(folder).rglob("manifest.json"):
        summary = path.with_name("summary.json")
        if summary.is_file():
            try:
                done = json.loads(summary.read_text(encoding="utf-8"))["status"] == "done"
                manifest = json.loads(path.read_text(encoding="utf-8"))
                if done:
                    runs.append((manifest["seed"], path.parent, dict(_flat(tomllib.loads(manifest["case"])))))
            except (OSError, ValueError, KeyError) as error:
                raise RunError(f"{path.parent}: is not a run's folder that can be read: {error}") from error
    return sorted(runs, key=lambda run: run[:2])


class _Same:
    """Whether values are the same, quantities in any unit."""

    def __init__(self, pairs):
        """\\param pairs of values that are to be compared"""
        texts = sorted({value for a, b in pairs if a != b for value in (a, b)
                        if isinstance(value, str) and re.match(r"\s*[-+.]?\d", value)})
        self.si = {text: found["si"] for text, found in zip(texts, ask("quantities", texts=texts) if texts else [])
                   if "si" in found}

    def __call__(self, a, b):
        if a == b and isinstance(a, bool) == isinstance(b, bool):
            return True
        x, y = (self.si.get(value) if isinstance(value, str) else number(value) for value in (a, b))
        return x is not None and y is not None and isinstance(a, str) == isinstance(b, str) and \
            abs(x - y) <= ROUNDING * max(abs(x), abs(y))


def find_runs(folder, reference):
    """Sorts every finished run to the case whose `where` it satisfies, and there to the variant whose settings it has; of
    several, to the one with the most entries. Runs of no case are passed over."""
    if not Path(folder).is_dir():
        raise RunError(f"{folder}: no such folder")
    runs = _finished_runs(folder)
    wanted = [settings for case in reference.cases for settings in [case.where, *(v.told_by for v in case.variants)]]
    same = _Same([(case[key], value) for settings in wanted for key, value in settings.items() for _, _, case in runs
                  if key in case])

    def best(candidates, settings_of, case):
        fitting = [one for one in candidates if all(key in case and same(case[key], value)
                                                    for key, value in settings_of(one).items())]
        return max(fitting, key=lambda one: len(settings_of(one)), default=None)  # of equals the first

    found = {}
    for _, path, keys_of_run in runs:
        case = best(reference.cases, lambda c: c.where, keys_of_run)
        variant = best(case.variants, lambda v: v.told_by, keys_of_run) if case else None
        if variant:
            found.setdefault((case.name, variant.label), Found(case.name, variant.label, [])).folders.append(path)
    return list(found.values())
