# SPDX-License-Identifier: Apache-2.0
"""Runs side by side."""
from collections import namedtuple

import numpy as np

#: A quantity of two runs: `difference` = second - first, `ratio` = second / first.
Difference = namedtuple("Difference", "name unit first second difference ratio")


def compare(first, second):
    """The quantities of the summaries that both runs have, in the order of the first; those about the machine are left
    out. Each is a Difference."""
    machine = {"wall_seconds", "settle_wall_seconds", "cpu_seconds", "peak_memory", "threads"}
    rows = []
    for name, a in first.summary.items():
        if name in second.summary and name not in machine:
            b = second.summary[name]
            ratio = float(b) / float(a) if float(a) != 0 else np.nan
            rows.append(Difference(name, a.units, float(a), float(b), float(b) - float(a), ratio))
    return rows


def changed_keys(first, second):
    """The keys in which the cases of two runs differ: {"air.enabled": (False, True)}; None where one has no such key."""
    a, b = _flat(first.case), _flat(second.case)
    return {key: (a.get(key), b.get(key)) for key in [*a, *(k for k in b if k not in a)] if a.get(key) != b.get(key)}


def _flat(case, before=""):
    keys = {}
    for key, value in case.items():
        keys |= _flat(value, f"{before}{key}.") if isinstance(value, dict) else {before + key: value}
    return keys
