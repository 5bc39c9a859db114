# SPDX-License-Identifier: Apache-2.0
"""talus ensemble: many members of a case, over seeds and varied keys.

Every combination of the varied keys is a group, every seed of a group a member, an ordinary run in FOLDER/GROUP/seed_0001.
Statistics are read from the members' folders in the order of their seeds: they depend neither on the order in which members
ran nor on how many ran at once.
"""
import itertools
import json
from functools import cached_property
from pathlib import Path
from typing import NamedTuple

import numpy as np

from talus import curves
from talus.ask import ask, find_program, write
from talus.lab import jobs, slurm
from talus.lab.command import (DONE, INTERRUPTED, NUMERICAL, Interruption, arguments, can_draw, number, processors,
                               run_command, say)
from talus.run import Run
from talus.table import Table
from talus.trouble import InputError, nearest, problem

OF_THE_MACHINE = {"wall_seconds", "settle_wall_seconds", "cpu_seconds", "peak_memory", "threads"}
LINE_WIDTH = 100


class Spread(NamedTuple):
    """A quantity over the members that have it: finite values in the order of the seeds."""

    unit: str
    values: list

    @property
    def mean(self):
        return curves.mean(self.values)

    @property
    def deviation(self):
        return curves.standard_deviation(self.values)

    def __str__(self):
        return f"{self.mean:.6g} ± {self.deviation:.3g}" if len(self.values) > 1 else f"{self.mean:.6g}"


class Group:
    """Members that differ in the seed. What is done is looked at once.
    \\param settings the varied keys with their texts"""

    def __init__(self, name, folder, settings=None, members=()):
        self.name, self.folder, self.settings, self.members = name, Path(folder), settings or {}, list(members)

    @cached_property
    def done(self):
        """The runs of the members that are done."""
        return [Run(member.folder) for member in self.members if member.is_done()]

    @cached_property
    def spreads(self):
        """By name, in the order in which quantities first occur; those about the machine are left out."""
        spreads = {}
        for run in self.done:
            for name, value in run.summary.items():
                if name not in OF_THE_MACHINE:
                    values = spreads.setdefault(name, Spread(value.units, [])).values
                    values += [float(value)] * bool(np.isfinite(value))
        return spreads

    @cached_property
    def bands(self):
        """Of the tables with time as first column: {name: {heading: (unit, values)}}, means and standard deviations, row by
        row, of every column that any member has."""
        tables = {}
        for run in self.done:
            for path in sorted((run.folder / "analysis").glob("*.csv")):
                table = Table(path)
                if len(table) and next(iter(table)) == "time":
                    tables.setdefault(path.stem, []).append(table)
        return {name: _bands(of_members) for name, of_members in sorted(tables.items())}

    def text_of(self, name):
        """Of a quantity "mean ± deviation", and of how many members where not all that are done have it; else "-"."""
        spread = self.spreads.get(name)
        if not (spread and spread.values):
            return "-"
        count = len(spread.values)
        return str(spread) if count == len(self.done) else f"{spread} ({count} of {len(self.done)})"

    def tables(self):
        """Texts by path: members.csv, quantities.csv and bands_TABLE.csv."""
        done = {run.folder: run.summary for run in self.done}
        lines = [",".join(["seed", "status", *(f"{name} [{spread.unit}]" for name, spread in self.spreads.items())])]
        for member in self.members:
            of_run = done.get(member.folder)
            lines.append(",".join([str(member.seed), "not done" if of_run is None else "done"] + [
                number(of_run.get(name, np.nan)) for name in self.spreads if of_run is not None]))
        tables = {self.folder / "members.csv": lines}

        lines = ["quantity,unit,members,mean,standard_deviation,least,largest"]
        for name, spread in self.spreads.items():
            values = spread.values or [np.nan]
            numbers = [spread.mean, spread.deviation, min(values), max(values)]
            lines.append(",".join([name, spread.unit, str(len(spread.values)), *map(number, numbers)]))
        tables[self.folder / "quantities.csv"] = lines

        for name, columns in self.bands.items():
            lines = [",".join(f"{heading} [{unit}]" for heading, (unit, _) in columns.items())]
            lines += [",".join(map(number, row)) for row in zip(*(values for _, values in columns.values()))]
            tables[self.folder / f"bands_{name}.csv"] = lines
        return {path: "\n".join(lines) + "\n" for path, lines in tables.items()}

    def entry(self):
        """What a report shows of it, None if no member is done."""
        if not self.done:
            return None
        entry = {"folder": str(self.done[0].folder), "name": self.name, "members": len(self.done), "bands": [],
                 "quantities": []}
        if len(self.done) > 1:
            entry["bands"] = [{"name": name, "names": list(columns), "units": [unit for unit, _ in columns.values()],
                               "columns": [[v if np.isfinite(v) else None for v in values]
                                           for _, values in columns.values()]} for name, columns in self.bands.items()]
            entry["quantities"] = [{"name": name, "unit": spread.unit, "values": spread.values}
                                   for name, spread in self.spreads.items()]
        return entry


