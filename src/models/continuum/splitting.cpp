// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/splitting.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <type_traits>
#include <vector>

#include "base/elementary.hpp"
#include "base/parallel.hpp"
#include "models/continuum/columns.hpp"
#include "numerics/neighbourhood.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr std::size_t min_merged = 4, max_merged = 12, min_halves = 2, max_halves = 3;

/// How places are relaxed.
struct Relaxation {
  int passes;
  double max_way;  ///< of a particle, in h
};
/// After a split, without levels (about a sector's axis alone), and of a bed that is laid.
constexpr Relaxation of_parts{40, 0.8}, about_axis{20, 0.2}, at_start{40, 0.2};

/// Corners of a cube; the first few of them lie about its middle as evenly as so many can.
constexpr std::array<std::array<double, 3>, 8> corners{
    {{-1, -1, -1}, {1, 1, -1}, {1, -1, 1}, {-1, 1, 1}, {1, 1, 1}, {-1, -1, 1}, {-1, 1, -1}, {1, -1, -1}}};

/// Three directions at right angles.
using Frame = std::array<Vector3, 3>;

Frame frame_along(const Vector3& normal) {
  const Vector3 other = std::abs(normal.x) < 0.8 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  const Vector3 across = cross(normal, other), first = (1 / norm(across)) * across;
  return {first, cross(normal, first), normal};
}

/// A wall of a vessel as a particle beside it meets it.
struct Mirror {
  Vector3 place, normal;  ///< of the wall, m; unit, towards the particle
};

/// The nearest one within a distance, m.
std::optional<Mirror> mirror_near(const Surface& vessel, const Vector3& x, double within) {
  if (vessel.is_empty()) return std::nullopt;
  const auto foot = vessel.nearest(x, within);
  if (!foot || !(foot->distance > 0)) return std::nullopt;
  return Mirror{foot->place, (1 / foot->distance) * (x - foot->place)};
}

/// Along the nearest wall within a distance, m; else along the axes.
Frame frame_at(const Boundary& boundary, const Vector3& x, double within) {
  if (const auto wall = mirror_near(boundary.vessel(), x, within)) return frame_along(wall->normal);
  const Domain& domain = boundary.domain();
  for (int wall = wall_number(0); wall < domain.wall_count(); ++wall)
    if (domain.is_beside(wall, x) && std::abs(domain.above(wall, x)) < within) return frame_along(domain.normal(wall));
  return {Vector3{1, 0, 0}, Vector3{0, 1, 0}, Vector3{0, 0, 1}};
}

bool is_between(const Boundary& boundary, const Vector3& a, const Vector3& b) {
  return boundary.domain().blocks(a, b) || (!boundary.vessel().is_empty() && boundary.vessel().blocks(a, b));
}

/// Whether a part would be beyond a wall or a face. Never two in one place, where nothing would part them.
bool leaves(const Boundary& boundary, const Vector3& a, const Vector3& b) {
  return is_between(boundary, a, b) || boundary.domain().bounce(a, b);
}

/// A displacement from x, halved until it ends before the wall, not on it.
Vector3 within(const Boundary& boundary, const Vector3& x, Vector3 by) {
  constexpr double beyond = 1 + 1e-6;
  for (int halved = 0; halved < 6 && leaves(boundary, x, x + beyond * by); ++halved) by = 0.5 * by;
  return by;
}

/// How the columns come from those before: each particle a copy of one, with a mass and a place of its own.
struct Copies {
  std::vector<std::uint32_t> source;
  std::vector<double> mass_ratio;
  std::vector<Vector3> moved;  ///< m
  std::vector<double> is_part;

  void keep(std::size_t i, double ratio) {
    source.push_back(static_cast<std::uint32_t>(i));
    mass_ratio.push_back(ratio), moved.emplace_back(), is_part.push_back(0);
  }
  void add_part(std::size_t of, double ratio, const Vector3& by) {
    source.push_back(static_cast<std::uint32_t>(of));
    mass_ratio.push_back(ratio), moved.push_back(by), is_part.push_back(1);
  }
};

