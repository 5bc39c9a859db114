// SPDX-License-Identifier: Apache-2.0
/// The cells of a case's air, from its parameters alone.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>

#include "base/unit.hpp"
#include "models/continuum/gas/atmosphere.hpp"

namespace talus::continuum {

namespace {

Vector3 extent(const Parameters& p) {
  return {p.box.width, p.box.depth, p.box.height};
}

double cell_size(const Parameters& p) {
  return p.air.cell.value_or(0.75 * p.bed.spacing);
}

double cell_size(const Parameters& p, int axis) {
  return axis == 1 && p.air.cell_depth ? *p.air.cell_depth : cell_size(p);
}

/// Whether some faces of so many layers of cells lie in the plate.
bool meets_the_plate(const Parameters& p, int layers) {
  const double layer = *p.plate.height / p.box.height * layers;
  return layers > 0 && std::abs(layer - std::round(layer)) < 1e-6;
}

/// Of the numbers of layers from least to most that are good, the nearest to `count`.
template <class IsGood>
std::optional<int> nearest_layers(int count, int least, int most, IsGood&& is_good) {
  for (int change = 0; change <= std::max(count - least, most - count); ++change)
    for (const int layers : {count + change, count - change})
      if (layers >= least && layers <= most && is_good(layers)) return layers;
  return std::nullopt;
}

/// Whether the cells can be numbered; the fault is told of the side of the box that is out of proportion, or of the
/// cells' size where none is.
std::optional<Problem> check_number_of_cells(const Parameters& p) {
  constexpr double max_cells = 1e9;
  constexpr const char* sides[3] = {"box.width", "box.depth", "box.height"};
  Vector3 size = extent(p);
  for (int axis = 0; axis < 3; ++axis) size[axis] /= cell_size(p, axis);
  double cells = 1;
  int longest = 0;
  for (int axis = 0; axis < 3; ++axis) {
    cells *= std::max(1.0, size[axis]);
    if (size[axis] > size[longest]) longest = axis;
  }
  if (cells <= max_cells) return std::nullopt;
  const double length = extent(p)[longest];
  const double next = std::max({1.0, size[(longest + 1) % 3], size[(longest + 2) % 3]});
  if (size[longest] > 100 * next || !std::isfinite(size[longest]))
    return Problem{
        .key = sides[longest],
        .what = fmt::format("{:.4g} m is {:.3g} cells of the air: {:.3g} cells in all", length, size[longest], cells),
        .allowed = fmt::format("at most {:.3g} m with cells of this size: {:.0e} cells", length * max_cells / cells,
                               max_cells)};
  const double dimensions = static_cast<double>((size.x > 1) + (size.y > 1) + (size.z > 1));
  return Problem{
      .key = p.air.cell ? "air.cell" : "bed.spacing",
      .what = fmt::format("makes {:.3g} cells of the air of {:.4g} mm", cells, cell_size(p) / millimetre),
      .allowed = fmt::format("cells of at least {:.3g} mm: {:.0e} cells",
                             cell_size(p) * std::pow(cells / max_cells, 1 / dimensions) / millimetre, max_cells)};
}

}  // namespace

Grid air_grid(const Parameters& p) {
  Grid grid;
  const Vector3 size = extent(p);
  for (int axis = 0; axis < 3; ++axis) {
    int count = std::max(1, static_cast<int>(std::lround(size[axis] / cell_size(p, axis))));
    if (!p.air.cell && p.air.gas.boundaries.is_periodic(axis) && count > 1) count += count % 2;
    if (axis == 2 && p.plate.height && !p.air.cell)  // cells of 1/2 to 1 bed.spacing
      count = nearest_layers(count, (3 * count + 3) / 4, (3 * count) / 2, [&](int layers) {
                return meets_the_plate(p, layers);
              }).value_or(count);
    grid.count[static_cast<std::size_t>(axis)] = count;
    grid.spacing[axis] = size[axis] / count;
  }
  return grid;
}

/// A size of the cells near the one there is, or a height of the plate, with which the plate lies on faces of cells.
std::string what_meets_the_plate(const Parameters& p, const Grid& grid) {
  const int count = grid.count[2];
  const auto size = [&](int layers) { return fmt::format("{:.4g} mm", p.box.height / layers / millimetre); };
  const auto layers = nearest_layers(count, std::max(1, count / 3), 3 * count, [&](int n) {
    if (!meets_the_plate(p, n)) return false;
    Parameters changed = p;
    changed.air.cell = parse_quantity(size(n))->value;
    return air_grid(changed).count[2] == n && check_air(changed).empty();
  });
  if (layers) return fmt::format("air.cell = \"{}\", of whose faces some lie in the plate", size(*layers));
  const double layer = std::floor(*p.plate.height / grid.spacing.z);
  return fmt::format("plate.height = \"{:.6g} mm\" or \"{:.6g} mm\", where faces of the cells are",
                     layer * grid.spacing.z / millimetre, (layer + 1) * grid.spacing.z / millimetre);
}

std::vector<Problem> check_air(const Parameters& p) {
  if (!p.air.enabled || !(cell_size(p) > 0)) return {};
  std::vector<Problem> problems = air::check(p.air.gas);
  const auto add = [&](std::string key, std::string what, std::string allowed) {
    problems.push_back({.key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)});
  };
  if (auto problem = check_number_of_cells(p)) return {std::move(*problem)};
  const Grid grid = air_grid(p);
  for (Problem& problem : air::check_inflows(p.air.gas, grid)) problems.push_back(std::move(problem));
  const FaceKind grains[6] = {p.box.left, p.box.right, p.box.front, p.box.rear, p.box.floor, p.box.top};
  constexpr const char* names[6] = {"left", "right", "front", "rear", "floor", "top"};
  for (std::size_t face = 0; face < 6; ++face)
    if ((p.air.gas.boundaries.kind[face] == FlowBoundary::periodic) != (grains[face] == FaceKind::periodic))
      add(fmt::format("air.{}", names[face]),
          fmt::format("is {}periodic, but box.{} is {}", grains[face] == FaceKind::periodic ? "not " : "", names[face],
                      choice_name(grains[face])),
          "periodic for both air and grains, or for neither");
  for (std::size_t face = 0; face < 6; ++face)
    if (grains[face] == FaceKind::symmetry && p.air.gas.boundaries.kind[face] != FlowBoundary::free_slip)
      add(fmt::format("air.{}", names[face]),
          fmt::format("is {}, but box.{} is a plane of symmetry", choice_name(p.air.gas.boundaries.kind[face]),
                      names[face]),
          "symmetry, as there");
  for (int axis = 0; axis < 3; ++axis) {
    const int count = grid.count[static_cast<std::size_t>(axis)];
    const char* const key = axis == 1 && p.air.cell_depth ? "air.cell_depth" : "air.cell";
    if (std::abs(grid.spacing[axis] / cell_size(p, axis) - 1) > 0.5)
      add(key, fmt::format("along {} the cells would be {:.4g} mm long", "xyz"[axis], grid.spacing[axis] / millimetre),
          "a length that divides the box's sides nearly evenly");
    if (p.air.gas.boundaries.is_periodic(axis) && count > 1 && count % 2 == 1)
      add(key, fmt::format("makes {} cells along {}, where the air is periodic", count, "xyz"[axis]),
          "an even number, or one");
  }
  if (p.air.cell_depth && !p.vessel.empty())
    add("air.cell_depth", "is given, but who is behind walls of a vessel is asked at the middles of cells",
        "cells as long along y as otherwise: only air.cell");
  if (p.plate.height) {
    const double layer = *p.plate.height / grid.spacing.z;
    if (std::abs(layer - std::round(layer)) > 1e-6)
      add("air.cell",
          fmt::format("plate.height is {:.6g} cells of {:.4g} mm above the floor", layer, grid.spacing.z / millimetre),
          what_meets_the_plate(p, grid));
  }
  return problems;
}

}  // namespace talus::continuum
