#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Talus without resolution: each row of reference.toml from sections of several spacings, prolonged to a spacing of none.

usage: resolution.py RUNS [--talus build/talus]        a folder of runs, one a spacing

A particle of Talus is as wide as a bead: near the edges of the slit and at surfaces both act by their size. So the beads'
trend in their diameter, prolonged to 0.2 mm, is set beside the particles' trend in their spacing, prolonged to 0.
"""
import argparse
import json
import subprocess
import sys
import tempfile
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "python"))

import talus  # noqa: E402
from trend import line_at  # noqa: E402


def rows_of(program, run):
    """The evaluated rows of one run, and its spacing in mm."""
    with tempfile.TemporaryDirectory() as folder:
        result = Path(folder) / "comparison.json"
        (Path(folder) / "run").symlink_to(run.folder.resolve())
        subprocess.run([program, "compare", folder, str(HERE / "reference.toml"), "--json", str(result)],
                       stdout=subprocess.DEVNULL, check=False)
        rows = json.loads(result.read_text(encoding="utf-8"))["rows"]
    there = {(row["number"], row["quantity"], row["printed"], row["criterion"]): row["values"][0] for row in rows
             if row["case"].endswith("section") and row["verdicts"][0] != "not evaluated" and row["values"][0] is not None}
    return float(run.case["bed"]["spacing"]) * 1e3, there


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("runs", type=Path)
    parser.add_argument("--talus", default=str(HERE.parents[1] / "build/talus"))
    given = parser.parse_args()
    runs = sorted((rows_of(given.talus, run) for run in talus.find_runs(given.runs)), key=lambda found: -found[0])
    if len(runs) < 2:
        sys.exit(f"{given.runs}: holds fewer than two runs of sections of the hopper")
    spacings = np.array([spacing for spacing, _ in runs])
    print("| row | quantity | beads | met if | " + " | ".join(f"{s:.4g} mm" for s in spacings) + " | at 0 | off the line |")
    print("|" + "---|" * (6 + len(runs)))
    for key in runs[0][1]:
        if any(key not in rows for _, rows in runs):
            continue
        values = [rows[key] for _, rows in runs]
        prolonged, off = line_at(spacings, values, at=0)
        print("| " + " | ".join([str(key[0]), f"`{key[1]}`", key[2], key[3], *(f"{v:.4g}" for v in values),
                                 f"**{prolonged:.4g}**", "" if np.isnan(off) else f"{off:.2g}"]) + " |")


if __name__ == "__main__":
    main()