/// A particle in eight, or as many as its mass has parts.
void add_parts(const Boundary& boundary, const State& s, std::size_t i, Copies& copies) {
  const double ratio = s.mass_ratio[i], count = std::min(8.0, ratio), part = std::floor(ratio / count);
  const double size = cube_root(s.mass_of(i) / s.density[i]);
  const Frame frame = frame_at(boundary, s.position[i], size);
  std::array<Vector3, 8> place;
  std::array<double, 8> mass;
  Vector3 middle;
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    mass[n] = part + (static_cast<double>(n) < ratio - part * count ? 1 : 0);
    for (std::size_t axis = 0; axis < 3; ++axis) place[n] += (0.25 * size * corners[n][axis]) * frame[axis];
    middle += (mass[n] / ratio) * place[n];
  }
  for (std::size_t n = 0; n < static_cast<std::size_t>(count); ++n) {
    copies.add_part(i, mass[n], within(boundary, s.position[i], place[n] - middle));
  }
}

/// How halves of a particle about the axis of a sector lie: a flow towards an outlet has drawn it out along the axis;
/// in a bed that is laid it takes up a disc.
enum class Halves { along_axis, across_axis };

/// A particle about the axis of a sector in two.
void add_halves(const Boundary& boundary, const State& s, std::size_t i, Halves halves, Copies& copies) {
  constexpr double apart = 0.7;  // in spacings
  const double ratio = s.mass_ratio[i], smaller = std::floor(0.5 * parts_of_mass * ratio) / parts_of_mass;
  const std::array mass{ratio - smaller, smaller};
  std::array<Vector3, 2> by;
  if (halves == Halves::along_axis) {
    const double size = cube_root(s.mass / s.density[i]);
    by = {Vector3{0, 0, -apart * size * mass[1] / ratio}, Vector3{0, 0, apart * size * mass[0] / ratio}};
  } else {  // the disc and the ring around it, of equal areas
    const Vector3 about = s.position[i] - boundary.domain().sector()->axis(), outwards{about.x, about.y, 0};
    by = {(std::sqrt(0.5) - 1) * outwards, (std::sqrt(1.5) - 1) * outwards};
  }
  for (std::size_t n = 0; n < 2; ++n) copies.add_part(i, mass[n], within(boundary, s.position[i], by[n]));
}

/// \param numbers of those that are new, -1: of others
void apply(const Copies& copies, const std::vector<std::int64_t>& numbers, State& s) {
  select(s, copies.source);
  for (std::size_t n = 0; n < copies.source.size(); ++n) {
    s.mass_ratio[n] = copies.mass_ratio[n];
    s.position[n] += copies.moved[n];
    if (numbers[n] >= 0 && !s.identity.empty())
      s.identity[n] = static_cast<std::int64_t>(s.population.next_identity) + numbers[n];
  }
}

/// Those that are too coarse, one level at a time. \returns of each particle whether it is a part of one that has
/// split, 1 or 0; nothing if none of all has
std::optional<std::vector<double>> split(const Levels& levels, const Boundary& boundary, Share& share, State& s,
                                         Halves halves = Halves::along_axis) {
  Copies copies;
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    if (const int level = level_of(s.mass_ratio[i]); level <= levels.wanted(s.position[i]))
      copies.keep(i, s.mass_ratio[i]);
    else if (level > 0)
      add_parts(boundary, s, i, copies);
    else
      add_halves(boundary, s, i, halves, copies);
  }
  const Parts parts = share.split(copies.source);
  if (parts.added == 0) return std::nullopt;
  apply(copies, parts.numbers, s);
  s.population.next_identity += parts.added;
  return std::move(copies.is_part);
}

/// Where particles of a level and a bed merge.
struct Cell {
  int level;
  std::int64_t tag;
  std::array<std::int64_t, 3> number;
  auto operator<=>(const Cell&) const = default;
};

