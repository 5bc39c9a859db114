# SPDX-License-Identifier: Apache-2.0
"""The grains in the figures: one run's snapshots, in particle radii. Times are in a/v_s."""
import numpy as np
import talus.draw
from measures import avalanche
from talus.draw import INK, PALE
from talus.grains import angle_of_line, find_heads, head_size, surface_walk

HEAD, LIGHT_HEAD, SURFACE, MEASURED, MEASURE = "#0072b2", "#6fb1dd", "#d55e00", "#009e73", "#d55e00"
GRAIN = "#7d8a99"


def radius_of(run):
    return float(run.case["particles"]["radius"])


def at(run, time):
    """The snapshot nearest to a time, with its time and the front's speed then, and the unit of speed v_s."""
    seen = avalanche(run)
    n = int(np.abs(seen.time - min(time, seen.time[-1])).argmin())
    snapshot = run.snapshots[run.snapshots.numbers[n]]
    row = {"time": seen.time[n], "front_speed": seen.front_speed_at(float(snapshot.time))}
    return snapshot, row, seen.speed


def draw(ax, run, snapshot, row, view, colours=GRAIN, column=None, **options):
    a = radius_of(run)
    if not isinstance(colours, str):
        options["colour"] = colours
    else:
        options.setdefault("colour", colours)
    discs = talus.draw.particles(ax, snapshot, column, view=view, unit=a, **options)
    ax.set_title(f"{ax.get_title(loc='left')} $\\tilde{{t}}$ = {row['time']:.3g}".strip())
    across, up = view.replace("-", "")
    ax.set(xlabel=f"${across}$ ($a_p$)", ylabel=f"${up}$ ($a_p$)")
    if "-x" in view:  # down the page
        ax.yaxis.set_major_formatter(lambda value, _: f"{0.0 - value:g}")
    return discs


def marked(snapshot, groups):
    """A colour for each grain. \\param groups of (grains, colour)"""
    colours = np.full(len(snapshot.positions), PALE, dtype=object)
    for grains, colour in groups:
        colours[grains] = colour
    return list(colours)


def about_front(ax, run, snapshot, behind, ahead, below, above):
    front = np.asarray(snapshot.positions)[:, 0].max() / radius_of(run)
    ax.set(xlim=(front - behind, front + ahead), ylim=(-below, above))


def slope(ax):
    """The slope, seen from the side."""
    ax.axhspan(-1e4, 0, color="#e5e2dc", zorder=0)
    ax.axhline(0, color=INK, linewidth=0.8)


def measure(ax, start, end, text):
    """A measured length: a line with arrow heads and its name."""
    ax.annotate("", start, end, arrowprops={"arrowstyle": "<->", "color": MEASURE, "linewidth": 1, "shrinkA": 0,
                                            "shrinkB": 0})
    ax.annotate(text, (np.array(start) + end) / 2, color=MEASURE, xytext=(0, 6), textcoords="offset points",
                ha="center", bbox={"boxstyle": "round,pad=0.1", "color": "white", "alpha": 0.85})


def shape(ax, run, name):
    """Figure 3: a shape at the start with its size, measured between the outermost centres."""
    snapshot, row, _ = at(run, 0)
    x, y, z = np.asarray(snapshot.positions).T / radius_of(run)
    if name == "circle":
        draw(ax, run, snapshot, row, "xy")
        size = np.hypot(x, y).max()
        measure(ax, (0, 0), (size, 0), f"$R$ = {size:.0f} $a_p$")
    elif name == "rectangle":
        draw(ax, run, snapshot, row, "y-x")
        behind = -x.min() + 8  # the axis up the page is -x
        measure(ax, (y.min(), behind), (y.max(), behind), f"$2W$ = {np.ptp(y):.0f} $a_p$")
        ax.set_ylim(-x.max() - 8, behind + 16)
    else:
        # The gate's foot is the corner at the slope; the level surface falls from the gate's top to the slope behind.
        draw(ax, run, snapshot, row, "xz")
        depth = ((z - (x - x.max())) / np.sqrt(2)).max()
        measure(ax, (x.max(), 0), (x.max() - depth / np.sqrt(2), depth / np.sqrt(2)), f"$D$ = {depth:.0f} $a_p$")
        slope(ax)
        ax.set_ylim(-8, z.max() + 8)
    ax.set_title(name)


