// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/splitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <type_traits>
#include <vector>

#include "base/elementary.hpp"
#include "base/parallel.hpp"
#include "models/continuum/columns.hpp"
#include "numerics/neighbourhood.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr std::size_t min_merged = 4, max_merged = 12;

/// Corners of a cube; the first few of them lie about its middle as evenly as so many can.
constexpr std::array<std::array<double, 3>, 8> corners{{{-1, -1, -1},
                                                        {1, 1, -1},
                                                        {1, -1, 1},
                                                        {-1, 1, 1},
                                                        {1, 1, 1},
                                                        {-1, -1, 1},
                                                        {-1, 1, -1},
                                                        {1, -1, -1}}};

/// Three directions at right angles.
using Frame = std::array<Vector3, 3>;

Frame frame_along(const Vector3& normal) {
  const Vector3 other = std::abs(normal.x) < 0.8 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  const Vector3 across = cross(normal, other), first = (1 / norm(across)) * across;
  return {first, cross(normal, first), normal};
}

/// Along the nearest wall within a distance, m; else along the axes.
Frame frame_at(const Boundary& boundary, const Vector3& x, double within) {
  if (const Surface& vessel = boundary.vessel(); !vessel.is_empty())
    if (const auto foot = vessel.nearest(x, within); foot && foot->distance > 0) {
      const Vector3 from = x - foot->place;
      return frame_along((1 / norm(from)) * from);
    }
  const Domain& domain = boundary.domain();
  for (int wall = 6; wall < domain.wall_count(); ++wall)
    if (domain.is_beside(wall, x) && std::abs(domain.above(wall, x)) < within) return frame_along(domain.normal(wall));
  return {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
}

bool is_between(const Boundary& boundary, const Vector3& a, const Vector3& b) {
  return boundary.domain().blocks(a, b) || (!boundary.vessel().is_empty() && boundary.vessel().blocks(a, b));
}

/// How the columns come from those before: each particle a copy of one, with a mass and a place of its own.
struct Copies {
  std::vector<std::uint32_t> source;
  std::vector<double> mass_ratio;
  std::vector<Vector3> moved;  ///< m
  std::vector<char> is_new;

  void add(std::size_t of, double ratio, const Vector3& by = {}, bool fresh = false) {
    source.push_back(static_cast<std::uint32_t>(of));
    mass_ratio.push_back(ratio), moved.push_back(by), is_new.push_back(fresh);
  }
};

/// A particle in eight, or as many as its mass has parts.
void add_parts(const Boundary& boundary, double spacing, const State& s, std::size_t i, Copies& copies) {
  const double ratio = s.mass_ratio[i], count = std::min(8.0, ratio), part = std::floor(ratio / count);
  const double size = cube_root(s.mass_of(i) / s.density[i]);
  const Frame frame = frame_at(boundary, s.position[i], std::max(size, spacing));
  std::array<Vector3, 8> place;
  std::array<double, 8> mass;
  Vector3 middle;
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    mass[n] = part + (static_cast<double>(n) < ratio - part * count ? 1 : 0);
    for (std::size_t axis = 0; axis < 3; ++axis) place[n] += (0.25 * size * corners[n][axis]) * frame[axis];
    middle += (mass[n] / ratio) * place[n];
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    Vector3 by = place[n] - middle;
    if (is_between(boundary, s.position[i], s.position[i] + by)) by = {};
    copies.add(i, mass[n], by, n > 0);
  }
}

void apply(const Copies& copies, State& s) {
  select(s, copies.source);
  for (std::size_t n = 0; n < copies.source.size(); ++n) {
    s.mass_ratio[n] = copies.mass_ratio[n];
    s.position[n] += copies.moved[n];
    if (copies.is_new[n]) s.identity[n] = static_cast<std::int64_t>(s.population.next_identity++);
  }
}

/// Those that are too coarse, one level at a time. \returns whether there were any
bool split(const Levels& levels, const Boundary& boundary, double spacing, State& s) {
  Copies copies;
  bool any = false;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (level_of(s.mass_ratio[i]) > levels.wanted(s.position[i])) {
      add_parts(boundary, spacing, s, i, copies);
      any = true;
    } else {
      copies.add(i, s.mass_ratio[i]);
    }
  }
  if (any) apply(copies, s);
  return any;
}

/// Where particles of a level and a bed merge.
struct Cell {
  int level;
  std::int64_t tag;
  std::array<std::int64_t, 3> number;
  auto operator<=>(const Cell&) const = default;
};

