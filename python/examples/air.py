# SPDX-License-Identifier: Apache-2.0
# %% [markdown]
# # Vortices that decay (model `air`)
# Taylor and Green's vortices keep their shape, and their velocity decays as exp(-2 nu k^2 t): exact, so that the error
# can be seen. Run the cells, or the whole file: `python3 python/examples/air.py FOLDER`.

# %% What is used
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
import numpy as np
from matplotlib import pyplot as plt

import talus
from talus import draw

folder = Path(sys.argv[1] if len(sys.argv) > 1 else "results/example-air")
folder.mkdir(parents=True, exist_ok=True)

# %% The run
cases = Path(__file__).resolve().parents[2] / "cases"
run = talus.simulate(cases / "taylor-green.toml", folder / "run", {"output.report": False}, existing="resume")

# %% Energy over time, on a logarithmic axis a straight line
energy = np.array([np.mean(np.sum(np.asarray(air["velocity"])**2, axis=-1)) for air in run.air])
rate = -np.polyfit(np.asarray(run.air.times), np.log(energy), 1)[0]
wave_number = 2 * np.pi / run.case["box"]["width"]
exact = 4 * float(run.case["air"]["viscosity"]) / 1.204115 * wave_number**2  # of air at 20 degrees C, 101325 Pa
print(f"the energy decays at {rate:.4f} 1/s, exactly {exact:.4f} 1/s: {100 * (rate / exact - 1):+.2f} %")

# %% The field at the end
with draw.style():
    figure, (left, right) = plt.subplots(1, 2, figsize=(7, 3))
    left.semilogy(run.air.times, energy / energy[0])
    left.set_xlabel("time (s)")
    left.set_ylabel("energy over that at the start")
    mesh = draw.field(right, run.air[-1], "velocity")
    draw.arrows(right, run.air[-1], apart=0.06)
    figure.colorbar(mesh, label="velocity (m/s)")
    draw.save(figure, folder / "air.png")

# %% All frames in one Dataset of xarray, where that is installed
try:
    frames = run.air.to_xarray(["velocity"])
    print(frames["velocity"].sel(axis="x").max(dim=("x", "y", "z")))
except ImportError:
    print("xarray is not installed")