def from_above(ax, run, time, *, view="xy", window=None, mark=True):
    """Figures 4 and 6: the grains of heads blue. \\param window (behind, ahead, to the sides) of the front; all without"""
    snapshot, row, _ = at(run, time)
    heads = find_heads(snapshot.positions, radius_of(run)) if mark else []
    draw(ax, run, snapshot, row, view, marked(snapshot, [(head, HEAD) for head in heads]) if mark else GRAIN)
    if window:
        about_front(ax, run, snapshot, window[0], window[1], window[2], window[2])


def motion_in_head(ax, run, time):
    """Figure 5b: the largest head, with the velocities relative to the front."""
    snapshot, row, v_s = at(run, time)
    a = radius_of(run)
    heads = find_heads(snapshot.positions, a)
    draw(ax, run, snapshot, row, "xy", marked(snapshot, [(head, LIGHT_HEAD) for head in heads]))
    about_front(ax, run, snapshot, 75, 6, 45, 45)
    places, velocity = np.asarray(snapshot.positions) / a, np.asarray(snapshot["velocity"]) / v_s
    seen = places[:, 0] > ax.get_xlim()[0]
    arrows = ax.quiver(*places[seen, :2].T, velocity[seen, 0] - row["front_speed"], velocity[seen, 1], angles="xy",
                       scale_units="xy", scale=0.5, width=0.003, color=INK, zorder=3)
    ax.quiverkey(arrows, 0.12, 0.92, 5, r"5 $v_s$", labelpos="E", fontproperties={"size": 7})


def relative_speed(ax, run, time):
    """Figure 7a: coloured by the velocity along the slope relative to the front's, in v_s, about the front."""
    snapshot, row, v_s = at(run, time)
    numbers = snapshot["velocity"][:, 0] / v_s - row["front_speed"]
    discs = draw(ax, run, snapshot, row, "xz", column=numbers, limits=(-6, 6), cmap="coolwarm")
    slope(ax)
    about_front(ax, run, snapshot, 330, 10, 8, 60)
    ax.figure.colorbar(discs, ax=ax, label=r"$\tilde{v}_x - \tilde{v}_f$", extend="both", aspect=8, pad=0.01)


def head_by(ax, run, by, time):
    """Figure 8: the heads by n or n'; by n' also width and thickness of the largest and the grains that define them."""
    snapshot, row, _ = at(run, time)
    a = radius_of(run)
    heads = find_heads(snapshot.positions, a, by)
    groups = [(head, HEAD) for head in heads]
    size = head_size(snapshot.positions, snapshot["radius"], heads[0], a) if heads and by == "n'" else None
    if size:
        groups.append((size.grains, MEASURED))
    draw(ax, run, snapshot, row, "xy", marked(snapshot, groups))
    about_front(ax, run, snapshot, 115, 20, 50, 50)
    ax.set_title(f"{ax.get_title(loc='left')}, by ${by}$")
    if not size:
        return
    ahead, beside = size.foremost / a + 7, size.right / a - 7
    places = np.asarray(snapshot.positions) / a
    left, right, foremost, inner = places[size.grains]
    dotted = {"linestyle": ":", "color": MEASURE, "linewidth": 0.8}
    for grain, edge in ((left, size.left / a), (right, size.right / a)):
        ax.plot([grain[0], ahead], [edge, edge], **dotted)
    measure(ax, (ahead, size.left / a), (ahead, size.right / a), "$w_h$")
    if np.isfinite(size.inner):
        for grain, edge in ((inner, size.inner / a), (foremost, size.foremost / a)):
            ax.plot([edge, edge], [grain[1], beside], **dotted)
        measure(ax, (size.inner / a, beside), (size.foremost / a, beside), "$l_h$")


def frontal_surface(ax, run, time):
    """Figure 11a: the front with the grains of its surface and the line through them."""
    snapshot, row, _ = at(run, time)
    a = radius_of(run)
    surface = surface_walk(snapshot.positions, a)
    draw(ax, run, snapshot, row, "xz", marked(snapshot, [(surface, SURFACE)]))
    if len(surface) >= 3:
        angle = angle_of_line(snapshot.positions, surface)
        middle = np.asarray(snapshot.positions)[surface][:, [0, 2]].mean(axis=0) / a
        along = 16 * np.array([-np.cos(angle), np.sin(angle)])
        ax.plot(*np.transpose([middle - along, middle + along]), "--", color=INK, linewidth=1)
        ax.annotate(f"{np.degrees(angle):.0f}°", middle + along, xytext=(4, 0), textcoords="offset points")
    slope(ax)
    about_front(ax, run, snapshot, 75, 20, 6, 36)
