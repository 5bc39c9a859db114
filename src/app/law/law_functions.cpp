// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <utility>

#include "app/law/law_case.hpp"
#include "io/series.hpp"
#include "physics/granular/fitted_table.hpp"

namespace talus::app {

namespace {

using granular::FittedFunctions;

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

void write_functions(const granular::Fits& fits, const std::filesystem::path& file) {
  const std::vector<double> strain = strains();
  std::vector<SeriesColumn> columns{{"strain", "1"}};
  std::vector<std::vector<double>> rows;
  for (const double a : strain) rows.push_back({a});
  const auto add = [&](const FittedFunctions& functions, const std::string& which) {
    const Curves curves = curves_of(functions, strain, fits.scale);
    const auto add_column = [&](const std::string& name, const char* unit, const std::vector<double>& values) {
      columns.push_back({name + "_" + which, unit});
      for (std::size_t n = 0; n < rows.size(); ++n) rows[n].push_back(values[n]);
    };
    for (std::size_t k = 0; k < 4; ++k) add_column(fmt::format("A{}", k + 1), k < 3 ? "Pa" : "1", curves.a1_to_a4[k]);
    add_column("friction", "1", curves.friction);
    add_column("pressure", "Pa", curves.pressure);
  };
  add(granular::printed_2011, "printed");
  if (fits.tables == granular::Tables::repaired) add(fits.functions(), "repaired");
  write_table(file, columns, rows);
}

}  // namespace talus::app
