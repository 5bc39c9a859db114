#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""The hopper of laws that talus calibrate --grains gives in full, beside the beads of ../dem-hopper: its rows in the mean of
three runs.

    validation/bead-shear/calibrated.py run RUNS   calibrations, with LAMMPS (hours on one core), to calibrated-*.toml
    validation/bead-shear/calibrated.py [--out results/calibrated] [--threads N] [--markdown FILE]

Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and python3-h5py."""
import subprocess
import sys
import tomllib
from pathlib import Path

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402
from talus.lab.evaluation import counts_text, evaluate, to_text  # noqa: E402
from talus.lab.reference import Found, read_reference  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))["calibrated"]
BEADS = {"hopper": "beads-round.toml", "rolling": "beads.toml"}  # of cases of ../dem-hopper/reference.toml
HOPPER = read_reference(HERE.parent / "dem-hopper" / "reference.toml")


def material_of(case):
    return HERE / f"calibrated-{case}.toml"


def make(runs):
    runs.mkdir(parents=True, exist_ok=True)
    for case, beads in BEADS.items():
        made = runs.resolve() / material_of(case).name
        subprocess.run([talus.find_program(), "calibrate", "--grains", HERE / beads, "--out", made, "--jobs", "1"], check=True)
        material_of(case).write_text(made.read_text(encoding="utf-8"), encoding="utf-8")


def settings_of(case):
    """Keys of the law and the wall, but for the moduli, which are the case's."""
    material = tomllib.loads(material_of(case.name).read_text(encoding="utf-8"))
    law = {f"law.critical-state.{key}": number["value"] for key, number in material["law"]["critical-state"].items()
           if not key.endswith("modulus") and key != "reference_packing"}
    return law | {"walls.coefficient": material["walls"]["acrylic"]["value"]}


def runs_of(options):
    """Case, variant, and the folders of its runs by seed."""
    for case in HOPPER.cases:
        if case.name in BEADS and material_of(case.name).exists():
            yield case, case.variants[0], {seed: options.out / f"{case.name}-{seed}" for seed in (1, 2, 3)}


def cases(options):
    for case, variant, folders in runs_of(options):
        for seed, folder in folders.items():
            given = {key: value for key, value in variant.settings.items() if not key.startswith(("law.", "walls."))}
            yield HERE.parents[1] / "cases" / case.file, folder, given | settings_of(case) | {"seed": seed}


def measure(options):
    found = [Found(case.name, variant.label, list(folders.values())) for case, variant, folders in runs_of(options)]
    rows = [one for one in evaluate(HOPPER, found) if one.row.case in {f.case for f in found}]
    return {"rows": sum(one.verdict == "met" for one in rows)}, rows


def tell(numbers, rows):
    return f"{to_text(rows)}\n{counts_text(rows)}\n\n" + study.table_of_numbers(REFERENCE["row"], numbers)


if __name__ == "__main__":
    if sys.argv[1:2] == ["run"]:
        make(Path(sys.argv[2]))
        sys.exit(0)
    sys.exit(study.compare(__file__, __doc__, "results/calibrated", REFERENCE["row"], cases, measure, tell, lambda found: None))
