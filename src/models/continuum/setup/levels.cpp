// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/levels.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <numbers>
#include <utility>

#include "models/continuum/setup/layout.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

/// Around an outlet.
void add_outlet(const Vector3& middle, double width, double depth, std::vector<std::array<Vector3, 2>>& boxes) {
  const Vector3 half{0.5 * width, 0.5 * depth, 0};
  boxes.push_back({middle - half, middle + half});
}

std::vector<std::array<Vector3, 2>> fine_boxes(const Layout& layout) {
  const Parameters& p = layout.given;
  std::vector<std::array<Vector3, 2>> boxes;
  for (const VesselOutlet& outlet : layout.vessel_outlets)
    add_outlet(outlet.middle, outlet.endless_along_x ? p.box.width : outlet.width,
               outlet.endless_along_y ? p.box.depth : outlet.depth, boxes);
  if (const auto& slit = layout.outlet; slit && boxes.empty())
    add_outlet({0.5 * (slit->left + slit->right), 0.5 * p.box.depth, slit->height}, slit->right - slit->left,
               p.box.depth, boxes);
  if (p.levels.low && p.levels.high) {
    const auto &low = *p.levels.low, &high = *p.levels.high;
    boxes.push_back({Vector3{low[0], low[1], low[2]}, Vector3{high[0], high[1], high[2]}});
  }
  return boxes;
}

double angle_of(const Sector& sector) {
  return 2 * std::numbers::pi / sector.copies();
}

/// levels.distance, m; nothing if it is left out and no outlet has a width.
std::optional<double> distance_of(const Layout& layout) {
  const LevelParameters& levels = layout.given.levels;
  if (levels.distance || !layout.outlet_width) return levels.distance;
  return (1 + 0.5 * static_cast<double>(levels.count)) * *layout.outlet_width;
}

}  // namespace

bool splits_at_axis(const Parameters& p) {
  return p.box.sector && p.law.is<granular::CriticalState>() && p.sph.smoothing == Smoothing::local &&
         !(stress_regularisation(p) > 0);
}

bool has_several_masses(const Parameters& p) {
  return p.levels.count > 0 || splits_at_axis(p);
}

Levels::Levels(const Layout& layout) : count_(static_cast<int>(layout.given.levels.count)) {
  if (!has_several_masses(layout.given)) return;
  distance_ = distance_of(layout).value_or(0);
  for (const auto& [low, high] : fine_boxes(layout)) regions_.push_back({low, high});
  const Lattice& lattice = layout.lattice;
  sector_ = layout.sector(), corner_ = lattice.corner, spacing_ = lattice.spacing;
  if (sector_) {
    const Parameters& p = layout.given;
    spacing_.x = std::sqrt(lattice.mass / (p.bed.packing * p.grains.density * lattice.spacing.z));
  }
}

/// To the nearest of the regions, m^2.
double Levels::square_of_distance(const Vector3& x) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Region& region : regions_) {
    double square = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const double apart = std::max({region.low[axis] - x[axis], x[axis] - region.high[axis], 0.0});
      square += apart * apart;
    }
    least = std::min(least, square);
  }
  return least;
}

int Levels::wanted(const Vector3& x, double slack) const {
  const double least = square_of_distance(x);
  int level = 0;
  for (double begins = slack * distance_; level < count_ && least > begins * begins; begins *= 2) ++level;
  if (!sector_) return level;
  constexpr double when_coarse = 2;  // as so much longer an arc counts where nothing decides what passes an outlet
  const double arc = (level > 0 ? when_coarse : 1) * sector_->radius(x) * angle_of(*sector_) / (slack * spacing_.x);
  while (level > lightest_level && arc < std::ldexp(1.0, level)) --level;
  return level;
}

double Levels::smooth_spacing(const Vector3& x) const {
  if (count_ == 0) return 1;
  const double over = std::sqrt(square_of_distance(x)) / distance_;
  return std::min(over < 1 ? 1 + over : 2 * over, std::exp2(count_));
}

std::array<std::int64_t, 3> Levels::cell_of(const Vector3& x, int level) const {
  const auto whole = [](double value) { return static_cast<std::int64_t>(std::floor(value)); };
  const Vector3 size = size_of_cell(level), from = x - corner_;
  const std::int64_t up = whole(from.z / size.z);
  if (!sector_) return {whole(from.x / size.x), whole(from.y / size.y), up};
  const Vector3 about = x - sector_->axis();
  const std::int64_t ring = whole(sector_->radius(x) / size.x);
  const double share = std::clamp(std::atan2(about.y, about.x) / angle_of(*sector_), 0.0, 1 - 1e-12);
  return {ring, whole(share * places_in_ring(ring)), up};
}

Vector3 Levels::middle_of(const std::array<std::int64_t, 3>& cell, int level) const {
  const Vector3 size = size_of_cell(level);
  const auto middle = [&](std::size_t axis) { return static_cast<double>(cell[axis]) + 0.5; };
  const double z = corner_.z + middle(2) * size.z;
  if (!sector_) return {corner_.x + middle(0) * size.x, corner_.y + middle(1) * size.y, z};
  const double radius = middle(0) * size.x, angle = middle(1) / places_in_ring(cell[0]) * angle_of(*sector_);
  return {sector_->axis().x + radius * std::cos(angle), sector_->axis().y + radius * std::sin(angle), z};
}