def _rows_together(tables):
    """Rows of several tables that belong together, [(table, row), ...] each: of the same number where the tables are equally
    long, otherwise of the same time, to within half of the usual distance of two rows."""
    times = [np.asarray(table["time"]) for table in tables]
    if len({len(time) for time in times}) == 1:
        return [[(table, row) for table in tables] for row in range(len(times[0]))]
    distances = np.sort(np.concatenate([np.diff(time) for time in times]))
    near = 0.5 * distances[len(distances) // 2] if len(distances) else 0
    together = []
    for time, n, row in sorted(((time[row], n, row) for n, time in enumerate(times) for row in range(len(time))),
                               key=lambda one: one[0]):
        if not together or not time - together[-1][0][0] <= near or any(n == other for _, other, _ in together[-1]):
            together.append([])
        together[-1].append((time, n, row))
    return [[(tables[n], row) for _, n, row in rows] for rows in together]


def _bands(tables):
    rows, bands = _rows_together(tables), {}
    columns = {name: unit for table in reversed(tables) for name, unit in table.units.items()}
    ordered = dict.fromkeys(name for table in tables for name in table)
    read = {id(table): {name: np.asarray(table[name]) for name in table} for table in tables}
    for name in ordered:
        values = [[v for table, row in together if name in table and np.isfinite(v := read[id(table)][name][row])]
                  for together in rows]
        bands[name if not bands else f"{name}_mean"] = columns[name], [curves.mean(of_row) for of_row in values]
        if len(bands) > 1:
            bands[f"{name}_deviation"] = columns[name], [curves.standard_deviation(of_row) for of_row in values]
    return bands


# ---------------------------------------------------------------------------------------------------------------- plan

def _read_vary(text, problems):
    """The key and its values; commas within brackets belong to an array."""
    key, _, rest = text.partition("=")
    if not key or not rest:
        problems.append(problem(f"--vary {text}", "no values", allowed="table.key=value1,value2,..."))
        return key, []
    if key == "seed":
        problems.append(problem(f"--vary {text}", "each member has a seed of its own", allowed="--members"))
    values, depth = [""], 0
    for c in rest:
        depth += (c == "[") - (c == "]")
        if c == "," and depth == 0:
            values.append("")
        else:
            values[-1] += c
    return key, values


def _folder_name(text):
    return "".join(c for c in text if c.isascii() and (c.isalnum() or c in ".=-_"))


def plan(case, folder, *, settings=(), vary=(), members=20, resume=False):
    """The groups, their members checked, whether the case wants pictures, and the units of the quantities that it can have
    (None: not known). Raises InputError with every problem of the case and of `vary`."""
    problems, groups = [], []
    varied = [(key, values) for key, values in (_read_vary(text, problems) for text in vary) if values]
    for combination in itertools.product(*(values for _, values in varied)):  # the last key fastest
        of_group = dict(zip((key for key, _ in varied), combination))
        name = "_".join(f"{key.rpartition('.')[2]}={_folder_name(value)}" for key, value in of_group.items()) or "all"
        if any(name == group.name for group in groups):
            problems.append(problem("--vary", f"two groups would be {name}", allowed="each value once"))
        groups.append(Group(name, Path(folder) / name, of_group))
    answer = ask("plan", case=case, settings=list(settings), members=members, resume=resume, groups=[
        {"folder": group.folder, "settings": [f"{key}={value}" for key, value in group.settings.items()]}
        for group in groups])
    if problems or answer["problems"]:
        raise InputError(problems + answer["problems"])
    for group, of_group in zip(groups, answer["groups"]):
        group.members = [jobs.Member(case, one["seed"], one["settings"], Path(one["folder"]), one["fingerprint"], one["end"])
                         for one in of_group]
    return groups, answer["pictures"], answer.get("quantities")


def check_quantities(asked, known):
    """Raises InputError with the nearest name for each quantity that is not known."""
    faults = [problem(f"--plot {name}", "no member has such a quantity", allowed=", ".join(known), near=nearest(name, known))
              for name in asked if name not in known]
    if faults:
        raise InputError(faults)


# --------------------------------------------------------------------------------------------------------------- sweep

def _with_unit(name, unit):
    return f"{name} [{unit or '1'}]"


def _quoted(text):
    return '"' + text.replace('"', '""') + '"' if set(text) & set(',"\n') else text


def all_quantities(groups):
    """Names and units of the quantities that any group has a value of."""
    return {name: spread.unit for group in groups for name, spread in group.spreads.items() if spread.values}


def sweep_text(groups):
    """A line per quantity, a column per group, in blocks that a terminal holds."""
    units = all_quantities(groups)
    names = ["", *(name if unit == "1" else _with_unit(name, unit) for name, unit in units.items())]
    first = max(map(len, names))
    columns = [[group.name, *(group.text_of(name) for name in units)] for group in groups]
    widths = [max(map(len, column)) for column in columns]
    blocks, begin = [], 0
    while begin < len(columns):
        end, used = begin, first
        while end < len(columns) and (end == begin or used + 2 + widths[end] <= LINE_WIDTH):
            used += 2 + widths[end]
            end += 1
        blocks.append("\n".join(name.ljust(first) + "".join(f"  {columns[c][row]:>{widths[c]}}" for c in range(begin, end))
                                for row, name in enumerate(names)))
        begin = end
    return "\n\n".join(blocks)


def write_sweep(groups, folder):
    """sweep.csv (a row per group: the varied keys in SI and degrees, number of members, mean of each quantity and, where
    groups have two members and more, its standard deviation) and sweep.json (the same, the values also as given)."""
    texts = list(dict.fromkeys(text for group in groups for text in group.settings.values()))
    parsed = dict(zip(texts, ask("quantities", texts=texts)))
    units, several = all_quantities(groups), any(len(s.values) > 1 for group in groups for s in group.spreads.values())
    heading = [_quoted(_with_unit(key, parsed[text]["unit"]) if "unit" in parsed[text] else key)
               for key, text in groups[0].settings.items()] + ["members"]
    for name, unit in units.items():
        heading += [_with_unit(name, unit)] + [_with_unit(f"{name}_deviation", unit)] * several
    lines, entries = [",".join(heading)], []
    for group in groups:
        cells = [number(parsed[text]["value"]) if "unit" in parsed[text] else _quoted(text)
                 for text in group.settings.values()]
        cells.append(str(max((len(spread.values) for spread in group.spreads.values()), default=0)))
        for name in units:
            spread = group.spreads.get(name, Spread("", []))
            cells += [number(spread.mean)] + [number(spread.deviation)] * several
        lines.append(",".join(cells))
        quantities = {}
        for name, spread in group.spreads.items():
            if spread.values:
                deviation = {"standard_deviation": spread.deviation} if len(spread.values) > 1 else {}
                quantities[name] = {"mean": spread.mean, **deviation, "members": len(spread.values), "unit": spread.unit}
        settings = {key: {"text": text, **{k: parsed[text][k] for k in ("value", "unit") if "unit" in parsed[text]}}
                    for key, text in group.settings.items()}
        entries.append({"group": group.name, "settings": settings, "quantities": quantities})
    write({folder / "sweep.csv": "\n".join(lines) + "\n",
           folder / "sweep.json": json.dumps(entries, indent=2, ensure_ascii=False) + "\n"})


# ------------------------------------------------------------------------------------------------------------- command

def write_results(groups, folder, plot, vary, pictures):
    """Tables, report and pictures of what is done; returns the pictures, the one to look at first before the others."""
    write({path: text for group in groups for path, text in group.tables().items()})
    check_quantities(plot, list(all_quantities(groups)))
    entries = [entry for entry in (group.entry() for group in groups) if entry]
    if entries:
        ask("report", path=folder / "report.html", title=folder.stem, runs=entries, comparisons=[])
    say(sweep_text(groups))
    if vary:
        write_sweep(groups, folder)
    if not pictures or not can_draw():
        return []
    ask("claim", folders=[group.folder / "pictures" for group in groups], files=[
        folder / "sweep.png",
        *(group.folder / "pictures" / name for group in groups
          for name in ("histograms.png", *(f"bands_{table}.png" for table in group.bands)))])
    from talus import charts  # only here: the rest does without matplotlib
    return charts.draw_charts("ensemble", str(folder), ",".join(group.name for group in groups), ",".join(plot))


def main():
    options = arguments("case", texts=("out", "launch"), lists=("set", "vary", "plot", "slurm"), numbers=("members", "jobs"),
                        flags=("resume", "gather"))
    interruption = Interruption()
    folder = Path(options.out or f"results/{Path(options.case).stem}-ensemble")
    members = options.members or 20
    resume = options.resume or options.gather
    if options.launch == "slurm":
        slurm.check(options.slurm, folder)
    if options.gather and not (folder.is_dir() and any(folder.iterdir())):
        raise InputError([problem(folder, "holds no ensemble: there is nothing to gather", allowed="--gather with the --out "
                                  "of the ensemble that ran, or without --gather to run it")])
    groups, pictures, quantities = plan(options.case, folder, settings=options.set, vary=options.vary, members=members,
                                        resume=resume)
    if options.plot and quantities is not None:
        check_quantities(options.plot, sorted({"steps", *quantities, *all_quantities(groups)}))
    runs = [member for group in groups for member in group.members]
    ask("begin", folder=folder, resume=resume, known=jobs.has_begun(runs))
    if options.launch == "slurm":
        gathering = [str(find_program()), "ensemble", options.case, "--out", str(folder), "--gather", "--members",
                     str(members)]
        for option, values in (("--set", options.set), ("--vary", options.vary), ("--plot", options.plot)):
            gathering += [word for value in values for word in (option, value)]
        return slurm.launch(folder, runs, gathering, options.jobs, options.slurm)

    result = jobs.gather(runs) if options.gather else jobs.run(runs, options.jobs or processors(), interruption)
    groups = [Group(group.name, group.folder, group.settings, group.members) for group in groups]  # what is done now
    drawn = write_results(groups, folder, options.plot, options.vary, pictures)
    for failed in result.failed:
        how = "Not done" if failed.status is None else f"Failed (exit status {failed.status})"
        say(f"{how}: {failed.folder}: {failed.reason}")
    say(f"{len(result.done)} of {len(runs)} runs done. Results: {folder}")
    if drawn:
        say(f"Picture: {drawn[0]}")
    if result.interrupted:
        return INTERRUPTED
    return NUMERICAL if result.failed else DONE


if __name__ == "__main__":
    run_command(main)
