# SPDX-License-Identifier: Apache-2.0
"""The quantities of Niiya, Awazu & Nishimori 2020 that only its table needs: of the mean curves of an ensemble, of all its
heads, of the motion within heads and tails. Times in a/v_s, velocities over v_s; a is the mean radius of the case, v_s the
speed of one grain alone (Stokes). Definitions: [estimator] of reference.toml.
"""
import math
from functools import cached_property, partial

import numpy as np
from grains import REACH, find_heads, head_size, pairs

from talus.measures import NotEvaluated, Quantity, once

FRONT_WINDOW = 0.25  # of the front speed, a/v_s
COLUMN = 4           # length of a column along the slope, in radii
STRAGGLERS = 0.05    # share of the grains, the rearmost, that the rear does not reach back to
HEAD_SHARE = 0.5     # of the head's thickness, down to which columns behind it belong to it
UPPER_SHARE = 2 / 3  # of the head's thickness, above which a grain belongs to the upper head
ROUNDING = 1e-9      # between times that count as equal, which are sums of steps


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
        """A number of every snapshot: of analysis/snapshots.csv, or of SNAPSHOT_NUMBERS."""
        if name not in self._columns:
            if name in SNAPSHOT_NUMBERS:
                self._columns[name] = np.array([self.number(name, n) for n in range(len(self.time))])
            else:
                table = self.run.table("snapshots")
                self._columns[name] = np.asarray(table[name]) if name in table else np.full(len(self.time), math.nan)
        return self._columns[name]

    def number(self, name, n):
        """A number of the n-th snapshot."""
        return SNAPSHOT_NUMBERS[name](self.view(n)) if name in SNAPSHOT_NUMBERS else self.column(name)[n]

    @once
    def view(self, n):
        return View(self, self.run.snapshots[self.run.snapshots.numbers[n]])

    @property
    def widths(self):
        """Of every head at the end, m."""
        return np.asarray(self.run.table("head_widths")["width"])


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
    def head(self):
        """The largest, by index; None without one, or from the side."""
        heads = [] if self.run.from_the_side else find_heads(self.positions, self.a)
        return heads[0] if heads else None

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


