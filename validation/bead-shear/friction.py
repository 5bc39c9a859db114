#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Beads of friction 0.1 and 0.3: hoppers of the law that talus calibrate --grains gives, beside their own.

    validation/bead-shear/friction.py run RUNS     hoppers of beads and calibrations, with LAMMPS (an hour on one core), to
                                                   data/friction.csv and friction-*.toml
    validation/bead-shear/friction.py [--out results/friction] [--threads N] [--markdown FILE]

Exit status 1 if a row of reference.toml is not met. Needs python3-numpy and python3-h5py."""
import csv
import subprocess
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402
from talus.measures import Window, measures_of  # noqa: E402

HOPPER = HERE.parent / "dem-hopper"
REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
TABLE = HERE / "data" / "friction.csv"
DEPTH = 2e-3  # m, of hopper.toml
BEADS = """[beads]
diameter = "2 mm"
density = "2500 kg/m3"
stiffness = "1600 N/m"
spread = 0.1
friction = {friction}
rolling_friction = 0.2
restitution = 0.8

[walls.acrylic]
friction = 0.3
"""


def material_of(friction):
    return HERE / f"friction-{friction:g}.toml"


def make(runs):
    """Hoppers of beads, and the laws of the beads."""
    hoppers = [runs / f"beads-{friction:g}" for friction in REFERENCE["frictions"]]
    for friction, hopper in zip(REFERENCE["frictions"], hoppers):
        subprocess.run([HOPPER / "run.py", hopper, "--diameter", "2e-3", "--friction", f"{friction}", "--rolling", "0.2", "--end", "0.4"],
                       check=True)
        beads = runs / f"beads-{friction:g}.toml"
        beads.write_text(BEADS.format(friction=friction), encoding="utf-8")
        made = runs / material_of(friction).name
        subprocess.run([talus.find_program(), "calibrate", "--grains", beads.resolve(), "--quick", "--out", made.resolve()], check=True,
                       cwd=HERE.parents[1])
        material_of(friction).write_text(made.read_text(encoding="utf-8"), encoding="utf-8")
    subprocess.run([HOPPER / "coarse_grain.py", *hoppers, "--out", runs / "tables"], check=True)
    with open(runs / "tables" / "numbers.csv", encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["quantity"].startswith(("discharge_rate", "surface_height"))
                and row["value"] != "nan"]
    with open(TABLE, "w", encoding="utf-8", newline="") as file:
        out = csv.writer(file, lineterminator="\n")
        out.writerow(["friction", "quantity", "place", "time_s", "unit", "value"])
        out.writerows([row["run"].split("-")[1], *(row[name] for name in ("quantity", "place", "time_s", "unit", "value"))] for row in rows)


def beads():
    with open(TABLE, encoding="utf-8", newline="") as file:
        return {(float(row["friction"]), row["quantity"], row["place"], row["time_s"]): float(row["value"]) for row in csv.DictReader(file)}


def folder_of(options, friction):
    return options.out / f"friction-{friction:g}"


def cases(options):
    for friction in REFERENCE["frictions"]:
        yield HERE / "hopper.toml", folder_of(options, friction), {"grains.material": str(material_of(friction))}


def discharge(run):
    """kg/s in 5 mm, as the tables of the beads have it."""
    time, window = np.asarray(run.series["time"]) - run.gate_time, REFERENCE["window"]
    return np.diff(np.interp(window, time, np.asarray(run.series["discharged_mass"])))[0] / np.diff(window)[0] * 5e-3 / DEPTH


def measure(options):
    quantities, of_beads = measures_of(HOPPER).quantities, beads()
    runs = {friction: talus.Run(folder_of(options, friction)) for friction in REFERENCE["frictions"]}
    begin, end = REFERENCE["window"]
    rates = {f: (discharge(run), of_beads[f, "discharge_rate_plateau", "", f"{begin:g}-{end:g}"]) for f, run in runs.items()}
    heights = []
    for vessel, bands in REFERENCE["bands"].items():
        for low, high in bands:
            for time in REFERENCE["times"]:
                name, place = f"surface_height_{vessel}", f"{low}-{high} mm from the middle"
                law = [1e3 * quantities[name].of(run, Window(at=time), **{"from": 1e-3 * low, "to": 1e-3 * high}) for run in runs.values()]
                heights.append((vessel, place, time, law, [of_beads[f, name, place, f"{time:g}"] for f in runs]))
    numbers = {f"discharge-{f:g}".replace(".", "-"): law / dem for f, (law, dem) in rates.items()}
    wrong = [dem[1] - dem[0] for _, _, _, law, dem in heights
             if abs(dem[1] - dem[0]) > REFERENCE["bead"] and (dem[1] - dem[0]) * (law[1] - law[0]) <= 0]
    return numbers | {"order": len(wrong)}, (rates, heights)


def tell(numbers, found):
    rates, heights = found
    lines = [f"friction {f:g}: {law:.4f} kg/s, beads {dem:.4f}\n" for f, (law, dem) in rates.items()]
    lines.append("\n| surface, mm | time, s | law, 0.1 and 0.3 | beads |\n|---|---|---|---|\n")
    lines += [f"| {vessel}, {place} | {time} | {law[0]:.1f}, {law[1]:.1f} | {dem[0]:.1f}, {dem[1]:.1f} |\n"
              for vessel, place, time, law, dem in heights]
    return "".join(lines) + "\n" + study.table_of_numbers(REFERENCE["row"], numbers)


if __name__ == "__main__":
    if sys.argv[1:2] == ["run"]:
        make(Path(sys.argv[2]))
        sys.exit(0)
    sys.exit(study.compare(__file__, __doc__, "results/friction", REFERENCE["row"], cases, measure, tell, lambda found: None))
