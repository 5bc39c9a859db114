// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/shorter_runs.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "app/continuum/accuracy.hpp"
#include "app/materials/materials.hpp"

namespace talus::app {

namespace {

constexpr double enough_across = 12;                 // particles, of an outlet
constexpr double larger[] = {3, 2.5, 2, 1.5, 1.25};  // spacings, over the case's

Shortening sector() {
  Shortening s{.alternatives = {}, .text = "one sector of the axisymmetric vessel"};
  for (std::string& setting : sector_settings()) s.alternatives.push_back({std::move(setting)});
  return s;
}

Shortening softer_grains(double modulus, double shear_over_bulk) {
  return {
      .alternatives = {{fmt::format("law.critical-state.bulk_modulus={:.4g} MPa", 1e-6 * modulus),
                        fmt::format("law.critical-state.shear_modulus={:.4g} MPa", 1e-6 * shear_over_bulk * modulus)}},
      .text = "grains as soft as discharge and loads allow (docs/design/time-steps.md)"};
}

Shortening larger_particles(const continuum::Layout& layout) {
  const continuum::Parameters& p = layout.given;
  const double width = layout.outlet ? layout.outlet->across : 0;
  std::vector<double> spacings;
  if (width > 0) spacings.push_back(width / enough_across);
  for (const double factor : larger)
    if (!(width > 0) || factor * p.bed.spacing < width / enough_across) spacings.push_back(factor * p.bed.spacing);
  Shortening s{.alternatives = {}, .text = width > 0 ? "fewer particles across the outlet" : "fewer particles"};
  const bool is_section = layout.lattice.count[1] == 1;
  for (const double spacing : spacings) {
    if (spacing < 1.05 * p.bed.spacing) continue;
    s.alternatives.push_back({"bed.spacing=" + millimetres(spacing)});
    if (is_section) s.alternatives.back().push_back("box.depth=" + millimetres(spacing));
  }
  return s;
}

}  // namespace

std::vector<Shortening> shorter_runs(const continuum::Layout& layout, double end) {
  const continuum::Parameters& p = layout.given;
  std::vector<Shortening> all;
  if (!p.box.sector && !p.vessel.empty()) all.push_back(sector());
  if (p.law.is<granular::CriticalState>()) {
    const double modulus = bulk_modulus_for(layout, end);
    if (modulus > 0 && p.law.of<granular::CriticalState>().bulk_modulus > 1.05 * modulus)
      all.push_back(softer_grains(modulus, shear_over_bulk(p.grains.material)));
  }
  if (p.integration.pair_precision == continuum::PairPrecision::in_double)
    all.push_back({.alternatives = {{"integration.pair_precision=single"}}, .text = "sums over pairs to some 1e-6"});
  all.push_back(larger_particles(layout));
  return all;
}

}  // namespace talus::app
