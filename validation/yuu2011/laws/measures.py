# SPDX-License-Identifier: Apache-2.0
"""The quantities of this study beside those of a summary: some of those of ../measures.py."""
from pathlib import Path

from talus.measures import measures_of

_NAMES = ("floor_arrival_first_time", "packing_max_outside_impact", "repose_angle_nearer", "repose_angle_other")
_HOPPER = measures_of(Path(__file__).resolve().parents[1]).quantities

QUANTITIES = {name: _HOPPER[name] for name in _NAMES}