/// Adds up particles that become one, the first of `all`: means by mass of places and velocities, by volume of what is
/// known of the grains. \returns by how much the kinetic energy falls, J
double merge_into_first(const std::vector<std::uint32_t>& all, State& s) {
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
  return energy - 0.5 * mass * dot(v, v);
}

/// Those that are too fine, one level up. \returns whether there were any
bool merge(const Levels& levels, const Boundary& boundary, Share& share, State& s) {
  const auto cell_of = [&](std::size_t i) -> std::optional<Cell> {
    const int level = level_of(s.mass_ratio[i]);
    if (level >= levels.count() || level >= levels.wanted(s.position[i], Levels::slack_of_merging)) return std::nullopt;
    return Cell{level, s.tag.empty() ? 0 : s.tag[i], levels.cell_of(s.position[i], level)};
  };
  share.bring(s, [&](std::size_t i) -> std::optional<Vector3> {
    const std::optional<Cell> cell = cell_of(i);
    if (!cell) return std::nullopt;
    return levels.middle_of(cell->number, cell->level);
  });
  std::map<Cell, std::vector<std::uint32_t>> cells;
  for (std::size_t i = 0; i < s.position.size(); ++i)
    if (const std::optional<Cell> cell = cell_of(i)) cells[*cell].push_back(static_cast<std::uint32_t>(i));
  const FixedPoint point(s.energy_unit);
  FixedVector lost;
  std::vector<char> gone(s.position.size(), 0);
  for (const auto& [cell, all] : cells) {
    const bool halves = cell.level < 0;
    if (all.size() < (halves ? min_halves : min_merged) || all.size() > (halves ? max_halves : max_merged)) continue;
    const auto hidden = [&, first = s.position[all.front()]](std::uint32_t i) {
      return is_between(boundary, first, s.position[i]);
    };
    if (std::any_of(all.begin() + 1, all.end(), hidden)) continue;
    lost.add(point, {merge_into_first(all, s), 0, 0});
    for (std::size_t n = 1; n < all.size(); ++n) gone[all[n]] = 1;
  }
  std::vector<std::uint32_t> left;
  for (std::size_t i = 0; i < gone.size(); ++i)
    if (!gone[i]) left.push_back(static_cast<std::uint32_t>(i));
  Votes votes{.least = {}, .largest = {}, .sum = {gone.size() - left.size()}};
  join(share.ranks(), votes, std::span(&lost, 1));
  if (votes.sum[0] == 0) return false;
  s.merged_energy += lost.value(point).x;
  share.remove(left);
  select(s, left);
  return true;
}

