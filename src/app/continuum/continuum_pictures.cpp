// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/continuum_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/curve.hpp"
#include "analysis/hopper_estimators.hpp"
#include "analysis/particle_field.hpp"
#include "app/case/run_tables.hpp"
#include "app/case/scene.hpp"
#include "app/continuum/air_pictures.hpp"
#include "app/continuum/continuum_analysis.hpp"
#include "app/continuum/vessel_fields.hpp"
#include "io/figure/figure.hpp"
#include "io/file_list.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

constexpr figure::Colour dot_colour = figure::rgb(0x5b4a33);
constexpr std::size_t pictures_of_a_run = 8;
constexpr int dots_of_particle = 50;
constexpr double dot_diameter = 200e-6;  // m; the picture draws at least its own smallest disc
const figure::Unit length_unit{1e-3, "mm"};

struct Frames {
  std::vector<std::filesystem::path> paths;
  std::vector<double> time;  // from the gate's opening
};

Frames snapshots_of(const std::filesystem::path& run_folder, const HopperRun& run) {
  return {snapshot_paths(run_folder), run.snapshots.time()};
}

/// So opaque that a settled bed looks alike, however many dots lie on each other: 0.25 at 18 dots a square millimetre.
figure::Colour colour_of_dots(const HopperShape& s) {
  const double dots = dots_of_particle * s.depth / std::pow(s.spacing, 3);  // 1/m^2
  return figure::with_alpha(dot_colour, std::clamp(0.25 * 18e6 / dots, 0.03, 1.0));
}

std::string title_of(double time) {
  return fmt::format("*t* = {:.2f} s", std::abs(time) < 5e-3 ? 0.0 : time);
}

figure::Window window_of(const HopperShape& shape, double top) {
  return {0, shape.width, 0, std::min(shape.height, top)};
}

double highest(const Snapshot& snapshot) {
  double z = 0;
  for (const Vector3& x : snapshot.positions()) z = std::max(z, x.z);
  return z;
}

/// Walls and plate, not covered by grains; an open face is no line.
std::vector<figure::Segment> outline(const HopperSetting& setting, double top) {
  const HopperShape& s = setting.shape;
  const Box& box = setting.domain.box();
  const figure::Colour colour = figure::ink;
  std::vector<figure::Segment> lines;
  const auto add = [&](int axis, int side, const Vector3& from, const Vector3& to) {
    if (is_mirror(box.face(axis, side))) lines.push_back({.from = from, .to = to, .colour = colour});
  };
  add(2, 0, {0, 0, 0}, {s.width, 0, 0});
  add(0, 0, {0, 0, 0}, {0, 0, top});
  add(0, 1, {s.width, 0, 0}, {s.width, 0, top});
  for (const WallLine& line : wall_lines(setting.domain))
    if (std::isinf(line.until)) lines.push_back({.from = line.from, .to = line.to, .colour = colour});
  for (const auto& [from, to] : setting.section) lines.push_back({.from = from, .to = to, .colour = colour});
  return lines;
}

/// Of a vessel in space, the particles in the section through its middle; else all. Thicker than a spacing, so that two
/// layers of a lattice that stand half a spacing from the middle are in it whole.
std::vector<std::size_t> seen_particles(const HopperSetting& setting, const Snapshot& view) {
  const auto positions = view.positions();
  const MassRatios ratios = view.mass_ratios();
  std::vector<std::size_t> seen;
  for (std::size_t i = 0; i < positions.size(); ++i)
    if (setting.section.empty() ||
        std::abs(positions[i].y - setting.middle) <= 0.75 * std::cbrt(ratios[i]) * setting.shape.spacing)
      seen.push_back(i);
  return seen;
}

/// Of those particles, m.
std::vector<double> radii_of(const HopperSetting& setting, const Snapshot& view,
                             const std::vector<std::size_t>& which) {
  const MassRatios ratios = view.mass_ratios();
  std::vector<double> radii;
  for (const std::size_t i : which) radii.push_back(0.5 * std::cbrt(ratios[i]) * setting.shape.spacing);
  return radii;
}

template <class T>
std::vector<T> picked(std::span<const T> column, const std::vector<std::size_t>& which) {
  std::vector<T> values;
  for (const std::size_t i : which) values.push_back(column[i]);
  return values;
}

void draw_packing(const std::filesystem::path& snapshot, double time, const HopperSetting& setting,
                  const std::string& title, const std::filesystem::path& path) {
  const PointSet points = read_points(snapshot);
  const Snapshot view = points.view();
  const std::vector<std::size_t> seen = seen_particles(setting, view);
  const std::vector<Vector3> positions = picked(view.positions(), seen);
  const std::vector<double> packing = picked(view.scalars("packing"), seen);
  const std::vector<double> radii = radii_of(setting, view, seen);
  figure::ParticlePicture picture =
      particle_picture(setting, positions, radii, {.values = packing, .label = "packing", .low = 0.4, .high = 0.7});
  picture.title = title_of(time);
  figure::write_png({.title = title, .panels = {picture}}, path);
}

