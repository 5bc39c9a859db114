# SPDX-License-Identifier: Apache-2.0
"""Avalanches in the units of the paper: a run, the mean of the members of an ensemble, and what the numbers of a snapshot
need of it. Times in a/v_s, velocities over v_s; a is the mean radius of the case, v_s the speed of one grain alone (Stokes).
"""
import math
from functools import cached_property, partial

import numpy as np

from talus.curves import mean as mean_of
from talus.grains import (REACH, UPPER_SHARE, angle_of_line, find_heads, head_size, pairs, surface_walk,
                          thickness_profile)
from talus.measures import NotEvaluated, once

FRONT_WINDOW = 0.25  # of the front speed, a/v_s
ROUNDING = 1e-9      # between times that count as equal, which are sums of steps


def common_part(curves):
    """Times and values of curves cut to as many points as the shortest has: runs end with the step that passes their end,
    which may just complete a window in one and not in another."""
    count = min(len(time) for time, _ in curves)
    times = curves[0][0][:count]
    for time, _ in curves:
        if count and np.abs(time[:count] - times).max() > 1e-6 * abs(times[-1]):
            raise NotEvaluated("the curves of the members differ in their times")
    return times, np.array([value[:count] for _, value in curves])


class Avalanche:
    """A run in the units of the paper: `time` of the snapshots (the first is the start), `column(name)` of them, the curve
    of the front speed, and its value over the last window of the run."""

    def __init__(self, run):
        self.run = run
        case = run.case
        particles, fluid = case["particles"], case["fluid"]
        self.radius = float(particles["radius"])
        weight = abs(4 / 3 * math.pi * self.radius**3 * float(case["gravity"]["acceleration"]) *
                     (particles["density"] - fluid["density"]))
        self.speed = weight * math.sin(math.radians(case["slope"]["angle"])) / (
            6 * math.pi * fluid["viscosity"] * self.radius)
        self.unit = self.radius / self.speed  # of time, s
        self.from_the_side = case["motion"] == "xz"
        stiffness = float(case["contact"].get("stiffness", math.nan))
        self.contact_weight_ratio = stiffness * 0.01 * self.radius / weight
        self.grains = len(run.snapshots[0].positions)
        self._columns = {}

    @cached_property
    def time(self):
        return np.array([snapshot.time for snapshot in self.run.snapshots]) / self.unit

    @cached_property
    def front(self):
        """Its place, m against s; from the side it is there once grains have reached the slope."""
        series = self.run.series
        place = np.asarray(series["front_on_slope_x" if self.from_the_side else "front_x"])
        there = np.isfinite(place)
        return np.asarray(series["time"])[there], place[there]

    @cached_property
    def front_speed(self):
        """The curve: times and values."""
        table = self.run.table("front_speed")
        return np.asarray(table["time"]), np.asarray(table["front_speed"])

    def front_speed_at(self, time):
        """Over the window that ends at a time, s; nan unless the front was there all the time."""
        window = FRONT_WINDOW * self.unit
        t, x = self.front
        if len(t) == 0 or time - window < t[0] - ROUNDING * window or time > t[-1] + ROUNDING * window:
            return math.nan
        now, before = np.interp([time, time - window], t, x)
        return (now - before) / window / self.speed

    @cached_property
    def front_speed_last(self):
        return self.front_speed_at(float(self.run.series["time"][-1]))

    def column(self, name):
        """A number of every snapshot, of SNAPSHOT_NUMBERS."""
        if name not in self._columns:
            self._columns[name] = np.array([self.number(name, n) for n in range(len(self.time))])
        return self._columns[name]

    def number(self, name, n):
        """A number of the n-th snapshot."""
        return SNAPSHOT_NUMBERS[name](self.view(n))

    @once
    def view(self, n):
        return View(self, self.run.snapshots[self.run.snapshots.numbers[n]])

    @property
    def widths(self):
        """Of every head at the end, m."""
        view = self.view(len(self.time) - 1)
        return np.array([head_size(view.positions, view.radii, head, self.radius).width for head in view.heads])


class MeanAvalanche:
    """The mean of the members' curves and numbers at equal times. A number that one member lacks the mean lacks too."""

    def __init__(self, members):
        self.members = members
        self.radius, self.speed, self.grains = members[0].radius, members[0].speed, members[0].grains
        if len({len(member.time) for member in members}) != 1:
            raise NotEvaluated("members differ in their number of data")

    @cached_property
    def time(self):
        return np.mean([member.time for member in self.members], axis=0)

    @cached_property
    def front_speed(self):
        times, values = common_part([member.front_speed for member in self.members])
        return times, values.mean(axis=0)

    @cached_property
    def front_speed_last(self):
        return np.mean([member.front_speed_last for member in self.members])

    @once
    def column(self, name):
        return np.mean([member.column(name) for member in self.members], axis=0)

    def number(self, name, n):
        return np.mean([member.number(name, n) for member in self.members])


