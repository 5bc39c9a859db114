# SPDX-License-Identifier: Apache-2.0
"""The curves of the figures: means and standard deviations over the members of an ensemble, from the tables that the
program leaves in analysis/ and the numbers of measures.py. Lengths in radii a, speeds in v_s, times in a/v_s. `radii`: the ensembles of one case, in
the order of the radius."""
import numpy as np
from measures import avalanche
from talus.draw import INK, MUTED, PALETTE

TIME = r"time $\tilde{t} = t\,v_s/a_p$"
SYMBOLS = "os^"
PRINTED_COUNTS = {1.0: (17.20, 1.69), 2.5: (13.95, 1.94), 5.0: (14.85, 1.35)}  # section 4.2; mm
BIN = 2  # radii, Figure 10b


def of_members(ensemble, number, first=1):
    """Times, mean and standard deviation (n - 1) of a number of the snapshots from the `first` on; of those members that
    have it. \\param number its name, or a function of an avalanche"""
    members = [avalanche(run) for run in ensemble.runs]
    rows = min(len(member.time) for member in members)
    values = np.array([(number(member) if callable(number) else member.column(number))[first:rows] for member in members])
    times = np.mean([member.time[first:rows] for member in members], axis=0)
    return times, *mean_and_deviation(values)


def mean_and_deviation(values):
    there = np.isfinite(values)
    count = there.sum(axis=0)
    with np.errstate(invalid="ignore", divide="ignore"):
        mean = np.where(there, values, 0).sum(axis=0) / count
        squares = np.where(there, (values - mean) ** 2, 0).sum(axis=0)
        return mean, np.where(count > 1, np.sqrt(squares / (count - 1)), 0)


def aspect_ratio(member):
    return member.column("head_width") / member.column("head_thickness")


def radius_of(ensemble):
    return float(ensemble.runs[0].case["particles"]["radius"])


def label_of(ensemble):
    return f"$a_p$ = {ensemble.variant}"


def points(ax, x, y, k, *, xerr=None, yerr=None, hollow=False, label=None):
    colour = PALETTE[k % len(PALETTE)]
    ax.errorbar(x, y, xerr=xerr, yerr=yerr, fmt=SYMBOLS[k % 3], markersize=3.5, color=colour, label=label,
                markerfacecolor="white" if hollow else colour, elinewidth=0.7, markeredgewidth=0.8)


def time_axis(ax):
    """From the start to a round time at or after the last one."""
    ax.set_xlabel(TIME)
    if np.isfinite(ax.dataLim.x1):  # else there is nothing to see
        ax.set_xlim(min(0, ax.dataLim.x0) - 0.5, 5 * np.ceil((1 - 1e-3) * ax.dataLim.x1 / 5))


def front_speed(ax, radii, printed=None):
    if printed:
        ax.axhspan(*printed, color=MUTED, alpha=0.15, linewidth=0, label="printed range")
    for k, ensemble in enumerate(radii):
        tables = [run.table("front_speed") for run in ensemble.runs]
        rows = min(len(table) for table in tables)
        time = tables[0]["time"][:rows]
        mean, deviation = mean_and_deviation(np.array([table["front_speed"][:rows] for table in tables]))
        # The third is dashed, so that one below it is seen.
        line, = ax.plot(time, mean, "--" if k == 2 else "-", label=label_of(ensemble), color=PALETTE[k])
        ax.fill_between(time, mean - deviation, mean + deviation, color=line.get_color(), alpha=0.25, linewidth=0)
    ax.set_ylabel(r"front speed $\tilde{v}_f$")
    time_axis(ax)
    ax.legend()


def over_time(ax, radii, number, *, first=1, in_radii=False, hollow=False, legend=True, printed=None):
    for k, ensemble in enumerate(radii):
        scale = radius_of(ensemble) if in_radii else 1
        time, mean, deviation = of_members(ensemble, number, first)
        points(ax, time, mean / scale, k, yerr=deviation / scale, hollow=hollow,
               label=None if hollow else label_of(ensemble))
    if printed is not None:
        ax.axhline(printed, color=MUTED, linewidth=0.8, linestyle="--", label="printed")
    time_axis(ax)
    if legend:
        ax.legend()


def name_symbols(ax, filled, hollow):
    """A legend of the radii, and of what filled and hollow symbols mean."""
    ax.plot([], [], "o", color=INK, markersize=3.5, label=filled)
    ax.plot([], [], "o", color=INK, markersize=3.5, markerfacecolor="white", label=hollow)
    ax.legend()


def against(ax, radii, x, y):
    for k, ensemble in enumerate(radii):
        _, x_mean, x_deviation = of_members(ensemble, x)
        _, y_mean, y_deviation = of_members(ensemble, y)
        points(ax, x_mean, y_mean, k, xerr=x_deviation, yerr=y_deviation, label=label_of(ensemble))
    ax.legend()


