# SPDX-License-Identifier: Apache-2.0
"""What a report shows of a folder: python3 -m talus.lab.gathered FOLDER prints {"runs": [...], "comparisons": [...]}, the
members of ensembles together, and the comparisons with papers of validation/. Started by `talus report` and at the end of
runs."""
import json
import sys
from pathlib import Path

from talus.lab.command import run_command, say
from talus.lab.evaluation import published


def _is_run(folder):
    return (folder / "manifest.json").is_file() and (folder / "summary.json").is_file()


def entries(folder):
    """Of a run, or of the ensembles below the folder, one for each folder that holds members."""
    folder = Path(folder)
    if _is_run(folder):
        return [{"folder": str(folder), "name": folder.name or folder.resolve().name, "members": 1, "bands": [],
                 "quantities": []}]
    from talus.lab.ensemble import Group  # only here: a run needs no numpy
    from talus.run import Run
    groups = {}
    for path in sorted(path.parent for path in folder.rglob("manifest.json") if _is_run(path.parent)):
        # A run of which nothing is random is a group of its own, FOLDER/GROUP; members are FOLDER/GROUP/seed_0001.
        name = (path.parent if path.name.startswith("seed_") else path).relative_to(folder)
        groups.setdefault(str(name), []).append(Run(path))
    of_groups = []
    for name, runs in groups.items():
        group = Group(name, folder / name)
        group.done = sorted((run for run in runs if run.status == "done"), key=lambda run: run.manifest["seed"])
        of_groups.append(group.entry())
    return [entry for entry in of_groups if entry]


def main():
    folder = sys.argv[1]
    say(json.dumps({"runs": entries(folder), "comparisons": [json.loads(text) for text in published(folder)]}))
    return 0


if __name__ == "__main__":
    run_command(main)
