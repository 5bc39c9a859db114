// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "app/law/law_results.hpp"
#include "io/figure/figure.hpp"
#include "physics/granular/fitted_table.hpp"

namespace talus::app {

namespace {

using namespace figure;
using granular::FittedFunctions;
using Component = double SymmetricTensor3<>::*;

constexpr std::array<Component, 3> normal_components{&SymmetricTensor3<>::xx, &SymmetricTensor3<>::yy,
                                                     &SymmetricTensor3<>::zz};
constexpr std::array<Component, 3> shear_components{&SymmetricTensor3<>::xy, &SymmetricTensor3<>::yz,
                                                    &SymmetricTensor3<>::zx};
constexpr std::array<const char*, 3> normal_names{"xx", "yy", "zz"}, shear_names{"xy", "yz", "zx"};

/// Which of three components of the strain varies most along the path, and by how much.
std::pair<std::size_t, double> most_varied(const FollowedPath& path, const std::array<Component, 3>& components) {
  std::size_t most = 0;
  double widest = 0;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto [low, high] = std::minmax_element(
        path.points.begin(), path.points.end(),
        [&](const auto& a, const auto& b) { return a.strain.*components[c] < b.strain.*components[c]; });
    const double width = high->strain.*components[c] - low->strain.*components[c];
    if (width > widest) widest = width, most = c;
  }
  return {most, widest};
}

template <class Value>
std::vector<double> column(const FollowedPath& path, Value&& value) {
  std::vector<double> values;
  for (const granular::PathPoint& point : path.points) values.push_back(value(point));
  return values;
}

/// From 1e-6 to beyond the range of the fits, 100 a decade.
std::vector<double> strains() {
  std::vector<double> a;
  for (int k = -600; k <= -100; ++k) a.push_back(std::pow(10.0, k / 100.0));
  return a;
}

/// A1 to A4 at a strain.
std::array<double, 4> functions_at(const granular::ComponentTable& table, double a) {
  double values[4];
  table.evaluate(a, values);
  std::array<double, 4> result;
  for (std::size_t k = 0; k < 4; ++k) result[k] = values[k] * granular::beyond_range(a);
  return result;
}

struct Curves {
  std::vector<double> a1_to_a4[4], friction, pressure;
};
Curves curves_of(const FittedFunctions& functions, const std::vector<double>& strain, double scale) {
  const granular::ComponentTable table = granular::component_table(functions);
  const granular::PressureTable pressure = granular::pressure_table(functions);
  Curves curves;
  for (const double a : strain) {
    const auto values = functions_at(table, a);
    for (std::size_t k = 0; k < 4; ++k) curves.a1_to_a4[k].push_back(values[k]);
    curves.friction.push_back(values[3] * a / std::sqrt(2.0));
    curves.pressure.push_back(scale * pressure(std::sqrt(3.0) * a) / std::sqrt(3.0));
  }
  return curves;
}

}  // namespace

void draw_path(const FollowedPath& path, const std::filesystem::path& file) {
  const std::size_t normal = most_varied(path, normal_components).first;
  const auto [shear, sheared_by] = most_varied(path, shear_components);
  Chart normals{.title = "normal stress",
                .x = {fmt::format("*e*_{{{}}}", normal_names[normal])},
                .y = {"*τ*", "Pa"},
                .series = {}};
  const std::vector<double> abscissa =
      column(path, [&](const auto& point) { return point.strain.*normal_components[normal]; });
  for (std::size_t c = 0; c < 3; ++c)
    normals.series.push_back(
        Line{.x = abscissa,
             .y = column(path, [&](const auto& point) { return point.stress.*normal_components[c]; }),
             .label = fmt::format("*τ*_{{{}}}", normal_names[c]),
             .dash = c == normal             ? Dash::solid
                     : c == (normal + 1) % 3 ? Dash::dashed
                                             : Dash::dotted});

  const Component sheared = shear_components[shear];
  const Chart shears{.title = "shear stress",
                     .x = {fmt::format("*e*_{{{}}}", shear_names[shear])},
                     .y = {fmt::format("*τ*_{{{}}}", shear_names[shear]), "Pa"},
                     .series = {Line{.x = column(path, [&](const auto& point) { return point.strain.*sheared; }),
                                     .y = column(path, [&](const auto& point) { return point.stress.*sheared; })}}};

  const auto friction = [](const granular::PathPoint& point) {
    const double pressure = trace(point.stress) / 3;
    return pressure > 0 ? norm(deviator(point.stress)) / std::sqrt(2.0) / pressure : std::nan("");
  };
  const auto deviator_size = [](const granular::PathPoint& point) { return norm(deviator(point.strain)); };
  const Chart frictions{.title = "friction",
                        .x = {"|*e*_{dev}|"},
                        .y = {"|*τ*_{dev}| / √2 *p*"},
                        .series = {Line{.x = column(path, deviator_size), .y = column(path, friction)}}};
  const double grain_density = path.parameters.grains.density;
  const Chart pressures{
      .title = "pressure",
      .x = {"packing"},
      .y = {"*p*", "Pa"},
      .series = {Line{.x = column(path, [&](const auto& point) { return point.density / grain_density; }),
                      .y = column(path, [](const auto& point) { return trace(point.stress) / 3; })}}};
  std::vector<Panel> panels{normals, shears, frictions, pressures};
  if (sheared_by == 0) panels.erase(panels.begin() + 1);
  write_png({.panels = std::move(panels), .columns = 2}, file);
}

void draw_functions(const granular::Fits& fits, const std::filesystem::path& file) {
  const std::vector<double> strain = strains();
  const bool repaired = fits.tables == granular::Tables::repaired;
  const Curves printed = curves_of(granular::printed_2011, strain, fits.scale);
  const Curves chosen = curves_of(fits.functions(), strain, fits.scale);
  const auto chart = [&](std::string title, Axis x, Axis y, const std::vector<double>& one,
                         const std::vector<double>& other) {
    Chart drawn{.title = std::move(title), .x = std::move(x), .y = std::move(y), .series = {}};
    drawn.series.push_back(Line{.x = strain, .y = one, .label = "printed", .colour = vermillion, .width = 1});
    if (repaired) drawn.series.push_back(Line{.x = strain, .y = other, .label = "repaired", .colour = blue});
    return drawn;
  };
  const auto axis = [&](std::string label) {
    return Axis{.label = std::move(label), .low = strain.front(), .high = strain.back(), .logarithmic = true};
  };
  std::vector<Panel> panels;
  for (std::size_t k = 0; k < 4; ++k)
    panels.emplace_back(chart(fmt::format("A{}", k + 1), axis("|*Ea*|"),
                              {.label = fmt::format("A{}", k + 1),
                               .unit = k < 3 ? "Pa" : "",
                               .low = k == 2 ? std::optional(1e3) : std::nullopt,
                               .logarithmic = true},
                              printed.a1_to_a4[k], chosen.a1_to_a4[k]));
  panels.emplace_back(chart("friction in simple shear", axis("|*e*_{dev}|"), {.label = "A4 |*e*_{dev}| / √2"},
                            printed.friction, chosen.friction));
  panels.emplace_back(chart("pressure", axis("*e*_{v}"), {.label = "*p*", .unit = "Pa", .logarithmic = true},
                            printed.pressure, chosen.pressure));
  write_png({.panels = std::move(panels), .columns = 2}, file);
}

}  // namespace talus::app