/// Adds up particles that become one, the first of `all`: means by mass of places and velocities, by volume of what is
/// known of the grains.
void merge_into_first(const std::vector<std::uint32_t>& all, State& s) {
  double mass = 0, volume = 0, energy = 0, ratio = 0;
  for (const std::uint32_t i : all) {
    mass += s.mass_of(i), ratio += s.mass_ratio[i];
    volume += s.mass_of(i) / s.density[i];
    energy += 0.5 * s.mass_of(i) * dot(s.velocity[i], s.velocity[i]);
  }
  const auto mean = [&](auto& column, auto&& weight, double total) {
    auto sum = (weight(all.front()) / total) * column[all.front()];
    for (std::size_t n = 1; n < all.size(); ++n) sum += (weight(all[n]) / total) * column[all[n]];
    return sum;
  };
  const auto by_mass = [&](std::uint32_t i) { return s.mass_of(i); };
  const auto by_volume = [&](std::uint32_t i) { return s.mass_of(i) / s.density[i]; };
  // Weights need masses and densities as they were: these are written last.
  const auto take = [&]<class Member>(const FieldInfo& field, Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles || column.empty()) return;
      using Value = typename Member::value_type;
      if constexpr (std::is_same_v<Value, Vector3>)
        column[all.front()] = mean(column, by_mass, mass);
      else if constexpr (std::is_same_v<Value, double>)
        if (&column != &s.density && &column != &s.mass_ratio) column[all.front()] = mean(column, by_volume, volume);
    }
  };
  for_each_field(take, s);
  s.mass_ratio[all.front()] = ratio;
  s.density[all.front()] = mass / volume;
  const Vector3& v = s.velocity[all.front()];
  s.merged_energy += energy - 0.5 * mass * dot(v, v);
}

/// Those that are too fine, one level up. \returns whether there were any
bool merge(const Levels& levels, const Boundary& boundary, State& s) {
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const int level = level_of(s.mass_ratio[i]);
    if (level >= levels.count() || level >= levels.wanted(s.position[i], Levels::slack_of_merging)) continue;
    cells[{level, s.tag.empty() ? 0 : s.tag[i], levels.cell_of(s.position[i], level)}].push_back(
        static_cast<std::uint32_t>(i));
  }
  std::vector<char> gone(s.position.size(), 0);
  bool any = false;
  for (const auto& [cell, all] : cells) {
    if (all.size() < min_merged || all.size() > max_merged) continue;
    const auto hidden = [&, first = s.position[all.front()]](std::uint32_t i) {
      return is_between(boundary, first, s.position[i]);
    };
    if (std::any_of(all.begin() + 1, all.end(), hidden)) continue;
    merge_into_first(all, s);
    for (std::size_t n = 1; n < all.size(); ++n) gone[all[n]] = 1;
    any = true;
  }
  if (!any) return false;
  std::vector<std::uint32_t> left;
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) left.push_back(static_cast<std::uint32_t>(i));
  select(s, left);
  return true;
}

}  // namespace

void split_and_merge(const Levels& levels, const Boundary& boundary, double spacing, State& s) {
  for (int level = 0; level < levels.count() && split(levels, boundary, spacing, s); ++level) {
  }
  merge(levels, boundary, s);
}

namespace {

/// Moves particles that have neighbours of another level, away from walls and free surfaces, until the sum of V grad W
/// over their neighbours, which a uniform pressure would push them by, has all but vanished: on two lattices that meet
/// it is a twelfth of one over the coarser spacing. \param ratio sph.smoothing_ratio
void relax(const Boundary& boundary, double smoothing_ratio, State& s) {
  constexpr int passes = 20;
  constexpr double share = 0.2, filled = 0.9;  // of h^2 times the sum; of the kernel
  ThreadTeam team(1);
  std::vector<double> length;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    length.push_back(smoothing_ratio * sph::smoothing_length(s.mass_of(i), s.density[i]));
  std::vector<Vector3> by(s.position.size());
  for (int pass = 0; pass < passes; ++pass) {
    Neighbourhood around(boundary.domain(), boundary.vessel());
    around.build(team, s.position, length, 0);
    for_each(team, s.position.size(), [&](std::size_t i) {
      by[i] = {};
      if (around.distance_from_vessel(i) < sph::support * length[i]) return;
      bool meets = false;
      double sum = s.mass_of(i) / s.density[i] * sph::cubic_spline(0.0, length[i]);
      Vector3 gradient;
      for (const std::uint32_t n : around.of(i)) {
        const bool is_ghost = n >= s.position.size();
        const std::size_t j = is_ghost ? around.ghosts()[n - s.position.size()].source : n;
        const Vector3 x = is_ghost ? around.image(around.ghosts()[n - s.position.size()]).position(s.position[j])
                                   : s.position[j];
        const Vector3 d = s.position[i] - x;
        const double distance = norm(d), h = 0.5 * (length[i] + length[j]), volume = s.mass_of(j) / s.density[j];
        meets = meets || level_of(s.mass_ratio[j]) != level_of(s.mass_ratio[i]);
        if (distance >= sph::support * h) continue;
        sum += volume * sph::cubic_spline(distance, h);
        gradient += (volume * sph::cubic_spline_slope(distance, h)) * d;
      }
      if (meets && sum > filled) by[i] = (-share * length[i] * length[i]) * gradient;
    });
    for (std::size_t i = 0; i < s.position.size(); ++i) s.position[i] += by[i];
  }
}

}  // namespace

void lay_levels(const Setup& setup, State& s) {
  const Levels levels(setup);
  s.mass_ratio.assign(s.position.size(), 1);
  for (int level = 0; level < levels.count() && merge(levels, *setup.boundary, s); ++level) {
  }
  s.merged_energy = 0;
  relax(*setup.boundary, setup.given.sph.smoothing_ratio, s);
}

}  // namespace talus::continuum
