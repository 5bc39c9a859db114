# SPDX-License-Identifier: Apache-2.0
"""The hopper of Yuu & Umekage 2011 for tests of its quantities."""
from pathlib import Path

import numpy as np
from runs_in_memory import RunInMemory, case
from talus.continuum import continuum
from talus.measures import Window, measures_of

MEASURES = measures_of(Path(__file__).resolve().parents[2] / "validation" / "yuu2011")
# The paper's box: 100 x 5 x 250 mm, the plate at 100 mm, its slit from 30 to 70 mm; h = 5/3 mm.
WIDTH, DEPTH, HEIGHT, PLATE, H = 0.1, 5e-3, 0.25, 0.1, 5e-3 / 3
GATE = 0.25  # s, in the run's time
MASS = 0.6 * 2500 * WIDTH * DEPTH * 50 * H


def paper_case(**tables):
    return case(WIDTH, DEPTH, HEIGHT, H, PLATE, (0.03, 0.07), bed_height=50 * H, **tables)


def measure(name, run, begin=0.0, end=np.inf, at=None, **place):
    return MEASURES.quantities[name].of(run, Window(at, begin, end), **place)


def snapshot(frame, of_case=None, gate=GATE, air=()):
    """The only snapshot of a run."""
    return continuum(RunInMemory(of_case or paper_case(), [frame], gate_time=gate, air=air)).snapshot(0)
