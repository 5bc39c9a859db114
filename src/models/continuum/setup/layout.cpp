// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/layout.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "models/continuum/setup/bed_walls.hpp"
#include "models/continuum/setup/vessel_bed.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

namespace {

constexpr std::int64_t max_along_an_axis = 1'000'000'000'000;  // far beyond what check() lets pass
constexpr double max_tried = 1e6;                              // positions, to count the particles of a bed
constexpr double max_in_vessel = 2e6;  // the same in a vessel; a sector looks at its share of them

/// Whether an upright box of the vessel has a wall there, across an axis.
bool is_side_of_box(const Parameters& p, int axis, double place) {
  return std::any_of(p.vessel.begin(), p.vessel.end(), [&](const VesselPart& v) {
    if (v.shape != VesselShape::box || v.along != Along::z) return false;
    const double half = 0.5 * (axis == 0 ? v.width : v.depth);
    return std::abs(std::abs(place - on_axis(p, v)[axis]) - half) < 1e-9 * half;
  });
}

/// Along an axis: what bed.file holds with half a spacing around it; else from key to key, where these are left out the
/// walls of the vessel between which the bed lies. Where grains see none the faces, or the vessel where it stands apart
/// from both, or its upright box where a face cuts it.
Extent bed_along(const Parameters& p, int axis, double width, const std::optional<double>& first,
                 const std::optional<double>& last) {
  if (p.bed.given) return {p.bed.given->low[axis] - 0.5 * p.bed.spacing, p.bed.given->high[axis] + 0.5 * p.bed.spacing};
  Extent extent{0, width};
  if (!p.vessel.empty()) {
    const VesselBounds around = bounds_of_vessel(p);
    const bool low = around.low[axis] > 0, high = around.high[axis] < width;
    if (low && (high || is_side_of_box(p, axis, around.low[axis]))) extent.low = around.low[axis];
    if (high && (low || is_side_of_box(p, axis, around.high[axis]))) extent.high = around.high[axis];
  }
  if (p.bed.walls) {
    const auto side = static_cast<std::size_t>(2 * axis);
    extent.low = std::max(extent.low, p.bed.walls->ends[side].value_or(extent.low));
    extent.high = std::min(extent.high, p.bed.walls->ends[side + 1].value_or(extent.high));
  }
  return {first.value_or(extent.low), last.value_or(extent.high)};
}

}  // namespace

Extent bed_along_x(const Parameters& p) {
  return bed_along(p, 0, p.box.width, p.bed.left, p.bed.right);
}

Extent bed_along_y(const Parameters& p) {
  return bed_along(p, 1, p.box.depth, p.bed.front, p.bed.rear);
}

double bed_bottom(const Parameters& p) {
  if (p.bed.given) return p.bed.given->low.z - 0.5 * p.bed.spacing;
  if (!p.bed.bottom && !p.vessel.empty()) return std::max(0.0, bounds_of_vessel(p).low.z);
  return p.bed.bottom.value_or(p.wedge.half_angle ? p.wedge.height : p.plate.height.value_or(0));
}

std::string beds_key(std::size_t n, std::string_view name) {
  return fmt::format("beds.{}.{}", n + 1, name);
}

Parameters with_bed_alone(const Parameters& p, std::size_t bed) {
  Parameters q = p;
  q.beds.clear();
  if (bed == 0) return q;
  static_cast<BedRegion&>(q.bed) = p.beds[bed - 1];
  q.bed.file.clear(), q.bed.given = nullptr;
  return q;
}

std::vector<std::size_t> beds_of(const Parameters& p) {
  std::vector<std::size_t> beds;
  if (p.bed.mass || p.bed.given || p.bed.height > 0) beds.push_back(0);
  for (std::size_t n = 1; n <= p.beds.size(); ++n) beds.push_back(n);
  return beds;
}

std::vector<Extent> heights_of_beds(const Parameters& p) {
  std::vector<Extent> all, joined;
  for (const std::size_t n : beds_of(p)) {
    const Parameters one = with_bed_alone(p, n);
    all.push_back({bed_bottom(one), bed_bottom(one) + one.bed.height});
  }
  std::sort(all.begin(), all.end(), [](const Extent& a, const Extent& b) { return a.low < b.low; });
  for (const auto& [low, high] : all) {
    if (joined.empty() || low > joined.back().high + p.bed.spacing)
      joined.push_back({low, high});
    else
      joined.back().high = std::max(joined.back().high, high);
  }
  return joined;
}

double depth_of_grains(const Parameters& p) {
  if (p.beds.empty() && !beds_of(p).empty()) return p.bed.height;
  if (beds_of(p).empty()) {
    const double top = p.vessel.empty() ? p.box.height : std::min(p.box.height, bounds_of_vessel(p).high.z);
    return std::max(p.bed.spacing, top - bed_bottom(p));
  }
  double depth = 0;
  for (const auto& [low, high] : heights_of_beds(p)) depth += high - low;
  return depth;
}

