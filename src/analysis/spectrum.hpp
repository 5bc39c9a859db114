// SPDX-License-Identifier: Apache-2.0
/// The period in which a series fluctuates: the highest peak of its power spectrum.
#pragma once

#include "analysis/curve.hpp"

namespace talus {

/// A curve at equal times `1/rate` apart from `from` to `to`, linear between its points; empty if it does not cover
/// them. \param rate 1/s
Curve at_equal_times(const Curve& curve, double rate, double from, double to);

/// Power of a curve at equal times after its least-squares line was taken from it, with a Hann window, at frequencies a
/// quarter of its own resolution 1/T apart (zero-padded four times) from `least` to `most`: |sum|^2 over the square of
/// the window's sum, so that a sinusoid of amplitude A far from both ends has a peak of A^2/4. As the plain sums: a
/// thousand data and some hundred frequencies do not need a fast transform.
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

}  // namespace talus