Vector3 Levels::size_of_cell(int level) const {
  return (level < 0 ? 1 : 2.0 * (1 << level)) * spacing_;
}

/// How many cells share a ring of a sector.
double Levels::places_in_ring(std::int64_t ring) const {
  return std::max(1.0, std::round((static_cast<double>(ring) + 0.5) * angle_of(*sector_)));
}

namespace {

/// Height, m, and particles for each of those of bed.spacing, of places of the bed: of coarser ones where it has many.
std::vector<std::pair<double, double>> particles_by_height(const Layout& layout) {
  constexpr double max_tried = 3e4;
  std::optional<Layout> coarser;
  if (const double count = bed_count(layout); count > max_tried) {
    Parameters p = layout.given;
    p.levels.distance = distance_of(layout);
    p.bed.spacing *= std::cbrt(count / max_tried);
    coarser.emplace(p);
  }
  const Layout& tried = coarser ? *coarser : layout;
  const Levels levels(tried);
  std::vector<std::pair<double, double>> particles;
  for (const Vector3& x : bed_positions(tried))
    particles.emplace_back(x.z, 1 / mass_ratio_of(levels.wanted(x, Levels::slack_of_merging)));
  std::sort(particles.begin(), particles.end());
  return particles;
}

}  // namespace

double share_of_particles(const Layout& layout) {
  if (!has_several_masses(layout.given) || layout.has_no_bed()) return 1;
  double sum = 0;
  const auto particles = particles_by_height(layout);
  for (const auto& [height, count] : particles) sum += count;
  return particles.empty() ? 1 : sum / static_cast<double>(particles.size());
}

std::vector<double> shares_left(const Layout& layout, std::span<const double> shares_of_mass) {
  std::vector<double> below{0}, left;  // how many lie below each of those of bed.spacing, and below all
  if (layout.given.levels.count > 0)
    for (const auto& [height, count] : particles_by_height(layout)) below.push_back(below.back() + count);
  const std::size_t last = below.size() - 1;
  for (const double share : shares_of_mass) {
    const double stay = 1 - share, place = stay * static_cast<double>(last);
    const std::size_t n = std::min(static_cast<std::size_t>(place), last);
    const double of_next = n < last ? (place - static_cast<double>(n)) * (below[n + 1] - below[n]) : 0;
    left.push_back(last > 0 ? (below[n] + of_next) / below[last] : stay);
  }
  return left;
}

namespace {

/// Adds a problem where something is so.
class Refusals {
 public:
  void operator()(bool so, const char* key, std::string what, std::string allowed) {
    if (so) problems_.push_back({.key = key, .what = std::move(what), .allowed = std::move(allowed)});
  }
  std::vector<Problem> take() { return std::move(problems_); }

 private:
  std::vector<Problem> problems_;
};

}  // namespace

std::vector<Problem> check_levels(const Parameters& p) {
  if (p.levels.count == 0) return {};
  Refusals refuse;
  refuse(p.levels.low.has_value() != p.levels.high.has_value(), p.levels.low ? "levels.high" : "levels.low",
         "one corner of the box without the other", "both corners, or none");
  if (p.levels.low && p.levels.high)
    for (std::size_t axis = 0; axis < 3; ++axis)
      refuse(!((*p.levels.low)[axis] <= (*p.levels.high)[axis]), "levels.high", "is below levels.low along an axis",
             "at least levels.low along each axis");
  refuse(p.sph.smoothing == Smoothing::fixed, "sph.smoothing", "fixed, and particles have several sizes",
         "local with levels");
  refuse(stress_regularisation(p) > 0, "sph.stress_regularisation", "not summed over particles of several sizes yet",
         "0 with levels");
  refuse(!p.law.is<granular::CriticalState>(), "law.name",
         "particles that split and merge have no place from which strain could be measured",
         "critical-state with levels");
  return refuse.take();
}

std::vector<Problem> check_levels(const Layout& layout) {
  const Parameters& p = layout.given;
  if (p.levels.count == 0) return {};
  Refusals refuse;
  const bool has_box = p.levels.low && p.levels.high, is_near_outlet = distance_of(layout).has_value();
  refuse(!layout.outlet && !has_box, "levels.count", "there is no outlet near which particles could be fine",
         "0, or a box of levels.low and levels.high");
  refuse((layout.outlet || has_box) && !is_near_outlet, "levels.distance", "left out, and no outlet has a width",
         "a distance");
  const double coarsest = std::exp2(p.levels.count) * p.bed.spacing, reach = 2.2 * sph::support * coarsest,
               room = layout.boundary->domain().max_reach();
  refuse(!(reach < room), "levels.count",
         fmt::format("particles of {:.3g} mm reach {:.3g} mm, walls are {:.3g} mm apart", 1e3 * coarsest, 1e3 * reach,
                     1e3 * room),
         "fewer levels, or walls farther apart");
  return refuse.take();
}

}  // namespace talus::continuum