std::optional<Outlet> slit_of(const Parameters& p) {
  const auto slit = [&](double height, double left, double right) {
    const double across = std::min(right - left, distance_of_walls(p.box.front, p.box.rear, p.box.depth));
    return Outlet{height, left, right, across, 0.5 * p.box.depth};
  };
  if (p.wedge.half_angle)
    return slit(p.wedge.height, 0.5 * (p.box.width - p.wedge.outlet), 0.5 * (p.box.width + p.wedge.outlet));
  if (p.plate.height && p.plate.slit_left && p.plate.slit_right)
    return slit(*p.plate.height, *p.plate.slit_left, *p.plate.slit_right);
  return std::nullopt;
}

std::optional<Sector> sector_of(const Parameters& p) {
  if (!p.box.sector) return std::nullopt;
  const double copies = std::round(2 * std::numbers::pi / *p.box.sector);
  if (!(copies >= Sector::min_copies && copies <= Sector::max_copies)) return std::nullopt;
  return Sector({0.5 * p.box.width, 0.5 * p.box.depth, 0}, static_cast<int>(copies));
}

double min_distance_of_layers(const Parameters& p) {
  // Images reach twice the support and the skin; particles grow as they thin out, so some room is left.
  return 3 * sph::support * p.sph.smoothing_ratio * p.bed.spacing;
}

Lattice lattice_of(const Parameters& p) {
  if (!p.beds.empty()) return lattice_of(with_bed_alone(p, beds_of(p).front()));
  const Extent x = bed_along_x(p), y = bed_along_y(p);
  const Vector3 extent{x.high - x.low, y.high - y.low, p.bed.height};
  Lattice lattice{.corner = {x.low, y.low, bed_bottom(p)}, .spacing = {}, .count = {}, .mass = 0};
  for (int axis = 0; axis < 3; ++axis) {
    const double spacings = extent[axis] / p.bed.spacing;
    const auto count = spacings < max_along_an_axis ? std::max<std::int64_t>(1, std::llround(spacings))
                                                    : std::int64_t{max_along_an_axis};
    lattice.count[static_cast<std::size_t>(axis)] = count;
    lattice.spacing[axis] = extent[axis] / static_cast<double>(count);
  }
  const bool empty = beds_of(p).empty();
  if (empty) lattice.count[2] = 0;
  if (empty || p.bed.given) {
    lattice.spacing = {p.bed.spacing, p.bed.spacing, p.bed.spacing};
    lattice.mass = p.bed.packing * p.grains.density * p.bed.spacing * p.bed.spacing * p.bed.spacing;
    return lattice;
  }
  lattice.mass = p.bed.packing * p.grains.density * lattice.spacing.x * lattice.spacing.y * lattice.spacing.z;
  if (const auto sector = sector_of(p); sector && sector->copies() > 1) {  // of the circle a whole number in each
    const int copies = sector->copies();
    const double circle = 0.25 * std::numbers::pi * extent.x * extent.x;
    const double places = std::max(1.0, std::round(circle / (copies * lattice.spacing.x * lattice.spacing.y)));
    lattice.mass = p.bed.packing * p.grains.density * (circle / (copies * places)) * lattice.spacing.z;
  }
  return lattice;
}

namespace {

/// Of a slit that a plane of symmetry cuts the whole width.
std::optional<double> width_of(const Parameters& p, const std::optional<Outlet>& outlet) {
  if (!outlet || !(outlet->right > outlet->left)) return std::nullopt;
  const bool halved = p.vessel.empty() && ((p.box.left == FaceKind::symmetry && outlet->left <= 0) ||
                                           (p.box.right == FaceKind::symmetry && outlet->right >= p.box.width));
  if (!halved) return outlet->across;
  return std::min(2 * (outlet->right - outlet->left), distance_of_walls(p.box.front, p.box.rear, p.box.depth));
}

std::optional<Outlet> outlet_of(const Parameters& p, const std::vector<VesselOutlet>& of_vessel) {
  if (of_vessel.empty()) return slit_of(p);
  const VesselOutlet& lowest = of_vessel.front();
  return Outlet{lowest.middle.z, lowest.middle.x - 0.5 * lowest.width, lowest.middle.x + 0.5 * lowest.width,
                lowest.narrow, lowest.middle.y};
}

}  // namespace

std::optional<double> outlet_width_of(const Parameters& p) {
  return width_of(p, outlet_of(p, outlets_of_vessel(p)));
}

