# SPDX-License-Identifier: Apache-2.0
"""Pictures of runs with matplotlib: each function draws into axes that the caller has made, and returns what it drew.
Lengths are drawn in `unit` metres (1e-3: mm), so that a picture in particle radii has unit = a."""
import io

import matplotlib
import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection

from talus.case import walls as walls_of
from talus.trouble import RunError

AXES = {"x": 0, "y": 1, "z": 2}
INK, MUTED, PALE = "#222222", "#6b7280", "#c3c8cf"
#: Told apart by colour-blind readers (Okabe & Ito, "Color Universal Design", 2008), without their yellow.
PALETTE = ["#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#56b4e9", INK]
STYLE = {
    "figure.dpi": 150, "figure.constrained_layout.use": True, "font.size": 8, "axes.titlesize": 8.5,
    "axes.titlelocation": "left", "axes.linewidth": 0.6, "axes.edgecolor": INK, "axes.prop_cycle":
    matplotlib.cycler(color=PALETTE), "xtick.major.width": 0.6, "ytick.major.width": 0.6, "lines.linewidth": 1.2,
    "legend.frameon": False, "legend.fontsize": 7, "mathtext.fontset": "dejavusans", "image.cmap": "viridis",
}


def style():
    """The look of Talus's figures, to be used as `with draw.style():`."""
    return matplotlib.rc_context(STYLE)


def particles(ax, snapshot, column=None, *, component=None, view="xz", radius=None, unit=1.0, colour=PALE, limits=None,
              cmap=None):
    """Particles as discs of their own size, seen along the axis that `view` ("xz", "xy", "y-x") leaves out.

    \\param column name of a column, or one number or vector a particle; left out: all in `colour`
    \\param component "x", "y" or "z" of a vector; left out: its length
    \\param radius m, one or one a particle; left out: the column `radius`
    \\param limits (low, high) of the colours; left out: those of the numbers
    Those nearer to the reader lie on top. Returns the collection, for a colour bar.
    """
    right, up = _directions(view)
    places = np.asarray(snapshot.positions)
    if radius is None:
        if "radius" not in snapshot:
            raise RunError(f"{snapshot.path}: has no column radius; give the radius of the discs")
        radius = snapshot["radius"]
    order = np.argsort(places @ np.cross(right, up), kind="stable")  # towards the reader
    diameter = 2 * np.broadcast_to(np.asarray(radius, dtype=float), len(places))[order] / unit
    discs = EllipseCollection(diameter, diameter, np.zeros(len(places)), units="xy", linewidths=0,
                              offsets=places[order] @ np.transpose([right, up]) / unit, offset_transform=ax.transData)
    if column is None:
        discs.set_facecolor(_in_order(colour, order))
    else:
        numbers = np.asarray(snapshot[column] if isinstance(column, str) else column, dtype=float)
        if numbers.ndim == 2:
            numbers = _of_vectors(numbers, component)
        elif component is not None:
            raise ValueError(f'component "{component}" of {column}, which is no vector')
        discs.set_array(numbers[order])
        discs.set_cmap(cmap or matplotlib.rcParams["image.cmap"])
        if limits is not None:
            discs.set_clim(*limits)
    ax.add_collection(discs)
    ax.set_aspect("equal")
    ax.autoscale_view()
    return discs


def walls(ax, run, *, top=None, unit=1.0, **options):
    """The walls of a run's vessel seen along y, without what its gate shuts. \\param top of the side walls, m"""
    lines = LineCollection(np.array(walls_of(run.case, top)).reshape(-1, 2, 2) / unit,
                           **{"colors": INK, "linewidths": 1.0, "zorder": 3, **options})
    ax.add_collection(lines)
    ax.set_aspect("equal")
    ax.autoscale_view()
    return lines


