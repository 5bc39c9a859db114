// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <unordered_map>

#include "base/random.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::cloud {

namespace {

constexpr int max_trials_of_grain = 1'000'000;

std::vector<double> draw_radii(const Parameters::Particles& p, Random& random) {
  std::vector<double> radius(p.count, p.radius);
  if (p.radius_spread == 0) return radius;
  for (double& a : radius) {
    double deviation;
    if (p.radius_distribution == RadiusDistribution::uniform) {
      deviation = random.uniform(-1, 1);
    } else {
      // Cut at three standard deviations, or where the radius would vanish.
      do deviation = random.normal();
      while (std::abs(deviation) > 3 || 1 + p.radius_spread * deviation < 0.05);
    }
    a = p.radius * (1 + p.radius_spread * deviation);
  }
  return radius;
}

/// A point of the box around the shape, and whether it lies inside, with a margin inwards.
struct ShapeSampler {
  const Parameters& parameters;
  bool on_slope;
  // A shape has those it needs: check().
  double size = parameters.particles.size.value_or(0);
  double length = parameters.particles.length.value_or(0), width = parameters.particles.width.value_or(0);

  Vector3 draw(Random& random) const {
    const double u = random.uniform(), v = random.uniform();
    switch (parameters.particles.shape) {
      case Shape::circle:
        return in_plane(size * (2 * u - 1), size * (2 * v - 1));
      case Shape::rectangle:
        return in_plane(length * (u - 0.5), width * (on_slope ? v : v - 0.5));
      case Shape::triangle:
        return in_plane(size * (2 * u - 1), size * v);
      case Shape::wedge:
        return in_plane(-size * u / std::sin(parameters.slope.angle), size * v / std::cos(parameters.slope.angle));
      case Shape::ball:
        return {size * (2 * u - 1), size * (2 * v - 1), size * (2 * random.uniform() - 1) + lift()};
      case Shape::dome:
        return {size * (2 * u - 1), size * (2 * v - 1), size * random.uniform()};
      case Shape::file:
        break;
    }
    return {};
  }

  bool contains(const Vector3& x, double margin) const {
    const double across = parameters.motion == Motion::xz ? x.z : x.y;
    switch (parameters.particles.shape) {
      case Shape::circle:
        return std::hypot(x.x, across - (on_slope ? size : 0)) <= size - margin;
      case Shape::rectangle:
        return std::abs(x.x) <= 0.5 * length - margin &&
               std::abs(across - (on_slope ? 0.5 * width : 0)) <= 0.5 * width - margin;
      // Right-angled at the apex: the flanks fall at 45 degrees.
      case Shape::triangle:
        return across >= margin && std::abs(x.x) + across <= size - std::sqrt(2.0) * margin;
      // The level surface lies `size` above the gate's foot, the origin: sizes along gravity.
      case Shape::wedge:
        return x.x <= -margin && across >= margin &&
               across * std::cos(parameters.slope.angle) - x.x * std::sin(parameters.slope.angle) <= size - margin;
      case Shape::ball:
        return norm(x - Vector3{0, 0, lift()}) <= size - margin;
      case Shape::dome:
        return x.z >= margin && norm(x) <= size - margin;
      case Shape::file:
        break;
    }
    return false;
  }

 private:
  double lift() const { return on_slope ? size : 0.0; }
  Vector3 in_plane(double x, double across) const {
    if (parameters.motion == Motion::xy) return {x, across, 0};
    // A circle above the slope rests on it.
    return {x, 0, across + (on_slope && parameters.particles.shape == Shape::circle ? size : 0.0)};
  }
};

/// Grains placed so far, in cells of two largest radii: a new grain can touch only those of the 27 cells around it.
class Placed {
 public:
  Placed(double max_radius, const std::vector<double>& radius) : cell_(2 * max_radius), radius_(radius) {}

  bool is_free(const Vector3& x, double a) const {
    const Key centre = key(x);
    for (std::int64_t k = -1; k <= 1; ++k)
      for (std::int64_t j = -1; j <= 1; ++j)
        for (std::int64_t i = -1; i <= 1; ++i) {
          const auto found = cells_.find(pack({centre.i + i, centre.j + j, centre.k + k}));
          if (found == cells_.end()) continue;
          for (const std::uint32_t n : found->second)
            if (norm(x - position_[n]) < a + radius_[n]) return false;
        }
    return true;
  }

  void place(const Vector3& x) {
    cells_[pack(key(x))].push_back(static_cast<std::uint32_t>(position_.size()));
    position_.push_back(x);
  }

  std::vector<Vector3> take() { return std::move(position_); }

 private:
  struct Key {
    std::int64_t i, j, k;
  };
  Key key(const Vector3& x) const {
    return {std::int64_t(std::floor(x.x / cell_)), std::int64_t(std::floor(x.y / cell_)),
            std::int64_t(std::floor(x.z / cell_))};
  }
  static std::uint64_t pack(const Key& c) {
    constexpr std::int64_t offset = 1 << 20;
    return std::uint64_t(c.i + offset) << 42 | std::uint64_t(c.j + offset) << 21 | std::uint64_t(c.k + offset);
  }

