// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/air_pictures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <vector>

#include "analysis/curve.hpp"
#include "app/case/run_tables.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "io/figure/figure.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

constexpr std::size_t pictures = 3;
constexpr double between_arrows = 9;  // units of the page

struct Layer {
  std::vector<Vector3> centre, velocity;
  std::vector<double> radius, pressure;
};

Layer middle_layer(const GridSnapshot& air) {
  Layer layer;
  const int j = air.count[1] / 2;
  for (int k = 0; k < air.count[2]; ++k)
    for (int i = 0; i < air.count[0]; ++i) {
      const std::size_t c = air.index(i, j, k);
      layer.centre.push_back(air.centre(i, j, k));
      layer.velocity.push_back(air.vectors("velocity")[c]);
      layer.pressure.push_back(air.scalars("pressure")[c]);
      layer.radius.push_back(0.75 * std::max(air.spacing.x, air.spacing.z));  // without gaps
    }
  return layer;
}

}  // namespace

bool draw_air(const std::filesystem::path& run_folder, const HopperSetting& setting, const std::string& title,
              const std::filesystem::path& path) {
  const RunFolder folder(run_folder);
  const std::vector<int> numbers = folder.snapshot_numbers("air");
  if (numbers.empty()) return false;
  const double gate = gate_time_of(read_series(folder.series()));
  std::vector<double> times;
  for (const int number : numbers) times.push_back(read_points_time(folder.snapshot(number, "air")) - gate);
  std::vector<Layer> layers;
  const std::vector<std::size_t> frames = chosen_snapshots(times, pictures);
  for (const std::size_t n : frames) layers.push_back(middle_layer(read_grid(folder.snapshot(numbers[n], "air"))));
  figure::Figure figure{.title = title};
  for (std::size_t n = 0; n < frames.size(); ++n) {
    const Layer& layer = layers[n];
    figure::ParticlePicture picture = particle_picture(
        setting, layer.centre, layer.radius, {.values = layer.pressure, .label = "pressure *P*", .unit = {1, "Pa"}});
    picture.title = fmt::format("*t* = {:.2f} s", times[frames[n]]);
    picture.arrows = figure::Arrows{.values = layer.velocity, .spacing = between_arrows};
    figure.panels.emplace_back(std::move(picture));
  }
  figure.columns = static_cast<int>(frames.size());
  figure::write_png(figure, path);
  return true;
}

}  // namespace talus::app
