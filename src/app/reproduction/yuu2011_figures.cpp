// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/yuu2011_figures.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "analysis/discharge.hpp"
#include "analysis/hopper_quantities.hpp"
#include "analysis/particle_field.hpp"
#include "app/continuum/continuum_pictures.hpp"
#include "app/reproduction/yuu2011_air.hpp"
#include "io/figure/figure.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr double flowing = 0.2;                    // s, of Figures 8, 9, 11 and 12
constexpr double seconds_a_period = 6e-3;          // of the means of Figure 7, one printed period
constexpr double rate_mean = 20e-3, every = 1e-3;  // of the means of Figure 6, s
constexpr double profile_above_plate = 20e-3;      // m, Figure 12
constexpr double edge_of_slit = 31e-3;             // m, Figure 11a
constexpr double below_slit = 50e-3;               // m above the floor, Figure 11b

const HopperRun& run_of(const HopperEnsemble& ensemble) {
  return ensemble.runs.front();
}

/// A run's snapshot nearest to a time from the gate's opening; nothing if it does not reach there.
struct Picked {
  PointSet points;
  std::vector<double> radii;
  double time = 0;
};
std::optional<Picked> picked(const HopperEnsemble& ensemble, double time) {
  const auto paths = particle_snapshots(ensemble.folders.front());
  if (paths.empty() || run_of(ensemble).end() < time - every) return std::nullopt;
  std::vector<double> times;
  for (const auto& path : paths) times.push_back(read_points_time(path) - run_of(ensemble).gate_time);
  const std::size_t n = nearest_point(times, time);
  Picked found{read_points(paths[n]), {}, times[n]};
  found.radii.assign(found.points.view().size(), 0.5 * run_of(ensemble).setting.shape.spacing);
  return found;
}

class Album {
 public:
  Album(const std::vector<HopperEnsemble>& ensembles, const std::filesystem::path& folder)
      : ensembles_(ensembles), folder_(folder) {}

  std::vector<FigureOfStudy> draw() {
    std::filesystem::create_directories(folder_);
    for (const HopperEnsemble& ensemble : ensembles_) draw_snapshots(ensemble);
    draw_surface_angles();
    draw_curves("figure_06.png", "Figure 6: discharge through the slit", "Means over 20 ms.",
                {.label = "discharge *Q*", .unit = "kg/s"},
                [](const HopperRun& run) { return mean_rates(passed_mass(run), rate_mean, every, 0, run.end()); });
    draw_curves("figure_07.png", "Figure 7: velocity of the grains in the middle of the slit", "Means over 6 ms.",
                {.label = "-*u*_{pz}", .unit = "m/s"}, [](const HopperRun& run) {
                  return mean_rates(integral(scaled(run.curve("slit_velocity"), -1)), seconds_a_period, every, 0,
                                    run.end());
                });
    draw_fields("figure_08.png", "Figure 8: packing",
                "At 0.2 s and at the end; particles as discs, deposited by the kernel.", "packing",
                {.label = "packing", .low = 0.3, .high = 0.65});
    draw_fields("figure_09.png", "Figure 9: vertical normal stress",
                "At 0.2 s and at the end; particles as discs, what does not depend on the strain's rate.", "stress_zz",
                {.label = "stress *τ*_{zz}", .unit = {1e3, "kPa"}, .low = 0, .high = 1.2});
    if (draw_air_vectors(ensembles_, folder_ / "figure_10.png"))
      figures_.push_back({folder_ / "figure_10.png", "Figure 10: velocity of the air",
                          "In the middle of the depth, 0.17 s and 1.0 s after the gate's opening; shaded: grains."});
    draw_pressures();
    draw_profiles();
    draw_curves("discharged.png", "Share of the grains below the plate", "The paper: more than half at 0.4 s.",
                {.label = "share below the plate", .low = 0, .high = 1},
                [](const HopperRun& run) { return discharged_share(run); });
    return std::move(figures_);
  }

