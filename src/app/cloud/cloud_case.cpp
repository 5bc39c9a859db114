// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_case.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <memory>
#include <numeric>
#include <utility>

#include "analysis/fronts.hpp"
#include "app/case/model_case.hpp"
#include "app/cloud/cloud_analysis.hpp"
#include "app/cloud/cloud_ranks_forecast.hpp"
#include "io/parameter_writer.hpp"
#include "io/points_csv.hpp"
#include "models/cloud/mobility_sum.hpp"
#include "models/cloud/model.hpp"
#include "models/cloud/parameters.hpp"

namespace talus::app {

namespace {

using cloud::Cloud;
using cloud::Grains;
using cloud::Parameters;

/// Columns without a unit are metres. Where that makes grains of another size than those of the case, or a cloud so
/// thin that the grains hardly meet, the numbers are of another unit: the case then has to name it.
void check_units(const std::vector<std::string>& without_unit, const Parameters& p, const Grains& grains,
                 std::vector<Problem>& problems) {
  constexpr double max_ratio = 100;
  const auto without = [&](const char* name) {
    return std::find(without_unit.begin(), without_unit.end(), name) != without_unit.end();
  };
  const auto add = [&](const char* columns, const char* column, std::string what) {
    problems.push_back(
        {.key = "particles.file",
         .what = fmt::format("{} without a unit: as metres, {}", columns, what),
         .allowed = fmt::format("the unit in the header: {0} [mm], or {0} [m] if that is meant", column)});
  };
  const auto count = static_cast<double>(grains.radius.size());
  if (grains.radius.empty()) return;
  const double radius = std::accumulate(grains.radius.begin(), grains.radius.end(), 0.0) / count;
  const double ratio = radius / p.particles.radius;
  if (without("radius") && !(ratio < max_ratio && ratio > 1 / max_ratio))
    return add("radius", "radius", fmt::format("a mean of {:.3g} times particles.radius", ratio));
  if (!without("x") || grains.radius.size() < 2) return;
  Vector3 low = grains.position.front(), high = low;
  for (const Vector3& x : grains.position)
    for (int axis = 0; axis < 3; ++axis)
      low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
  double room = 1;
  int axes = 0;
  for (int axis = 0; axis < 3; ++axis)
    if (high[axis] > low[axis]) room *= high[axis] - low[axis], ++axes;
  const double distance = axes > 0 ? std::pow(room / count, 1.0 / axes) : 0;
  if (distance > max_ratio * radius)
    add("coordinates", "x", fmt::format("some {:.3g} radii from grain to grain", distance / radius));
}

/// What was made of the columns.
std::vector<std::string> remarks_on(const Snapshot& points, const Grains& grains) {
  const auto [least, most] = std::minmax_element(grains.radius.begin(), grains.radius.end());
  std::vector<std::string> remarks{fmt::format(
      "particles.file: {} grains; {}", grains.radius.size(),
      points.has("radius") ? fmt::format("radii from {:.4g} to {:.4g} mm", 1e3 * *least, 1e3 * *most)
                           : fmt::format("no column radius: all have particles.radius, {:.4g} mm", 1e3 * *least))};
  if (points.has("id")) remarks.emplace_back("particles.file: the column id is not used; grains keep the file's order");
  return remarks;
}

struct GivenGrains {
  Grains grains;
  std::vector<std::string> remarks;
};

/// Reads the points of particles.file; radii that the file does not give are the mean radius.
GivenGrains read_grains(const CaseFile& file, const Parameters& p, std::vector<Problem>& problems) {
  static constexpr KnownColumn others[] = {{"id", dimension::none}};
  static constexpr std::string_view no_inertia =
      "a cloud has no inertia, its velocities follow from the places of the grains at every moment (Eq. 4a)";
  static constexpr RefusedColumn refused[] = {
      {"velocity", no_inertia}, {"velocity_x", no_inertia}, {"velocity_y", no_inertia}, {"velocity_z", no_inertia},
      {"vx", no_inertia},       {"vy", no_inertia},         {"vz", no_inertia}};
  GivenPoints given;
  read_input("particles.file", problems,
             [&] { given = read_given_points(input_path(file, p.particles.file), others, refused); });
  GivenGrains read;
  if (!problems.empty()) return read;
  const Snapshot view = given.points.view();
  Grains& grains = read.grains;
  grains.position.assign(view.positions().begin(), view.positions().end());
  if (view.has("radius")) {
    grains.radius.assign(view.scalars("radius").begin(), view.scalars("radius").end());
  } else {
    grains.radius.assign(grains.position.size(), p.particles.radius);
  }
  check_units(given.without_unit, p, grains, problems);
  const std::vector<Problem> faults = cloud::check_grains(p, grains);
  if (problems.empty()) problems = faults;
  if (problems.empty()) read.remarks = remarks_on(view, grains);
  return read;
}

std::string digest_of(const Grains& grains) {
  const auto bytes = [](const auto& column) {
    return std::string_view(reinterpret_cast<const char*>(column.data()), column.size() * sizeof(column[0]));
  };
  return digest(std::string(bytes(grains.position)).append(bytes(grains.radius)));
}

/// The front's position after every step; a case without x as its way down still has a foremost grain.
std::vector<NamedValue> observe_front(const Snapshot& snapshot, double layer) {
  const double front = front_position(snapshot.positions()).value_or(std::nan(""));
  const double on_slope = front_position_on_slope(snapshot.positions(), layer).value_or(std::nan(""));
  return {{"front_x", "m", front}, {"front_on_slope_x", "m", on_slope}};
}

std::vector<NamedValue> groups(const Parameters& p) {
  const cloud::Scales s = cloud::scales(p);
  const double a = p.particles.radius;
  const double reynolds = p.fluid.density * a * s.stokes_speed / p.fluid.viscosity;
  return {{"particles", "1", static_cast<double>(p.particles.count)},
          {"stokes_speed", "m/s", s.stokes_speed},
          {"stokes_time", "s", s.stokes_time},
          {"contact_ratio", "1", s.contact_ratio},
          {"volume_fraction", "1", s.volume_fraction},
          {"reynolds_number", "1", reynolds},
          {"stiffness_ratio", "1", cloud::contact_rate(p) * s.stokes_time}};
}

Forecast forecast(const Parameters& p, const run::RunParameters& run) {
  const auto n = static_cast<double>(p.particles.count);
  const cloud::Forecast f = cloud::forecast(p, run.end, n);
  const double snapshots = run.end / run.snapshots + 1;
  return {.phases = {{"run", f.steps, f.evaluations}},
          .memory_bytes = cloud::memory_of(n),
          .disk_bytes = snapshots * (104 * n + 20e3) + 2 * (88 * n + 20e3) + f.steps * 200 + 1e6};
}

/// Of all velocities. The pairs are the work, unless there are none to be summed.
double measure_evaluation(const Parameters& p, ThreadTeam& team) {
  const auto count = static_cast<double>(p.particles.count);
  // Of the spectral sum, whose cost is in proportion to the grains, enough for its grid to weigh as it will.
  const bool spectral = cloud::spectral_accuracy_of(p, count) != nullptr;
  const double measured = std::min(count, spectral ? 20000.0 : 3000.0);
  const Grains grains = cloud::sample(p, static_cast<std::size_t>(measured));
  cloud::Velocities velocities(p, grains.radius);
  std::vector<Vector3> velocity(grains.radius.size());
  if (spectral) {
    std::vector<std::int64_t> order(grains.radius.size());
    std::iota(order.begin(), order.end(), std::int64_t{0});
    velocities.arrange_sum(order, velocities.choose_sum(grains.position));
  }
  const double seconds = seconds_of(team, 0.1, [&] { velocities(team, grains.position, velocity); });
  const int power = spectral || p.fluid.mobility == hydrodynamics::Mobility::none ? 1 : 2;
  return seconds * std::pow(count / measured, power);
}

Lines on_ranks(const Parameters& p, double evaluations, ThreadTeam& team, double evaluation, int ranks) {
  Parameters without = p;
  without.fluid.mobility = hydrodynamics::Mobility::none;
  return forecast_on_ranks(p, evaluations, {evaluation, measure_evaluation(without, team)}, ranks);
}

Problem too_large(const Parameters& p, double available) {
  const double each = cloud::memory_of(1) - cloud::memory_of(0);
  const double most = std::max(1.0, (available - cloud::memory_of(0)) / each);
  const bool file = p.particles.shape == cloud::Shape::file;
  return {.key = file ? "particles.file" : "particles.count",
          .what = fmt::format("{} grains", p.particles.count),
          .allowed = fmt::format("at most {:.3g} grains", most)};
}

CloudFrame frame_of(const Parameters& p) {
  const cloud::Scales s = cloud::scales(p);
  return {{p.particles.radius, s.stokes_speed}, p.motion, p.slope.enabled, s.gravity};
}

}  // namespace

CloudStudy study_of(const CaseFile& file) {
  ParameterReader reader(file, cloud::renamed_keys);
  const auto [run, p] = read_case<Parameters>(reader);
  return {run.title, frame_of(p)};
}

namespace {

class CloudRun : public OpenedRun {
 public:
  CloudRun(std::filesystem::path folder, CloudStudy study) : OpenedRun(std::move(folder)), study_(std::move(study)) {}

