# SPDX-License-Identifier: Apache-2.0
"""Curves of all variants of a hopper in one figure, for the paper's study and that of the laws."""
import talus.draw
from hopper import Hopper
from matplotlib import pyplot as plt

RATE = 20e-3  # s, of the means of Figure 6


class Hoppers:
    def __init__(self, study, album, case):
        self.album = album
        self.hoppers = [Hopper(ensemble, number) for number, ensemble in enumerate(study.of_case(case))]

    def curves(self, name, title, caption, ylabel, curve):
        figure, ax = plt.subplots(figsize=(5.4, 3.4))
        for hopper in self.hoppers:
            ax.plot(*curve(hopper), hopper.dash, color=hopper.colour, label=hopper.variant)
        ax.set(xlabel="$t$ (s)", ylabel=ylabel, xlim=(0, None))
        ax.legend()
        self.album.add(name, figure, title, caption)

    def discharge(self, name, title):
        self.curves(name, title, "Means over 20 ms.", "discharge $Q$ (kg/s)",
                    lambda hopper: hopper.means("discharge_rate", RATE))

    def surface_angles(self, name, title):
        figure, axes = plt.subplots(1, 2, figsize=(7.2, 3.4), sharex=True, sharey=True)
        for ax, where in zip(axes, ("hopper", "bin")):
            for hopper in self.hoppers:
                table = hopper.run.table("snapshots")
                flowing = table["time"] >= 0
                if f"surface_angle_{where}" in table:  # something lies there already
                    ax.plot(table["time"][flowing], table[f"surface_angle_{where}"][flowing], hopper.dash,
                            color=hopper.colour, label=hopper.variant)
            ax.axhline(30, color=talus.draw.MUTED, linewidth=0.6, linestyle=":", label="printed at rest")
            ax.set(xlabel="$t$ (s)", title=where, xlim=(0, None))
        axes[0].set(ylabel="slope of the free surface (°)")
        axes[1].legend(loc="center left", bbox_to_anchor=(1, 0.5))
        self.album.add(name, figure, title,
                       "Of the whole surface, left and right half averaged. The paper: rest at 30 degrees.")