/// The grains over time, particles as dots.
void draw_grains(const Frames& frames, const HopperSetting& setting, const std::string& title,
                 const std::filesystem::path& path) {
  const std::vector<std::size_t> chosen = chosen_snapshots(frames.time, pictures_of_a_run);
  std::vector<std::vector<Vector3>> dots;
  std::vector<std::vector<double>> radii;
  double top = 0;
  for (const std::size_t n : chosen) {
    const PointSet points = read_points(frames.paths[n]);
    const Snapshot view = points.view();
    if (!setting.section.empty()) {
      const std::vector<std::size_t> seen = seen_particles(setting, view);
      dots.push_back(picked(view.positions(), seen));
      radii.push_back(radii_of(setting, view, seen));
      top = std::max(top, setting.shape.height);
      continue;
    }
    const Particles particles =
        particles_of_density(view.positions(), view.scalars("density"), setting.particle_mass, setting.grain_density,
                             setting.smoothing_length, view.mass_ratios());
    Domain domain = setting.domain;
    if (frames.time[n] >= 0) domain.open_gates(frames.time[n]);
    dots.push_back(figure::particle_dots(view.positions(), particles.smoothing_length, view.integers("identity"),
                                         domain, dots_of_particle));
    top = std::max(top, highest(view) + 4 * setting.shape.spacing);
  }
  figure::Figure figure{.title = title};
  const bool in_space = !setting.section.empty();
  for (std::size_t n = radii.size(); n < dots.size(); ++n) radii.emplace_back(dots[n].size(), 0.5 * dot_diameter);
  for (std::size_t n = 0; n < chosen.size(); ++n) {
    figure::ParticlePicture picture{.title = title_of(frames.time[chosen[n]]),
                                    .positions = dots[n],
                                    .radii = radii[n],
                                    .view = figure::view_xz,
                                    .colouring = figure::Plain{in_space ? dot_colour : colour_of_dots(setting.shape)},
                                    .segments = outline(setting, top),
                                    .length = length_unit};
    picture.window = window_of(setting.shape, top);
    figure.panels.emplace_back(std::move(picture));
  }
  figure.columns = static_cast<int>(std::min<std::size_t>(3, chosen.size()));
  figure::write_png(figure, path);
}

/// The section of a vessel while it flows, by speed: what rests is seen. False without two snapshots to tell.
bool draw_flow(const Frames& frames, const HopperRun& run, const std::string& title,
               const std::filesystem::path& path) {
  const HopperSetting& setting = run.setting;
  const talus::Window flow = hopper::while_it_flows(run);
  if (frames.time.size() < 2 || !flow.at) return false;
  const std::size_t n = std::max<std::size_t>(1, nearest_point(frames.time, *flow.at));
  const std::size_t earlier = nearest_point(std::span(frames.time).first(n), frames.time[n] - setting.averaging_time);
  const PointSet now = read_points(frames.paths[n]), before = read_points(frames.paths[earlier]);
  const std::vector<double> speed = mean_speeds(before.view(), now.view(), setting.computed);
  const auto positions = now.view().positions();
  const double mean = hopper::mean_speed_above(setting.shape.outlet->height, now.view(), speed);
  if (!(mean > 0)) return false;
  const std::vector<std::size_t> seen = seen_particles(setting, now.view());
  const std::vector<Vector3> places = picked(positions, seen);
  std::vector<double> over_mean = picked(std::span<const double>(speed), seen);
  for (double& v : over_mean) v /= mean;
  const std::vector<double> radii = radii_of(setting, now.view(), seen);
  figure::ParticlePicture picture = particle_picture(
      setting, places, radii,
      {.values = over_mean, .label = "speed / mean speed (below 0.1: stagnant)", .low = 0, .high = 0.2});
  picture.title = title_of(frames.time[n]);
  figure::write_png({.title = title, .panels = {picture}}, path);
  return true;
}

}  // namespace

figure::ParticlePicture particle_picture(const HopperSetting& setting, std::span<const Vector3> positions,
                                         std::span<const double> radii, figure::ByValue values) {
  double top = 0;
  for (const Vector3& x : positions) top = std::max(top, x.z);
  figure::ParticlePicture picture{.positions = positions,
                                  .radii = radii,
                                  .view = figure::view_xz,
                                  .colouring = std::move(values),
                                  .segments = outline(setting, top),
                                  .length = length_unit};
  picture.window = window_of(setting.shape, top + 4 * setting.shape.spacing);
  return picture;
}

std::vector<std::filesystem::path> draw_continuum(const std::filesystem::path& run_folder, const HopperRun& run,
                                                  const std::string& title) {
  const HopperSetting& setting = run.setting;
  const std::filesystem::path pictures = run_folder / "pictures";
  make_folder(pictures);
  std::vector<std::filesystem::path> drawn;
  const Frames frames = snapshots_of(run_folder, run);
  if (!frames.paths.empty()) {
    drawn.push_back(pictures / "frames.png");
    draw_grains(frames, setting, title, drawn.back());
    drawn.push_back(pictures / "packing.png");
    draw_packing(frames.paths.back(), frames.time.back(), setting, title, drawn.back());
  }
  if (draw_air(run_folder, setting, title, pictures / "air.png")) drawn.push_back(pictures / "air.png");
  if (draw_fields(run_folder, setting, title, pictures / "fields.png")) drawn.push_back(pictures / "fields.png");
  if (setting.shape.outlet && !setting.section.empty() && draw_flow(frames, run, title, pictures / "flow.png"))
    drawn.push_back(pictures / "flow.png");
  return drawn;
}

}  // namespace talus::app
