# SPDX-License-Identifier: Apache-2.0
"""talus compare: runs against a reference, or against each other."""
from pathlib import Path

from talus.ask import find_project, write
from talus.lab.command import DONE, NOT_MET, arguments, can_draw, run_command, say
from talus.lab.evaluation import counts_text, evaluate, to_json, to_text
from talus.lab.reference import find_runs, read_reference
from talus.run import Run
from talus.trouble import InputError, problem


def finished_runs(folder, reference):
    """As find_runs. Raises InputError if there is none."""
    found = find_runs(folder, reference)
    if not found:
        raise InputError([problem(folder, f"holds no finished run of a case of {reference.path}",
                                  allowed="the folder of a run, of an ensemble, or of reproduce")])
    return found


def with_reference(folder, path, json_path):
    reference = read_reference(path if Path(path).exists() else find_project(path) or path)
    found = finished_runs(folder, reference)
    rows = evaluate(reference, found)
    say(f"{reference.source}\n{to_text(rows)}\n{counts_text(rows)}")
    if json_path:
        write({json_path: to_json(reference, rows, found, folder)})
    return NOT_MET if any(one.verdict == "not met" for one in rows) else DONE


def _keys(case):
    """A resolved case's values as they are written, by key."""
    values, table = {}, ""
    for line in case.split("\n"):
        key, equals, value = line.partition(" = ")
        if line.startswith("["):
            table = line[1:-1] + "."
        elif equals and not line.startswith("#"):
            values[table + key] = value
    return values


def two_runs(folders, picture):
    """Which keys of the cases differ, and the quantities of both summaries."""
    runs = [Run(folder) for folder in folders]
    keys = [_keys(run.manifest["case"]) for run in runs]
    say("Keys that differ:")
    for key in sorted(keys[0].keys() | keys[1].keys()):
        first, second = (of_run.get(key, "") for of_run in keys)
        if first != second:
            say(f"  {key}: {first or '-'}   |   {second or '-'}")
    first, second = (run.summary for run in runs)
    say(f"{'quantity':32} {Path(folders[0]).name:>14} {Path(folders[1]).name:>14} {'difference':>12}")
    for name in dict.fromkeys([*first, *second]):
        a, b = first.get(name), second.get(name)
        texts = ["-" if value is None else f"{float(value):.6g}" for value in (a, b)]
        difference = "-" if a is None or b is None else f"{float(b) - float(a):.3g}"
        unit = (b if a is None else a).units
        say(f"{name:32} {texts[0]:>14} {texts[1]:>14} {difference:>12} {'' if unit == '1' else unit}")
    if picture and can_draw():
        from talus import charts  # only here: the rest does without matplotlib
        for path in charts.draw_charts("runs", *folders, picture):
            say(f"Picture: {path}")
    return DONE


def main():
    options = arguments("dir", "other", texts=("json", "picture"))
    if Path(options.other).is_dir():
        return two_runs([options.dir, options.other], options.picture)
    return with_reference(options.dir, options.other, options.json)


if __name__ == "__main__":
    run_command(main)