def thickness_profile(positions, radii, a):
    """Of an avalanche seen from the side: thickness of the columns counted backwards from the foremost centre to the one
    that holds the last grain which is no straggler, the column of each grain, and of the columns the crest (the thickest of
    the front half) and how many belong to the head."""
    x, z = positions[:, 0], positions[:, 2]
    column = ((x.max() - x) / (COLUMN * a)).astype(int)
    count = int((x.max() - np.quantile(x, STRAGGLERS)) / (COLUMN * a)) + 1
    thickness = np.zeros(count)
    within = column < count
    np.maximum.at(thickness, column[within], (z + radii)[within])
    crest = int(thickness[:(count + 1) // 2].argmax())
    thin = np.flatnonzero(thickness[crest + 1:] < HEAD_SHARE * thickness[crest])
    return thickness, column, crest, crest + 1 + (int(thin[0]) if len(thin) else count - crest - 1)


def mean_of(values):
    return values.mean() if len(values) else math.nan


# ------------------------------------------------------------------------------------------------- numbers of a snapshot

def concavity(view):
    if view.head is None:
        return math.nan
    x, y = view.positions[view.head, :2].T
    rear, centre = x - view.radii[view.head], (view.size.left + view.size.right) / 2
    sides = rear[y > centre], rear[y < centre]
    if not all(map(len, sides)):
        return math.nan
    return (view.size.inner - sum(side.min() for side in sides) / 2) / view.size.thickness


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
    "head_concavity": concavity,
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


# --------------------------------------------------------------------------------------------------- curves, statistics

def part(curve, begin, end):
    """The part of a curve with begin < t <= end."""
    time, value = curve
    inside = (time > begin + ROUNDING * abs(begin)) & (time <= end + ROUNDING * abs(end) if math.isfinite(end) else True)
    return time[inside], value[inside]


def common_part(curves):
    """Times and values of curves cut to as many points as the shortest has: runs end with the step that passes their end,
    which may just complete a window in one and not in another."""
    count = min(len(time) for time, _ in curves)
    times = curves[0][0][:count]
    for time, _ in curves:
        if count and np.abs(time[:count] - times).max() > 1e-6 * abs(times[-1]):
            raise NotEvaluated("the curves of the members differ in their times")
    return times, np.array([value[:count] for _, value in curves])


def fit_line(x, y, *, through_origin=False):
    """Slope of the line of least squares, and 1 - sum of squared residuals over the sum of squares about the mean of y."""
    x, y = np.asarray(x, dtype=float), np.asarray(y, dtype=float)
    if through_origin:
        slope, intercept = (x * y).sum() / (x * x).sum(), 0.0
    else:
        scatter = ((x - x.mean()) ** 2).sum() if len(x) else 0.0
        if not scatter > 0:
            return math.nan, math.nan
        slope = ((x - x.mean()) * (y - y.mean())).sum() / scatter
        intercept = y.mean() - slope * x.mean()
    total = ((y - y.mean()) ** 2).sum()
    return slope, 1 - ((y - intercept - slope * x) ** 2).sum() / total if total > 0 else math.nan


def spearman_correlation(x, y):
    """Correlation of the ranks, equal values sharing their mean rank."""
    def ranks(sample):
        _, which, counts = np.unique(sample, return_inverse=True, return_counts=True)
        last = np.cumsum(counts)
        return (last - (counts - 1) / 2)[which]
    x, y = ranks(np.asarray(x)), ranks(np.asarray(y))
    x, y = x - x.mean(), y - y.mean()
    scatter = (x * x).sum() * (y * y).sum()
    return (x * y).sum() / math.sqrt(scatter) if scatter > 0 else math.nan


def skewness(sample):
    """Third central moment over the 3/2 power of the second."""
    d = np.asarray(sample) - np.mean(sample)
    second = (d**2).mean()
    return (d**3).mean() / second**1.5 if second > 0 else math.nan


def anderson_darling(sample):
    """Adjusted statistic, A² (1 + 0.75/n + 2.25/n²), of the test of normality with mean and standard deviation of the
    sample, and the probability of a larger one: D'Agostino & Stephens, Goodness-of-Fit Techniques (1986), table 4.9. nan
    below 8 values, to which the table does not reach."""
    sample = np.sort(sample)
    n = len(sample)
    if n < 8 or not sample.std() > 0:
        return math.nan, math.nan
    z = (sample - sample.mean()) / sample.std(ddof=1)
    below = np.array([log_normal_below(value) for value in z])
    above = np.array([log_normal_below(-value) for value in z[::-1]])
    a = -n - ((2 * np.arange(n) + 1) * (below + above)).sum() / n
    a *= 1 + 0.75 / n + 2.25 / n**2
    return a, anderson_darling_p_value(a)


def log_normal_below(z):
    """Logarithm of the standard normal distribution function. Below -37, where erfc underflows, the first term of the
    tail's asymptotic series errs by less than 1/z² < 1e-3, in a logarithm of -690."""
    if z < -37:
        return -0.5 * z * z - math.log(-z) - 0.5 * math.log(2 * math.pi)
    return math.log(0.5 * math.erfc(-z / math.sqrt(2)))


def anderson_darling_p_value(a):
    if a > 10:  # the formulas turn around far outside the table
        return 0.0
    if a >= 0.6:
        return math.exp(1.2937 - 5.709 * a + 0.0186 * a * a)
    if a >= 0.34:
        return math.exp(0.9177 - 4.279 * a - 1.38 * a * a)
    if a >= 0.2:
        return 1 - math.exp(-8.318 + 42.796 * a - 59.938 * a * a)
    return 1 - math.exp(-13.436 + 101.14 * a - 223.73 * a * a)


def finite_values(numbers):
    """Those that are not nan, as long as the others are the fewer; else none."""
    numbers = np.asarray(numbers)
    there = numbers[np.isfinite(numbers)]
    return there if 2 * len(there) >= len(numbers) else there[:0]


# ------------------------------------------------------------------------------------------------- numbers of one run

@once
def _avalanche_of(run):
    return Avalanche(run)


def avalanche(run):
    """A run, or the mean of runs, in the units of the paper."""
    return run if isinstance(run, (Avalanche, MeanAvalanche)) else _avalanche_of(run)


def mean(runs):
    return MeanAvalanche([avalanche(run) for run in runs])


def of_front_speed(of):
    """of(run, times, values) of the front speed within the window."""
    def value(run, window):
        run = avalanche(run)
        time, speed = part(run.front_speed, window.begin, window.end)
        return of(run, time, speed) if len(time) else math.nan
    return value


def slopes(time, speed):
    """Of the lines through the first and the second half; the middle of the time belongs to the first."""
    end = time[-1]
    return [fit_line(*part((time, speed), *half))[0] for half in ((0, 0.5 * end), (0.5 * end, end))]


def at(name):
    """A number of the snapshot nearest to the window's time, of two the earlier; the start counts only where it is all."""
    def value(run, window):
        run = avalanche(run)
        if len(run.time) == 0:
            return math.nan
        first = min(1, len(run.time) - 1)
        last = window.at is None or math.isinf(window.at)
        return run.number(name, len(run.time) - 1 if last else first + int(np.abs(run.time[first:] - window.at).argmin()))
    return value


def of_aspect_ratio(of):
    def value(run, window):
        run = avalanche(run)
        ratio = run.column("head_width")[1:] / run.column("head_thickness")[1:]
        _, ratio = part((run.time[1:], ratio), window.begin, window.end)
        return of(ratio) if len(ratio) else math.nan
    return value


def head_particles_first(run, _):
    run = avalanche(run)
    return run.column("head_particles")[1] / run.grains if len(run.time) > 1 else math.nan


def head_particles_half_time(run, _):
    run = avalanche(run)
    time, particles, level = run.time, run.column("head_particles"), 0.5 * run.grains
    below = np.flatnonzero(particles <= level)
    if len(below) == 0 or below[0] == 0:
        return time[0] if len(below) else math.nan
    n = below[0]
    return time[n - 1] + (time[n] - time[n - 1]) * (particles[n - 1] - level) / (particles[n - 1] - particles[n])


def head_particles_trend(run, _):
    run = avalanche(run)
    return spearman_correlation(run.column("head_particles")[1:], run.time[1:])


def head_speed_correlation(from_largest, run, _):
    run = avalanche(run)
    speed, particles = run.column("front_speed")[1:], run.column("head_particles")[1:]
    first = int(speed.argmax()) if from_largest else 0
    return spearman_correlation(particles[first:], speed[first:])


# ---------------------------------------------------------------------------------------- numbers of members and radii

def avalanches(runs, least=1):
    if len(runs) < least:
        raise NotEvaluated(f"takes {least} members")
    return [avalanche(run) for run in runs]


def front_speed_spread(groups, window):
    members = avalanches(groups[0], 2)
    _, speed = common_part([part(member.front_speed, window.begin, window.end) for member in members])
    return mean_of(speed.std(axis=0, ddof=1) / speed.mean(axis=0))


def frontal_angle_spread_ratio(groups, _):
    members = avalanches(groups[0], 2)
    angles = np.array([member.column("frontal_angle")[1:] for member in members]).T
    deviation = np.array([there.std(ddof=1) if len(there := finite_values(of_time)) > 1 else math.nan
                          for of_time in angles])
    quarter = len(deviation) // 4
    return mean_of(deviation[len(deviation) - quarter:]) / mean_of(deviation[:quarter])


def widths_in_radii(runs):
    return np.concatenate([member.widths / member.radius for member in avalanches(runs)])


def widths_of_radii(groups):
    """Radius and widths in radii of each; what is asked of a line takes three."""
    if len(groups) < 3 or not all(groups):
        raise NotEvaluated("takes runs of three radii")
    return [avalanche(runs[0]).radius for runs in groups], [widths_in_radii(runs) for runs in groups]


def head_width_median_spread(groups, _):
    medians = [np.median(widths) for widths in widths_of_radii(groups)[1]]
    return (max(medians) - min(medians)) / np.mean(medians)


def width_line(through_origin, groups, _):
    radii, widths = widths_of_radii(groups)
    return fit_line(radii, [w.mean() * a for w, a in zip(widths, radii)], through_origin=through_origin)[1]


def _at(name, unit, text):
    return Quantity(unit, text, at(name))


QUANTITIES = {
    "front_speed_max": Quantity(
        "1", "largest front speed over v_s of the mean curve. Front: the largest x of a grain's centre, seen from the side of "
        "those lower than 2 a; speed: its displacement over 0.25 a/v_s, one every 0.25 a/v_s",
        of_front_speed(lambda run, time, speed: speed.max())),
    "front_speed_min": Quantity("1", "the smallest of them", of_front_speed(lambda run, time, speed: speed.min())),
    "front_speed_max_time": Quantity(
        "1", "time of the largest front speed, in a/v_s", of_front_speed(lambda run, time, speed: time[speed.argmax()])),
    "front_speed_rise": Quantity("1", "largest front speed over the first one", of_front_speed(
        lambda run, time, speed: speed.max() / run.front_speed[1][0])),
    "front_speed_fall": Quantity("1", "largest front speed over that of the run's last 0.25 a/v_s", of_front_speed(
        lambda run, time, speed: speed.max() / run.front_speed_last)),
    "front_speed_slope_early": Quantity(
        "1", "slope of the line through the first half of the front-speed curve, in v_s per a/v_s",
        of_front_speed(lambda run, time, speed: slopes(*run.front_speed)[0])),
    "front_speed_slope_change": Quantity("1", "that of the second half less it", of_front_speed(
        lambda run, time, speed: slopes(*run.front_speed)[1] - slopes(*run.front_speed)[0])),
    "front_speed": _at("front_speed", "1", "front speed over v_s at the snapshot"),
    "head_aspect_ratio": Quantity(
        "1", "width over thickness of the largest head, of their means over the members; mean over the snapshots",
        of_aspect_ratio(np.mean)),
    "head_aspect_ratio_min": Quantity("1", "the smallest of them", of_aspect_ratio(np.min)),
    "head_aspect_ratio_max": Quantity("1", "the largest of them", of_aspect_ratio(np.max)),
    "head_concavity": _at(
        "head_concavity", "1", "how far the head's rear boundary is ahead at its centre of its two sides, over the thickness; "
        "positive for a crescent"),
    "head_curl_left": _at("head_curl_left", "1", "mean curl of the velocity in the left half of the head, in v_s/a"),
    "head_curl_right": _at("head_curl_right", "1", "mean curl of the velocity in the right half of the head, in v_s/a"),
    "head_rear_relative_velocity": _at(
        "head_rear_relative_velocity", "1", "how much faster than the front the head's central rear runs, over v_s"),
    "head_front_outward_velocity": _at(
        "head_front_outward_velocity", "1", "velocity away from the centre line in the head's front half, over v_s"),
    "head_particles_first": Quantity(
        "1", "share of the grains in the largest head at the first data", head_particles_first),
    "head_particles_half_time": Quantity(
        "1", "time at which the largest head holds half of the grains, in a/v_s", head_particles_half_time),
    "head_particles_trend": Quantity(
        "1", "rank correlation of the largest head's grains with time", head_particles_trend),
    "head_particles_front_speed_correlation": Quantity(
        "1", "rank correlation of the largest head's grains with the front speed, from its largest value on",
        partial(head_speed_correlation, True)),
    "head_particles_front_speed_correlation_all": Quantity(
        "1", "rank correlation of the largest head's grains with the front speed, over the whole run",
        partial(head_speed_correlation, False)),
    "front_rear_thickness_ratio": _at(
        "front_rear_thickness_ratio", "1", "thickness of the head over the median thickness of the rear half, from the side"),
    "head_upper_relative_velocity": _at(
        "head_upper_relative_velocity", "1", "how much faster than the front the upper head runs, over v_s"),
    "head_lower_relative_velocity": _at(
        "head_lower_relative_velocity", "1", "how much faster than the front the lower head runs, over v_s"),
    "tail_relative_velocity": _at(
        "tail_relative_velocity", "1", "how much faster than the front the tail runs, over v_s"),
    "frontal_angle_first": Quantity(
        "deg", "frontal_angle at the first data", lambda run, _: avalanche(run).number("frontal_angle", 1)
        if len(avalanche(run).time) > 1 else math.nan, may_be_missing=True),
    "displacement_spread": _at(
        "displacement_spread", "1",
        "largest difference of a grain's displacement from the mean, along x, over the mean; from the start on"),
    "displacement_lateral": _at(
        "displacement_lateral", "1", "largest difference of a grain's displacement from the mean, along y, over a"),
    "contact_weight_ratio": Quantity(
        "1", "contact force at an overlap of 0.01 a over a grain's weight in the fluid: the γ of Eq. 9",
        lambda run, _: avalanche(run).contact_weight_ratio),
    "front_speed_spread": Quantity(
        "1", "standard deviation of the front speed between members over its mean, mean over the window",
        front_speed_spread, together=True),
    "frontal_angle_spread_ratio": Quantity(
        "1", "spread of the frontal angle between members, last quarter of the run over first",
        frontal_angle_spread_ratio, together=True),
    "head_width_normality_p_value": Quantity(
        "1", "Anderson-Darling test of the widths of all heads of all members at the end",
        lambda groups, _: anderson_darling(widths_in_radii(groups[0]))[1], together=True),
    "head_width_skewness": Quantity(
        "1", "skewness of them", lambda groups, _: skewness(widths_in_radii(groups[0])), together=True),
    "head_width_median_spread": Quantity(
        "1", "range of the radii's median widths (in a) over their mean", head_width_median_spread, together=True),
    "head_width_line_r_squared": Quantity(
        "1", "R² of the line of the mean width against the radius", partial(width_line, False), together=True),
    "head_width_line_origin_r_squared": Quantity(
        "1", "the same through the origin", partial(width_line, True), together=True),
}
