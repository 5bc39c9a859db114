// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_snapshots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/curve.hpp"
#include "analysis/frontal_angle.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

using namespace figure;

namespace {

constexpr double pi = 3.14159265358979323846;
constexpr Colour other = rgb(0x9aa5b1), light_blue = rgb(0x6fb1dd);

/// A measured length, with arrow heads.
Segment measure(const Vector3& from, const Vector3& to, const std::string& label) {
  return {.from = from, .to = to, .label = label, .colour = vermillion, .arrow_heads = true};
}

/// From a grain to the line that measures.
Segment extension(const Vector3& from, const Vector3& to) {
  return {.from = from, .to = to, .colour = vermillion, .dash = Dash::dotted};
}

/// The grains between which a head's width and thickness are measured, Figure 8c.
struct MeasuredGrains {
  std::uint32_t left, right, foremost, inner;
};

MeasuredGrains measured_grains(std::span<const Vector3> position, std::span<const double> radius, const GrainSet& head,
                               const HeadSize& size) {
  MeasuredGrains measured{head[0], head[0], head[0], head[0]};
  auto left = [&](std::uint32_t i) { return position[i].y + radius[i]; };
  auto right = [&](std::uint32_t i) { return position[i].y - radius[i]; };
  auto front = [&](std::uint32_t i) { return position[i].x + radius[i]; };
  auto from_inner = [&](std::uint32_t i) { return std::abs(position[i].x - radius[i] - size.inner); };
  for (const std::uint32_t i : head) {
    if (left(i) > left(measured.left)) measured.left = i;
    if (right(i) < right(measured.right)) measured.right = i;
    if (front(i) > front(measured.foremost)) measured.foremost = i;
    if (from_inner(i) < from_inner(measured.inner)) measured.inner = i;
  }
  return measured;
}

/// Width ahead of the head, thickness right of it, each tied to its two grains.
std::vector<Segment> measures_of(std::span<const Vector3> position, const MeasuredGrains& grains, const HeadSize& size,
                                 double distance) {
  const double left = size.centre + 0.5 * size.width, right = size.centre - 0.5 * size.width;
  const double ahead = size.foremost + distance, beside = right - distance;
  std::vector<Segment> segments{extension({position[grains.left].x, left, 0}, {ahead, left, 0}),
                                extension({position[grains.right].x, right, 0}, {ahead, right, 0}),
                                measure({ahead, left, 0}, {ahead, right, 0}, "*w*_{h}")};
  if (!std::isfinite(size.inner)) return segments;
  segments.push_back(extension({size.inner, position[grains.inner].y, 0}, {size.inner, beside, 0}));
  segments.push_back(extension({size.foremost, position[grains.foremost].y, 0}, {size.foremost, beside, 0}));
  segments.push_back(measure({size.inner, beside, 0}, {size.foremost, beside, 0}, "*l*_{h}"));
  return segments;
}

double foremost(std::span<const Vector3> position) {
  return std::max_element(position.begin(), position.end(), [](const auto& a, const auto& b) { return a.x < b.x; })->x;
}

}  // namespace

MemberSnapshots::MemberSnapshots(const AvalancheEnsemble& ensemble)
    : ensemble_(ensemble), radius_(ensemble.runs.front().scales.mean_radius) {}

MemberSnapshots::Loaded& MemberSnapshots::load(double t) {
  const AvalancheRun& run = ensemble_.runs.front();
  std::vector<double> times;
  for (const AvalancheFrame& frame : run.frames) times.push_back(frame.time);
  const std::size_t n = nearest_point(times, t);
  Loaded& loaded = loaded_.emplace_back();
  loaded.points = read_points(snapshot_paths(ensemble_.folders.front()).at(n));
  loaded.time = run.frames[n].time;
  loaded.front_speed = run.frames[n].front_speed;
  return loaded;
}

ParticlePicture MemberSnapshots::plain(const Loaded& loaded, const View& view) const {
  const Snapshot snapshot = loaded.points.view();
  return {.title = fmt::format("*t̃* = {:.3g}", loaded.time),
          .positions = snapshot.positions(),
          .radii = snapshot.scalars("radius"),
          .view = view,
          .length = {radius_, "*a*_{p}"}};
}

figure::Window MemberSnapshots::about_front(std::span<const Vector3> position, double behind, double ahead,
                                            double below, double above) const {
  const double front = foremost(position);
  return {front - behind * radius_, front + ahead * radius_, -below * radius_, above * radius_};
}

void MemberSnapshots::mark(Loaded& loaded, const std::vector<GrainSet>& heads, ParticlePicture& picture) const {
  loaded.category.assign(picture.positions.size(), 0);
  for (const GrainSet& head : heads)
    for (const std::uint32_t i : head) loaded.category[i] = 1;
  picture.colouring = ByCategory{.of = loaded.category, .categories = {{"", other}, {"head", blue}}};
}

ParticlePicture MemberSnapshots::at(double t, const View& view) {
  return plain(load(t), view);
}

ParticlePicture MemberSnapshots::circle_at_start() {
  ParticlePicture picture = at(0, view_xy);
  double size = 0;
  for (const Vector3& x : picture.positions) size = std::max(size, norm(x));
  picture.title = "circle";
  picture.segments = {measure({}, {size, 0, 0}, fmt::format("*R* = {:.0f} *a*_{{p}}", size / radius_))};
  return picture;
}

