#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Figures 3 to 11 of Niiya, Awazu & Nishimori 2020 from a reproduction's runs, and its page.

    python3 validation/niiya2020/figures.py results/niiya2020
"""
import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

from study import main  # noqa: E402  (it also finds the package talus)

import curves  # noqa: E402
import numpy as np  # noqa: E402
import pictures  # noqa: E402
from matplotlib import pyplot as plt  # noqa: E402

END = np.inf  # of the run: its last snapshot
WIDTH = 7.2   # of the page, inches


def radius_of(ensemble):
    return float(ensemble.runs[0].case["particles"]["radius"])


def members_of(radii):
    counts = [len(ensemble.runs) for ensemble in radii]
    if max(counts) == 1:
        return "one member"
    return f"{max(counts)} members" if min(counts) == max(counts) else f"{min(counts)} to {max(counts)} members"


def spread_of(radii):
    return f"Mean and standard deviation of {members_of(radii)} of each radius."


def one_run(radii):
    return f"Particles: one run with *a*<sub>p</sub> = {radii[-1].variant}."


class Figures:
    def __init__(self, study, album):
        self.album = album
        self.circles, self.rectangles, self.triangles = (
            sorted(study.of_case(name), key=radius_of) for name in ("circle", "rectangle", "triangle"))

    def draw(self):
        self.shapes()
        if self.circles:
            self.disc_to_head()
            self.front_of_the_circle()
        if self.rectangles:
            self.band_to_heads()
        if self.triangles:
            self.head_and_tail()
        if self.circles:
            self.heads_by_n()
            self.head_in_time()
        if self.circles or self.rectangles:
            self.sizes_of_heads()
        if self.triangles:
            self.frontal_angle()
        if self.circles or self.triangles:
            self.motions()

    def panels(self, layout, height, **options):
        """Axes by letter, each with its letter as the title."""
        figure, axes = plt.subplot_mosaic(layout, figsize=(WIDTH, height), **options)
        for letter, ax in axes.items():
            ax.set_title(f"({letter})")
        return figure, axes

    def shapes(self):
        shown = [(name, radii) for name, radii in
                 (("circle", self.circles), ("triangle", self.triangles), ("rectangle", self.rectangles)) if radii]
        figure, axes = plt.subplots(len(shown), 1, figsize=(0.82 * WIDTH, 2.6 * len(shown)), squeeze=False)
        for ax, (name, radii) in zip(axes[:, 0], shown):
            pictures.shape(ax, radii[-1].runs[0], name)
        missing = [text for text, radii in (("Figures 4, 5, 8 and 9 (circle)", self.circles),
                                            ("Figure 6 (rectangle)", self.rectangles),
                                            ("Figures 7 and 11 (triangle)", self.triangles)) if not radii]
        self.album.add("figure_03.png", figure, "As Figure 3: the shapes at the start",
                       "The circle and the rectangle are seen from above, the triangle (a heap behind a gate) from the "
                       "side. Lengths in particle radii; the slope falls along *x*; the printed *W* is half of the "
                       "rectangle's width." +
                       (f" Left out for want of finished runs: {', '.join(missing)}." if missing else ""))

    def disc_to_head(self):
        run = self.circles[-1].runs[0]
        figure, axes = self.panels([["a", "b"], ["c", "d"], ["e", "e"]], 6.6, gridspec_kw={"height_ratios": [1, 1, 1.2]})
        for letter, time in zip("abcde", (0, 7.96, 19.9, END, END)):
            pictures.from_above(axes[letter], run, time, window=None if letter == "e" else (370, 20, 75))
        self.album.add("figure_04.png", figure, "As Figure 4: a disc gathers into one head",
                       "(a) The start; (b) the front overtakes; (c) a crescent; (d) the end of the run; (e) the same with "
                       "all that is left behind. Blue: the head by *n'* (Eq. 11b), which at the start is nearly all. " +
                       one_run(self.circles))

    def front_of_the_circle(self):
        figure, axes = self.panels([["a", "b"]], 3.0)
        curves.front_speed(axes["a"], self.circles, printed=(30, 70))
        pictures.motion_in_head(axes["b"], self.circles[-1].runs[0], 19.9)
        self.album.add("figure_05.png", figure,
                       "As Figure 5: the circle's front speed, and velocities relative to the front",
                       "(a) Front speed over the Stokes speed *v*<sub>s</sub>; (b) velocities less the front's, in the "
                       f"head and behind it. {spread_of(self.circles)} {one_run(self.circles)}")

    def band_to_heads(self):
        run = self.rectangles[-1].runs[0]
        figure, axes = self.panels([["a", "a"], ["b", "b"], ["c", "c"], ["d", "d"]], 7.6,
                                   gridspec_kw={"height_ratios": [0.5, 0.7, 1.6, 1.6]})
        for letter, time in zip("abc", (0, 7.96, END)):
            pictures.from_above(axes[letter], run, time, view="y-x", mark=letter != "a")
        curves.front_speed(axes["d"], self.rectangles, printed=(20, 28))
        self.album.add("figure_06.png", figure, "As Figure 6: a straight front breaks into heads",
                       "(a) The start; (b) the front gathers and becomes wavy; (c) heads (blue) at the end of the run, all "
                       "seen from above with the slope falling down the page; (d) front speed over *v*<sub>s</sub>. "
                       f"{one_run(self.rectangles)} {spread_of(self.rectangles)}")

    def head_and_tail(self):
        run = self.triangles[-1].runs[0]
        figure, axes = self.panels([["a", "a"], ["b", "b"], ["c", "d"]], 6.0,
                                   gridspec_kw={"height_ratios": [1, 1, 1.5]})
        for letter, time in zip("ab", (15.9, END)):
            pictures.relative_speed(axes[letter], run, time)
        curves.front_speed(axes["c"], self.triangles)
        curves.over_time(axes["d"], self.triangles, "front_rear_thickness_ratio", printed=2)
        axes["d"].set(ylabel="thickness, head over rear", ylim=(0, None))
        self.album.add("figure_07.png", figure, "As Figure 7: head and tail",
                       "(a) The front, coloured by the velocity along the slope less the front's; (b) the same at the end "
                       "of the run; (c) front speed over *v*<sub>s</sub>; (d) thickness of the head over the median of "
                       f"the rear half, printed: more than 2. {one_run(self.triangles)} {spread_of(self.triangles)}")

    def heads_by_n(self):
        figure, axes = self.panels([["a", "b"]], 2.8)
        for letter, by in (("a", "n"), ("b", "n'")):
            pictures.head_by(axes[letter], self.circles[-1].runs[0], by, 19.9)
        self.album.add("figure_08.png", figure, "As Figure 8: the head by *n* and by *n'*",
                       "(a) The grains that Eq. 11a takes for heads; (b) those of Eq. 11b, with width and layer thickness "
                       "of the head and the four grains (green) that they are measured between. " + one_run(self.circles))

    def head_in_time(self):
        radii = self.circles
        figure, axes = self.panels([["a", "b"], ["c", "d"]], 5.2)
        curves.over_time(axes["a"], radii, "head_particles")
        curves.over_time(axes["b"], radii, "head_thickness", in_radii=True, legend=False)
        curves.over_time(axes["b"], radii, "head_width", in_radii=True, hollow=True, legend=False)
        curves.name_symbols(axes["b"], r"thickness $\tilde{l}_h$", r"width $\tilde{w}_h$")
        curves.over_time(axes["c"], radii, curves.aspect_ratio, printed=4)
        curves.against(axes["d"], radii, "head_particles", "front_speed")
        axes["a"].set(ylabel="grains in the head", ylim=(0, None))
        axes["b"].set(ylabel="size of the head ($a_p$)", ylim=(0, None))
        axes["c"].set(ylabel=r"$\tilde{w}_h / \tilde{l}_h$", ylim=(0, 6.5))
        axes["d"].set(xlabel="grains in the head", ylabel=r"front speed $\tilde{v}_f$", xlim=(0, None), ylim=(0, None))
        self.album.add("figure_09.png", figure, "As Figure 9: the circle's head in time",
                       "(a) Number of its grains; (b) its width and layer thickness; (c) width over thickness, mean of the "
                       f"members' ratios; (d) front speed against the number of grains. {spread_of(radii)}")

    def sizes_of_heads(self):
        drawn = []
        if self.circles:
            drawn.append((lambda ax: curves.width_against_thickness(ax, self.circles),
                          "width against thickness, circle"))
        if self.rectangles:
            drawn.append((lambda ax: curves.width_distribution(ax, self.rectangles),
                          "widths of the rectangle's heads at the end, and the Gaussian nearest to those of " +
                          self.rectangles[-1].variant))
            if len(self.rectangles) > 1:
                drawn.append((lambda ax: curves.width_against_radius(ax, self.rectangles),
                              "their mean and standard deviation against the radius"))
            drawn.append((lambda ax: curves.head_counts(ax, self.rectangles), "their number, beside the printed one"))
        letters = "abcd"[:len(drawn)]
        layout = [list(letters[:2]), list((letters[2:] * 2)[:2])] if len(drawn) > 2 else [list(letters)]
        figure, axes = self.panels(layout, 2.6 * len(layout))
        for letter, (draw, _) in zip(letters, drawn):
            draw(axes[letter])
        left_out = "" if len(self.rectangles) > 1 else " Left out: width against radius, which takes two radii."
        self.album.add("figure_10.png", figure, "As Figure 10: how the sizes of heads vary",
                       "; ".join(f"({letter}) {text}" for letter, (_, text) in zip(letters, drawn)) + "." + left_out +
                       " " + spread_of(self.circles or self.rectangles))

    def frontal_angle(self):
        figure, axes = self.panels([["a", "b"], ["c", "c"]], 4.6)
        for letter, time in zip("ab", (15.9, END)):
            pictures.frontal_surface(axes[letter], self.triangles[-1].runs[0], time)
        curves.over_time(axes["c"], self.triangles, "frontal_angle", first=0, printed=60)
        axes["c"].set(ylabel=r"frontal angle $\phi_f$ (°)", ylim=(30, 120))
        self.album.add("figure_11.png", figure, "As Figure 11: the frontal angle",
                       "(a) The grains of the front's surface and the line through them; (b) the same at the end of the "
                       f"run; (c) angle between the slope and the line. {one_run(self.triangles)} "
                       f"{spread_of(self.triangles)}")

    def motions(self):
        drawn = []
        if self.circles:
            drawn += [(self.circles, ("head_curl_left", "head_curl_right"), ("left half of the head", "right half"),
                       "mean curl ($v_s/a_p$)", "curl of the velocity in the halves of the circle's head"),
                      (self.circles, ("head_rear_relative_velocity", "head_front_outward_velocity"),
                       ("rear, forwards", "front, outwards"), "relative velocity ($v_s$)",
                       "its rear and its front, relative to the front")]
        if self.triangles:
            drawn += [(self.triangles, ("head_upper_relative_velocity", "head_lower_relative_velocity"),
                       ("upper head", "lower head"), r"$\tilde{v}_x - \tilde{v}_f$",
                       "upper third and lower part of the triangle's head"),
                      (self.triangles, ("tail_relative_velocity",), (), r"$\tilde{v}_x - \tilde{v}_f$ of the tail",
                       "the triangle's tail")]
        letters = "abcd"[:len(drawn)]
        figure, axes = self.panels([list(letters[i:i + 2]) for i in range(0, len(drawn), 2)], 1.3 * len(drawn))
        for letter, (radii, names, symbols, text, _) in zip(letters, drawn):
            for name in names:
                curves.over_time(axes[letter], radii, name, hollow=name != names[0], legend=len(names) == 1)
            if symbols:
                curves.name_symbols(axes[letter], *symbols)
            axes[letter].axhline(0, color="#6b7280", linewidth=0.6)
            axes[letter].set_ylabel(text)
        self.album.add("figure_motions.png", figure, "Beside Figures 5b and 7a: motion relative to the front in time",
                       "; ".join(f"({letter}) {d[-1]}" for letter, d in zip(letters, drawn)) + ". " +
                       spread_of(self.circles or self.triangles))


if __name__ == "__main__":
    main(lambda study, album: Figures(study, album).draw(), __file__)
