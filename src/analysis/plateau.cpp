// SPDX-License-Identifier: Apache-2.0
#include "analysis/plateau.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <span>
#include <vector>

#include "analysis/discharge.hpp"
#include "analysis/statistics.hpp"

namespace talus {

namespace {

constexpr std::size_t fewest = 5;

struct Stretch {
  std::size_t begin = 0, count = 0;
};

/// The longest stretch of which every mean lies within the spread of their mean.
Stretch longest_level(std::span<const double> means, double least, double spread) {
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
  constexpr double in_length = 4, times = 3, most_blocks = 10;
  const Curve fine = mean_rates(cumulative, length / in_length, length / in_length, from, to);
  const double count = static_cast<double>(fine.value.size());
  const double block = std::max(times * correlation_time(fine.value), in_length);
  const double blocks = std::min(most_blocks, std::floor(count / block));
  if (!(blocks >= static_cast<double>(fewest))) return Plateau::none;
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
  const Stretch level = longest_level(means.value, half, spread);
  if (level.count == 0) return {};
  const double begin = means.time[level.begin] - 0.5 * length,
               end = means.time[level.begin + level.count - 1] + 0.5 * length;
  return {.from = begin,
          .to = end,
          .value = mean(std::span<const double>(means.value).subspan(level.begin, level.count)),
          .error = error_of_blocks(cumulative, length, begin, end)};
}

}  // namespace talus