class View:
    """One snapshot, and what several numbers need of it, made when it is first asked for."""

    def __init__(self, run, snapshot):
        self.run, self.snapshot, self.a = run, snapshot, run.radius
        self.positions = np.array(snapshot.positions)
        if run.from_the_side:
            self.positions[:, 1] = 0
        self.radii, self.velocity = np.asarray(snapshot["radius"]), np.asarray(snapshot["velocity"]) / run.speed
        self.front_speed = run.front_speed_at(snapshot.time)

    @cached_property
    def heads(self):
        """Largest first, each by index; none from the side."""
        return [] if self.run.from_the_side else find_heads(self.positions, self.a)

    @property
    def head(self):
        """The largest; None without one."""
        return self.heads[0] if self.heads else None

    @cached_property
    def size(self):
        return head_size(self.positions, self.radii, self.head, self.a)

    @cached_property
    def curls(self):
        """Of the head's grains, v_s/a; nan for one with too few others around it, or with all on one line."""
        i, j = pairs(self.positions, REACH * self.a)
        mine = np.isin(i, self.head)
        i, j = i[mine], j[mine]
        count = len(self.positions)
        others = np.bincount(i, minlength=count)

        def sum_over(values):
            return np.bincount(i, weights=values, minlength=count)

        def moment(first, second):
            """About the mean of i and the others; that of i is zero before."""
            return sum_over(first * second) - sum_over(first) * sum_over(second) / (others + 1)

        (x, y), (u, v) = (self.positions[j, :2] - self.positions[i, :2]).T, (self.velocity[j, :2] - self.velocity[i, :2]).T
        xx, xy, yy = moment(x, x), moment(x, y), moment(y, y)
        determinant = xx * yy - xy * xy
        with np.errstate(invalid="ignore", divide="ignore"):
            u_y = (moment(u, y) * xx - moment(u, x) * xy) / determinant
            v_x = (moment(v, x) * yy - moment(v, y) * xy) / determinant
            curl_of_all = v_x - u_y
        known = (others >= 2) & (determinant > 1e-12 * (xx + yy) ** 2)
        return np.where(known, curl_of_all, math.nan)[self.head] * self.a

    @cached_property
    def profile(self):
        return thickness_profile(self.positions, self.radii, self.a)


# ------------------------------------------------------------------------------------------------- numbers of a snapshot

def from_above(of):
    return lambda view: math.nan if view.run.from_the_side else of(view)


def of_size(name):
    """Of the largest head; nan without one."""
    return lambda view: math.nan if view.head is None else getattr(view.size, name)


def frontal_angle(view):
    """From the side, degrees; nan where fewer than three grains make the surface, or they prefer no direction."""
    walk = surface_walk(view.positions, view.a) if view.run.from_the_side else []
    return math.degrees(angle_of_line(view.positions, walk)) if len(walk) > 2 else math.nan


def in_head(of):
    """of(view, x, y, velocity relative to the front, y of the head's centre), of the head's grains; nan without a head."""
    def number(view):
        if view.head is None:
            return math.nan
        velocity = view.velocity[view.head] - [view.front_speed, 0, 0]
        centre = (view.size.left + view.size.right) / 2
        x, y = view.positions[view.head, :2].T
        return of(view, x, y, velocity, centre)
    return number


def curl(sign, view, _, y, __, centre):
    curls = view.curls[sign * (y - centre) > 0]
    return mean_of(curls[np.isfinite(curls)])


def rear_relative_velocity(view, x, y, velocity, centre):
    middle = view.size.foremost - 0.5 * view.size.thickness
    return mean_of(velocity[(x < middle) & (4 * np.abs(y - centre) <= view.size.width), 0])


def front_outward_velocity(view, x, y, velocity, centre):
    ahead = x > view.size.foremost - 0.5 * view.size.thickness
    return mean_of((velocity[:, 1] * np.sign(y - centre))[ahead])


def front_rear_thickness_ratio(view):
    if not view.run.from_the_side:
        return math.nan
    thickness, _, crest, _ = view.profile
    rear = thickness[(len(thickness) + 1) // 2:]
    return thickness[crest] / np.median(rear) if len(rear) else math.nan


def of_part(which, view):
    """How much faster than the front the upper head, the lower head or the tail runs."""
    if not view.run.from_the_side:
        return math.nan
    thickness, column, crest, head_columns = view.profile
    head, upper = column < head_columns, view.positions[:, 2] > UPPER_SHARE * thickness[crest]
    part = {"upper": head & upper, "lower": head & ~upper, "tail": ~head}[which]
    return mean_of(view.velocity[part, 0] - view.front_speed)


def displacement(of, view):
    start = view.run.view(0).snapshot.positions
    if len(start) != len(view.snapshot.positions):
        raise NotEvaluated("displacements need the same grains at the start and now")
    d = np.asarray(view.snapshot.positions) - start
    mean = d.mean(axis=0)
    apart = np.abs(d - mean).max(axis=0)
    return apart[0] / mean[0] if of == "spread" else apart[1] / view.a


SNAPSHOT_NUMBERS = {
    "front_speed": lambda view: view.front_speed,
    "head_count": from_above(lambda view: len(view.heads)),
    "head_particles": from_above(lambda view: 0 if view.head is None else len(view.head)),
    "head_width": of_size("width"),
    "head_thickness": of_size("thickness"),
    "frontal_angle": frontal_angle,
    "head_concavity": of_size("concavity"),
    "head_curl_left": in_head(partial(curl, 1)),
    "head_curl_right": in_head(partial(curl, -1)),
    "head_rear_relative_velocity": in_head(rear_relative_velocity),
    "head_front_outward_velocity": in_head(front_outward_velocity),
    "front_rear_thickness_ratio": front_rear_thickness_ratio,
    "head_upper_relative_velocity": partial(of_part, "upper"),
    "head_lower_relative_velocity": partial(of_part, "lower"),
    "tail_relative_velocity": partial(of_part, "tail"),
    "displacement_spread": partial(displacement, "spread"),
    "displacement_lateral": partial(displacement, "lateral"),
}
