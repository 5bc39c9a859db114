// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/vessel_fields.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <vector>

#include "analysis/cell_means.hpp"
#include "analysis/hopper_estimators.hpp"
#include "app/case/run_tables.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "io/figure/figure.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

constexpr double size_of_cell = 2;  // spacings

std::filesystem::path path_of(const std::filesystem::path& run_folder) {
  return run_folder / "analysis" / "fields.vtkhdf";
}

/// A field of the section, cells as discs.
struct Shown {
  const char* label;
  std::function<double(const GridSnapshot&, std::size_t)> value;
};

}  // namespace

void write_fields(const std::filesystem::path& run_folder, const HopperRun& run, const Vector3& low,
                  const Vector3& high) {
  Window window{.at = {}, .from = 0, .to = run.end()};
  if (run.setting.shape.outlet) window = hopper::while_it_flows(run);
  CellMeans means(cells_over(low, high, size_of_cell * run.setting.shape.spacing), run.setting.grain_diameter,
                  run.setting.grain_density);
  const auto paths = snapshot_paths(run_folder);
  if (paths.empty()) return;
  const double middle = 0.5 * (window.from + window.to);
  const std::size_t nearest = nearest_point(run.snapshots.time(), middle);
  for (std::size_t n = 0; n < paths.size(); ++n)
    if (const double time = run.snapshots.time()[n]; n == nearest || (time >= window.from && time <= window.to))
      means.take(read_points(paths[n]).view());
  write_grid(path_of(run_folder), means.result(middle));
}

bool draw_fields(const std::filesystem::path& run_folder, const HopperSetting& setting, const std::string& title,
                 const std::filesystem::path& path) {
  if (!std::filesystem::exists(path_of(run_folder))) return false;
  const GridSnapshot grid = read_grid(path_of(run_folder));
  const std::vector<double>& filled = grid.scalars("filled");
  const int layer = grid.cell_at(1, setting.middle);
  std::vector<std::size_t> cells;
  std::vector<Vector3> places;
  for (int k = 0; k < grid.count[2]; ++k)
    for (int i = 0; i < grid.count[0]; ++i)
      if (const std::size_t n = grid.index(i, layer, k); filled[n] > 0.5)
        cells.push_back(n), places.push_back(grid.centre(i, layer, k));
  if (cells.empty()) return false;
  const auto scalar = [](const char* name) {
    return [name](const GridSnapshot& g, std::size_t n) { return g.scalars(name)[n]; };
  };
  const Shown shown[] = {
      {"speed, m/s", [](const GridSnapshot& g, std::size_t n) { return norm(g.vectors("velocity")[n]); }},
      {"pressure, Pa", scalar("pressure")},
      {"packing", scalar("packing")},
      {"inertial number, log_{10}", [](const GridSnapshot& g, std::size_t n) {
         return std::log10(std::max(1e-5, g.scalars("inertial_number")[n]));
       }}};
  const std::vector<double> radii(cells.size(), 0.75 * grid.spacing.x);  // without gaps
  std::vector<std::vector<double>> values;
  figure::Figure figure{.title = title};
  for (const Shown& field : shown) {
    values.emplace_back();
    for (const std::size_t n : cells) values.back().push_back(field.value(grid, n));
  }
  for (std::size_t f = 0; f < values.size(); ++f) {
    std::vector<double> sorted = values[f];
    std::sort(sorted.begin(), sorted.end());
    const double least = sorted.front(), most = sorted[(sorted.size() - 1) * 98 / 100];
    const double high = most > least ? most : least + 1;
    figure.panels.emplace_back(particle_picture(
        setting, places, radii, {.values = values[f], .label = shown[f].label, .low = least, .high = high}));
  }
  write_png(figure, path);
  return true;
}

}  // namespace talus::app
