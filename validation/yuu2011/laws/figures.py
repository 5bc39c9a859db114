#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Discharge and surface with each constitutive law, and the page of the study.

    python3 validation/yuu2011/laws/figures.py results/yuu2011/laws
"""
import sys
from pathlib import Path

sys.path[:0] = [str(Path(__file__).resolve().parents[k]) for k in (1, 2)]

from study import main  # noqa: E402  (it also finds the package talus)

from figures_of_hopper import Hoppers  # noqa: E402


def draw(study, album):
    hoppers = Hoppers(study, album, "section")
    hoppers.discharge("discharge.png", "Discharge with each law")
    hoppers.surface_angles("surface.png", "Slope of the free surface with each law")


if __name__ == "__main__":
    main(draw, __file__)
