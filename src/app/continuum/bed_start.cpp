// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/bed_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/case/scene.hpp"
#include "base/unit.hpp"
#include "io/figure/figure.hpp"
#include "models/continuum/setup/bed_report.hpp"
#include "models/continuum/setup/initial.hpp"
#include "models/continuum/setup/levels.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::app {

namespace {

using continuum::Layout;

constexpr double half_thickness = 0.51;  // of a section, in sizes of a particle: one layer of a lattice at least
constexpr figure::View view_yz{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};

/// What a section across an axis shows.
struct Section {
  std::vector<Vector3> positions;
  std::vector<double> radii;
  std::vector<figure::Segment> segments;
};

/// The particles at the start, of the whole vessel.
struct Bed {
  std::vector<Vector3> positions;
  std::vector<double> sizes;  ///< sides of the cubes that they fill, m
};

Bed bed_of(const continuum::Setup& setup) {
  const double spacing = setup.given.bed.spacing;
  Bed bed;
  if (continuum::has_several_masses(setup.given)) {
    const continuum::State state = continuum::initial_state(setup);
    bed.positions = state.position;
    for (const double ratio : state.mass_ratio) bed.sizes.push_back(spacing * std::cbrt(ratio));
  } else {
    bed.positions = continuum::bed_positions(setup);
    bed.sizes.assign(bed.positions.size(), spacing);
  }
  const std::size_t own = bed.positions.size();
  const auto& sector = setup.sector();
  for (int k = 1; sector && k < sector->copies(); ++k)
    for (std::size_t n = 0; n < own; ++n) {
      bed.positions.push_back(sector->turned(bed.positions[n], k));
      bed.sizes.push_back(bed.sizes[n]);
    }
  return bed;
}

Section section(const Layout& layout, const Bed& bed, int axis, double at) {
  Section cut;
  // Through the layer nearest to the plane.
  double nearest = INFINITY;
  for (const Vector3& x : bed.positions) nearest = std::min(nearest, std::abs(x[axis] - at));
  for (std::size_t n = 0; n < bed.positions.size(); ++n)
    if (std::abs(bed.positions[n][axis] - at) <= std::max(nearest, half_thickness * bed.sizes[n])) {
      cut.positions.push_back(bed.positions[n]);
      cut.radii.push_back(0.5 * bed.sizes[n]);
    }
  const Domain& domain = layout.boundary->domain();
  if (axis == 1)
    for (const WallLine& line : scene_of(domain, 0).walls) cut.segments.push_back({line.from, line.to});
  const Box& box = domain.box();
  const auto add_face = [&](int of, int side, const Vector3& from, const Vector3& to) {
    if (axis == 0 && is_mirror(box.face(of, side))) cut.segments.push_back({from, to});
  };
  const Vector3 &a = box.low, &b = box.high;
  add_face(2, 0, a, {a.x, b.y, a.z});
  add_face(2, 1, {a.x, a.y, b.z}, {a.x, b.y, b.z});
  add_face(1, 0, a, {a.x, a.y, b.z});
  add_face(1, 1, {a.x, b.y, a.z}, {a.x, b.y, b.z});
  // section_at() cuts across y.
  const auto turned = [&](Vector3 x) {
    if (axis == 0) std::swap(x.x, x.y);
    return x;
  };
  std::vector<Triangle> triangles;
  for (Triangle t : layout.boundary->vessel().triangles()) {
    for (Vector3& corner : t.corner) corner = turned(corner);
    triangles.push_back(t);
  }
  if (!triangles.empty())
    for (const auto& [from, to] : section_at(Surface(std::move(triangles), layout.given.vessel.size()), at))
      cut.segments.push_back({turned(from), turned(to)});
  return cut;
}

figure::ParticlePicture picture_of(const Section& cut, const figure::View& view, std::string title) {
  figure::ParticlePicture picture{
      .title = std::move(title), .positions = cut.positions, .radii = cut.radii, .view = view};
  picture.segments = cut.segments;
  figure::Window w{INFINITY, -INFINITY, INFINITY, -INFINITY};
  const auto add = [&](const Vector3& x, double room) {
    const double across = dot(view.right, x), up = dot(view.up, x);
    w = {std::min(w.left, across - room), std::max(w.right, across + room), std::min(w.bottom, up - room),
         std::max(w.top, up + room)};
  };
  for (std::size_t n = 0; n < cut.positions.size(); ++n) add(cut.positions[n], cut.radii[n]);
  for (const figure::Segment& segment : cut.segments) add(segment.from, 0), add(segment.to, 0);
  if (!(w.left < w.right && w.bottom < w.top)) return picture;  // nothing to show
  const double room = 0.02 * std::max(w.right - w.left, w.top - w.bottom);
  picture.window = {w.left - room, w.right + room, w.bottom - room, w.top + room};
  picture.length =
      std::max(w.right - w.left, w.top - w.bottom) < 2 ? figure::Unit{millimetre, "mm"} : figure::Unit{1, "m"};
  picture.aspect = std::clamp((w.top - w.bottom) / (w.right - w.left), 0.2, 2.5);
  return picture;
}

/// Without what rounding leaves of 0.
double in_millimetres(double length) {
  return std::abs(length) < 1e-9 ? 0 : length / millimetre;
}

}  // namespace

