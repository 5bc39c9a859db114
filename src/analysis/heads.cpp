// SPDX-License-Identifier: Apache-2.0
#include "analysis/heads.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace talus {

namespace {

using Numbers = std::vector<std::uint32_t>;
constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double reach = 4;     // mean radii
constexpr double share = 0.25;  // of the largest number
constexpr std::size_t least = 5;

std::uint32_t max_number(const Numbers& number, const GrainSet& grains) {
  std::uint32_t largest = 0;
  for (const std::uint32_t i : grains) largest = std::max(largest, number[i]);
  return largest;
}

}  // namespace

NeighbourNumbers neighbour_numbers(const Links& links) {
  NeighbourNumbers numbers;
  for (std::size_t i = 0; i < links.size(); ++i)
    numbers.direct.push_back(static_cast<std::uint32_t>(links.of(i).size()));
  for (std::size_t i = 0; i < links.size(); ++i) {
    std::uint32_t sum = 0;
    for (const std::uint32_t j : links.of(i)) sum += numbers.direct[j];
    numbers.indirect.push_back(sum);
  }
  return numbers;
}

std::vector<GrainSet> find_heads(std::span<const Vector3> position, double mean_radius) {
  if (position.empty()) return {};
  const Links links(position, reach * mean_radius);
  const Numbers number = neighbour_numbers(links).indirect;

  const double limit = share * *std::max_element(number.begin(), number.end());
  std::vector<bool> candidate(position.size(), false);
  for (const GrainSet& part : links.connected_sets(std::vector<bool>(position.size(), true))) {
    const std::uint32_t largest = max_number(number, part);
    if (largest <= limit) continue;
    for (const std::uint32_t i : part) candidate[i] = number[i] > share * largest;
  }
  std::vector<GrainSet> heads = links.connected_sets(candidate);
  std::erase_if(heads, [&](const GrainSet& head) { return head.size() < least; });
  std::sort(heads.begin(), heads.end(),
            [&](const GrainSet& a, const GrainSet& b) { return is_larger(a, b, position); });
  return heads;
}

HeadSize head_size(std::span<const Vector3> position, std::span<const double> radius, const GrainSet& head,
                   double mean_radius) {
  HeadSize size;
  double left = -infinity, right = infinity;
  size.foremost = -infinity;
  for (const std::uint32_t i : head) {
    left = std::max(left, position[i].y + radius[i]);
    right = std::min(right, position[i].y - radius[i]);
    size.foremost = std::max(size.foremost, position[i].x + radius[i]);
  }
  size.width = left - right;
  size.centre = 0.5 * (left + right);

  // GrainSet in the order of y, so that a window is a run of them.
  GrainSet across = head;
  std::sort(across.begin(), across.end(),
            [&](std::uint32_t a, std::uint32_t b) { return position[a].y < position[b].y; });
  const double half = 0.5 * reach * mean_radius;
  size.inner = -infinity;
  for (std::size_t n = 0, begin = 0; n < across.size(); ++n) {
    const Vector3& x = position[across[n]];
    if (!size.in_central_half(x)) continue;
    while (position[across[begin]].y < x.y - half) ++begin;
    double boundary = infinity;
    for (std::size_t m = begin; m < across.size() && position[across[m]].y <= x.y + half; ++m)
      boundary = std::min(boundary, position[across[m]].x - radius[across[m]]);
    size.inner = std::max(size.inner, boundary);
  }
  if (size.inner == -infinity) size.inner = std::numeric_limits<double>::quiet_NaN();
  size.thickness = size.foremost - size.inner;
  return size;
}

}  // namespace talus
