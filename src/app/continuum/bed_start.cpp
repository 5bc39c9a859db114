// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/bed_start.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/case/scene.hpp"
#include "io/figure/figure.hpp"
#include "models/continuum/setup/bed_report.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::app {

namespace {

using continuum::Layout;

constexpr double millimetre = 1e-3;
constexpr double half_thickness = 0.51;  // of a section, in spacings: one layer of a lattice at least
constexpr figure::View view_yz{{0, 1, 0}, {0, 0, 1}, {1, 0, 0}};

/// What a section across an axis shows.
struct Section {
  std::vector<Vector3> positions;
  std::vector<double> radii;
  std::vector<figure::Segment> segments;
};

/// \param positions of the whole bed
Section section(const Layout& layout, const std::vector<Vector3>& positions, int axis, double at) {
  const continuum::Parameters& p = layout.given;
  Section cut;
  // Through the layer nearest to the plane.
  double nearest = INFINITY;
  for (const Vector3& x : positions) nearest = std::min(nearest, std::abs(x[axis] - at));
  for (const Vector3& x : positions)
    if (std::abs(x[axis] - at) <= std::max(nearest, half_thickness * p.bed.spacing)) cut.positions.push_back(x);
  cut.radii.assign(cut.positions.size(), 0.5 * p.bed.spacing);
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
    for (const auto& [from, to] : section_at(Surface(std::move(triangles), p.vessel.size()), at))
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
      extents.push_back(fmt::format("{} {:.4g} to {:.4g} mm", "xyz"[axis], report.low[axis] / millimetre,
                                    report.high[axis] / millimetre));
    lines.emplace_back("lies at", fmt::format("{}", fmt::join(extents, ", ")));
    lines.emplace_back("lies against",
                       report.beside.empty() ? "no wall or face" : fmt::format("{}", fmt::join(report.beside, ", ")));
  }
  if (p.bed.given && !p.bed.given->unread.empty())
    lines.emplace_back("not read",
                       fmt::format("{}: stress and history start from zero", fmt::join(p.bed.given->unread, ", ")));
  return lines;
}

void draw_bed(const Layout& layout, const std::string& title, const std::filesystem::path& path) {
  const continuum::Parameters& p = layout.given;
  std::vector<Vector3> positions = continuum::bed_positions(layout);
  if (const auto& sector = layout.sector()) {
    const std::size_t own = positions.size();
    for (int k = 1; k < sector->copies(); ++k)
      for (std::size_t n = 0; n < own; ++n) positions.push_back(sector->turned(positions[n], k));
  }
  Vector3 middle = 0.5 * Vector3{p.box.width, p.box.depth, p.box.height};
  if (!positions.empty()) {
    Vector3 low = positions.front(), high = low;
    for (const Vector3& x : positions)
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
    middle = 0.5 * (low + high);
  }
  std::vector<Section> cuts = {section(layout, positions, 1, middle.y)};
  const bool is_deep = p.box.depth > 4 * p.bed.spacing;
  if (is_deep) cuts.push_back(section(layout, positions, 0, middle.x));
  figure::Figure figure{.title = title, .columns = static_cast<int>(cuts.size()), .letters = false};
  figure.panels.emplace_back(
      picture_of(cuts[0], figure::view_xz, fmt::format("*y* = {:.4g} mm", middle.y / millimetre)));
  if (is_deep)
    figure.panels.emplace_back(picture_of(cuts[1], view_yz, fmt::format("*x* = {:.4g} mm", middle.x / millimetre)));
  figure::write_png(figure, path);
}

}  // namespace talus::app