  std::vector<NamedValue> analyse() override { return analyze_cloud(folder(), study_.frame, run()); }
  std::vector<std::filesystem::path> draw() override { return draw_cloud(folder(), study_.frame, study_.title); }
  Scene scene() override {
    const CloudFrame& frame = study_.frame;
    const std::string_view view = !frame.has_slope                     ? "xz"
                                  : frame.motion == cloud::Motion::xy  ? "xy"
                                  : frame.motion == cloud::Motion::xyz ? "free"
                                                                       : "xz";
    return {.walls = {}, .box = {}, .slope = frame.has_slope, .radius = frame.scales.mean_radius, .view = view};
  }
  bool reaches(double time) override { return run().reaches(time); }
  double number(const std::string& quantity, const Window& window) override {
    return number_of<AvalancheRun>(run(), avalanche_measures(), quantity, window);
  }

 private:
  const AvalancheRun& run() {
    if (!run_) run_ = read_avalanche(folder(), study_.frame);
    return *run_;
  }

  CloudStudy study_;
  std::optional<AvalancheRun> run_;
};

}  // namespace

std::unique_ptr<OpenedRun> open_cloud_run(const CaseFile& resolved, const std::filesystem::path& folder,
                                          std::size_t /*snapshot_memory*/) {
  return std::make_unique<CloudRun>(folder, study_of(resolved));
}

PreparedCase prepare_cloud(const CaseFile& file) {
  ParameterReader reader(file, cloud::renamed_keys);
  auto read = read_case<Parameters>(reader);
  Parameters& p = read.model;
  if (auto problem = cloud::check_steps(p, read.run.end)) {
    reader.check({std::move(*problem)});
    reader.throw_problems();
  }

  std::optional<Grains> given;
  std::vector<std::string> remarks;
  if (p.particles.shape == cloud::Shape::file) {
    std::vector<Problem> problems;
    auto [grains, made] = read_grains(file, p, problems);
    ParameterReader points(file);
    points.check(problems);
    points.throw_problems();
    given = std::move(grains);
    remarks = std::move(made);
    p.particles.count = static_cast<std::int64_t>(given->radius.size());
  }

  if (p.gravity.direction && file.contains("slope.angle"))
    remarks.emplace_back("slope.angle: is not used, gravity.direction says where gravity points");

  PreparedCase prepared = prepared_case("cloud", read);
  if (given) prepared.inputs = digest_of(*given);
  prepared.remarks = std::move(remarks);
  prepared.seed = p.seed;
  prepared.instruction_set = choice_name(resolve(p.integration.instruction_set));
  prepared.groups = groups(p);
  prepared.regime = cloud::regime_of_case(p);
  auto grains = [p, given] { return given ? *given : cloud::pack(p); };
  const auto n = static_cast<double>(p.particles.count);
  prepared.open = [study = CloudStudy{read.run.title, frame_of(p)}](const std::filesystem::path& folder) {
    return std::make_unique<CloudRun>(folder, study);
  };
  prepared.make_model = [p, grains](ThreadTeam&) { return run::any_model(Cloud(p, grains())); };
  prepared.make_part = [p, grains](ThreadTeam&, const Ranks& ranks) {
    return run::any_model(Cloud(p, grains(), ranks));
  };
  prepared.shared = {.count = n,
                     .name = "grains",
                     .key = given ? "particles.file" : "particles.count",
                     .allowed = "some 1000 grains on each pay"};
  const double layer = 2 * p.particles.radius;
  prepared.observers = {{.columns = {"position"}, .observe = [layer](const Pieces& pieces) {
                           std::vector<NamedValue> values;
                           pieces([&](const Snapshot& all) { values = observe_front(all, layer); });
                           return values;
                         }}};
  prepared.forecast = forecast(p, read.run);
  prepared.measure_evaluation = [p](ThreadTeam& team) { return measure_evaluation(p, team); };
  prepared.on_ranks = [p, f = prepared.forecast](ThreadTeam& team, double evaluation, int ranks) {
    return on_ranks(p, f.phases.front().evaluations, team, evaluation, ranks);
  };
  prepared.too_large = [p](double available) { return too_large(p, available); };
  prepared.headline = {.column = "front_x", .name = p.slope.enabled ? "front" : "foremost grain", .is_rate = true};
  return prepared;
}

}  // namespace talus::app
