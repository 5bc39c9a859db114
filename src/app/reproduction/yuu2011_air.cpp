// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/yuu2011_air.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "analysis/curve.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "io/figure/figure.hpp"
#include "io/run_folder.hpp"
#include "io/vtkhdf.hpp"
#include "io/vtkhdf_grid.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double printed_times[] = {0.17, 1.0};  // s, Figure 10
constexpr double between_arrows = 5e-3;          // m
constexpr double of_stream = 0.05;               // packing from which a cell is drawn as holding grains
constexpr double arrow_of_unit = 14;             // units of the page for 1 m/s
constexpr double late = 10e-3;                   // by which a run may miss a time, s
constexpr Colour grain_colour = rgb(0xe8dcc4);

/// The cells of the middle layer: what a picture of them looks at.
struct Layer {
  double time;
  std::vector<Vector3> centre, arrow;
  std::vector<double> radius;
  std::vector<std::int64_t> kind;  // 0: hardly any grains; 1: grains
};

Layer middle_layer(const GridSnapshot& air) {
  Layer layer{.time = air.time, .centre = {}, .arrow = {}, .radius = {}, .kind = {}};
  const auto& velocity = air.vectors("velocity");
  const auto& packing = air.scalars("solid_fraction");
  const auto every = [&](double spacing) { return std::max(1, static_cast<int>(between_arrows / spacing + 0.5)); };
  const int every_x = every(air.spacing.x), every_z = every(air.spacing.z), j = air.count[1] / 2;
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (int k = 0; k < air.count[2]; ++k)
    for (int i = 0; i < air.count[0]; ++i) {
      const std::size_t c = air.index(i, j, k);
      const bool has_arrow = i % every_x == every_x / 2 && k % every_z == every_z / 2;
      layer.centre.push_back(air.centre(i, j, k));
      layer.arrow.push_back(has_arrow ? velocity[c] : Vector3{none, none, none});
      layer.radius.push_back(0.75 * std::max(air.spacing.x, air.spacing.z));  // without gaps
      layer.kind.push_back(packing[c] > of_stream);
    }
  return layer;
}

ParticlePicture picture_of(const Layer& layer, const HopperEnsemble& ensemble) {
  ParticlePicture picture = particle_picture(ensemble.runs.front().setting, layer.centre, layer.radius, {});
  picture.colouring = ByCategory{layer.kind, {{"", white}, {"", grain_colour}}};
  picture.arrows = Arrows{.values = layer.arrow, .length = arrow_of_unit, .spacing = 0};
  picture.title = fmt::format("{}, *t* = {:.2f} s", ensemble.variant, layer.time);
  return picture;
}

/// \param cell_of index of the cell at a number along the axis
template <class CellOf>
AirProfile profile_of(const GridSnapshot& air, int axis, CellOf&& cell_of) {
  AirProfile profile;
  for (int n = 0; n < air.count[static_cast<std::size_t>(axis)]; ++n) {
    const std::size_t c = cell_of(n);
    profile.place.push_back(1e3 * (air.low[axis] + (n + 0.5) * air.spacing[axis]));
    profile.pressure.push_back(air.scalars("pressure")[c]);
    profile.velocity.push_back(air.vectors("velocity")[c].z);
  }
  return profile;
}

}  // namespace

std::optional<GridSnapshot> air_at(const HopperEnsemble& ensemble, double time) {
  const RunFolder folder(ensemble.folders.front());
  const std::vector<int> numbers = folder.snapshot_numbers("air");
  if (numbers.empty() || ensemble.runs.front().end() < time - late) return std::nullopt;
  const double gate = ensemble.runs.front().gate_time;
  std::vector<double> times;
  for (const int number : numbers) times.push_back(read_points_time(folder.snapshot(number, "air")) - gate);
  GridSnapshot air = read_grid(folder.snapshot(numbers[nearest_point(times, time)], "air"));
  air.time -= gate;
  return air;
}

bool draw_air_vectors(const std::vector<HopperEnsemble>& ensembles, const std::filesystem::path& path) {
  std::vector<Layer> layers;
  layers.reserve(std::size(printed_times) * ensembles.size());
  Figure figure{.columns = static_cast<int>(std::size(printed_times))};
  for (const HopperEnsemble& ensemble : ensembles)
    for (const double time : printed_times)
      if (const std::optional<GridSnapshot> air = air_at(ensemble, time)) {
        layers.push_back(middle_layer(*air));
        figure.panels.emplace_back(picture_of(layers.back(), ensemble));
      }
  if (layers.empty()) return false;
  write_png(figure, path);
  return true;
}

AirProfile air_along_x(const GridSnapshot& air, double z) {
  return profile_of(air, 0, [&](int i) { return air.index(i, air.count[1] / 2, air.cell_at(2, z)); });
}

AirProfile air_along_z(const GridSnapshot& air, double x) {
  return profile_of(air, 2, [&](int k) { return air.index(air.cell_at(0, x), air.count[1] / 2, k); });
}

}  // namespace talus::app
