#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Grains of uniform strength over outlets of a wedge and a cone, and grains whose strength grows with what they bear, in a wedge
after flow through a wider outlet: at which strength do they arch?

    validation/arching/arching.py [--out results/arching] [--threads N] [--markdown FILE] [--picture FILE] [--only wedge cone flow]

A run that is there is not made again. Exit status 1 if a row of reference.toml is not met. Needs python3-numpy, python3-h5py and
python3-matplotlib."""
import math
import sys
import tomllib
from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent))
import study  # noqa: E402
import talus  # noqa: E402

REFERENCE = tomllib.loads((HERE / "reference.toml").read_text(encoding="utf-8"))
M, DENSITY, GRAVITY, HALF_ANGLE, BOTTOM = 0.5, 1500.0, 9.81, 20.0, 60.0  # SI, degrees, mm
FACTOR = {"wedge": 1 + HALF_ANGLE / 180, "cone": 2 + HALF_ANGLE / 60, "flow": 1 + HALF_ANGLE / 180}
SERIES = {"wedge": [(60, 1), (90, 1), (120, 1), (60, 2)], "cone": [(60, 1), (60, 2)], "flow": [(60, 1)]}
REOPENS, ENDS, KAPPA = 0.8, 1.3, 0.1  # of flow.toml; s after the first opening


def tensile_strength(kind, outlet, ratio, gravity):
    """Of grains whose f_c is `ratio` times what Jenike's arch over the outlet needs, Pa. \\param outlet mm \\param gravity over g"""
    phi = math.atan(M)
    return ratio * DENSITY * gravity * GRAVITY * 1e-3 * outlet / FACTOR[kind] * (1 - math.sin(phi)) / (2 * M * math.cos(phi))


def settings_of(kind, outlet, ratio, gravity):
    """Lengths go with the outlet, the moduli with the weight."""
    if kind == "flow":  # a_0 by itself, Pa
        return {"law.critical-state.tensile_strength": f"{ratio:g} Pa", "output.report": False, "output.pictures": False}
    size, tan = outlet / 60, math.tan(math.radians(HALF_ANGLE))
    settings = {"law.critical-state.tensile_strength": f"{tensile_strength(kind, outlet, ratio, gravity):.6g} Pa",
                "law.critical-state.bulk_modulus": f"{2 * size * gravity:.6g} MPa",
                "law.critical-state.shear_modulus": f"{1.2 * size * gravity:.6g} MPa",
                "gravity.acceleration": f"{gravity * GRAVITY} m/s2", "bed.height": f"{150 * size:g} mm", "box.width": f"{200 * size:g} mm",
                "output.report": False, "output.pictures": False}
    if kind == "wedge":
        return settings | {"wedge.outlet": f"{outlet} mm", "box.height": f"{BOTTOM + 200 * size:g} mm"}
    height = 160 * size
    return settings | {"box.depth": f"{200 * size:g} mm", "box.height": f"{BOTTOM + height + 20:g} mm",
                       "vessel.1.lower_radius": f"{0.5 * outlet} mm", "vessel.1.upper_radius": f"{0.5 * outlet + height * tan:.6g} mm",
                       "vessel.1.top": f"{BOTTOM + height:g} mm", "vessel.2.radius": f"{0.5 * outlet} mm"}


def runs(options):
    for kind in options.only:
        for outlet, gravity in SERIES[kind]:
            for ratio in REFERENCE["ratios"][kind]:
                yield kind, outlet, gravity, ratio, options.out / f"{kind}-{outlet}-g{gravity}-r{ratio:g}"


def cases(options):
    for kind, outlet, gravity, ratio, folder in runs(options):
        yield HERE / f"{kind}.toml", folder, settings_of(kind, outlet, ratio, gravity)


def ratio_and_arch(ratio, run):
    return ratio, run.summary["residual_fraction"] > REFERENCE["left"]


def strength_and_arch(adhesion, run):
    """Ratio f_c H/(rho g B) by the strength a = a_0 + kappa p that the mean pressure above the narrow outlet, up to its width, gives
    grains just before it opens; whether hardly anything passes it."""
    before = [s for s in run.snapshots if s.time - run.gate_time < REOPENS][-1]
    x, width = before.positions, 0.06
    above = (np.abs(x[:, 0] - 0.14) < 0.5 * width) & (x[:, 2] > 0.06) & (x[:, 2] < 0.06 + width)
    strength = adhesion + KAPPA * np.mean([before[f"stress_{axis}"][above].mean() for axis in ("xx", "yy", "zz")])
    time, gone = np.asarray(run.series["time"]) - run.gate_time, np.asarray(run.series["removed_mass"])
    passed = np.subtract(*np.interp([ENDS, 0.5 * (REOPENS + ENDS)], time, gone)) / (0.5 * (ENDS - REOPENS))
    wide = np.subtract(*np.interp([0.55, 0.45], time, gone)) / 0.1
    return strength / tensile_strength("flow", 60, 1, 1), bool(passed < REFERENCE["passes"] * wide)


def ratio_at_failure(options, kind, outlet, gravity):
    """The middle between the largest that flows and the smallest that arches."""
    state = strength_and_arch if kind == "flow" else ratio_and_arch
    arched = [state(ratio, talus.Run(folder)) for k, o, g, ratio, folder in runs(options) if (k, o, g) == (kind, outlet, gravity)]
    flows, arches = ([ratio for ratio, flag in arched if flag == wanted] for wanted in (False, True))
    if not arched or arched[0][1] or not arched[-1][1]:
        sys.exit(f"{kind}, {outlet} mm: no strength at failure among {arched}")
    return 0.5 * (max(flows) + min(arches))


def measure(options):
    found = {kind: {of: ratio_at_failure(options, kind, *of) for of in SERIES[kind]} for kind in options.only}
    numbers = {}
    for kind, ratios in found.items():
        numbers |= {f"{kind}-{outlet}": 1 / ratio for (outlet, gravity), ratio in ratios.items() if gravity == 1}
        if (60, 2) in ratios:
            numbers[f"{kind}-heavy"] = 2 * ratios[60, 2] / ratios[60, 1]
    return numbers, found


def tell(numbers, found):
    lines = ["| hopper, outlet, gravity | f_c H/(ρ g B) at failure |", "|---|---|"]
    lines += [f"| {kind}, {outlet} mm, {gravity} g | {ratio:.3g} |" for kind, ratios in found.items()
              for (outlet, gravity), ratio in ratios.items()]
    return "\n".join(lines) + "\n\n" + study.table_of_numbers(REFERENCE, numbers)


def draw(found):
    from matplotlib import pyplot as plt
    figure, axes = plt.subplots(figsize=(4, 2.8), layout="constrained")
    for kind, ratios in found.items():
        axes.plot(*zip(*((outlet, 1 / ratio) for (outlet, gravity), ratio in ratios.items() if gravity == 1)), "o-", label=kind)
    axes.axhspan(0.75, 1.25, color="0.92")
    axes.set(xlabel="outlet (mm), particles of 5 mm", ylabel="critical outlet over Jenike's", xlim=(0, None), ylim=(0, 1.5))
    axes.legend(frameon=False)
    return figure


def add_options(parser):
    parser.add_argument("--only", nargs="+", choices=list(SERIES), default=list(SERIES))


if __name__ == "__main__":
    sys.exit(study.compare(__file__, __doc__, "results/arching", REFERENCE, cases, measure, tell, draw, add_options=add_options))