  double cell_;
  const std::vector<double>& radius_;
  std::vector<Vector3> position_;
  std::unordered_map<std::uint64_t, std::vector<std::uint32_t>> cells_;
};

double extent(const std::vector<Vector3>& points) {
  Vector3 low = points.front(), high = low;
  for (const Vector3& x : points) {
    low = {std::min(low.x, x.x), std::min(low.y, x.y), std::min(low.z, x.z)};
    high = {std::max(high.x, x.x), std::max(high.y, x.y), std::max(high.z, x.z)};
  }
  return std::max({high.x - low.x, high.y - low.y, high.z - low.z});
}

/// Pairs of grains that overlap by more than any run lets pass, or whose tensor is not finite.
struct Overlaps {
  std::size_t count = 0, first = 0, second = 0;
  double largest = 0;  ///< m
};

Overlaps overlaps_beyond(const Parameters& p, const Grains& grains) {
  Overlaps found;
  const double widest = 2 * *std::max_element(grains.radius.begin(), grains.radius.end());
  const double limit = p.integration.max_overlap * p.particles.radius;
  const bool singular = p.fluid.mobility == hydrodynamics::Mobility::rotne_prager_1969;
  const CellGrid grid(grains.position, std::max(widest, extent(grains.position) / (1 << 19)));
  for (std::size_t i = 0; i < grains.position.size(); ++i)
    grid.for_each_candidate(grains.position[i], [&](std::uint32_t j) {
      if (j <= i) return;
      const double distance = norm(grains.position[j] - grains.position[i]);
      const double overlap = grains.radius[i] + grains.radius[j] - distance;
      if (!(p.contact.enabled && overlap > limit) && !(singular && distance == 0)) return;
      if (found.count++ == 0 || overlap > found.largest) found.first = i, found.second = j, found.largest = overlap;
    });
  return found;
}

}  // namespace

Grains pack(const Parameters& parameters) {
  Random random(static_cast<std::uint64_t>(parameters.seed));
  Grains grains;
  grains.radius = draw_radii(parameters.particles, random);
  const bool on_slope = parameters.slope.enabled && parameters.motion != Motion::xy;
  const ShapeSampler shape{parameters, on_slope};
  Placed placed(*std::max_element(grains.radius.begin(), grains.radius.end()), grains.radius);
  for (std::size_t n = 0; n < grains.radius.size(); ++n) {
    const double a = grains.radius[n];
    const double margin = parameters.particles.boundary == Boundary::whole ? a : 0.0;
    int trial = 0;
    Vector3 x;
    do {
      if (++trial > max_trials_of_grain)
        throw NumericalError({.what = fmt::format("no place for a grain after {} trials", max_trials_of_grain),
                              .term = "random packing of the start",
                              .place = fmt::format("grain {} of {}", n + 1, grains.radius.size()),
                              .advice = "a larger shape or fewer grains"});
      x = shape.draw(random);
    } while (!shape.contains(x, margin) || (on_slope && x.z < a) || !placed.is_free(x, a));
    placed.place(x);
  }
  grains.position = placed.take();
  return grains;
}

std::vector<Problem> check_grains(const Parameters& parameters, const Grains& grains) {
  std::vector<Problem> problems;
  auto add = [&](const std::string& what, const std::string& allowed) {
    problems.push_back({.key = "particles.file", .what = what, .allowed = allowed});
  };
  if (grains.position.empty()) add("holds no points", "at least one");
  std::size_t bad_radius = 0, not_finite = 0, out_of_plane = 0;
  for (const double a : grains.radius) bad_radius += !(std::isfinite(a) && a > 0);
  for (const Vector3& x : grains.position) {
    not_finite += !std::isfinite(norm(x));
    out_of_plane += (parameters.motion == Motion::xy && x.z != 0) || (parameters.motion == Motion::xz && x.y != 0);
  }
  if (bad_radius) add(fmt::format("{} radii are not positive numbers", bad_radius), "radii above 0");
  if (not_finite) add(fmt::format("{} places are not finite", not_finite), "finite coordinates");
  if (!grains.position.empty() && !not_finite && !(extent(grains.position) < 1e6 * parameters.particles.radius))
    add(fmt::format("the points extend over {:.3g} m, more than a million radii", extent(grains.position)),
        "grains near each other; see particles.radius and the units of the columns");
  if (out_of_plane)
    add(fmt::format("{} points lie outside the plane of motion \"{}\"", out_of_plane, choice_name(parameters.motion)),
        "points in that plane, or motion = \"xyz\"");
  if (!problems.empty()) return problems;
  const double a = parameters.particles.radius, limit = parameters.integration.max_overlap;
  const std::string allowed = fmt::format("overlaps up to integration.max_overlap = {:g} radii", limit);
  if (const Overlaps overlaps = overlaps_beyond(parameters, grains); overlaps.count > 0)
    add(fmt::format("{} pair{} overlap too much; points {} and {} by {:.3g} radii", overlaps.count,
                    overlaps.count == 1 ? "" : "s", overlaps.first + 1, overlaps.second + 1, overlaps.largest / a),
        allowed);
  std::size_t sunk = 0, deepest = 0;
  if (parameters.slope.enabled && parameters.contact.enabled && parameters.motion != Motion::xy)
    for (std::size_t n = 0; n < grains.position.size(); ++n) {
      const auto depth = [&](std::size_t k) { return grains.radius[k] - grains.position[k].z; };
      if (depth(n) > limit * a && (sunk++ == 0 || depth(n) > depth(deepest))) deepest = n;
    }
  if (sunk > 0)
    add(fmt::format("{} point{} of grains within the slope; point {} lies at z = {:.4g} m", sunk, sunk == 1 ? "" : "s",
                    deepest + 1, grains.position[deepest].z),
        allowed);
  return problems;
}

}  // namespace talus::cloud
