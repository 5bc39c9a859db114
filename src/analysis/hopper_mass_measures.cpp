// SPDX-License-Identifier: Apache-2.0
/// What of the grains is there, has come and has gone: a part of the list of hopper_measures.cpp.
#include <cmath>

#include "analysis/hopper_estimators.hpp"

namespace talus::hopper {

namespace {

using Run = HopperRun;
using Row = Measure<Run>;

bool always(const Run&) {
  return true;
}
bool comes_or_goes(const Run& run) {
  return run.series.has("fed_mass");
}

/// The last value of a column of the series; 0 if there is none.
double last(const Run& run, const char* column) {
  return run.series.has(column) ? run.series.column(column).back() : 0;
}

/// M and what has come since, less what has gone.
double mass_expected(const Run& run) {
  return run.setting.mass() + last(run, "fed_mass") - last(run, "removed_mass");
}

}  // namespace

std::vector<Row> hopper_mass_measures() {
  return {
      Row("mass", "kg", "mass of all particles", at(mass)),
      Row("mass_error", "1", "|mass of all particles over M, and what inlets fed less what was removed, − 1|",
          {[](const Run& r, const Place& p, const Window& w) {
            return std::abs(value_at_window(mass, r, p, w) / mass_expected(r) - 1);
          }},
          {{always}}),
      Row("fed_mass", "kg", "mass that came in through inlets, to the end of the run",
          {[](const Run& r, const Place&, const Window&) { return last(r, "fed_mass"); }}, {{comes_or_goes}}),
      Row("removed_mass", "kg", "mass that was taken away, to the end of the run",
          {[](const Run& r, const Place&, const Window&) { return last(r, "removed_mass"); }}, {{comes_or_goes}}),
  };
}

}  // namespace talus::hopper