/// Moves particles below free surfaces so that the sum of V grad W over their neighbours, by which a uniform pressure
/// would push them, all but vanishes: on two lattices that meet it is a twelfth of one over the coarser spacing, and
/// parts of a particle overlap its neighbours. The nearest wall of a vessel counts as a mirror, towards which nobody
/// moves; none passes a wall. \param ratio sph.smoothing_ratio \param is_part of each particle, whether it moves, 1 or
/// 0; empty, of one process: those move that have neighbours of another level
void relax(const Boundary& boundary, double ratio, const Relaxation& how, std::vector<double> is_part, Share& share,
           State& s) {
  constexpr double step = 0.2, filled = 0.9;  // of h^2 times the sum; of the kernel
  // Lists of their own, for which several processes find a halo.
  const std::vector<Vector3>& begun = s.list_position = s.position;
  std::vector<double>&length = s.list_smoothing_length, &margin = s.list_margin;
  length.clear(), margin.clear();
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    length.push_back(ratio * cube_root(s.mass_of_size(i) / s.density[i]));
    margin.push_back(how.max_way * length.back());
  }
  share.distribute(s, boundary.domain(), std::array{&is_part});
  const std::size_t count = s.position.size();
  std::vector<double> volume;
  for (std::size_t i = 0; i < count; ++i) volume.push_back(s.mass_of(i) / s.density[i]);
  std::vector<char> is_still;
  for (std::size_t i = 0; i < is_part.size(); ++i) is_still.push_back(!share.owns(i) || is_part[i] == 0);
  ThreadTeam team(1);
  Neighbourhood around(boundary.domain());
  around.build(team, begun, length, margin, {is_still, share.part().reach, share.part().margin});
  const auto place = [&](std::uint32_t n) {
    if (n < count) return s.position[n];
    const Ghost& ghost = around.ghosts()[n - count];
    return around.image(ghost).position(s.position[ghost.source]);
  };
  const auto source = [&](std::uint32_t n) { return n < count ? n : around.ghosts()[n - count].source; };
  std::vector<std::uint32_t> moving;
  for (std::uint32_t i = 0; i < count; ++i) {
    const auto differs = [&](std::uint32_t n) {
      return level_of(s.mass_ratio[source(n)]) != level_of(s.mass_ratio[i]);
    };
    if (is_part.empty() ? std::ranges::any_of(around.of(i), differs) : !is_still[i]) moving.push_back(i);
  }
  std::vector<std::optional<Mirror>> walls;
  for (const std::uint32_t i : moving)
    walls.push_back(mirror_near(boundary.vessel(), s.position[i], sph::support * length[i]));
  std::vector<Vector3> by(moving.size());
  for (int pass = 0; pass < how.passes; ++pass) {
    for (std::size_t m = 0; m < moving.size(); ++m) {
      const std::uint32_t i = moving[m];
      const Vector3& x = s.position[i];
      const std::optional<Mirror>& wall = walls[m];
      double sum = 0;
      Vector3 gradient;
      const auto add = [&](std::uint32_t j, const Vector3& other) {
        const Vector3 d = x - other;
        const double distance = norm(d), h = 0.5 * (length[i] + length[j]);
        if (distance >= sph::support * h) return;
        sum += volume[j] * sph::cubic_spline(distance, h);
        gradient += (volume[j] * sph::cubic_spline_slope(distance, h)) * d;
      };
      const auto add_both = [&](std::uint32_t j, const Vector3& other) {
        const double above = wall ? dot(other - wall->place, wall->normal) : 0;
        if (above < 0) return;  // behind the wall
        add(j, other);
        if (wall) add(j, other - (2 * above) * wall->normal);
      };
      add_both(i, x);
      for (const std::uint32_t n : around.of(i)) add_both(source(n), place(n));
      by[m] = sum > filled ? (-step * length[i] * length[i]) * gradient : Vector3{};
      if (wall) by[m] -= std::min(dot(by[m], wall->normal), 0.0) * wall->normal;
    }
    for (std::size_t m = 0; m < moving.size(); ++m) {
      const std::uint32_t i = moving[m];
      const Vector3 moved = s.position[i] + by[m] - begun[i];
      if (norm(moved) < margin[i] && !leaves(boundary, begun[i], begun[i] + moved)) s.position[i] += by[m];
    }
    share.refresh(std::array{Halo::column(std::span(s.position))});
  }
  share.drop_halo(s);
}

}  // namespace

void split_and_merge(const Levels& levels, const Boundary& boundary, const Parameters& p, Share& share, State& s) {
  for (int level = levels.lightest(); level < levels.count(); ++level) {
    std::optional<std::vector<double>> is_part = split(levels, boundary, share, s);
    if (!is_part) break;
    relax(boundary, p.sph.smoothing_ratio, levels.count() > 0 ? of_parts : about_axis, std::move(*is_part), share, s);
  }
  merge(levels, boundary, share, s);
}

void lay_levels(const Setup& setup, State& s) {
  const Levels levels(setup);
  Share alone(one_process());
  s.mass_ratio.assign(s.position.size(), 1);
  for (int level = 0; level < levels.count() && merge(levels, *setup.boundary, alone, s); ++level) {
  }
  s.merged_energy = 0;
  for (int level = levels.lightest(); level < 0; ++level) split(levels, *setup.boundary, alone, s, Halves::across_axis);
  relax(*setup.boundary, setup.given.sph.smoothing_ratio, at_start, {}, alone, s);
  s.list_position.clear(), s.list_smoothing_length.clear(), s.list_margin.clear();  // none have been built
}

}  // namespace talus::continuum