std::vector<std::pair<std::string, std::string>> bed_lines(const Layout& layout) {
  const continuum::Parameters& p = layout.given;
  if (layout.has_no_bed()) return {{"bed", "none: grains come in through inlets only"}};
  std::vector<std::pair<std::string, std::string>> lines;
  for (const std::size_t n : layout.beds) {
    const continuum::BedReport report = continuum::report_of_bed(layout.with_bed_alone(n));
    const std::string name = n == 0 ? "bed" : fmt::format("beds.{}, tag {}", n, p.beds[n - 1].tag);
    lines.emplace_back(name, fmt::format("{:.0f} particles, {:.4g} kg", report.particles, report.mass));
    std::vector<std::string> extents;
    for (int axis = 0; axis < 3; ++axis)
      extents.push_back(fmt::format("{} {:.4g} to {:.4g} mm", "xyz"[axis], in_millimetres(report.low[axis]),
                                    in_millimetres(report.high[axis])));
    lines.emplace_back("lies at", fmt::format("{}", fmt::join(extents, ", ")));
    lines.emplace_back("lies against",
                       report.beside.empty() ? "no wall or face" : fmt::format("{}", fmt::join(report.beside, ", ")));
  }
  if (p.bed.given && !p.bed.given->unread.empty())
    lines.emplace_back("not read",
                       fmt::format("{}: stress and history start from zero", fmt::join(p.bed.given->unread, ", ")));
  return lines;
}

void draw_bed(const continuum::Setup& setup, const std::string& title, const std::filesystem::path& path) {
  const continuum::Parameters& p = setup.given;
  const Bed bed = bed_of(setup);
  Vector3 middle = 0.5 * Vector3{p.box.width, p.box.depth, p.box.height};
  if (!bed.positions.empty()) {
    Vector3 low = bed.positions.front(), high = low;
    for (const Vector3& x : bed.positions)
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
    middle = 0.5 * (low + high);
  }
  std::vector<Section> cuts = {section(setup, bed, 1, middle.y)};
  const bool is_deep = p.box.depth > 4 * p.bed.spacing;
  if (is_deep) cuts.push_back(section(setup, bed, 0, middle.x));
  figure::Figure figure{.title = title, .columns = static_cast<int>(cuts.size()), .letters = false};
  figure.panels.emplace_back(
      picture_of(cuts[0], figure::view_xz, fmt::format("*y* = {:.4g} mm", middle.y / millimetre)));
  if (is_deep)
    figure.panels.emplace_back(picture_of(cuts[1], view_yz, fmt::format("*x* = {:.4g} mm", middle.x / millimetre)));
  figure::write_png(figure, path);
}

}  // namespace talus::app
