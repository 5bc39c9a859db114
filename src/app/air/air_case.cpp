// SPDX-License-Identifier: Apache-2.0
#include "app/air/air_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "app/case/model_case.hpp"
#include "base/instruction_set.hpp"
#include "io/parameter_writer.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "models/air/model.hpp"

namespace talus::app {

namespace {

using air::AirModel;
using air::ModelParameters;

constexpr double bytes_a_cell = 900, max_cells_measured = 1e5;

double cells_of(const ModelParameters& p) {
  return static_cast<double>(air::grid_of(p).cells());
}

std::vector<NamedValue> groups(const ModelParameters& p) {
  const double rho = p.gas.density();
  return {{"cells", "1", cells_of(p)},
          {"density", "kg/m3", rho},
          {"reynolds_number_of_the_box", "1", rho * air::given_speed(p) * p.box.width / p.gas.viscosity}};
}

Forecast forecast(const ModelParameters& p, const run::RunParameters& run) {
  const Grid grid = air::grid_of(p);
  // Vortices of speed u along x move as fast along z; walls drag along one axis.
  const double crossing = air::given_speed(p) * (1 / grid.spacing[0] + 1 / grid.spacing[2]);
  const double step = crossing > 0 ? std::min(p.gas.max_step, p.gas.courant / crossing) : p.gas.max_step;
  const double steps = std::ceil(run.end / step), cells = cells_of(p);
  Forecast f;
  f.phases = {{.name = "flow", .steps = steps, .evaluations = steps}};
  f.memory_bytes = 20e6 + bytes_a_cell * cells;
  f.disk_bytes = (run.end / run.snapshots + 1) * (16 * cells + 20e3) + 2 * (60 * cells + 20e3) +
                 (run.series > 0 ? run.end / run.series : steps) * 250;
  return f;
}

/// Seconds of a step, from one of at most 10^5 cells.
double measure_step(ModelParameters p, ThreadTeam& team) {
  const double cells = cells_of(p);
  if (cells > max_cells_measured) p.cell *= std::cbrt(cells / max_cells_measured);
  AirModel model(p);
  model.begin(team);
  return cells / cells_of(p) * seconds_of(team, 0.2, [&] { model.advance(team); });
}

Problem too_large(const ModelParameters& p, double available) {
  const double cells = cells_of(p);
  return {.key = "air.cell",
          .what = fmt::format("{:.4g} mm makes {:.3g} cells", 1e3 * p.cell, cells),
          .allowed = fmt::format("at least {:.2g} mm", 1e3 * p.cell * std::cbrt(bytes_a_cell * cells / available))};
}

}  // namespace

namespace {

class AirRun : public OpenedRun {
 public:
  AirRun(std::filesystem::path folder, const Vector3& size) : OpenedRun(std::move(folder)), size_(size) {}

  std::vector<NamedValue> analyse() override {
    const Series series = read_series(RunFolder(folder()).series());
    std::vector<NamedValue> quantities;
    for (std::size_t n = 0; n < series.names.size(); ++n)
      if (series.rows() > 0 && series.names[n] != "time" && series.names[n] != "step")
        quantities.push_back({series.names[n], series.units[n], series.columns[n].back()});
    return quantities;
  }
  Scene scene() override {
    return {.walls = {{{0, 0, 0}, {size_.x, 0, 0}},
                      {{0, 0, size_.z}, {size_.x, 0, size_.z}},
                      {{0, 0, 0}, {0, 0, size_.z}},
                      {{size_.x, 0, 0}, {size_.x, 0, size_.z}}},
            .box = {{{0, 0, 0}, size_}}};
  }

 private:
  Vector3 size_;
};

std::unique_ptr<OpenedRun> opened(const ModelParameters& p, const std::filesystem::path& folder) {
  return std::make_unique<AirRun>(folder, Vector3{p.box.width, p.box.depth, p.box.height});
}

}  // namespace

std::unique_ptr<OpenedRun> open_air_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                        std::size_t /*snapshot_memory*/) {
  ParameterReader reader(resolved, air::renamed_keys);
  return opened(read_case<ModelParameters>(reader).model, folder);
}

PreparedCase prepare_air(const CaseFile& file) {
  ParameterReader reader(file, air::renamed_keys);
  const auto read = read_case<ModelParameters>(reader);
  const ModelParameters& p = read.model;
  PreparedCase prepared = prepared_case("air", read);
  prepared.instruction_set = choice_name(resolve(InstructionSet::automatic));
  prepared.groups = groups(p);
  prepared.regime = air::regime_of_case(p);
  prepared.open = [p](const std::filesystem::path& folder) { return opened(p, folder); };
  prepared.make_model = [p](ThreadTeam&) { return run::any_model(AirModel(p)); };
  prepared.forecast = forecast(p, read.run);
  prepared.measure_evaluation = [p](ThreadTeam& team) { return measure_step(p, team); };
  prepared.too_large = [p](double available) { return too_large(p, available); };
  return prepared;
}

}  // namespace talus::app
