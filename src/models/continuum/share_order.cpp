// SPDX-License-Identifier: Apache-2.0
/// The places of the particles in the order of all.
#include <algorithm>
#include <limits>
#include <numeric>
#include <tuple>

#include "models/continuum/share.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::continuum {

namespace {

constexpr std::size_t samples_of_rank = 32;  // from which the borders of a common sort are chosen

std::vector<std::uint32_t> numbers(std::size_t count) {
  std::vector<std::uint32_t> numbers(count);
  std::iota(numbers.begin(), numbers.end(), 0u);
  return numbers;
}

/// A particle in the common sort.
struct Sorted {
  std::uint64_t key;
  std::int64_t place;
  std::int64_t rank, number;  // where it is
  bool operator<(const Sorted& other) const { return std::tie(key, place) < std::tie(other.key, other.place); }
};

/// The borders between what each process sorts, chosen from samples of all. \param own sorted
std::vector<Sorted> borders(const Ranks& ranks, const std::vector<Sorted>& own) {
  std::vector<Sorted> samples;
  for (std::size_t n = 0; n < std::min(samples_of_rank, own.size()); ++n)
    samples.push_back(own[n * own.size() / std::min(samples_of_rank, own.size())]);
  samples = ranks.gather_values(samples);
  std::sort(samples.begin(), samples.end());
  std::vector<Sorted> borders;
  const auto size = static_cast<std::size_t>(ranks.size());
  for (std::size_t r = 1; r < size && !samples.empty(); ++r) borders.push_back(samples[r * samples.size() / size]);
  return borders;
}

}  // namespace

/// The order of the particles by their places. \param own how many come first, which mostly are in it
std::vector<std::uint32_t> Share::by_place(std::size_t own) const {
  std::vector<std::uint32_t> order = numbers(place_.size());
  const auto before = [&](std::uint32_t a, std::uint32_t b) { return place_[a] < place_[b]; };
  const auto middle = order.begin() + static_cast<std::ptrdiff_t>(own);
  if (!std::is_sorted(order.begin(), middle, before)) std::sort(order.begin(), middle, before);
  std::sort(middle, order.end(), before);
  std::inplace_merge(order.begin(), middle, order.end(), before);
  return order;
}

void Share::sort(const State& s, double cell_size) {
  if (is_all()) return;
  const Stopwatch watch(time_.sharing);
  constexpr double infinity = std::numeric_limits<double>::infinity();
  Votes votes{.least = {infinity, infinity, infinity}, .largest = {}, .sum = {}};
  for (const Vector3& x : s.position)
    for (int axis = 0; axis < 3; ++axis) {
      double& least = votes.least[static_cast<std::size_t>(axis)];
      least = std::min(least, x[axis]);
    }
  ranks_.join(votes);
  const std::vector<std::uint64_t> keys =
      spatial_keys(s.position, {votes.least[0], votes.least[1], votes.least[2]}, cell_size);
  std::vector<Sorted> own;
  for (std::size_t i = 0; i < keys.size(); ++i)
    own.push_back({keys[i], place_[i], ranks_.rank(), static_cast<std::int64_t>(i)});
  std::sort(own.begin(), own.end());

  // Each process sorts what is between two borders.
  const std::vector<Sorted> border = borders(ranks_, own);
  ByRank to_sort(ranks_);
  for (std::size_t n = 0; n < own.size(); ++n)
    to_sort.add(static_cast<int>(std::upper_bound(border.begin(), border.end(), own[n]) - border.begin()), n);
  std::vector<Sorted> part = ranks_.plan(to_sort.counts())->exchange(own);
  std::sort(part.begin(), part.end());
  std::int64_t first = 0;
  const std::vector<std::int64_t> counts = ranks_.gather_values(std::vector{static_cast<std::int64_t>(part.size())});
  for (int r = 0; r < ranks_.rank(); ++r) first += counts[static_cast<std::size_t>(r)];

  // And tells the others the places.
  struct Told {
    std::int64_t number, place;
  };
  ByRank to_tell(ranks_);
  for (std::size_t n = 0; n < part.size(); ++n) to_tell.add(static_cast<int>(part[n].rank), n);
  std::vector<Told> told;
  for (const std::uint32_t n : to_tell.all()) told.push_back({part[n].number, first + static_cast<std::int64_t>(n)});
  for (const Told& one : ranks_.plan(to_tell.counts())->exchange(told))
    place_[static_cast<std::size_t>(one.number)] = one.place;
}

void Share::add(std::size_t count) {
  if (is_all()) return;
  for (std::size_t n = 0; n < count && ranks_.is_first(); ++n) {
    place_.push_back(static_cast<std::int64_t>(count_ + n));
    if (!is_halo_.empty()) is_halo_.push_back(0);
  }
  count_ += count;
}

std::size_t Share::remove(std::span<const std::uint32_t> kept) {
  std::vector<std::int64_t> gone, left;
  for (std::size_t i = 0, n = 0; i < place_.size(); ++i) {
    const bool stays = n < kept.size() && kept[n] == i;
    (stays ? left : gone).push_back(place_[i]);
    n += stays;
  }
  gone = ranks_.gather_values(gone);
  std::sort(gone.begin(), gone.end());
  for (std::int64_t& place : left) place -= std::lower_bound(gone.begin(), gone.end(), place) - gone.begin();
  place_ = std::move(left);
  count_ -= gone.size();
  return gone.size();
}

Parts Share::split(std::span<const std::uint32_t> source) {
  struct Split {
    std::int64_t place, added;
    bool operator<(const Split& other) const { return place < other.place; }
  };
  const auto place_of = [&](std::uint32_t i) { return is_all() ? std::int64_t{i} : place_[i]; };
  const auto is_added = [&](std::size_t n) { return n > 0 && source[n] == source[n - 1]; };
  std::vector<Split> splits;
  for (std::size_t n = 0; n < source.size(); ++n) {
    if (!is_added(n)) continue;
    if (!is_added(n - 1)) splits.push_back({place_of(source[n]), 0});
    ++splits.back().added;
  }
  splits = ranks_.gather_values(splits);
  std::sort(splits.begin(), splits.end());
  Parts parts;
  for (const Split& one : splits) parts.added += static_cast<std::uint64_t>(one.added);
  if (parts.added == 0) return parts;

  std::vector<std::int64_t> place;
  std::int64_t before = 0;  // added to those that come first in the order of all
  auto next = splits.begin();
  std::size_t first = 0;  // of what a particle becomes
  for (std::size_t n = 0; n < source.size(); ++n) {
    if (!is_added(n)) {
      for (; next != splits.end() && next->place < place_of(source[n]); ++next) before += next->added;
      first = n;
    }
    const auto part = static_cast<std::int64_t>(n - first);
    parts.numbers.push_back(part > 0 ? before + part - 1 : -1);
    place.push_back(place_of(source[n]) + before + part);
  }
  count_ += parts.added;
  if (!is_all()) place_ = std::move(place);
  return parts;
}

}  // namespace talus::continuum
