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

/// Straight across the head and along it, where Figure 8c measures.
std::vector<Segment> measures_of(const HeadSize& size, double z) {
  const double left = size.centre + 0.5 * size.width, right = size.centre - 0.5 * size.width;
  const double behind = size.foremost - size.thickness;
  std::vector<Segment> segments{{.from = {behind, left, z},
                                 .to = {behind, right, z},
                                 .label = "*w*_{h}",
                                 .colour = vermillion,
                                 .arrow_heads = true}};
  if (std::isfinite(size.inner))
    segments.push_back({.from = {size.inner, size.centre, z},
                        .to = {size.foremost, size.centre, z},
                        .label = "*l*_{h}",
                        .colour = vermillion,
                        .arrow_heads = true});
  return segments;
}

double foremost(std::span<const Vector3> position) {
  return std::max_element(position.begin(), position.end(), [](const auto& a, const auto& b) { return a.x < b.x; })->x;
}

}  // namespace

MemberSnapshots::MemberSnapshots(const StudiedEnsemble& ensemble)
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

figure::Window MemberSnapshots::about_front(std::span<const Vector3> position, double behind, double below,
                                            double above) const {
  const double front = foremost(position);
  return {front - behind * radius_, front + 0.08 * behind * radius_, -below * radius_, above * radius_};
}

void MemberSnapshots::mark(Loaded& loaded, const std::vector<GrainSet>& heads, ParticlePicture& picture) const {
  loaded.category.assign(picture.positions.size(), -1);
  for (const GrainSet& head : heads)
    for (const std::uint32_t i : head) loaded.category[i] = 0;
  picture.colouring = ByCategory{.of = loaded.category, .categories = {{"head", blue}}};
}

ParticlePicture MemberSnapshots::at(double t, const View& view) {
  return plain(load(t), view);
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
  picture.arrows = Arrows{.values = loaded.arrow, .unit = {v_s, "*v*_{s}"}, .length = 4, .spacing = 9};
  picture.window = about_front(picture.positions, 75, 45, 45);
  return picture;
}

ParticlePicture MemberSnapshots::relative_speed(double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xz);
  const double v_s = ensemble_.runs.front().scales.stokes_speed;
  for (const Vector3& v : loaded.points.view().vectors("velocity"))
    loaded.value.push_back(v.x - loaded.front_speed * v_s);
  picture.colouring = ByValue{.values = loaded.value,
                              .label = "*ṽ*_{x} - *ṽ*_{f}",
                              .unit = {v_s, ""},
                              .map = ColourMap::cool_warm,
                              .low = -8,
                              .high = 8};
  picture.slope = true;
  picture.window = about_front(picture.positions, 170, 8, 50);
  return picture;
}

ParticlePicture MemberSnapshots::head_by(HeadRule::Measure measure, double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xy);
  picture.title = fmt::format("by *{}*, {}", measure == HeadRule::Measure::direct ? "n" : "n'", picture.title);
  const std::vector<GrainSet> heads = find_heads(picture.positions, radius_, {.measure = measure});
  mark(loaded, heads, picture);
  if (!heads.empty() && measure == HeadRule::Measure::indirect)
    picture.segments = measures_of(head_size(picture.positions, picture.radii, heads.front(), radius_), 0);
  picture.window = about_front(picture.positions, 120, 50, 50);
  return picture;
}

ParticlePicture MemberSnapshots::frontal_surface(double t) {
  Loaded& loaded = load(t);
  ParticlePicture picture = plain(loaded, view_xz);
  loaded.category.assign(picture.positions.size(), -1);
  const GrainSet surface = surface_walk(picture.positions, radius_);
  Vector3 middle;
  for (const std::uint32_t i : surface) {
    loaded.category[i] = 0;
    middle += (1.0 / static_cast<double>(surface.size())) * picture.positions[i];
  }
  picture.colouring = ByCategory{.of = loaded.category, .categories = {{"surface of the front", vermillion}}};
  if (const auto angle = angle_of_line(picture.positions, surface)) {
    const Vector3 along = 16 * radius_ * Vector3{-std::cos(*angle), 0, std::sin(*angle)};
    picture.segments.push_back({.from = middle - along,
                                .to = middle + along,
                                .label = fmt::format("{:.0f}°", *angle * 180 / pi),
                                .dash = Dash::dashed});
  }
  picture.slope = true;
  picture.window = about_front(picture.positions, 90, 6, 40);
  return picture;
}

}  // namespace talus::app
