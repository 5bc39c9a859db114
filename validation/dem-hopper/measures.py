# SPDX-License-Identifier: Apache-2.0
"""The quantities of this study beside those of a summary: some of those of the hopper of Yuu & Umekage 2011."""
from pathlib import Path

from talus.measures import measures_of

_NAMES = ("surface_height_hopper", "surface_height_bin", "surface_outward_angle_bin", "hopper_velocity", "foot_speed",
          "stream_packing")
_HOPPER = measures_of(Path(__file__).resolve().parents[1] / "yuu2011").quantities

QUANTITIES = {name: _HOPPER[name] for name in _NAMES}
