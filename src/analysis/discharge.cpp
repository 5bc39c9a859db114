// SPDX-License-Identifier: Apache-2.0
#include "analysis/discharge.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <memory>
#include <numbers>
#include <span>
#include <stdexcept>
#include <vector>

#include "analysis/statistics.hpp"

namespace talus {

Curve integral(const Curve& curve) {
  Curve sum{curve.time, std::vector<double>(curve.time.size(), 0.0)};
  for (std::size_t n = 1; n < curve.time.size(); ++n)
    sum.value[n] = sum.value[n - 1] + 0.5 * (curve.value[n] + curve.value[n - 1]) * (curve.time[n] - curve.time[n - 1]);
  return sum;
}

Curve scaled(const Curve& curve, double factor, double constant) {
  Curve result = curve;
  for (double& value : result.value) value = constant + factor * value;
  return result;
}

bool covers(const Curve& curve, double from, double to) {
  const auto rounding = [](double t) { return 1e-9 * std::abs(t); };
  return !curve.time.empty() && curve.time.front() <= from + rounding(from) && to - rounding(to) <= curve.time.back();
}

double mean_rate(const Curve& cumulative, double from, double to) {
  if (!covers(cumulative, from, to) || !(to > from)) return no_value;
  return (value_at(cumulative, to) - value_at(cumulative, from)) / (to - from);
}

Curve mean_rates(const Curve& cumulative, double length, double every, double from, double to) {
  Curve means;
  for (std::size_t n = 0;; ++n) {
    const double start = from + static_cast<double>(n) * every, end = start + length;
    if (end > to + 1e-9 * std::abs(to)) return means;
    if (!covers(cumulative, start, end)) continue;
    means.time.push_back(start + 0.5 * length);
    means.value.push_back(mean_rate(cumulative, start, end));
  }
}

double first_maximum_time(const Curve& values, double reach) {
  for (std::size_t n = 1; n < values.time.size(); ++n) {
    if (!covers(values, values.time[n], values.time[n] + reach)) break;
    bool largest = true;
    for (std::size_t m = 0; m < values.time.size() && largest; ++m) {
      if (m == n || std::abs(values.time[m] - values.time[n]) > reach * (1 + 1e-9)) continue;
      largest = m < n ? values.value[m] < values.value[n] : values.value[m] <= values.value[n];
    }
    if (largest) return values.time[n];
  }
  return no_value;
}

Curve about_running_mean(const Curve& curve, double length, double from, double to) {
  const Curve sums = integral(curve);
  Curve left;
  for (std::size_t n = 0; n < curve.time.size(); ++n) {
    const double t = curve.time[n];
    if (t <= from || t > to || !covers(sums, t - 0.5 * length, t + 0.5 * length)) continue;
    left.time.push_back(t);
    left.value.push_back(curve.value[n] - mean_rate(sums, t - 0.5 * length, t + 0.5 * length));
  }
  return left;
}

Curve at_equal_times(const Curve& curve, double rate, double from, double to) {
  Curve equal;
  if (!covers(curve, from, to)) return equal;
  const auto last = static_cast<std::size_t>(std::floor((to - from) * rate * (1 + 1e-9)));
  for (std::size_t n = 0; n <= last; ++n) {
    equal.time.push_back(from + static_cast<double>(n) / rate);
    equal.value.push_back(value_at(curve, equal.time.back()));
  }
  return equal;
}

Curve power_spectrum(const Curve& curve, double least, double most) {
  const std::size_t count = curve.time.size();
  if (count < 4) throw std::invalid_argument("a spectrum needs four data");
  const double n = static_cast<double>(count);
  const double interval = (curve.time.back() - curve.time.front()) / (n - 1);
  const Line line = fit_line(curve.time, curve.value);
  constexpr std::size_t padded = 4;  // times as long, with zeros
  std::vector<double> tapered(padded * count, 0.0);
  double window_sum = 0;
  for (std::size_t k = 0; k < count; ++k) {
    const double window = 0.5 - 0.5 * std::cos(2 * std::numbers::pi * static_cast<double>(k) / n);
    window_sum += window;
    tapered[k] = window * (curve.value[k] - line.intercept - line.slope * curve.time[k]);
  }
  std::vector<std::complex<double>> spectrum(tapered.size() / 2 + 1);
  const std::unique_ptr<fftw_plan_s, decltype(&fftw_destroy_plan)> plan(
      fftw_plan_dft_r2c_1d(static_cast<int>(tapered.size()), tapered.data(),
                           reinterpret_cast<fftw_complex*>(spectrum.data()), FFTW_ESTIMATE),
      fftw_destroy_plan);
  fftw_execute(plan.get());

  Curve power;
  const double step = 1 / (padded * n * interval);
  for (auto k = static_cast<std::size_t>(std::ceil(least / step));
       k < spectrum.size() && static_cast<double>(k) * step <= most; ++k) {
    power.time.push_back(static_cast<double>(k) * step);
    power.value.push_back(std::norm(spectrum[k]) / (window_sum * window_sum));
  }
  return power;
}

double dominant_period(const Curve& curve, double shortest, double longest) {
  double period = no_value, highest = 0;
  if (curve.time.size() < 4) return period;
  const Curve power = power_spectrum(curve, 1 / longest, 1 / shortest);
  for (std::size_t k = 1; k + 1 < power.value.size(); ++k)
    if (power.value[k] > highest && power.value[k] > power.value[k - 1] && power.value[k] >= power.value[k + 1]) {
      highest = power.value[k];
      period = 1 / power.time[k];
    }
  return period;
}

double crossing_period(const Curve& curve) {
  double begin = 0, end = 0, crossings = 0;
  for (std::size_t n = 1; n < curve.time.size(); ++n) {
    const double before = curve.value[n - 1], now = curve.value[n];
    if (!(before < 0 && now >= 0)) continue;
    end = std::lerp(curve.time[n - 1], curve.time[n], before / (before - now));
    if (crossings++ == 0) begin = end;
  }
  return crossings > 1 ? (end - begin) / (crossings - 1) : no_value;
}

namespace {

constexpr std::size_t fewest = 5;

struct Stretch {
  std::size_t begin = 0, count = 0;
};

/// The longest stretch of which every mean lies within the spread of their mean.
Stretch max_level_stretch(std::span<const double> means, double least, double spread) {
  Stretch best{.count = fewest - 1};
  for (std::size_t n = 0; n + best.count < means.size(); ++n) {
    if (means[n] < least) continue;
    double sum = 0, low = means[n], high = means[n];
    for (std::size_t end = n; end < means.size(); ++end) {
      sum += means[end], low = std::min(low, means[end]), high = std::max(high, means[end]);
      const std::size_t count = end - n + 1;
      const double middle = sum / static_cast<double>(count), most = spread * std::abs(middle);
      if (count > best.count && high - middle <= most && middle - low <= most) best = {n, count};
    }
  }
  return best.count < fewest ? Stretch{} : best;
}

}  // namespace

double correlation_time(std::span<const double> values) {
  const double middle = mean(values);
  const auto product = [&](std::size_t apart) {
    double sum = 0;
    for (std::size_t n = apart; n < values.size(); ++n) sum += (values[n] - middle) * (values[n - apart] - middle);
    return sum;
  };
  const double square = product(0);
  double time = 1;
  for (std::size_t apart = 1; square > 0 && 2 * apart < values.size(); ++apart) {
    const double correlation = product(apart) / square;
    if (!(correlation > 0)) break;
    time += 2 * correlation;
  }
  return time;
}

double error_of_blocks(const Curve& cumulative, double length, double from, double to) {
  constexpr double in_length = 4, times = 3, max_blocks = 10;
  const auto is_within = [&](double t) { return from <= t && t <= to; };
  const auto points = std::count_if(cumulative.time.begin(), cumulative.time.end(), is_within);
  const double apart = (to - from) / std::max(1.0, static_cast<double>(points - 1));  // between them nothing is known
  const double step = std::max(length / in_length, apart);
  const Curve fine = mean_rates(cumulative, step, step, from, to);
  const double count = static_cast<double>(fine.value.size());
  const double block = std::max(times * correlation_time(fine.value), length / step);
  const double blocks = std::min(max_blocks, std::floor(count / block));
  if (!(blocks >= static_cast<double>(fewest))) return no_value;
  const double each = (to - from) / blocks;
  std::vector<double> means;
  for (double n = 0; n < blocks; ++n)
    means.push_back(mean_rate(cumulative, from + n * each, std::min(from + (n + 1) * each, to)));
  return student_t(blocks - 1) * standard_deviation(means) / std::sqrt(blocks);
}

Plateau find_plateau(const Curve& cumulative, double length, double spread, double from, double to) {
  const Curve means = mean_rates(cumulative, length, length, from, to);
  if (means.value.size() < fewest) return {};
  const double half = 0.5 * *std::max_element(means.value.begin(), means.value.end());
  if (!(half > 0)) return {};
  const Stretch level = max_level_stretch(means.value, half, spread);
  if (level.count == 0) return {};
  const double begin = means.time[level.begin] - 0.5 * length,
               end = means.time[level.begin + level.count - 1] + 0.5 * length;
  return {.from = begin,
          .to = end,
          .value = mean(std::span<const double>(means.value).subspan(level.begin, level.count)),
          .error = error_of_blocks(cumulative, length, begin, end)};
}

}  // namespace talus
