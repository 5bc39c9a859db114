# SPDX-License-Identifier: Apache-2.0
"""A reference's rows evaluated and judged, and the table of them. The program's quantities are measured by the program, over
the window of each row; those of a study by validation/STUDY/measures.py."""
import json
import math
import os
from collections import Counter
from dataclasses import dataclass, field
from pathlib import Path

from talus.ask import ask, find_project
from talus.lab.reference import OF_TWO, Row, find_runs, read_reference
from talus.trouble import InputError, RunError, nearest, problem

PAPERS = ("niiya2020", "yuu2011")
VERDICTS = ("met", "not met", "reported", "not evaluated")
STATISTIC_TEXTS = {"standard_deviation": "standard deviation", "ratio": "ratio", "difference": "difference"}


@dataclass
class Evaluated:
    row: Row
    values: list = field(default_factory=list)  #: None: not evaluated
    missing: str = ""                           #: why there is no value
    verdict: str = "reported"


def row_values(row, of_variants, may_be_missing=False):
    """The values of a row from the numbers of the members of each variant, or from one of all its members; None where numbers
    are not there or too few. \\param may_be_missing members whose number is nan are left out while they are the fewer"""
    values = [_value_of_variant(row, members, may_be_missing) for members in of_variants]
    if row.of != "variants":
        return values
    if row.statistic not in OF_TWO:
        return values[:1] or [None]
    if None in values:
        return [None]
    if len(values) != 2:
        raise ValueError("a ratio and a difference are of two variants")
    first, second = values
    if row.statistic == "difference":
        return [first - second]
    return [first / second if second else math.copysign(math.inf, first) if first else math.nan]


def _value_of_variant(row, members, may_be_missing):
    if not members or None in members:
        return None
    if row.of not in ("each", "variants"):
        return members[0]
    if row.statistic == "standard_deviation" and len(members) < 2:
        return None
    if may_be_missing:
        there = [one for one in members if not math.isnan(one)]
        members = there if 2 * len(there) >= len(members) else []
    if not members or any(map(math.isnan, members)):
        return math.nan
    import statistics  # only here: most runs at whose end this module is read are of no paper
    if row.statistic == "standard_deviation":
        return statistics.stdev(members)
    return statistics.median(members) if row.statistic == "median" else statistics.fmean(members)


# ---------------------------------------------------------------------------------------------------- program's numbers

def _asked(row):
    at, begin, end = (str(time) if time is not None and math.isinf(time) else time for time in row.window)
    return {"quantity": None if row.of_study else row.quantity, "at": at, "from": begin, "to": end}


def _answers(reference, found, jobs):
    """What the program says of each row of each run: {folder: {row's id: answer}}."""
    asked = {}
    for ensemble in found:
        rows = [row for row in reference.rows if row.case == ensemble.case and ensemble.variant in row.variants]
        asked |= {folder: rows for folder in ensemble.folders if rows}
    runs = [{"folder": os.fspath(folder), "questions": [_asked(row) for row in rows]} for folder, rows in asked.items()]
    if jobs > 1:
        from concurrent.futures import ThreadPoolExecutor  # only here: most comparisons ask at once
        with ThreadPoolExecutor(jobs) as pool:
            answers = [answer for [answer] in pool.map(lambda run: ask("numbers", runs=[run]), runs)]
    else:
        answers = ask("numbers", runs=runs) if runs else []
    return {folder: {row.id: answer for row, answer in zip(rows, of_run)}
            for (folder, rows), of_run in zip(asked.items(), answers)}


def _folders(row, found, answers):
    """Of each variant the runs, none where they are not there or one ends before the window does."""
    groups = []
    for variant in row.variants:
        folders = next((e.folders for e in found if (e.case, e.variant) == (row.case, variant)), [])
        groups.append(folders if all(answers[folder][row.id]["reaches"] for folder in folders) else [])
    return groups


def _evaluate_own(reference, evaluated, groups, answers, note_faults, may_be_missing):
    row = evaluated.row
    of_runs = [[answers[folder][row.id] for folder in group] for group in groups]
    fault = next((answer["fault"] for group in of_runs for answer in group if "fault" in answer), None)
    try:
        if fault is not None:
            raise ValueError(fault)
        evaluated.values = row_values(row, [[float(one["value"]) for one in group] for group in of_runs], may_be_missing)
    except ValueError as error:
        if not note_faults:
            raise InputError([problem(reference.path, str(error), key=f"row {row.id}")]) from error
        evaluated.missing = str(error)
        evaluated.values = [None] * (1 if row.of == "variants" else len(row.variants))


# ---------------------------------------------------------------------------------------------------- study's numbers

def _question(row, groups):
    """How talus.measures is asked: for "each" member's number, one of the "curves" of the members or of their "values", or one
    of all variants "together"."""
    of = row.of if row.of in ("curves", "values") else "each"
    if row.of == "variants" and row.statistic not in OF_TWO:
        of = "together"
    groups = [[os.fspath(folder) for folder in (group[:1] if row.of == "case" else group)] for group in groups]
    at, begin, end = row.window
    return {"quantity": row.quantity, "unit": None if row.statistic == "ratio" else row.unit, "of": of, "groups": groups,
            "window": {"at": at, "from": begin, "to": end}, "place": row.place}