namespace {

/// The lattice and which of its positions hold particles: walls go through the whole depth, so all positions along y
/// are alike. The bed may lie on both sides of a [plate], and on one side only of other walls.
struct Bed {
  const Layout& layout;
  const Parameters& parameters = layout.given;
  const Lattice& lattice = layout.lattice;
  const Domain& domain = layout.boundary->domain();
  Vector3 seed = parameters.bed.inside ? Vector3{(*parameters.bed.inside)[0], 0, (*parameters.bed.inside)[2]}
                                       : at(0.5 * static_cast<double>(lattice.count[0] - 1), 0,
                                            static_cast<double>(lattice.count[2] - 1));

  Vector3 at(double i, double j, double k) const {
    return lattice.corner +
           Vector3{(i + 0.5) * lattice.spacing.x, (j + 0.5) * lattice.spacing.y, (k + 0.5) * lattice.spacing.z};
  }
  bool is_whole = !parameters.wedge.half_angle && parameters.plates.empty();
  bool holds(const Vector3& x) const {
    return is_whole || (!domain.is_near_wall(x, 0.25 * parameters.bed.spacing) && !domain.blocks(x, seed));
  }
};

}  // namespace

Layout::Layout(const Parameters& parameters) : Layout(parameters, std::make_shared<const Boundary>(parameters)) {}

Layout::Layout(Parameters parameters, std::shared_ptr<const Boundary> same_boundary)
    : given(with_walls_of_beds(std::move(parameters), same_boundary)),
      boundary(std::move(same_boundary)),
      vessel_outlets(outlets_of_vessel(given)),
      outlet(outlet_of(given, vessel_outlets)),
      outlet_width(width_of(given, outlet)),
      copies(sector() ? sector()->copies() : 1),
      beds(beds_of(given)),
      lattice(lattice_of(given)),
      bottom(bed_bottom(beds.empty() ? given : continuum::with_bed_alone(given, beds.front()))),
      depth(depth_of_grains(given)) {}

Layout Layout::with_bed_alone(std::size_t bed) const {
  return with(continuum::with_bed_alone(given, bed));
}

std::vector<Vector3> bed_positions(const Layout& layout) {
  const Parameters& p = layout.given;
  if (!p.beds.empty()) {
    std::vector<Vector3> positions;
    for (const std::size_t n : layout.beds)
      for (const Vector3& x : bed_positions(layout.with_bed_alone(n))) positions.push_back(x);
    return positions;
  }
  if (p.bed.given) return p.bed.given->position;
  if (layout.has_no_bed()) return {};
  if (p.bed.mass) {  // the lowest of them
    Parameters whole = p;
    whole.bed.mass = std::nullopt;
    std::vector<Vector3> positions = bed_positions(layout.with(whole));
    positions.resize(std::min(positions.size(), static_cast<std::size_t>(count_of_mass(p))));
    return positions;
  }
  if (!p.vessel.empty()) return bed_in_vessel(layout);
  const Bed bed{layout};
  const auto& count = bed.lattice.count;
  std::vector<Vector3> positions;
  for (std::int64_t k = 0; k < count[2]; ++k)
    for (std::int64_t j = 0; j < count[1]; ++j)
      for (std::int64_t i = 0; i < count[0]; ++i)
        if (const Vector3 x = bed.at(double(i), double(j), double(k)); bed.holds(x)) positions.push_back(x);
  return positions;
}

namespace {

double count_of_bed(const Layout& layout) {
  const Parameters& p = layout.given;
  if (!p.beds.empty()) {
    double count = 0;
    for (const std::size_t n : layout.beds) count += bed_count(layout.with_bed_alone(n));
    return count;
  }
  if (p.bed.given) return static_cast<double>(p.bed.given->position.size());
  if (layout.has_no_bed()) return 0;
  if (p.bed.mass) return count_of_mass(p);
  if (!p.vessel.empty()) {
    if (layout.lattice.positions() <= max_in_vessel * layout.copies)
      return static_cast<double>(bed_in_vessel(layout).size());
    Parameters coarser = p;
    coarser.bed.spacing *= 2;
    return 8 * bed_count(Layout(coarser));
  }
  const Bed bed{layout};
  const auto& count = bed.lattice.count;
  if (bed.is_whole) return bed.lattice.positions();
  const double layer = static_cast<double>(count[0]) * static_cast<double>(count[2]);
  const auto stride = static_cast<std::int64_t>(std::ceil(std::sqrt(std::max(1.0, layer / max_tried))));
  double held = 0, tried = 0;
  for (std::int64_t k = stride / 2; k < count[2]; k += stride)
    for (std::int64_t i = stride / 2; i < count[0]; i += stride, ++tried)
      held += bed.holds(bed.at(double(i), 0, double(k))) ? 1 : 0;
  return tried > 0 ? std::round(held / tried * layer) * static_cast<double>(count[1]) : 0;
}

}  // namespace

double bed_count(const Layout& layout) {
  std::call_once(layout.counted->once, [&] { layout.counted->particles = count_of_bed(layout); });
  return layout.counted->particles;
}

}  // namespace talus::continuum
