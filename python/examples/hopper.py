# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A hopper (model `continuum`)
# A coarse case in seconds: 8 particles across the outlet, where 12 and more are wanted (`talus check` says so).
# Run the cells in an editor that knows `# %%`, or the whole file: `python3 python/examples/hopper.py FOLDER`.

# %% What is used
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot as plt

import talus
from talus import draw

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/example-hopper")
folder.mkdir(parents=True, exist_ok=True)

# %% A case, and two runs of it: in a vacuum, and with another friction
case = talus.new("hopper", folder / "hopper.toml", overwrite=True, width="60 mm", fill="40 mm", outlet="30 mm", drop="40 mm")
coarse = {"bed.spacing": "3.75 mm", "box.depth": "3.75 mm", "run.end": "0.2 s", "output.report": False}
smooth = talus.simulate(case, folder / "smooth", coarse | {"law.critical-state.static_friction": 0.3}, existing="resume")
rough = talus.simulate(case, folder / "rough", coarse | {"law.critical-state.static_friction": 0.6}, existing="resume")

# %% Numbers with their units
print(rough.case["grains"]["diameter"], rough.status)
print("mass that is left:", rough.summary["residual_fraction"])

# %% What differs, in the cases and in the results
print(talus.changed_keys(smooth, rough))
for row in talus.compare(smooth, rough):
    if abs(row.difference) > 0.05 * abs(row.first):
        print(f"{row.name:32} {row.first:10.4g} {row.second:10.4g} {row.unit}")

# %% Discharge and particles
with draw.style():
    figure, axes = plt.subplots(1, 3, figsize=(9, 3), width_ratios=(2, 1, 1))
    for run, name in ((smooth, "friction 0.3"), (rough, "friction 0.6")):
        draw.curve(axes[0], run.series, "discharge_rate", start=run.gate_time, label=name)
    axes[0].set_xlim(0)
    axes[0].legend()
    for ax, run in zip(axes[1:], (smooth, rough)):
        snapshot = run.snapshots.at(run.gate_time + 0.15)
        draw.particles(ax, snapshot, np.linalg.norm(snapshot["velocity"], axis=1), radius=run.case["bed"]["spacing"] / 2,
                       unit=1e-3, limits=(0, 1))
        draw.walls(ax, run, top=0.09, unit=1e-3)
    draw.save(figure, folder / "hopper.png")

# %% As a table of pandas, where that is installed
try:
    print(rough.series.to_pandas(index="time")["discharge_rate"].describe())
except ImportError:
    print("pandas is not installed")