def width_against_thickness(ax, radii):
    most = 0
    for k, ensemble in enumerate(radii):
        a = radius_of(ensemble)
        _, thickness, thickness_deviation = of_members(ensemble, "head_thickness")
        _, width, width_deviation = of_members(ensemble, "head_width")
        points(ax, thickness / a, width / a, k, xerr=thickness_deviation / a, yerr=width_deviation / a,
               label=label_of(ensemble))
        most = max(most, np.nanmax(thickness / a))
    ax.plot([0, most], [0, 4 * most], "--", color=INK, linewidth=0.8, label=r"$\tilde{w}_h = 4\,\tilde{l}_h$, printed")
    ax.set(xlabel=r"thickness $\tilde{l}_h$", ylabel=r"width $\tilde{w}_h$", xlim=(0, None), ylim=(0, None))
    ax.legend()


def widths_at_end(ensemble):
    """Of the heads of all members, in radii."""
    return np.concatenate([avalanche(run).widths for run in ensemble.runs]) / radius_of(ensemble)


def nearest_gaussian(x, density):
    """Mean and deviation of the Gaussian of least squares, by Gauss-Newton steps from the moments; None if they leave
    the range, or if fewer than three densities say something of it."""
    if np.count_nonzero(density) < 3:
        return None
    mean = (x * density).sum() / density.sum()
    deviation = np.sqrt(((x - mean) ** 2 * density).sum() / density.sum())
    for _ in range(100):
        g = gaussian(x, mean, deviation)
        slopes = np.stack([g * (x - mean) / deviation**2, g * ((x - mean) ** 2 / deviation**3 - 1 / deviation)], axis=1)
        step = np.linalg.lstsq(slopes, density - g, rcond=None)[0]
        mean, deviation = mean + step[0], deviation + step[1]
        if not (0 < deviation < np.ptp(x) and x[0] < mean < x[-1]):
            return None
        if np.abs(step).max() < 1e-9 * deviation:
            break
    return mean, deviation


def gaussian(x, mean, deviation):
    return np.exp(-0.5 * ((x - mean) / deviation) ** 2) / (deviation * np.sqrt(2 * np.pi))


def width_distribution(ax, radii):
    ax.set(xlabel=r"width $\tilde{w}_h$", ylabel="probability density")
    widths = [(ensemble, w) for ensemble in radii if len(w := widths_at_end(ensemble))]
    if not widths:
        return
    edges = np.arange(0, max(w.max() for _, w in widths) + 2 * BIN, BIN)
    middle = (edges[1:] + edges[:-1]) / 2
    for k, (ensemble, w) in enumerate(widths):
        density = np.histogram(w, edges, density=True)[0]
        ax.plot(middle, density, color=PALETTE[k], linewidth=0.7)
        points(ax, middle, density, k, label=f"{label_of(ensemble)}, {len(w)} heads")
    if (fit := nearest_gaussian(middle, density)) is not None:
        x = np.linspace(0, edges[-1], 121)
        ax.plot(x, gaussian(x, *fit), "--", color=INK, linewidth=0.8, label=f"Gaussian {fit[0]:.1f} ± {fit[1]:.1f}")
    ax.set(xlim=(0, None), ylim=(0, None))
    ax.legend()


def width_against_radius(ax, radii):
    a = np.array([radius_of(ensemble) for ensemble in radii]) * 1e3
    widths = [widths_at_end(ensemble) for ensemble in radii]
    mean, deviation = a * [w.mean() for w in widths], a * [w.std(ddof=1) for w in widths]
    points(ax, a, mean, 0, yerr=deviation, label="all heads at the end")
    slope = (a * mean).sum() / (a * a).sum()
    ax.plot([0, 1.1 * a.max()], [0, 1.1 * slope * a.max()], "--", color=INK, linewidth=0.8,
            label=f"$w_h$ = {slope:.1f} $a_p$")
    ax.set(xlabel="radius $a_p$ (mm)", ylabel="width $w_h$ (mm)", xlim=(0, None), ylim=(0, None))
    ax.legend()


def head_counts(ax, radii):
    counts = [np.array([avalanche(run).column("head_count")[-1] for run in ensemble.runs]) for ensemble in radii]
    mean, deviation = zip(*(mean_and_deviation(c[:, None]) for c in counts))
    points(ax, [1e3 * radius_of(e) for e in radii], np.ravel(mean), 0, yerr=np.ravel(deviation), label="computed")
    beside = 0.12  # mm, so that the error bars are told apart
    ax.errorbar([a + beside for a in PRINTED_COUNTS], [m for m, _ in PRINTED_COUNTS.values()],
                yerr=[d for _, d in PRINTED_COUNTS.values()], fmt="s", markersize=3.5, color=INK,
                markerfacecolor="white", elinewidth=0.7, label="printed")
    ax.set(xlabel="radius $a_p$ (mm)", ylabel="heads at the end", xlim=(0, 5.6), ylim=(0, 26))
    ax.legend()
