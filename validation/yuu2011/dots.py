# SPDX-License-Identifier: Apache-2.0
"""Figure 4 of the paper: each particle as 50 dots scattered about it by the kernel. The paper does not say what becomes of
a dot behind a wall; here it goes to its mirror image, so that there are none where there are no grains."""
import numpy as np
import talus.case

DOTS = 50      # of a particle
COLOUR = "#5b4a33"
PIXEL = 0.2e-3  # m, a grain's diameter


def scattered(snapshot, mass, case, opened):
    """Places of all dots in the plane x, z: normally distributed with a deviation of 2 h/3, none beyond 2 h. The same for
    the same snapshot. \\param mass of a particle, kg \\param opened whether the gate has gone"""
    places = np.asarray(snapshot.positions)
    h = np.cbrt(mass / np.asarray(snapshot["density"]))
    random = np.random.default_rng(0)
    offset = random.normal(scale=2 / 3, size=(len(places), DOTS, 3))
    while (far := (offset**2).sum(axis=2) > 4).any():
        offset[far] = random.normal(scale=2 / 3, size=(far.sum(), 3))
    start = np.repeat(places[:, [0, 2]], DOTS, axis=0)
    end = start + (offset * h[:, None, None])[..., [0, 2]].reshape(-1, 2)
    for line in talus.case.walls(case, shut=not opened):
        end = mirrored(start, end, *line)
    return end


def mirrored(start, end, one, other):
    """Ends of steps that cross the line from `one` to `other`, reflected by it; the other ends as they are."""
    one, along = np.array(one), np.subtract(other, one)
    length = np.hypot(*along)
    normal = np.array([-along[1], along[0]]) / length
    before, after = (start - one) @ normal, (end - one) @ normal
    with np.errstate(invalid="ignore", divide="ignore"):
        crossing = start + (end - start) * (before / (before - after))[:, None]
    place = (crossing - one) @ along / length**2
    crosses = (before * after < 0) & (place >= 0) & (place <= 1)
    return np.where(crosses[:, None], end - 2 * after[:, None] * normal, end)


def draw(ax, run, snapshot, opened, unit):
    """All dots as a density on pixels of a grain's diameter, so that the picture is small however many there are."""
    case = run.case
    width, depth, spacing = (float(case[table][key]) for table, key in (("box", "width"), ("box", "depth"),
                                                                         ("bed", "spacing")))
    mass = case["bed"]["packing"] * case["grains"]["density"] * spacing**3
    dots = scattered(snapshot, mass, case, opened)
    top = dots[:, 1].max() + PIXEL
    edges = [np.arange(0, width + PIXEL, PIXEL), np.arange(0, top + PIXEL, PIXEL)]
    count = np.histogram2d(*dots.T, bins=edges)[0]
    # So opaque that a settled bed looks alike whatever the spacing and the depth.
    settled = DOTS * depth / spacing**3 * PIXEL**2  # dots a pixel
    shade = shades(1 - np.exp(-count / settled))
    ax.imshow(np.moveaxis(shade, 0, 1), origin="lower", interpolation="antialiased", zorder=0,
              extent=(0, edges[0][-1] / unit, 0, edges[1][-1] / unit))


def shades(share):
    """From white to the colour of the dots."""
    dark = np.array([int(COLOUR[k:k + 2], 16) for k in (1, 3, 5)]) / 255
    return 1 - np.round(share, 2)[..., None] * (1 - dark)
