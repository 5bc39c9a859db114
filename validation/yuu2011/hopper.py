# SPDX-License-Identifier: Apache-2.0
"""One variant of the hopper, with times from the opening of its gate."""
import numpy as np
from talus.draw import PALETTE

LATE = 10e-3  # s, by which a run may end before a time


class Hopper:
    """One variant: its first run (nothing is random), with times from the opening of the gate."""

    def __init__(self, ensemble, number):
        self.run, self.variant = ensemble.runs[0], ensemble.variant
        self.colour, self.dash = PALETTE[number % len(PALETTE)], "-" if number < len(PALETTE) else ":"
        self.gate = self.run.gate_time
        self.end = float(self.run.series["time"][-1]) - self.gate
        self.width, self.spacing = (float(self.run.case[table][key]) for table, key in (("box", "width"),
                                                                                         ("bed", "spacing")))

    @property
    def plate(self):
        """Height of the plate, m."""
        return float(self.run.case["plate"]["height"])

    def reaches(self, time):
        return self.end >= time - LATE

    def at(self, time, snapshots=None):
        """The snapshot nearest to a time; None if the run does not reach it."""
        snapshots = self.run.snapshots if snapshots is None else snapshots
        return snapshots.at(self.gate + min(time, self.end)) if len(snapshots) and self.reaches(time) else None

    def time_of(self, snapshot):
        return abs(round(snapshot.time - self.gate, 2))

    def means(self, column, length, every=1e-3):
        """Means of a column of the series over `length` seconds, one every `every`; until it first has no value."""
        time, value = self.run.series["time"] - self.gate, np.asarray(self.run.series[column])
        after = np.flatnonzero(~np.isfinite(value) & (time > 0))
        if len(after):
            time, value = time[:after[0]], value[:after[0]]
        there = np.isfinite(value)
        time, value = time[there], value[there]
        integral = np.append(0, np.cumsum(np.diff(time) * (value[1:] + value[:-1]) / 2))
        start = np.arange(0, time[-1] - length, every)
        return start + length / 2, (np.interp(start + length, time, integral) - np.interp(start, time, integral)) / length
