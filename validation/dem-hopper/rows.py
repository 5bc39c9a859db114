#!/usr/bin/python3
# SPDX-License-Identifier: Apache-2.0
"""Writes what the beads have into the rows of reference.toml: at 0.2 mm on the line in D through the means of all sizes,
or the mean of all sizes where the slope of that line is less than twice its standard error (trend.py).

usage: rows.py

Of the discharge the line is that of Beverloo's form (trend.py). Rows whose id begins with `rolling` are those of beads
with a rolling friction of 0.2, the others those of round ones. Widths of the bounds stay as they are. Of a row that has
no value, but a bound or nothing, the text alone is written. Rows of what numbers.csv does not have at the row's time,
of two sizes at least, stay as they are.
"""
import re
import tomllib
from pathlib import Path

import numpy as np
from trend import beverloo, line_at, read, slope_and_error

HERE = Path(__file__).resolve().parent


def written(value, unit):
    """A number with its unit; lengths and angles to a tenth."""
    number = f"{value:.1f}" if unit in ("mm", "deg") else f"{value:.3g}"
    return number + {"1": "", "deg": " degrees"}.get(unit, f" {unit}")


def length_mm(text):
    return float(text.removesuffix(" mm"))


def key_of(row):
    """Place and time of a row as numbers.csv names them."""
    window, place = row["window"], row.get("place", {})
    time = f"{window['at']:g}" if "at" in window else f"{window['from']:g}-{window['to']:g}"
    if row["quantity"] == "foot_speed":
        return f"{length_mm(place['from']):g}-{length_mm(place['to']):g} mm from the middle", ""
    if row["quantity"] == "hopper_velocity":
        left, right = length_mm(place["left"]), length_mm(place["right"])
        return f"z = {length_mm(place['height']):g} mm, x = {left:g}-{right:g} mm", time
    if row["quantity"] == "stream_packing":
        return "stream", time
    if "from" in place:
        return f"{length_mm(place['from']):g}-{length_mm(place['to']):g} mm from the middle", time
    return "", time


def of_beads(row, numbers):
    """Text and value of a row; none where fewer than two diameters have it."""
    quantity = {"stream_packing": "packing"}.get(row["quantity"], row["quantity"])
    place, time = key_of(row)
    for (of, where, when, unit), values in numbers.items():
        if (of, where, when) == (quantity, place, time) and len(values) > 1:
            diameters = sorted(values, reverse=True)
            means = [np.mean(values[d]) for d in diameters]
            if quantity == "discharge_rate_plateau":
                k, value = beverloo(diameters, means)
                end = f"{written(value, unit)}, k = {k:.2g}"
            else:
                slope, error = slope_and_error(values)
                level = abs(slope) < 2 * error
                value = np.mean(means) if level else line_at(diameters, means)[0]
                end = ("as the mean: " if level else "") + written(value, unit)
            sizes = ", ".join(f"{written(mean, unit).split()[0]} ({d:g} mm)" for d, mean in zip(diameters, means))
            return f"{sizes}; at 0.2 mm: {end}", value * (1e-3 if unit == "mm" else 1.0)
    return None


def of_tables():
    """The numbers of data/numbers.csv, of round beads and of those with rolling friction."""
    return {kind: read(HERE / "data" / "numbers.csv", rolling) for kind, rolling in (("round", 0.0), ("rolling", 0.2))}


def rewritten(text, numbers):
    """reference.toml with what the beads have. \\param numbers as of_tables() has them"""
    rows = iter(tomllib.loads(text)["row"])
    parts = re.split(r"(?m)^(?=\[\[row\]\]$)", text)
    for at in range(1, len(parts)):
        row = next(rows)
        found = of_beads(row, numbers["rolling" if row["id"].startswith("rolling") else "round"])
        if not found:
            continue
        printed, value = found
        parts[at] = re.sub(r'(?m)^printed = .*$', lambda _: f'printed = "{printed}"', parts[at])
        if "value" in row["criterion"]:
            parts[at] = re.sub(r"(?m)^criterion = \{ value = [^,]*", lambda _: f"criterion = {{ value = {value:.4g}", parts[at])
    return "".join(parts)


def main():
    reference = HERE / "reference.toml"
    reference.write_text(rewritten(reference.read_text(encoding="utf-8"), of_tables()), encoding="utf-8")


if __name__ == "__main__":
    main()
