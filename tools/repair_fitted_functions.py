#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Joins the pieces of Yuu & Umekage's fitted functions A1 to A4 without contradicting a printed digit.

Reads the printed coefficients from src/physics/granular/fitted_functions.hpp and prints the table `repaired_2011` of the
same file. Needed only if that derivation is to be repeated: numpy and scipy, neither of which Talus itself uses.

Unknowns are the digits lost by rounding: a coefficient c printed to two digits lies within half a unit of its second. Of
all coefficients for which the pieces meet at their joints and rise and fall as one peak, those are taken for which the
mean square of the relative difference from the print, over log a, is least. A quadratic programme for each function.
"""
import pathlib
import re

import numpy as np
from scipy.optimize import linprog, minimize

HEADER = pathlib.Path(__file__).parent.parent / "src/physics/granular/fitted_functions.hpp"
MISPRINTS = {("A1", 6, 2): 2.5e10}  # printed 2.7e10
SAMPLES = 41  # a piece
LIMIT = 0.98  # of half a unit: so that the coefficients still round to the printed ones when written with few digits
# The argument at which a function turns from rising to falling (between two: not asked), and up to which it has to fall.
PEAK = {"A1": (5e-5, 5e-5, 0.035), "A2": (4.5e-5, 5.5e-5, 0.035), "A3": (1.65e-4, 1.75e-4, 0.004),
        "A4": (1.1e-4, 1.3e-4, 0.035)}
NEGLIGIBLE = {"A3": 2e3}  # Pa, below which the relative difference is no measure


def printed_functions():
    """{name: [(end, [c0, c1, c2, c3]), ...]} of printed_2011."""
    text = HEADER.read_text()
    block = text[text.index("printed_2011 = {"):text.index("// clang-format on")]
    functions = {}
    for name, body in re.findall(r"// (A\d)\n(.*?)\}\}", block, re.S):
        rows = re.findall(r"\{([^{}]*,[^{}]*,[^{}]*,[^{}]*,[^{}]*)(?:\}|$)", body)
        numbers = [[float(x) for x in row.split(",")] for row in rows]
        functions[name] = [(n[0], n[:0:-1]) for n in numbers]
    return functions


def half_unit(c):
    return 0.5 * 10.0 ** (np.floor(np.log10(abs(c))) - 1) if c else 0.0


def repaired(name, pieces):
    pieces = [(end, [MISPRINTS.get((name, k, i), c) for i, c in enumerate(cs)]) for k, (end, cs) in enumerate(pieces)]
    unknown = {}
    for k, (_, cs) in enumerate(pieces):
        for i, c in enumerate(cs):
            if c:
                unknown[k, i] = len(unknown)

    def value(k, a, derivative=False):
        """Row of weights of the unknowns, and the constant, of piece k (or its derivative) at a."""
        row, constant = np.zeros(len(unknown)), 0.0
        for i, c in enumerate(pieces[k][1]):
            if c:
                power = (i * a ** (i - 1) if i else 0.0) if derivative else a**i
                row[unknown[k, i]] = half_unit(c) * power
                constant += c * power
        return row, constant

    joints, at_joints, rises, at_least, differences = [], [], [], [], []
    begin = 0.0
    for k, (end, _) in enumerate(pieces):
        if k + 1 < len(pieces):
            left, c_left = value(k, end)
            right, c_right = value(k + 1, end)
            size = max(abs(c_left), abs(c_right))
            joints.append((left - right) / size)
            at_joints.append((c_right - c_left) / size)
        first = begin if begin > 0 else end / 50
        for a in np.geomspace(first, end, SAMPLES):
            row, constant = value(k, a)
            size = max(abs(constant), NEGLIGIBLE.get(name, 0.0))
            differences.append(np.sqrt(np.log(end / first) / SAMPLES) * row / size)
            last_rise, first_fall, last_fall = PEAK[name]
            inside_rise, inside_fall = end <= last_rise, begin >= first_fall and a <= last_fall
            if inside_rise or inside_fall:
                row, constant = value(k, a, derivative=True)
                sign = a / size if inside_rise else -a / size
                rises.append(sign * row)
                at_least.append(1e-9 - sign * constant)
        begin = end
    joints, rises, differences = np.array(joints), np.array(rises), np.array(differences)
    at_joints, at_least = np.array(at_joints), np.array(at_least)

    bounds = [(0.0, 0.0)] * len(unknown)
    for (k, i), u in unknown.items():
        c = pieces[k][1][i]
        below = 0.1 if f"{abs(c):.1e}".startswith("1.0") else 1.0  # 9.94e4 is not printed as 1.0e5
        bounds[u] = (-LIMIT * below, LIMIT) if c > 0 else (-LIMIT, LIMIT * below)
    start = linprog(np.zeros(len(unknown)), A_ub=-rises, b_ub=-at_least, A_eq=joints, b_eq=at_joints, bounds=bounds)
    if start.x is None:
        raise SystemExit(f"{name}: no coefficients within the printed digits join and fall")
    square = differences.T @ differences + 1e-5 * np.eye(len(unknown))
    found = minimize(lambda x: 0.5 * x @ square @ x, start.x, jac=lambda x: square @ x, bounds=bounds, method="SLSQP",
                     constraints=[{"type": "eq", "fun": lambda x: joints @ x - at_joints, "jac": lambda x: joints},
                                  {"type": "ineq", "fun": lambda x: rises @ x - at_least, "jac": lambda x: rises}],
                     options={"maxiter": 2000, "ftol": 1e-14})
    if not found.success:
        raise SystemExit(f"{name}: {found.message}")
    return [(end, [c + half_unit(c) * found.x[unknown[k, i]] if c else 0.0 for i, c in enumerate(cs)])
            for k, (end, cs) in enumerate(pieces)]


def number(c):
    if not c:
        return "0"
    mantissa, exponent = f"{c:.8e}".split("e")
    return f"{mantissa.rstrip('0').rstrip('.')}e{int(exponent)}"


def main():
    for name, pieces in printed_functions().items():
        rows = [f"{{{number(end)}, {', '.join(number(c) for c in cs[::-1])}}}" for end, cs in repaired(name, pieces)]
        print(f"    // {name}\n    {{{len(rows)}, {{" + (",\n" + " " * 9).join(rows) + "}},")


if __name__ == "__main__":
    main()
