// SPDX-License-Identifier: Apache-2.0
/// The closed regions of the pressure's equation, and the report of a failure.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "base/error.hpp"
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
        closed_.push_back(region);
      }
}

template <class Number>
double total_of(const std::vector<std::size_t>& region, const std::vector<Number>& column) {
  ExactSum total;
  for (const std::size_t c : region) total.add(static_cast<double>(column[c]));
  return total.value();
}

/// Size of the part of the residual that no value can balance.
double PoissonSolver::unbalanced() const {
  double square = 0;
  for (const auto& region : closed_) {
    const double total = total_of(region, residual_);
    square += total * total / static_cast<double>(region.size());
  }
  return std::sqrt(square);
}

template <class Number>
void PoissonSolver::remove_means(std::vector<Number>& column) const {
  for (const auto& region : closed_) {
    const auto mean = static_cast<Number>(total_of(region, column) / static_cast<double>(region.size()));
    for (const std::size_t c : region) column[c] -= mean;
  }
}
template void PoissonSolver::remove_means(std::vector<double>&) const;
template void PoissonSolver::remove_means(std::vector<float>&) const;

void PoissonSolver::fail(const char* what, const char* advice) const {
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