 private:
  void add(const std::string& name, const Figure& figure, const std::string& title, const std::string& caption) {
    write_png(figure, folder_ / name);
    figures_.push_back({folder_ / name, title, caption});
  }

  std::size_t number_of(const HopperEnsemble& ensemble) const {
    return static_cast<std::size_t>(&ensemble - ensembles_.data());
  }
  Colour colour_of(const HopperEnsemble& ensemble) const { return palette_colour(number_of(ensemble)); }
  /// Dotted where the colours come round again.
  Dash dash_of(const HopperEnsemble& ensemble) const {
    return number_of(ensemble) < palette.size() ? Dash::solid : Dash::dotted;
  }

  void draw_snapshots(const HopperEnsemble& ensemble) {
    const std::filesystem::path path = folder_ / fmt::format("figure_04_{}.png", ensemble.variant);
    draw_grains(ensemble.folders.front(), run_of(ensemble).setting, ensemble.variant, path);
    figures_.push_back({path, "Figure 4: grains, " + ensemble.variant,
                        "At the paper's times, 50 dots a particle, spread by the kernel as the paper does."});
  }

  Line line_of(const HopperEnsemble& ensemble, Curve curve, const std::string& what = {}) const {
    curve = part(curve, 0, run_of(ensemble).end());
    return {.x = std::move(curve.time),
            .y = std::move(curve.value),
            .label = ensemble.variant + what,
            .colour = colour_of(ensemble),
            .dash = dash_of(ensemble)};
  }

  void draw_curves(const std::string& name, const std::string& title, const std::string& caption, const Axis& y,
                   Curve (*curve)(const HopperRun&)) {
    Chart chart{.x = {.label = "*t*", .unit = "s", .low = 0}, .y = y};
    for (const HopperEnsemble& ensemble : ensembles_) {
      Line line = line_of(ensemble, curve(run_of(ensemble)));
      if (!line.x.empty()) chart.series.emplace_back(std::move(line));
    }
    if (!chart.series.empty()) add(name, {.panels = {chart}}, title, caption);
  }

  void draw_surface_angles() {
    Chart chart{.x = {.label = "*t*", .unit = "s", .low = 0},
                .y = {.label = "slope of the free surface", .unit = "deg"}};
    for (const HopperEnsemble& ensemble : ensembles_) {
      chart.series.emplace_back(
          line_of(ensemble, run_of(ensemble).curve(&HopperFrame::surface_angle_hopper), ", hopper"));
      Line bin = line_of(ensemble, run_of(ensemble).curve(&HopperFrame::surface_angle_bin), ", bin");
      bin.dash = Dash::dashed;
      chart.series.emplace_back(std::move(bin));
    }
    add("figure_05.png", {.panels = {chart}}, "Figure 5: slope of the free surface",
        "Of the whole surface, left and right half averaged. The paper: rest at 30 degrees.");
  }

  void draw_fields(const std::string& name, const std::string& title, const std::string& caption,
                   const std::string& column, const ByValue& colours) {
    std::vector<Picked> shown;
    shown.reserve(2 * ensembles_.size());
    Figure figure{.columns = 2};
    for (const HopperEnsemble& ensemble : ensembles_)
      for (const double time : {flowing, run_of(ensemble).end()}) {
        std::optional<Picked> found = picked(ensemble, time);
        if (!found) continue;
        shown.push_back(std::move(*found));
        const Snapshot view = shown.back().points.view();
        ByValue coloured = colours;
        coloured.values = view.scalars(column);
        ParticlePicture picture =
            particle_picture(run_of(ensemble).setting, view.positions(), shown.back().radii, coloured);
        picture.title = fmt::format("{}, *t* = {:.2f} s", ensemble.variant, shown.back().time);
        figure.panels.emplace_back(std::move(picture));
      }
    if (!figure.panels.empty()) add(name, figure, title, caption);
  }

