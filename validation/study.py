# SPDX-License-Identifier: Apache-2.0
"""What the scripts of the studies share.

Figures of a reproduction (validation/STUDY/figures.py): the runs and rows that `talus compare --json` has put in order, the
page that shows them, and the command line, `main`. Studies by one script that runs its cases itself (validation/orifice,
janssen-cylinder, drum): the table of numbers beside their reference, and the command line, `compare`."""
import argparse
import json
import os
import re
import sys
import textwrap
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "python"))

import matplotlib  # noqa: E402
import numpy as np  # noqa: E402
matplotlib.use("Agg")

import talus  # noqa: E402
import talus.draw  # noqa: E402

PROJECT = Path(__file__).resolve().parents[1]


def mass_ratios(snapshot):
    """The mass of each particle over that of one of bed.spacing."""
    return snapshot["mass_ratio"] if "mass_ratio" in snapshot else np.ones(len(snapshot.positions))


@dataclass
class Ensemble:
    """The runs of one variant of one case, in the order of their seeds."""

    case: str
    variant: str
    runs: list


@dataclass
class Study:
    """A reproduction's folder, read from its comparison.json."""

    folder: Path
    name: str
    title: str
    source: str
    rows: list
    ensembles: list

    @classmethod
    def read(cls, folder):
        folder = Path(folder)
        try:
            text = json.loads((folder / "comparison.json").read_text(encoding="utf-8"))
        except OSError as error:
            raise talus.RunError(f"{folder}/comparison.json: {error.strerror}; it is written by `talus reproduce`, or for "
                                 f"any runs by `talus compare DIR REFERENCE.toml --json DIR/comparison.json`") from error
        ensembles = [Ensemble(e["case"], e["variant"], [talus.Run(folder / run) for run in e["folders"]])
                     for e in text.get("runs", [])]
        return cls(folder, text["study"], text["title"], text["source"], text["rows"], ensembles)

    def of_case(self, name):
        return [ensemble for ensemble in self.ensembles if ensemble.case == name]


@dataclass
class Album:
    """The figures in the order of the page; each is written as soon as it is added."""

    folder: Path
    pages: list = field(default_factory=list)

    def add(self, name, figure, title, caption):
        self.folder.mkdir(parents=True, exist_ok=True)
        talus.draw.save(figure, self.folder / name)
        self.pages.append((self.folder / name, title, caption))


def number(value):
    if value is None:
        return "none"
    return f"{value:.0f}" if abs(value) >= 1000 else f"{value:.4g}"


def numbers(row):
    return ["-" if verdict == "not evaluated" else number(value) for value, verdict in zip(row["values"], row["verdicts"])]


def table_of_rows(rows):
    """A line a row; if all rows are of the same variants, more than a line holds, a line a variant and a column a row."""
    variants = rows[0]["variants"]
    if len(variants) > 4 and all(r["variants"] == variants and len(r["values"]) == len(variants) for r in rows):
        head = [["", *(f"{r['number']}: `{r['quantity']}`, {r['unit']}" for r in rows)], ["---"] * (len(rows) + 1),
                ["the paper", *(r["printed"] for r in rows)], ["met if", *(r["criterion"] for r in rows)]]
        body = [[variant, *(f"**{numbers(r)[k]}**" if r["verdicts"][k] == "not met" else numbers(r)[k] for r in rows)]
                for k, variant in enumerate(variants)]
        return _lines(head + body) + "\nIn bold: not met. -: the run did not get there.\n"
    head = [["row", "case", "quantity", "the paper", "met if", "computed", ""], ["---"] * 7]
    return _lines(head + [
        [str(r["number"]), f"{r['case']} ({', '.join(r['variants'])})",
         f"`{r['quantity']}`" + (f" ({r['statistic']})" if r["statistic"] else ""), f"{r['printed']} ({r['source']})",
         r["criterion"], ", ".join(numbers(r)), "**met**" if r["verdict"] == "met" else r["verdict"]] for r in rows])


def table_of_runs(study):
    """What each variant took: means over its members."""
    lines = [["case", "variant", "runs", "particles", "cells of the air", "until, s", "steps", "processor time, s",
              "wall time, s"], ["---"] * 9]
    for e in study.ensembles:
        first = e.runs[0]
        mean = {name: sum(run.summary[name] for run in e.runs) / len(e.runs)
                for name in ("steps", "cpu_seconds", "wall_seconds")}
        air = " x ".join(map(str, first.air[0].shape)) if len(first.air) else ""
        lines.append([e.case, e.variant, str(len(e.runs)), str(len(first.snapshots[-1].positions)), air,
                      f"{first.series['time'][-1]:.4g}", f"{mean['steps']:.0f}", f"{mean['cpu_seconds']:.4g}",
                      f"{mean['wall_seconds']:.4g}"])
    return _lines(lines)


def failed_runs(study):
    """A line a run that did not get through, with what its log says."""
    lines = []
    for run in talus.find_runs(study.folder):
        if run.status in ("done", "running"):
            continue
        log = run.folder / "log.txt"
        said = log.read_text(encoding="utf-8").splitlines()[-1:] if log.is_file() else []
        lines.append(f"- {run.folder.relative_to(study.folder)}: {run.status}; {' '.join(said)[21:]}")
    return lines


