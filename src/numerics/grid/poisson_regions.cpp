// SPDX-License-Identifier: Apache-2.0
/// The closed regions of the pressure's equation, and the report of a failure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
#include "base/exact_sum.hpp"
#include "numerics/grid/poisson.hpp"

namespace talus {

/// Regions by flooding through open faces.
void PoissonSolver::find_closed_regions() {
  closed_.clear();
  std::vector<bool> visited(board_.size(), false);
  const auto [nx, ny, nz] = grid_.count;
  struct Place {
    int i, j, k;
  };
  std::vector<Place> front;
  std::vector<std::size_t> region;
  for (int k0 = 0; k0 < nz; ++k0)
    for (int j0 = 0; j0 < ny; ++j0)
      for (int i0 = 0; i0 < nx; ++i0) {
        if (visited[board_.at(i0, j0, k0)]) continue;
        visited[board_.at(i0, j0, k0)] = true;
        front.assign(1, {i0, j0, k0});
        region.clear();
        bool is_closed = true;
        while (!front.empty()) {
          const Place at = front.back();
          front.pop_back();
          const std::size_t here = board_.at(at.i, at.j, at.k);
          region.push_back(here);
          is_closed = is_closed && matrix_.outside[here] <= 0;
          for (int axis = 0; axis < 3; ++axis)
            for (const int step : {-1, 1}) {
              Place to = at;
              int& moved = axis == 0 ? to.i : axis == 1 ? to.j : to.k;
              const int n = grid_.count[static_cast<std::size_t>(axis)];
              moved += step;
              if (moved < 0 || moved >= n) {
                if (!board_.is_periodic(axis)) continue;
                moved = (moved + n) % n;
              }
              const std::size_t there = board_.at(to.i, to.j, to.k);
              const double through = matrix_.low[static_cast<std::size_t>(axis)][step < 0 ? here : there];
              if (through > 0 && !visited[there]) visited[there] = true, front.push_back(to);
            }
        }
        if (!is_closed) continue;
        std::sort(region.begin(), region.end());
        take_region(region);
      }
}

/// Keeps what this process has to do with a region. A cell by itself is known to all that have it on their rows.
void PoissonSolver::take_region(const std::vector<std::size_t>& cells) {
  Region region{.own = {}, .beside = {}, .size = cells.size(), .is_parted = false, .is_counted = false};
  const auto is_on = [&](std::span<const RowRange> slabs, std::size_t row) {
    return std::any_of(slabs.begin(), slabs.end(), [&](const RowRange& s) { return row >= s.begin && row < s.end; });
  };
  std::size_t first = board_.rows(), last = 0;
  for (const std::size_t c : cells) {
    const std::size_t row = board_.row_at(c);
    first = std::min(first, row), last = std::max(last, row);
    if (is_on(own_, row))
      region.own.push_back(c);
    else if (is_on(around_, row))
      region.beside.push_back(c);
  }
  region.is_counted = is_on(own_, first);
  // Its rows and those next to them are not all of one process.
  const auto& border = slabs_.border();
  const auto owner = std::upper_bound(border.begin(), border.end(), first);
  region.is_parted = !ranks_.is_alone() && region.size > 1 &&
                     (first < *(owner - 1) + board_.reach() || last + board_.reach() >= *owner);
  closed_.push_back(std::move(region));
}

namespace {

template <class Number>
void add(const std::vector<std::size_t>& cells, const std::vector<Number>& column, ExactSum& total) {
  for (const std::size_t c : cells) total.add(static_cast<double>(column[c]));
}

}  // namespace

/// Sums over the regions of which several processes have rows.
template <class Number>
std::vector<double> PoissonSolver::totals_of_parted(const std::vector<Number>& column) const {
  std::vector<ExactSum> own;
  for (const Region& region : closed_)
    if (region.is_parted) add(region.own, column, own.emplace_back());
  if (own.empty()) return {};
  const std::vector<ExactSum> all = ranks_.gather_values(own);
  std::vector<double> totals;
  for (std::size_t n = 0; n < own.size(); ++n) {
    ExactSum total;
    for (std::size_t other = n; other < all.size(); other += own.size()) total.add(all[other]);
    totals.push_back(total.value());
  }
  return totals;
}

/// Size of the part of the residual that no value can balance.
double PoissonSolver::unbalanced() const {
  const std::vector<double> parted = totals_of_parted(residual_);
  std::vector<double> totals;
  std::size_t next = 0;
  for (const Region& region : closed_) {
    ExactSum own;
    if (!region.is_parted) add(region.own, residual_, own);
    const double total = region.is_parted ? parted[next++] : own.value();
    totals.push_back(region.is_counted ? total : 0);
  }
  ranks_.add_up(totals);
  double square = 0;
  for (std::size_t n = 0; n < totals.size(); ++n)
    square += totals[n] * totals[n] / static_cast<double>(closed_[n].size);
  return std::sqrt(square);
}

template <class Number>
void PoissonSolver::remove_means(std::vector<Number>& column) const {
  const std::vector<double> parted = totals_of_parted(column);
  std::size_t next = 0;
  for (const Region& region : closed_) {
    ExactSum own;
    if (!region.is_parted) add(region.own, column, own);
    if (region.size == 1) add(region.beside, column, own);
    const double total = region.is_parted ? parted[next++] : own.value();
    const auto mean = static_cast<Number>(total / static_cast<double>(region.size));
    for (const auto* cells : {&region.own, &region.beside})
      for (const std::size_t c : *cells) column[c] -= mean;
  }
}
template void PoissonSolver::remove_means(std::vector<double>&) const;
template void PoissonSolver::remove_means(std::vector<float>&) const;

void PoissonSolver::fail(const char* what, const char* advice) {
  gather(std::array{&residual_});
  std::array<int, 3> worst{};
  double most = -1;
  for (int k = 0; k < grid_.count[2]; ++k)
    for (int j = 0; j < grid_.count[1]; ++j)
      for (int i = 0; i < grid_.count[0]; ++i) {
        const double size = std::abs(residual_[board_.at(i, j, k)]);
        if (size > most || (std::isnan(size) && !std::isnan(most))) most = size, worst = {i, j, k};
      }
  const auto [i, j, k] = worst;
  const Vector3 x = grid_.centre(i, j, k);
  throw NumericalError({.what = what,
                        .term = fmt::format("largest residual of a cell {:.3g}", most),
                        .place = fmt::format("cell ({}, {}, {}) at ({:.4g}, {:.4g}, {:.4g}) m", i, j, k, x.x, x.y, x.z),
                        .advice = advice});
}

}  // namespace talus
