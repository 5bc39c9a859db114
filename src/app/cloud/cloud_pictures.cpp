// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "analysis/frontal_angle.hpp"
#include "analysis/heads.hpp"
#include "io/figure/figure.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

using namespace figure;

/// The grains of heads (seen from above) or of the front's surface (from the side), the rest pale.
std::vector<std::int64_t> marked(const Snapshot& snapshot, const CloudFrame& frame) {
  std::vector<std::int64_t> category(snapshot.size(), -1);
  if (!frame.has_slope) return category;
  if (frame.motion == cloud::Motion::xy) {
    for (const GrainSet& head : find_heads(snapshot.positions(), frame.scales.mean_radius))
      for (const std::uint32_t i : head) category[i] = 0;
  } else if (frame.motion == cloud::Motion::xz) {
    for (const std::uint32_t i : surface_walk(snapshot.positions(), frame.scales.mean_radius)) category[i] = 0;
  }
  return category;
}

View view_of(const CloudFrame& frame) {
  if (frame.motion == cloud::Motion::xy) return view_xy;
  if (frame.motion == cloud::Motion::xz || !frame.has_slope) return view_xz;
  return view_oblique(-0.6, 0.45);
}

}  // namespace

std::vector<std::filesystem::path> draw_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                              const std::string& title) {
  const std::filesystem::path pictures = run_folder / "pictures";
  std::filesystem::create_directories(pictures);
  std::vector<std::filesystem::path> drawn;

  const std::vector<std::filesystem::path> snapshots = snapshot_paths(run_folder);
  if (!snapshots.empty()) {
    const std::size_t last = snapshots.size() - 1;
    std::vector<std::size_t> chosen = {0, last / 5, last / 2, last};
    chosen.erase(std::unique(chosen.begin(), chosen.end()), chosen.end());
    std::vector<PointSet> points;
    std::vector<std::vector<std::int64_t>> categories;
    for (const std::size_t n : chosen) {
      points.push_back(read_points(snapshots[n]));
      categories.push_back(marked(points.back().view(), frame));
    }
    std::vector<ParticlePicture> frames;
    for (std::size_t n = 0; n < points.size(); ++n) {
      const Snapshot view = points[n].view();
      ParticlePicture picture{.title = fmt::format("*t̃* = {:.1f}", view.time / frame.scales.time()),
                              .positions = view.positions(),
                              .radii = view.scalars("radius"),
                              .view = view_of(frame),
                              .length = {frame.scales.mean_radius, "*a*"}};
      picture.slope = frame.has_slope && frame.motion != cloud::Motion::xy;
      picture.depth = frame.motion == cloud::Motion::xyz;
      if (frame.has_slope && frame.motion != cloud::Motion::xyz)
        picture.colouring =
            ByCategory{.of = categories[n],
                       .categories = {{frame.motion == cloud::Motion::xy ? "head" : "surface of the front", blue}}};
      frames.push_back(std::move(picture));
    }
    share_scale(frames);
    Figure figure{.title = title};
    for (ParticlePicture& picture : frames) figure.panels.emplace_back(std::move(picture));
    drawn.push_back(pictures / "frames.png");
    write_png(figure, drawn.back());
  }

  if (std::filesystem::exists(run_folder / "analysis" / "front_speed.csv")) {
    const talus::Series speed = read_series(run_folder / "analysis" / "front_speed.csv");
    const auto time = speed.column("time"), value = speed.column("front_speed");
    const Chart chart{.title = title,
                      .x = {.label = "*t* *v*_{s}/*a*"},
                      .y = {.label = "front speed *v*_{f}/*v*_{s}"},
                      .series = {Line{.x = {time.begin(), time.end()}, .y = {value.begin(), value.end()}}}};
    drawn.push_back(pictures / "front_speed.png");
    write_png({.panels = {chart}}, drawn.back());
  }
  return drawn;
}

}  // namespace talus::app
