// SPDX-License-Identifier: Apache-2.0
/// Flow through a plane, from the mass beyond it: rates are means over a length of time, differences of a cumulative
/// curve, so that no grain is lost between data. A curve of a rate is brought into that form by integral(). Where a
/// curve does not cover a window the result is nan, or empty.
#pragma once

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

}  // namespace talus
