# SPDX-License-Identifier: Apache-2.0
"""The quantities of Niiya, Awazu & Nishimori 2020 that only its table needs: of the mean curves of an ensemble, of all its
heads, of the motion within heads and tails. Times in a/v_s, velocities over v_s; a is the mean radius of the case, v_s the
speed of one grain alone (Stokes). Definitions: [estimator] of reference.toml.
"""
import math
from functools import partial

import numpy as np
from avalanche import Avalanche, MeanAvalanche, common_part

from talus.curves import Curve, curve, first_time_at_or_below, part
from talus.curves import mean as mean_of
from talus.measures import NotEvaluated, Quantity, once
from talus.samples import anderson_darling, finite_values, fit_line, skewness, spearman_correlation

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
        time, speed = part(Curve(*run.front_speed), window.begin, window.end)
        return of(run, time, speed) if len(time) else math.nan
    return value


def slopes(time, speed):
    """Of the lines through the first and the second half; the middle of the time belongs to the first."""
    end = time[-1]
    return [fit_line(*part(Curve(time, speed), *half))[0] for half in ((0, 0.5 * end), (0.5 * end, end))]


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
        _, ratio = part(Curve(run.time[1:], ratio), window.begin, window.end)
        return of(ratio) if len(ratio) else math.nan
    return value


def head_particles_first(run, _):
    run = avalanche(run)
    return run.column("head_particles")[1] / run.grains if len(run.time) > 1 else math.nan


def head_particles_half_time(run, _):
    run = avalanche(run)
    return first_time_at_or_below(curve(run.time, run.column("head_particles")), 0.5 * run.grains)


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
    _, speed = common_part([part(Curve(*member.front_speed), window.begin, window.end) for member in members])
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


def _at(name, unit, text, **more):
    return Quantity(unit, text, at(name), **more)


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
    "head_count": _at(
        "head_count", "1", "number of heads: connected sets (link 4 a) of at least 5 grains whose n' is above a quarter of the "
        "largest in their part of the avalanche; n' is the sum of the neighbours' numbers of neighbours, within 4 a"),
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
    "frontal_angle": _at(
        "frontal_angle", "deg", "seen from the side: angle between the slope behind the front and the line through the surface "
        "grains from the foremost up to the top; below 90 the front leans back", may_be_missing=True),
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