def _evaluate_by_study(reference, rows, jobs):
    """\\param rows (evaluated, groups of folders)"""
    from talus import measures  # only here: a reference without such rows needs no numpy
    path, questions = reference.measures / "measures.py", [_question(one.row, groups) for one, groups in rows]
    try:
        study = measures.measures_of(reference.measures)
        faults = [_study_fault(reference, study, rows[fault["question"]][0].row, fault)
                  for fault in measures.faults(study, questions)]
        if faults:
            raise InputError(faults)
        answers = measures.answers(study, questions, jobs)
    except RunError:
        raise
    except Exception as error:  # whatever the study's own code raises
        raise RunError(f"{path}: {type(error).__name__}: {error}") from error
    for (one, _), answer in zip(rows, answers):
        one.values = row_values(one.row, answer["values"], study.quantities[one.row.quantity].may_be_missing)
        one.missing = next((reason for reason in answer["missing"] if reason), "")


def _study_fault(reference, study, row, fault):
    if fault["key"] != "quantity":
        return problem(reference.path, fault["what"], line=row.line, key=fault["key"], allowed=fault["allowed"])
    known = [*study.quantities, *(measure["name"] for measure in ask("measures"))]
    return problem(reference.path, f'there is no quantity "{row.quantity}"', line=row.line, key="quantity",
                   allowed=f"a name of docs/quantities.md or {reference.measures / 'measures.py'}",
                   near=nearest(row.quantity, known))


# ---------------------------------------------------------------------------------------------------------- all of them

def evaluate(reference, found, note_faults=False, jobs=1):
    """\\param note_faults a row whose measure fails, one that no such runs have, says so; else it is an InputError
    \\param jobs processes at a time"""
    answers = _answers(reference, found, jobs)
    known = {measure["name"]: measure["may_be_missing"] for measure in ask("measures")}
    rows, of_study = [], []
    for row in reference.rows:
        one = Evaluated(row)
        rows.append(one)
        groups = _folders(row, found, answers)
        if not row.of_study:
            _evaluate_own(reference, one, groups, answers, note_faults, known[row.quantity])
            continue
        one.values = [None] * (1 if row.of == "variants" else len(row.variants))
        if not note_faults or any(groups):
            of_study.append((one, groups))
    if of_study:
        _evaluate_by_study(reference, of_study, jobs)
    for one in rows:
        one.verdict = one.row.criterion.verdict_of_all(one.values)
    return rows


def _number(value):
    if value is None:
        return "-"
    if math.isnan(value):
        return "none"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def to_text(rows):
    """As lines for a terminal; last why rows have no value."""
    lines = [f"{'row':>3}  {'quantity':38} {'printed/met if':14} {'computed':24} {'verdict':14} case"]
    for one in rows:
        row, statistic = one.row, STATISTIC_TEXTS.get(one.row.statistic)
        lines.append(f"{row.number:>3}  {row.quantity + (f', {statistic}' if statistic else ''):38} {str(row.criterion):14} "
                     f"{', '.join(map(_number, one.values)):24} {one.verdict:14} {row.case} ({', '.join(row.variants)})")
    for reason, count in sorted(Counter(one.missing for one in rows if one.missing).items()):
        lines.append(f"{count} row{'s' * (count != 1)} not evaluated: {reason}")
    return "\n".join(lines)


def counts_text(rows):
    """"39 met, 6 not met, 11 reported, 0 not evaluated"."""
    counts = Counter(one.verdict for one in rows)
    return ", ".join(f"{counts[verdict]} {verdict}" for verdict in VERDICTS)


def _missing(one, found):
    """Why a row has no value; empty if it has one, or if the runs that it is about are not there."""
    if one.missing or any(value is not None for value in one.values):
        return one.missing
    there = {(ensemble.case, ensemble.variant) for ensemble in found}
    if all((one.row.case, variant) in there for variant in one.row.variants):
        return "the run ends before its time window does, or there are too few members"
    return ""


def to_json(reference, rows, found, folder):
    """{"study", "title", "source", "rows", "runs"}: values and the verdict on each in the order of the row's variants, the
    folders of members relative to `folder`. A value that was evaluated and has no meaning is null with the verdict "not met"."""
    written = {"study": reference.study, "title": reference.title, "source": reference.source, "rows": [], "runs": []}
    for one in rows:
        row = one.row
        written["rows"].append({
            "id": row.id, "number": row.number, "quantity": row.quantity, "case": row.case, "variants": row.variants,
            "statistic": STATISTIC_TEXTS.get(row.statistic, ""), "printed": row.printed, "source": row.source,
            "criterion": str(row.criterion), "unit": row.unit,
            "values": [value if value is not None and math.isfinite(value) else None for value in one.values],
            "verdicts": ["not evaluated" if value is None else row.criterion.verdict(value) for value in one.values],
            "verdict": one.verdict, "missing": _missing(one, found)})
    for ensemble in found:
        written["runs"].append({"case": ensemble.case, "variant": ensemble.variant,
                                "folders": [os.path.relpath(path, folder) for path in ensemble.folders]})
    return json.dumps(written, indent=2, ensure_ascii=False) + "\n"


def published(folder):
    """The comparisons, as JSON, of the runs below a folder with the papers that they are about. Rows that a run is too short
    for have no value and say so."""
    comparisons = []
    for paper in PAPERS:
        path = find_project(Path("validation") / paper / "reference.toml")
        if path is None:
            continue
        found = find_runs(folder, read_reference(path, with_rows=False))
        if found:
            reference = read_reference(path)
            comparisons.append(to_json(reference, evaluate(reference, found, note_faults=True), found, folder))
    return comparisons