  void draw_pressures() {
    Chart up{
        .title = "at *x* = 31 mm", .x = {.label = "*P*", .unit = "Pa"}, .y = {.label = "*z*", .unit = "mm", .low = 0}};
    Chart across{.title = "at *z* = 50 mm", .x = {.label = "*x*", .unit = "mm"}, .y = {.label = "*P*", .unit = "Pa"}};
    for (const HopperEnsemble& ensemble : ensembles_) {
      const std::optional<GridSnapshot> air = air_at(ensemble, flowing);
      if (!air) continue;
      Line line{.label = ensemble.variant, .colour = colour_of(ensemble), .dash = dash_of(ensemble)};
      AirProfile profile = air_along_z(*air, edge_of_slit);
      line.x = std::move(profile.pressure), line.y = std::move(profile.place);
      up.series.emplace_back(line);
      profile = air_along_x(*air, below_slit);
      line.x = std::move(profile.place), line.y = std::move(profile.pressure);
      across.series.emplace_back(line);
    }
    if (!up.series.empty())
      add("figure_11.png", {.panels = {up, across}}, "Figure 11: pressure of the air",
          "At 0.2 s in the middle of the depth, against that of the surroundings.");
  }

  /// Figure 12: mean vertical velocity of the particles within a spacing of the height, and the air's there.
  void draw_profiles() {
    Chart chart{.x = {.label = "*x*", .unit = "mm"}, .y = {.label = "*u*_{pz}, *u*_{z}", .unit = "m/s"}};
    for (const HopperEnsemble& ensemble : ensembles_) {
      const HopperShape& shape = run_of(ensemble).setting.shape;
      const std::optional<Picked> found = picked(ensemble, flowing);
      if (!found || !shape.plate) continue;
      const Snapshot view = found->points.view();
      const double z = shape.plate->height + profile_above_plate;
      const auto cells = static_cast<std::size_t>(std::lround(shape.width / shape.spacing));
      std::vector<double> sum(cells, 0), count(cells, 0);
      for (std::size_t i = 0; i < view.size(); ++i) {
        const Vector3 x = view.positions()[i];
        if (std::abs(x.z - z) > shape.spacing) continue;
        const auto cell = std::min(cells - 1, static_cast<std::size_t>(std::max(0.0, x.x / shape.spacing)));
        sum[cell] += view.vectors("velocity")[i].z;
        ++count[cell];
      }
      Line line{.label = ensemble.variant, .colour = colour_of(ensemble)};
      for (std::size_t cell = 0; cell < cells; ++cell)
        if (count[cell] > 0) {
          line.x.push_back(1e3 * (static_cast<double>(cell) + 0.5) * shape.spacing);
          line.y.push_back(sum[cell] / count[cell]);
        }
      chart.series.emplace_back(std::move(line));
      if (const std::optional<GridSnapshot> air = air_at(ensemble, flowing)) {
        AirProfile profile = air_along_x(*air, z);
        chart.series.emplace_back(Line{.x = std::move(profile.place),
                                       .y = std::move(profile.velocity),
                                       .label = ensemble.variant + ", of the air",
                                       .colour = colour_of(ensemble),
                                       .dash = Dash::dashed});
      }
    }
    if (!chart.series.empty())
      add("figure_12.png", {.panels = {chart}}, "Figure 12: vertical velocity 20 mm above the slit",
          "At 0.2 s; particles within a spacing of the height, means over a spacing in *x*; the air in the middle of "
          "the "
          "depth.");
  }

  const std::vector<HopperEnsemble>& ensembles_;
  std::filesystem::path folder_;
  std::vector<FigureOfStudy> figures_ = {};
};

}  // namespace

std::vector<FigureOfStudy> draw_yuu2011(const std::vector<HopperEnsemble>& ensembles,
                                        const std::filesystem::path& folder) {
  return Album(ensembles, folder).draw();
}

}  // namespace talus::app
