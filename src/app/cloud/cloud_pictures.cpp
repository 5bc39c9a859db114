// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <utility>

#include "analysis/statistics.hpp"
#include "app/case/run_tables.hpp"
#include "io/figure/figure.hpp"
#include "io/file_list.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

/// Speeds of the grains, m/s.
std::vector<double> speeds_of(const Snapshot& snapshot) {
  std::vector<double> speeds;
  for (const Vector3& velocity : snapshot.vectors("velocity")) speeds.push_back(norm(velocity));
  return speeds;
}

figure::View view_of(const CloudFrame& frame) {
  if (frame.motion == cloud::Motion::xy) return figure::view_xy;
  if (frame.motion == cloud::Motion::xz) return figure::view_xz;
  return figure::view_oblique(0.6, 0.45);
}

/// Across gravity, which points down the page, and along it.
std::array<figure::View, 2> views_of_a_fall(const Vector3& gravity) {
  const Vector3 other = std::abs(gravity.x) < 0.9 ? Vector3{1, 0, 0} : Vector3{0, 1, 0};
  const Vector3 across = other - dot(other, gravity) * gravity;
  const Vector3 right = (1 / norm(across)) * across, up = -1 * gravity;
  return {figure::View{right, up, cross(right, up)}, figure::View{right, cross(gravity, right), gravity}};
}

double quantile_along(std::span<const Vector3> position, const Vector3& direction, double probability) {
  std::vector<double> along;
  for (const Vector3& x : position) along.push_back(dot(x, direction));
  return quantile(along, probability);
}

/// A window of the given extent about the cloud's middle, which most of the grains have not left.
figure::Window follow(std::span<const Vector3> position, const figure::View& view, double half_width, double below,
                      double above) {
  const double x = quantile_along(position, view.right, 0.5), y = quantile_along(position, view.up, 0.5);
  return {x - half_width, x + half_width, y - below, y + above};
}

/// The front of an avalanche, with what is 180 radii behind it.
figure::Window front_of(std::span<const Vector3> position, const CloudFrame& frame) {
  const double a = frame.scales.mean_radius, front = quantile_along(position, {1, 0, 0}, 1);
  if (frame.motion == cloud::Motion::xz) return {front - 180 * a, front + 20 * a, -8 * a, 72 * a};
  const double centre = quantile_along(position, {0, 1, 0}, 0.5);
  if (frame.motion == cloud::Motion::xy) return {front - 180 * a, front + 20 * a, centre - 50 * a, centre + 50 * a};
  const figure::View view = view_of(frame);
  const double x = dot(view.right, {front, centre, 0}), y = dot(view.up, {front, centre, 0});
  return {x - 180 * a, x + 40 * a, y - 45 * a, y + 105 * a};
}

struct Frames {
  std::vector<PointSet> points;
  std::vector<std::vector<double>> speeds;
  double speed_max = 0;                             // of all but the fastest hundredth, over v_s
  std::vector<std::vector<double>> radii_of_cloud;  // of a cloud that falls: without the grains that it has left behind

  Frames(std::span<const std::filesystem::path> snapshots, const CloudFrame& frame) {
    const std::size_t last = snapshots.size() - 1;
    std::vector<std::size_t> chosen = {0, last / 5, last / 2, last};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    for (const std::size_t n : chosen) {
      points.push_back(read_points(snapshots[n]));
      speeds.push_back(speeds_of(points.back().view()));
      speed_max = std::max(speed_max, quantile(speeds.back(), 0.99) / frame.scales.stokes_speed);
    }
  }

  std::vector<figure::ParticlePicture> pictures(const CloudFrame& frame, const figure::View& view) const {
    std::vector<figure::ParticlePicture> pictures;
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Snapshot snapshot = points[n].view();
      figure::ParticlePicture picture{.title = fmt::format("*t̃* = {:.1f}", snapshot.time / frame.scales.time()),
                                      .positions = snapshot.positions(),
                                      .radii = snapshot.scalars("radius"),
                                      .view = view,
                                      .length = {frame.scales.mean_radius, "*a*"}};
      picture.slope = frame.has_slope && frame.motion != cloud::Motion::xy;
      picture.depth = frame.motion == cloud::Motion::xyz;
      if (frame.has_slope)
        picture.colouring = figure::ByValue{.values = speeds[n],
                                            .label = "speed",
                                            .unit = {frame.scales.stokes_speed, "*v*ₛ"},
                                            .low = 0,
                                            .high = std::max(speed_max, 1e-12),
                                            .bar = n + 1 == points.size()};
      pictures.push_back(std::move(picture));
    }
    return pictures;
  }
};

