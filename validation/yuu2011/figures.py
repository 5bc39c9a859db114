#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures 4 to 12 of Yuu & Umekage 2011 from a reproduction's runs, and its page. The paper's Figure 3 is the grid of its
air, and Figures 1 and 2 are the law's own (`talus law`).

    python3 validation/yuu2011/figures.py results/yuu2011
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from study import main  # noqa: E402  (it also finds the package talus)

import dots  # noqa: E402
from figures_of_hopper import Hoppers  # noqa: E402
import numpy as np  # noqa: E402
import talus.draw  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402
from talus.continuum import continuum  # noqa: E402

MM = 1e-3
SNAPSHOTS = (0, 0.17, 0.2, 0.3, 0.4, 0.5, 1.0)  # s, Figure 4
FLOWING = 0.2                # s, Figures 8, 9, 11 and 12
VECTORS = (0.17, 1.0)        # s, Figure 10
PERIOD = 6e-3                # s, of the means of Figure 7: one printed period
EDGE_OF_SLIT, BELOW_SLIT = 31e-3, 50e-3  # m, Figures 11a and 11b
ABOVE_SLIT = 20e-3           # m, Figure 12


def grid_of(count, across):
    """Axes in rows of `across`, those left over off."""
    rows = -(-count // across)
    figure, axes = plt.subplots(rows, across, figsize=(7.2, 7.2 / across * 1.75 * rows), squeeze=False)
    for ax in axes.flat[count:]:
        ax.set_axis_off()
    return figure, axes.flat[:count]


def vessel(ax, hopper, top):
    talus.draw.walls(ax, hopper.run, top=top, unit=MM)
    ax.set(xlim=(-1, hopper.width / MM + 1), ylim=(-1, top / MM), xlabel="$x$ (mm)", ylabel="$z$ (mm)")


class Figures(Hoppers):
    def draw(self):
        for hopper in self.hoppers:
            self.grains(hopper)
        self.surface_angles("figure_05.png", "Figure 5: slope of the free surface")
        self.discharge("figure_06.png", "Figure 6: discharge through the slit")
        self.curves("figure_07.png", "Figure 7: velocity of the grains in the middle of the slit", "Means over 6 ms.",
                    "$-u_{pz}$ (m/s)", lambda hopper: (lambda t, v: (t, -v))(*hopper.means("slit_velocity", PERIOD)))
        self.fields("figure_08.png", "Figure 8: packing", "packing", 1, "packing", (0.3, 0.65),
                    "At the start, at 0.2 s and at the end; the packing that the kernel deposits at each particle.",
                    (0, FLOWING, np.inf))
        self.fields("figure_09.png", "Figure 9: vertical normal stress", "stress_zz", 1e3, r"stress $\tau_{zz}$ (kPa)",
                    (0, 1.2), "At 0.2 s and at the end; the part that does not depend on the rate of strain.",
                    (FLOWING, np.inf))
        with_air = [hopper for hopper in self.hoppers if len(hopper.run.air)]
        if with_air:
            self.air_vectors(with_air)
            self.pressures(with_air)
        self.profiles()
        self.curves("discharged.png", "Share of the grains below the plate", "The paper: more than half at 0.4 s.",
                    "share below the plate", self.discharged_share)

    def grains(self, hopper):
        times = [time for time in SNAPSHOTS if hopper.reaches(time)]
        figure, axes = grid_of(len(times), 4)
        shown = [hopper.at(time) for time in times]
        top = max(float(s.positions[:, 2].max()) for s in shown) + 4 * hopper.spacing
        for ax, snapshot in zip(axes, shown):
            dots.draw(ax, hopper.run, snapshot, opened=snapshot.time >= hopper.gate, unit=MM)
            vessel(ax, hopper, top)
            ax.set_title(f"$t$ = {hopper.time_of(snapshot):.2f} s")
        self.album.add(f"figure_04_{hopper.variant}.png", figure, f"Figure 4: grains, {hopper.variant}",
                       "At the paper's times, 50 dots a particle, spread by the kernel as in the paper.")

    @staticmethod
    def discharged_share(hopper):
        series = hopper.run.series
        mass = series["discharged_mass"]
        flowing = series["time"] >= hopper.gate
        return series["time"][flowing] - hopper.gate, mass[flowing] / continuum(hopper.run).mass

    def fields(self, name, title, column, unit, text, limits, caption, times):
        shown = [(hopper, hopper.at(min(time, hopper.end))) for hopper in self.hoppers for time in times
                 if hopper.reaches(min(time, hopper.end))]
        figure, axes = grid_of(len(shown), 2 * len(times) if len(self.hoppers) > 1 else len(times))
        for ax, (hopper, snapshot) in zip(axes, shown):
            discs = talus.draw.particles(ax, snapshot, snapshot[column] / unit, radius=hopper.spacing / 2, unit=MM,
                                         limits=limits)
            vessel(ax, hopper, float(snapshot.positions[:, 2].max()) + 4 * hopper.spacing)
            ax.set_title(f"{hopper.variant}, {hopper.time_of(snapshot):.2f} s")
        figure.colorbar(discs, ax=list(axes), label=text, extend="both", aspect=40, location="bottom", shrink=0.6)
        self.album.add(name, figure, title, caption)

    def air_vectors(self, hoppers):
        shown = [(h, h.at(time, h.run.air)) for h in hoppers for time in VECTORS if h.reaches(time)]
        if not shown:
            return
        figure, axes = grid_of(len(shown), max(2, min(4, len(shown))))
        for ax, (hopper, air) in zip(axes, shown):
            talus.draw.field(ax, air, "solid_fraction", unit=MM, limits=(0.05, 0.051), cmap=GRAINS)
            arrows = talus.draw.arrows(ax, air, apart=5e-3, unit=MM, length=10e-3)
            ax.quiverkey(arrows, 0.85, 1.03, 1, "1 m/s", labelpos="W", fontproperties={"size": 7})
            vessel(ax, hopper, float(air.z[-1] + air.spacing[2] / 2))
            ax.set_title(f"{hopper.variant}\n{hopper.time_of(air):.2f} s")  # the key of the arrows beside it
        self.album.add("figure_10.png", figure, "Figure 10: velocity of the air",
                       "In the middle of the depth, 0.17 s and 1.0 s after the opening of the gate; shaded: grains.")

    def pressures(self, hoppers):
        figure, (up, across) = plt.subplots(1, 2, figsize=(7.2, 3.2))
        for hopper in hoppers:
            air = hopper.at(FLOWING, hopper.run.air)
            if air is None:
                continue
            pressure = air.layer("pressure")
            i, k = np.abs(air.x - EDGE_OF_SLIT).argmin(), np.abs(air.z - BELOW_SLIT).argmin()
            options = {"color": hopper.colour, "linestyle": hopper.dash, "label": hopper.variant}
            up.plot(pressure[i], air.z / MM, **options)
            across.plot(air.x / MM, pressure[:, k], **options)
        if not up.lines:
            plt.close(figure)
            return
        up.set(title="(a) at $x$ = 31 mm", xlabel="$P$ (Pa)", ylabel="$z$ (mm)", ylim=(0, None))
        across.set(title="(b) at $z$ = 50 mm", xlabel="$x$ (mm)", ylabel="$P$ (Pa)")
        up.legend()
        self.album.add("figure_11.png", figure, "Figure 11: pressure of the air",
                       "At 0.2 s in the middle of the depth, relative to the surroundings.")

    def profiles(self):
        """Figure 12: means over a spacing in x of the particles within a spacing of the height, and the air there."""
        figure, ax = plt.subplots(figsize=(5.4, 3.4))
        for hopper in self.hoppers:
            snapshot = hopper.at(FLOWING)
            if snapshot is None:
                continue
            height = hopper.plate + ABOVE_SLIT
            x, _, z = np.asarray(snapshot.positions).T
            near = np.abs(z - height) <= hopper.spacing
            cells = round(hopper.width / hopper.spacing)
            cell = np.clip((x[near] / hopper.spacing).astype(int), 0, cells - 1)
            count = np.bincount(cell, minlength=cells)
            total = np.bincount(cell, weights=snapshot["velocity"][near, 2], minlength=cells)
            there = count > 0
            ax.plot((np.flatnonzero(there) + 0.5) * hopper.spacing / MM, total[there] / count[there], hopper.dash,
                    color=hopper.colour, label=f"{hopper.variant}, grains")
            air = hopper.at(FLOWING, hopper.run.air)
            if air is not None:
                k = np.abs(air.z - height).argmin()
                ax.plot(air.x / MM, air.layer("velocity")[:, k, 2], "--", color=hopper.colour,
                        label=f"{hopper.variant}, air")
        if not ax.lines:
            plt.close(figure)
            return
        ax.set(xlabel="$x$ (mm)", ylabel="$u_{pz}$, $u_z$ (m/s)")
        ax.legend()
        self.album.add("figure_12.png", figure, "Figure 12: vertical velocity 20 mm above the slit",
                       "At 0.2 s; particles within a spacing of the height, means over a spacing in *x*; the air in the "
                       "middle of the depth.")


#: White where there are hardly any grains, and the colour of sand where there are.
GRAINS = plt.matplotlib.colors.ListedColormap(["#ffffff", "#e8dcc4"])

if __name__ == "__main__":
    main(lambda study, album: Figures(study, album, "hopper").draw(), __file__)