def field(ax, air, column, *, component=None, y=None, unit=1.0, limits=None, **options):
    """A column of the air as a map over x and z, in the cells at the depth `y` (left out: the middle).
    \\param component "x", "y" or "z" of a vector; left out: its length. Returns the mesh, for a colour bar."""
    values = np.asarray(air.layer(column, y))
    if values.ndim == 3:
        values = _of_vectors(values, component)
    low, high = limits or (None, None)
    mesh = ax.pcolormesh(_edges(air.x, air.spacing[0]) / unit, _edges(air.z, air.spacing[2]) / unit, values.T,
                         **{"vmin": low, "vmax": high, "rasterized": True, **options})
    ax.set_aspect("equal")
    return mesh


def arrows(ax, air, column="velocity", *, apart=5e-3, unit=1.0, y=None, length=None, **options):
    """A vector of the air as arrows over x and z. \\param apart m between them \\param length m on the map for a value of
    1; left out: matplotlib's choice. Returns the arrows, for a quiverkey."""
    values = np.asarray(air.layer(column, y))
    step = [max(1, round(apart / float(air.spacing[axis]))) for axis in (0, 2)]
    part = tuple(slice(n // 2, None, n) for n in step)
    scale = {} if length is None else {"scale": unit / length, "scale_units": "xy", "angles": "xy"}
    vectors = values[part]
    return ax.quiver(air.x[part[0]] / unit, air.z[part[1]] / unit, vectors[..., 0].T, vectors[..., 2].T,
                     **{"color": INK, "width": 0.0022, **scale, **options})


def curve(ax, table, column, *, against="time", start=0.0, spread=None, unit=1.0, **options):
    """A column of a table against another, with the names and units on the axes.
    \\param start what counts as zero on the axis across (the gate's opening) \\param spread half the height of a band
    \\param unit of the column in its own unit (1e3: kPa of Pa; name the axis yourself then)"""
    x, y = np.asarray(table[against]) - start, np.asarray(table[column]) / unit
    line, = ax.plot(x, y, **options)
    if spread is not None:
        ax.fill_between(x, y - spread, y + spread, color=line.get_color(), alpha=0.2, linewidth=0)
    for set_label, old, name in ((ax.set_xlabel, ax.get_xlabel(), against), (ax.set_ylabel, ax.get_ylabel(), column)):
        if not old:
            set_label(label(name, table.units[name]))
    return line


def label(name, unit):
    """The name of an axis: "discharge rate (kg/s)"; without a unit where that is 1."""
    return name.replace("_", " ") + ("" if unit == "1" else f" ({unit})")


def save(figure, path, colours=256):
    """Writes a figure as a small PNG of a palette."""
    from PIL import Image  # comes with matplotlib
    drawn = io.BytesIO()
    figure.savefig(drawn, format="png")
    picture = Image.open(drawn).convert("RGB")
    picture.quantize(colours, method=Image.Quantize.MEDIANCUT, dither=Image.Dither.NONE).save(path, optimize=True)
    matplotlib.pyplot.close(figure)


def _directions(view):
    """"xz" or "y-x" as the unit vectors that point across and up the page."""
    signs, letters = [], []
    for character in view:
        if character in AXES:
            letters.append(character)
            signs.append(-1.0 if view[view.index(character) - 1:view.index(character)] == "-" else 1.0)
        elif character != "-":
            letters.append(None)
    if len(letters) != 2 or None in letters or letters[0] == letters[1]:
        raise ValueError(f'view "{view}": two of x, y, z, across and up the page, such as "xz" or "y-x"')
    return [sign * np.eye(3)[AXES[letter]] for letter, sign in zip(letters, signs)]


def _of_vectors(vectors, component):
    """One component of each, or its length."""
    return np.linalg.norm(vectors, axis=-1) if component is None else vectors[..., AXES[component]]


def _in_order(colour, order):
    """One colour for all, or one a particle in the order of drawing."""
    several = not isinstance(colour, str) and len(colour) == len(order) and not isinstance(colour, tuple)
    return np.asarray(matplotlib.colors.to_rgba_array(colour))[order] if several else colour


def _edges(centres, spacing):
    return np.append(np.asarray(centres) - spacing / 2, centres[-1] + spacing / 2)