figure::Figure figure_of(const std::string& title, std::vector<figure::ParticlePicture> pictures) {
  figure::Figure figure{.title = title};
  for (figure::ParticlePicture& picture : pictures) figure.panels.emplace_back(std::move(picture));
  return figure;
}

/// The whole avalanche, and its front.
std::vector<std::pair<std::string, figure::Figure>> avalanche_figures(const Frames& frames, const CloudFrame& frame,
                                                                      const std::string& title) {
  std::vector<figure::ParticlePicture> whole = frames.pictures(frame, view_of(frame));
  figure::share_scale(whole);
  std::vector<std::pair<std::string, figure::Figure>> figures;
  figures.emplace_back("frames.png", figure_of(title, std::move(whole)));
  std::vector<figure::ParticlePicture> front = frames.pictures(frame, view_of(frame));
  for (figure::ParticlePicture& picture : front) picture.window = front_of(picture.positions, frame);
  figures.emplace_back("front.png", figure_of(title + ": the front", std::move(front)));
  return figures;
}

/// Radii of the grains that are within a distance of the median along a direction; the others are left out of a
/// picture.
std::vector<double> radii_of_those_near(const figure::ParticlePicture& picture, const Vector3& direction,
                                        double distance) {
  const double middle = quantile_along(picture.positions, direction, 0.5);
  std::vector<double> radii(picture.radii.begin(), picture.radii.end());
  for (std::size_t i = 0; i < radii.size(); ++i)
    if (std::abs(dot(picture.positions[i], direction) - middle) > distance)
      radii[i] = std::numeric_limits<double>::quiet_NaN();
  return radii;
}

/// A falling cloud from the side, with the grains that it leaves behind, and below that as seen along gravity.
std::vector<std::pair<std::string, figure::Figure>> fall_figures(Frames& frames, const CloudFrame& frame,
                                                                 const std::string& title) {
  const auto [side, along] = views_of_a_fall(frame.gravity);
  const double radius = 0.5 * (quantile_along(frames.points[0].view().positions(), side.right, 1) -
                               quantile_along(frames.points[0].view().positions(), side.right, 0));
  std::vector<figure::ParticlePicture> pictures = frames.pictures(frame, side),
                                       from_below = frames.pictures(frame, along);
  frames.radii_of_cloud.resize(from_below.size());
  for (std::size_t n = 0; n < from_below.size(); ++n) {
    frames.radii_of_cloud[n] = radii_of_those_near(from_below[n], side.up, 2 * radius);
    from_below[n].radii = frames.radii_of_cloud[n];
  }
  for (figure::ParticlePicture& picture : pictures)
    picture.window = follow(picture.positions, side, 2 * radius, 2 * radius, 4 * radius);
  for (figure::ParticlePicture& picture : from_below)
    picture.window = follow(picture.positions, along, 2 * radius, 2 * radius, 2 * radius);
  std::move(from_below.begin(), from_below.end(), std::back_inserter(pictures));
  figure::Figure figure = figure_of(title, std::move(pictures));
  figure.columns = static_cast<int>(frames.points.size());
  return {{"frames.png", std::move(figure)}};
}

}  // namespace

std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                              const std::string& title) {
  const std::filesystem::path pictures = run_folder / "pictures";
  make_folder(pictures);
  std::vector<std::filesystem::path> drawn;

  const std::vector<std::filesystem::path> snapshots = snapshot_paths(run_folder);
  if (!snapshots.empty()) {
    Frames frames(snapshots, frame);
    for (const auto& [name, figure] :
         frame.has_slope ? avalanche_figures(frames, frame, title) : fall_figures(frames, frame, title)) {
      drawn.push_back(pictures / name);
      figure::write_png(figure, drawn.back());
    }
  }

  return drawn;
}

}  // namespace talus::app