def write_page(study, album, path, script, gaps=None, notes=None):
    """The page of a study: what was run, the rows, what is not met and why (`gaps`, written by hand), the figures.
    \\param script that draws the figures \\param notes text by the caller, shown after the table"""
    path = Path(path)
    manifest = study.ensembles[0].runs[0].manifest
    rows = [r for r in study.rows if study.of_case(r["case"])]
    others = ", ".join(dict.fromkeys(f"`{r['case']}`" for r in study.rows if not study.of_case(r["case"])))
    left_out = _wrapped(f"Left out: rows of {others}, of which this folder has no run.") if others else ""
    counts = [f"{sum(r['verdict'] == v for r in study.rows)} {v}" for v in ("met", "not met", "reported", "not evaluated")]
    paragraphs = [f"# {study.title}", study.source, _wrapped(
        f"Computed with Talus {manifest['version']} ({manifest['revision']}) on {manifest['machine']['processor']}; "
        f"figures and page by `{Path(script).resolve().relative_to(PROJECT).as_posix()}`. Rows, estimators and criteria "
        "were written down before the first comparison; values stand in the order of the variants."),
        table_of_runs(study), f"**{', '.join(counts)}**", table_of_rows(rows) if rows else "", left_out]
    if notes:
        paragraphs.append(notes)
    if failed := failed_runs(study):
        paragraphs += ["## Runs that did not get through", "\n".join(failed)]
    if gaps and gaps.is_file():
        paragraphs.append(_moved_links(gaps.read_text(encoding="utf-8"), gaps.parent, path.parent))
    for picture, title, caption in album.pages:
        link = os.path.relpath(picture, path.parent)
        paragraphs += [f"## {title}", f"![{title}]({link})", _wrapped(caption)]
    path.write_text("\n\n".join(text.strip() for text in paragraphs if text.strip()) + "\n", encoding="utf-8")


def main(draw, script):
    """The command line of a study's script. \\param draw function of (study, album) \\param script its path"""
    parser = argparse.ArgumentParser(description="Draws the figures of a reproduction and writes its page.")
    parser.add_argument("folder", type=Path, help="folder of `talus reproduce`, or of any runs with a comparison.json")
    parser.add_argument("--figures", type=Path, help="folder of the pictures; left out: FOLDER/figures")
    parser.add_argument("--page", type=Path, help="left out: FOLDER/STUDY.md")
    options = parser.parse_args()
    try:
        study = Study.read(options.folder)
        album = Album(options.figures or options.folder / "figures")
        page = options.page or options.folder / f"{study.name}.md"
        with talus.draw.style():
            draw(study, album)
        write_page(study, album, page, script, gaps=Path(script).resolve().parent / "gaps.md")
    except talus.RunError as error:
        sys.exit(f"figures: {error}")
    print(f"Page: {page}\nFigures: {len(album.pages)} in {album.folder}")


def is_met(row, value):
    return abs(value - row["value"]) <= row["tolerance"]


def table_of_numbers(reference, numbers, digits=3):
    """A line for each number beside its row of the reference: `says`, `value`, `tolerance`."""
    lines = [["what", "computed", "value, tolerance", ""], ["---"] * 4]
    for name, value in numbers.items():
        row = reference[name]
        lines.append([row["says"], f"{value:.{digits}f}", f"{row['value']:g} ± {row['tolerance']:g}",
                      "met" if is_met(row, value) else "**not met**"])
    return _lines(lines)


def rows_of(folder, *beginnings):
    """The rows of a folder's reference.toml whose names begin so."""
    rows = tomllib.loads((Path(folder) / "reference.toml").read_text(encoding="utf-8"))
    return {name: row for name, row in rows.items() if name.startswith(beginnings)}


def compare(script, text, out, reference, cases, measure, tell, draw, spacing=None, add_options=None):
    """The command line of a study that runs its cases itself; returns the exit status, 1 if a row is not met.
    \\param script its path \\param text its help \\param out folder of its runs if no other is named
    \\param cases function of (options), returns the case, the folder and the settings of each run; those that are done are
           not made again
    \\param measure function of (options), returns the numbers by row of the reference, and all that was found
    \\param tell function of (numbers, found), returns Markdown \\param draw function of (found), returns a figure
    \\param spacing of the
           particles if --spacing names no other, mm; left out: there is no such option \\param add_options function of (parser),
           which gives it options of the study's own"""
    parser = argparse.ArgumentParser(prog=Path(script).name, description=text,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--program", help="left out: as talus.find_program says")
    parser.add_argument("--threads", type=int)
    parser.add_argument("--out", type=Path, default=Path(out))
    parser.add_argument("--markdown", type=Path, help="file of the tables")
    parser.add_argument("--picture", type=Path)
    if spacing:
        parser.add_argument("--spacing", type=float, default=spacing, help="of the particles, mm")
    if add_options:
        add_options(parser)
    options = parser.parse_args()
    try:
        for case, folder, settings in cases(options):
            talus.simulate(case, folder, settings, threads=options.threads, existing="resume", program=options.program)
        numbers, found = measure(options)
    except talus.RunError as error:
        sys.exit(f"{parser.prog}: {error}")
    told = tell(numbers, found)
    print(told, end="")
    if options.markdown:
        options.markdown.write_text(told, encoding="utf-8")
    if options.picture:
        draw(found).savefig(options.picture, dpi=150)
    return 0 if all(is_met(reference[name], value) for name, value in numbers.items()) else 1


def _lines(cells):
    return "\n".join("| " + " | ".join(line) + " |" for line in cells) + "\n"


def _wrapped(text):
    return textwrap.fill(text, 100, break_long_words=False, break_on_hyphens=False)


def _moved_links(text, old, new):
    """Relative links of a Markdown text as they are from another folder."""
    def moved(match):
        target = match[2]
        return match[0] if re.match(r"[a-z]+:|#", target) else f"{match[1]}({os.path.relpath(old / target, new)})"
    return re.sub(r"(\[[^\]]*\])\(([^)\s]+)\)", moved, text)
