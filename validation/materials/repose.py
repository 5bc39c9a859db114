#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Asks `talus calibrate --repose` for the law of a heap, and pours a heap of that law with other particles.

    validation/materials/repose.py [--out results/repose] [--threads N] [--markdown FILE] [--angles 24 30 36]

What is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and python3-h5py; an hour of
processor time."""
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402
from talus import heap  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))["repose"]
SPACING = 3.5  # mm; the command's heaps have 3 mm
ROWS = {f"{angle}": {"says": f"heap of the law for {angle} degrees", "value": angle, "tolerance": REFERENCE["tolerance"]}
        for angle in REFERENCE["angles"]}


def material_of(options, angle):
    path = (options.out / f"repose-{angle}.toml").resolve()
    if not path.exists():
        options.out.mkdir(parents=True, exist_ok=True)
        subprocess.run([talus.find_program(options.program), "calibrate", "--repose", f"{angle}deg", "--bulk-density", "900 kg/m3", "--diameter",
                        "0.5 mm", "--out", path], check=True)
    return path


def settings_of(options, angle):
    material = material_of(options, angle)
    friction = tomllib.loads(material.read_text(encoding="utf-8"))["law"]["critical-state"]["static_friction"]["value"]
    return heap.settings_of(material, friction, 900) | {"bed.spacing": f"{SPACING} mm"}


def cases(options):
    for angle in options.angles:
        yield heap.CASE, options.out / f"heap-{angle}", settings_of(options, angle)


def measure(options):
    return {f"{angle}": heap.angle_of(talus.Run(options.out / f"heap-{angle}")) for angle in options.angles}, None


def tell(numbers, _):
    return study.table_of_numbers(ROWS, numbers, 1)


def add_options(parser):
    parser.add_argument("--angles", nargs="+", type=int, choices=REFERENCE["angles"], default=REFERENCE["angles"])


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/repose", ROWS, cases, measure, tell, lambda found: None, add_options=add_options))
