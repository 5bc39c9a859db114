// SPDX-License-Identifier: Apache-2.0
/// Flow through a plane, from the mass beyond it: rates are means over a length of time, differences of a cumulative
/// curve, so that no grain is lost between data; their extremes, the period in which they fluctuate, and where they are
/// steady. A curve of a rate is brought into that form by integral(). Where a curve does not cover a window the result
/// is nan, or empty.
#pragma once

#include <span>

#include "analysis/curve.hpp"

namespace talus {

/// Integral of a curve from its first time on, by trapezoids.
Curve integral(const Curve& curve);

/// The curve times a factor, plus a constant: mass passed = total - mass above.
Curve scaled(const Curve& curve, double factor, double constant = 0);

/// True if the curve has data from `from` to `to`, but for rounding.
bool covers(const Curve& curve, double from, double to);

/// Mean over from..to of what the curve is the integral of.
double mean_rate(const Curve& cumulative, double from, double to);

/// Means over `length`, one every `every`, each whole within from..to; their times are their centres.
Curve mean_rates(const Curve& cumulative, double length, double every, double from, double to);

/// Time of the first value that is larger than all within `reach` before it and not smaller than any within `reach`
/// after it; nan if there is none. The curve has to cover the reach after it; before, it may begin later, as a rate
/// does that begins from nothing. The first value of a curve is no maximum.
double first_maximum_time(const Curve& values, double reach);

/// The curve less its own centred mean over `length`, of the data within from..to whose mean the curve covers.
Curve about_running_mean(const Curve& curve, double length, double from, double to);

/// A curve at equal times `1/rate` apart from `from` to `to`, linear between its points; empty if it does not cover
/// them. \param rate 1/s
Curve at_equal_times(const Curve& curve, double rate, double from, double to);

/// Power of a curve at equal times after its least-squares line was taken from it, with a Hann window, at frequencies a
/// quarter of its own resolution 1/T apart (zero-padded four times) from `least` to `most`: |sum|^2 over the square of
/// the window's sum, so that a sinusoid of amplitude A far from both ends has a peak of A^2/4.
/// \param least, most frequencies, 1/s, below half the rate of the data; the times of the result are the frequencies
/// \throws std::invalid_argument for fewer than four data
Curve power_spectrum(const Curve& curve, double least, double most);

/// Period of the highest peak of the power between two periods; nan if there is no peak: a value above its neighbours.
/// \param shortest > 0; nan for a curve of fewer than four data
double dominant_period(const Curve& curve, double shortest, double longest);

/// Mean time between the up-crossings of zero, linear between the data; nan for fewer than two crossings. Of a broad
/// spectrum, whose highest peak says little, it is Rice's mean period.
/// Source: S. O. Rice, Bell Syst. Tech. J. 23, 282 (1944), section 3.3.
double crossing_period(const Curve& curve);

struct Plateau {
  double from = no_value, to = no_value;  ///< its ends
  double value = no_value;                ///< mean rate between them
  double error = no_value;  ///< half width of its 95 % interval; nan where the stretch is too short for one
};

/// The longest stretch of consecutive means over `length`, five at least, that all lie within `spread` of their own
/// mean (relative); of several as long the first. A stretch does not begin before the rate has come to half of the
/// largest mean, so that a rest is no plateau. Nan where there is none.
///
/// The error is error_of_blocks(). \param cumulative the integral of the rate \param length of a mean
Plateau find_plateau(const Curve& cumulative, double length, double spread, double from, double to);

/// Half width of the 95 % interval of the mean rate over from..to, from the means of five to ten blocks of equal
/// length: Student's t times their standard error. A block is at least as long as `length`, and as three correlation
/// times of the means over a quarter of it, or over the time between the data if that is longer, so that blocks are
/// independent; nan where there is no room for five.
/// Source: Flyvbjerg & Petersen, J. Chem. Phys. 91 (1989) 461 (blocks); Sokal, Monte Carlo Methods (1997) (length)
double error_of_blocks(const Curve& cumulative, double length, double from, double to);

/// Integrated correlation time of equally spaced values, in their spacing: 1 + 2 sum of the correlations up to the
/// first that is not positive; 1 for independent ones.
double correlation_time(std::span<const double> values);

}  // namespace talus