ParticlePicture MemberSnapshots::rectangle_at_start() {
  ParticlePicture picture = at(0, view_downhill);
  double left = 0, right = 0, rear = 0;
  for (const Vector3& x : picture.positions)
    left = std::max(left, x.y), right = std::min(right, x.y), rear = std::min(rear, x.x);
  const double behind = rear - 8 * radius_;
  picture.title = "rectangle";
  picture.segments = {
      measure({behind, left, 0}, {behind, right, 0}, fmt::format("2*W* = {:.0f} *a*_{{p}}", (left - right) / radius_))};
  return picture;
}

ParticlePicture MemberSnapshots::triangle_at_start() {
  ParticlePicture picture = at(0, view_xz);
  // The gate's foot is the corner at the slope; the level surface falls from the gate's top to the slope behind.
  const Vector3 foot{foremost(picture.positions), 0, 0}, upwards{-std::sqrt(0.5), 0, std::sqrt(0.5)};
  double depth = 0;
  for (const Vector3& x : picture.positions) depth = std::max(depth, dot(upwards, x - foot));
  picture.title = "triangle";
  picture.slope = true;
  picture.segments = {measure(foot, foot + depth * upwards, fmt::format("*D* = {:.0f} *a*_{{p}}", depth / radius_))};
  return picture;
}

ParticlePicture MemberSnapshots::front_with_heads(double t) {
  ParticlePicture picture = with_heads(t, view_xy);
  picture.window = about_front(picture.positions, 370, 20, 75, 75);
  return picture;
}

ParticlePicture MemberSnapshots::with_heads(double t, const View& view) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view);
  mark(loaded, find_heads(picture.positions, radius_), picture);
  return picture;
}

ParticlePicture MemberSnapshots::motion_in_head(double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xy);
  mark(loaded, find_heads(picture.positions, radius_), picture);
  const double v_s = ensemble_.runs.front().scales.stokes_speed;
  for (const Vector3& v : loaded.points.view().vectors("velocity"))
    loaded.arrow.push_back({v.x - loaded.front_speed * v_s, v.y, 0});
  std::get<ByCategory>(picture.colouring).categories[1].colour = light_blue;  // arrows are seen on it
  picture.arrows = Arrows{.values = loaded.arrow, .unit = {v_s, "*v*_{s}"}, .length = 4, .spacing = 9};
  picture.window = about_front(picture.positions, 75, 6, 45, 45);
  return picture;
}

ParticlePicture MemberSnapshots::relative_speed(double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xz);
  const double v_s = ensemble_.runs.front().scales.stokes_speed;
  for (const Vector3& v : loaded.points.view().vectors("velocity"))
    loaded.value.push_back(v.x - loaded.front_speed * v_s);
  picture.colouring = ByValue{.values = loaded.value,
                              .label = "*ṽ*_{x} − *ṽ*_{f}",
                              .unit = {v_s, ""},
                              .map = ColourMap::cool_warm,
                              .low = -6,
                              .high = 6};
  picture.slope = true;
  picture.window = about_front(picture.positions, 330, 10, 8, 60);
  return picture;
}

ParticlePicture MemberSnapshots::head_by(HeadRule::Measure measure, double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xy);
  picture.title = fmt::format("by *{}*, {}", measure == HeadRule::Measure::direct ? "n" : "n'", picture.title);
  const std::vector<GrainSet> heads = find_heads(picture.positions, radius_, {.measure = measure});
  mark(loaded, heads, picture);
  if (!heads.empty() && measure == HeadRule::Measure::indirect) {
    const HeadSize size = head_size(picture.positions, picture.radii, heads.front(), radius_);
    const MeasuredGrains grains = measured_grains(picture.positions, picture.radii, heads.front(), size);
    for (const std::uint32_t i : {grains.left, grains.right, grains.foremost, grains.inner}) loaded.category[i] = 2;
    std::get<ByCategory>(picture.colouring).categories.push_back({"measured", green});
    picture.segments = measures_of(picture.positions, grains, size, 7 * radius_);
  }
  picture.window = about_front(picture.positions, 115, 20, 50, 50);
  return picture;
}

ParticlePicture MemberSnapshots::frontal_surface(double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xz);
  loaded.category.assign(picture.positions.size(), 0);
  const GrainSet surface = surface_walk(picture.positions, radius_);
  Vector3 middle;
  for (const std::uint32_t i : surface) {
    loaded.category[i] = 1;
    middle += (1.0 / static_cast<double>(surface.size())) * picture.positions[i];
  }
  picture.colouring =
      ByCategory{.of = loaded.category, .categories = {{"", other}, {"surface of the front", vermillion}}};
  if (const auto angle = angle_of_line(picture.positions, surface)) {
    const Vector3 along = 16 * radius_ * Vector3{-std::cos(*angle), 0, std::sin(*angle)};
    picture.segments.push_back({.from = middle - along,
                                .to = middle + along,
                                .label = fmt::format("{:.0f}°", *angle * 180 / pi),
                                .dash = Dash::dashed});
  }
  picture.slope = true;
  picture.window = about_front(picture.positions, 75, 20, 6, 36);
  return picture;
}

}  // namespace talus::app
