# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # A sweep of avalanches (model `cloud`)
# Clouds of 150 grains on slopes of two angles, three seeds each, in seconds.
# Run the cells, or the whole file: `python3 python/examples/avalanche.py FOLDER`.

# %% What is used
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot as plt

import talus
from talus import draw

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/example-avalanche")
folder.mkdir(parents=True, exist_ok=True)

# %% A case, and every combination of two keys
case = talus.new("avalanche", folder / "avalanche.toml", overwrite=True, grains=150)
sweep = talus.sweep(case, folder / "sweep", {"slope.angle": ["30 deg", "50 deg"], "fluid.mobility": ["none", "zuk-2014"]},
                    {"run.end": "1 ms"}, members=3, resume=(folder / "sweep").exists())
print(sweep)

# %% Means and deviations over the members
for group, speed, deviation in zip(sweep.groups, sweep["front_speed_max"], sweep.deviation("front_speed_max")):
    print(f"{group:40} {speed:6.2f} ± {deviation:.2f} {sweep['front_speed_max'].units}")

# %% What the grains drag along makes the front faster: with the fluid's flow, and without
with_flow = np.array(sweep["fluid.mobility"]) == "zuk-2014"
print("faster by", np.mean(sweep["front_speed_max"][with_flow]) / np.mean(sweep["front_speed_max"][~with_flow]))

# %% The members are ordinary runs
run = sweep.runs(sweep.groups[-1])[0]
with draw.style():
    figure, ax = plt.subplots(figsize=(6, 2))
    speed = np.linalg.norm(run.snapshots[-1]["velocity"], axis=1)
    figure.colorbar(draw.particles(ax, run.snapshots[-1], speed, view="xy"), label="speed (m/s)")
    draw.save(figure, folder / "avalanche.png")

# %% As a table of pandas, where that is installed
try:
    print(sweep.to_pandas()[["slope.angle", "fluid.mobility", "front_speed_max"]])
except ImportError:
    print("pandas is not installed")
