# SPDX-License-Identifier: Apache-2.0
"""talus reproduce: a paper's runs, all of them, and the paper's numbers beside ours. Every member of every case and variant of
validation/STUDY/reference.toml runs that is not done yet; the rows go into comparison.txt and comparison.json, the page and
its figures are validation/STUDY/figures.py's."""
import json
import subprocess
import sys
from pathlib import Path

from talus.ask import ask, find_project, write
from talus.lab import jobs
from talus.lab.command import (DONE, FILES, INTERRUPTED, NOT_MET, NUMERICAL, Interruption, arguments, can_draw, processors,
                               run_command, say)
from talus.lab.compare import finished_runs
from talus.lab.ensemble import plan
from talus.lab.evaluation import counts_text, evaluate, to_json, to_text
from talus.lab.reference import read_reference, toml_text
from talus.trouble import InputError, RunError, nearest, problem


def _read_study(study):
    """Its reference, and the project's folder with cases/ and validation/."""
    name = Path("validation") / study / "reference.toml"
    path = find_project(name)
    if path is None:
        raise RunError(f"{name}: is neither here, nor where the program was built or installed; run the command in the "
                       "project's folder")
    return read_reference(path), Path(str(path).removesuffix(str(name)) or ".")


def _check_variants(reference, asked):
    known = list(dict.fromkeys(variant.label for case in reference.cases for variant in case.variants))
    faults = [problem("--variant", f'"{label}" is no variant of {reference.study}', allowed=", ".join(known),
                      near=nearest(label, known)) for label in asked if label not in known]
    if faults:
        raise InputError(faults)


def _groups(reference, project, folder, options, members):
    """One of each case and variant."""
    quick = reference.quick if options.quick else {}
    wanted = options.variant or quick.get("variants")
    groups = []
    for case in reference.cases:
        for variant in case.variants:
            if wanted and variant.label not in wanted:
                continue
            settings = [f"{key}={toml_text(value)}" for changed in (variant.settings, quick.get("settings", {}))
                        for key, value in changed.items()]
            [group], _, _ = plan(str(project / "cases" / case.file), folder / f"{case.name}-{variant.label.replace(' ', '')}",
                                 settings=settings, members=members, resume=options.resume)
            group.name = f"{case.name}, {variant.label}"
            groups.append(group)
    return groups


def _draw(project, study, folder):
    """The figures and the page, or a word on what they need. Returns False if the script failed."""
    script = project / "validation" / study / "figures.py"
    if not can_draw():
        say(f"Once it is there: python3 {script} {folder}")
        return True
    # -B: nothing is left beside the script.
    done = subprocess.run([sys.executable, "-B", script, folder], stdin=subprocess.DEVNULL, capture_output=True, text=True,
                          check=False)
    if done.stdout:
        say(done.stdout.rstrip("\n"))
    if done.returncode != 0:
        say(f"talus: {script} failed; it said:\n{done.stderr}", sys.stderr)
    return done.returncode == 0


def main():
    options = arguments("study", texts=("out",), lists=("variant",), numbers=("members", "jobs"), flags=("quick", "resume"))
    interruption = Interruption()
    folder = Path(options.out or f"results/{options.study}{'-quick' if options.quick else ''}")
    reference, project = _read_study(options.study)
    _check_variants(reference, options.variant)
    members = options.members or (reference.quick.get("members", 1) if options.quick else reference.members)
    groups = _groups(reference, project, folder, options, members)
    runs = [member for group in groups for member in group.members]
    ask("begin", folder=folder, resume=options.resume, known=jobs.has_begun(runs))
    at_once = options.jobs or processors()
    say(f"{reference.source}\n{len(runs)} runs ({members} members of each case and radius), {at_once} at a time, in {folder}")
    result = jobs.run(runs, at_once, interruption)
    for failed in result.failed:
        say(f"Failed (exit status {failed.status}): {failed.folder}: {failed.reason}")
    if result.interrupted:
        say(f"Interrupted; --resume goes on: {folder}")
        return INTERRUPTED

    found = finished_runs(folder, reference)
    rows = evaluate(reference, found, jobs=at_once)
    text, in_json = f"{to_text(rows)}\n{counts_text(rows)}\n", to_json(reference, rows, found, folder)
    write({folder / "comparison.txt": text, folder / "comparison.json": in_json})
    say(text.rstrip("\n"))
    entries = [entry for entry in (group.entry() for group in groups) if entry]
    ask("report", path=folder / "report.html", title=reference.title, runs=entries, comparisons=[json.loads(in_json)])
    if not _draw(project, options.study, folder):
        return FILES
    if result.failed:
        return NUMERICAL
    return NOT_MET if any(one.verdict == "not met" for one in rows) else DONE


if __name__ == "__main__":
    run_command(main)
