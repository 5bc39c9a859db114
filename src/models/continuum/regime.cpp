// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/regime.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include "base/unit.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/setup/bed_report.hpp"
#include "models/continuum/setup/forecast.hpp"

namespace talus::continuum {

namespace {

constexpr double min_across = 12;  // particles
constexpr double min_outlet_over_axis = 2.8;
constexpr double notable_part = 0.1;  // of an outlet, of a wall
constexpr double nearly_all = 0.99;   // of an outlet
constexpr double notable_viscosity = 0.2;
constexpr double notable_compression = 0.05;

/// Over its area, Pa.
double weight_of_bed(const Setup& setup) {
  return setup.density * setup.given.gravity.acceleration * setup.depth;
}

/// The law's range: its grains, and the pressure at which its fit ends.
void add_range_of_law(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  const granular::LawRange range = setup.material.range();
  const std::string_view law = choice_name(p.law.name);
  if (const double fitted = range.grain_diameter; fitted > 0)
    lines.push_back({"grain diameter", fmt::format("{:.4g} mm", p.grains.diameter / millimetre),
                     fmt::format("the law {} is a fit to grains of {:.4g} mm", law, fitted / millimetre),
                     p.grains.diameter < 0.5 * fitted || p.grains.diameter > 2 * fitted});
  if (!std::isfinite(range.max_pressure)) return;
  const double weight = weight_of_bed(setup);
  lines.push_back({"weight of the bed over its area", fmt::format("{:.4g} Pa", weight),
                   fmt::format("the fit of the law {} ends at a pressure of {:.4g} Pa", law, range.max_pressure),
                   weight > range.max_pressure});
}

/// Where the values of the material hold.
void add_range_of_material(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  const MaterialRange& range = p.grains.range;
  if (range.name.empty()) return;
  lines.push_back({"diameter of the material's grains", fmt::format("{:.4g} mm", p.grains.diameter / millimetre),
                   fmt::format("the values of {} hold from {:.4g} to {:.4g} mm", range.name,
                               range.min_diameter / millimetre, range.max_diameter / millimetre),
                   !(p.grains.diameter >= range.min_diameter && p.grains.diameter <= range.max_diameter)});
  for (const ValueBeyond& beyond : range.beyond)
    lines.push_back({beyond.key, beyond.value, fmt::format("the range of {} is {}", range.name, beyond.range), true});
  const double weight = weight_of_bed(setup);
  lines.push_back({"weight of the bed for its material", fmt::format("{:.4g} Pa", weight),
                   fmt::format("over its area; the values of {} hold up to a pressure of {:.4g} Pa", range.name,
                               range.max_pressure),
                   weight > range.max_pressure});
}

/// A bed laid denser than its grains touch is under pressure before it bears its weight.
void add_pressure_at_start(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  if (!p.law.is<granular::CriticalState>()) return;
  const auto& law = p.law.of<granular::CriticalState>();
  const double pressure = law.bulk_modulus * std::log(p.bed.packing / law.reference_packing);
  if (!(pressure > 0)) return;
  const double weight = weight_of_bed(setup);
  lines.push_back({"pressure of the bed at the start", fmt::format("{:.4g} Pa", pressure),
                   fmt::format("before it bears its weight, {:.4g} Pa over its area: bed.packing is above "
                               "law.critical-state.reference_packing, {:.4g}",
                               weight, law.reference_packing),
                   pressure > weight});
}

/// A bed that is too soft for its weight is another bed once it has settled.
void add_compression(const Setup& setup, std::vector<RegimeLine>& lines) {
  const double modulus = setup.density * setup.sound_speed * setup.sound_speed, weight = weight_of_bed(setup);
  if (!(weight > 0)) return;
  lines.push_back(
      {"weight of the bed over its modulus", fmt::format("{:.2g}", weight / modulus),
       fmt::format("of {:.3g} Pa, density times the square of the sound speed: the share by which the bed's "
                   "foot is compressed; above {:g} take larger moduli of the law",
                   modulus, notable_compression),
       weight > notable_compression * modulus});
}

/// What a sector is, and what of the outlet is as coarse as its axis, where its copies stand in a ring.
void add_sector(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  const int copies = setup.copies;
  if (copies == 1) return;
  lines.push_back(
      {"sector", fmt::format("{:.4g} deg", *p.box.sector * 180 / std::numbers::pi),
       fmt::format("computed in place of the whole vessel, of which it is one of {}; all numbers are those of "
                   "the whole",
                   copies)});
  const auto& outlet = setup.outlet;
  const double width = outlet ? outlet->across : 0;
  if (!(width > 0)) return;
  const double lightest = splits_at_axis(p) ? 1 / parts_of_mass : 1;
  const double ring = std::sqrt(lightest * copies / std::numbers::pi) * p.bed.spacing, ratio = 0.5 * width / ring;
  lines.push_back(
      {"outlet over the sector's axis", fmt::format("{:.3g}", ratio),
       fmt::format("radius of the outlet over that of the ring in which the lightest particle and its copies "
                   "stand about the axis, {:.3g} mm; with whole ones the outlet discharges 6 % less at 2.3, 16 % at "
                   "1.9, 33 % at 1.6 "
                   "(validation/sector): below {:g} take a larger sector or a smaller bed.spacing",
                   ring / millimetre, min_outlet_over_axis),
       ratio < min_outlet_over_axis});
}

/// \param width the narrower side; \param name of one of several, with a blank before it
void add_outlet(const Parameters& p, double width, const std::string& name, std::vector<RegimeLine>& lines) {
  if (!(width > 0)) return;
  const bool few = width < min_across * (1 - 1e-9) * p.bed.spacing;
  const std::string advice =
      few ? fmt::format("; take bed.spacing = \"{:.3g} mm\" or less", width / min_across / millimetre) : "";
  lines.push_back(
      {"particles across the outlet" + name, fmt::format("{:.3g}", width / p.bed.spacing),
       "the flow is underestimated as if the outlet were 3 spacings narrower; use at least 12 (validation/slots)" +
           advice,
       few});
  lines.push_back({"grains across the outlet" + name, fmt::format("{:.3g}", width / p.grains.diameter),
                   "fewer than 10 arch and clog, which a continuum does not", width < 10 * p.grains.diameter});
}

/// Artificial viscosity, which grows with the speed of sound and so with the size of a plant.
void add_viscosity(const Setup& setup, std::vector<RegimeLine>& lines) {
  constexpr double range = 1;  // of what the study found
  const double alpha = setup.given.sph.viscosity_alpha, viscosity = setup.viscosity_at_outlet(alpha);
  if (!std::isfinite(viscosity)) return;
  const bool much = viscosity > notable_viscosity;
  std::string text = fmt::format(
      "sph.viscosity_alpha times sound speed and smoothing length over D (g D)^½ of the outlet: it slows the discharge "
      "by {} {:.2g} % (validation/plant)",
      viscosity > range ? "more than" : "some", 100 * viscous_loss * std::min(viscosity, range));
  if (much)
    text += fmt::format("; take sph.viscosity_alpha = {:.2g}, softer grains or a smaller bed.spacing",
                        alpha * max_viscosity / viscosity);
  lines.push_back({"viscosity at the outlet", fmt::format("{:.3g}", viscosity), text, much});
}

void add_outlets(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  const std::vector<VesselOutlet>& outlets = setup.vessel_outlets;
  if (outlets.empty() && setup.outlet) add_outlet(p, setup.outlet->across, "", lines);
  for (std::size_t n = 0; n < p.plates.size(); ++n) {
    const InclinedPlate& plate = p.plates[n];
    const double length = std::hypot(plate.to[0] - plate.from[0], plate.to[1] - plate.from[1]);
    for (std::size_t k = 0; k + 1 < plate.openings.size(); k += 2)
      if (const double width = plate.openings[k + 1] - plate.openings[k]; width < nearly_all * length)
        add_outlet(p, width, fmt::format(" of plates.{}", n + 1), lines);
  }
  for (const VesselOutlet& outlet : outlets) {
    const std::string name = outlets.size() > 1 ? " " + outlet.name : "";
    add_outlet(p, outlet.narrow, name, lines);
    if (const double covered = share_covered(setup, outlet); covered > 0)
      lines.push_back(
          {"share of the outlet" + name + " with a wall in it or just above", fmt::format("{:.2g}", covered),
           covered > nearly_all
               ? "no grain leaves: a wall that is no gate shuts it, as the bottom of a closed body does"
               : "what is open there is narrower than the gate, by which the outlet's width and what follows from "
                 "it are taken: give the gate the size of the hole",
           covered > notable_part});
    if (const double blocked = share_blocked_below(setup, outlet); blocked > 0)
      lines.push_back({"share of the outlet" + name + " with a wall below", fmt::format("{:.2g}", blocked),
                       fmt::format("nearer than it is across, {:.4g} mm: grains that do not fall freely there leave "
                                   "more slowly than the analytical estimate says",
                                   outlet.narrow / millimetre),
                       blocked > notable_part});
  }
}

/// Mass comes in by whole layers.
void add_inlets(const Setup& setup, std::vector<RegimeLine>& lines) {
  constexpr double min_layers = 5;
  const Parameters& p = setup.given;
  for (std::size_t n = 0; n < p.inlets.size(); ++n) {
    const Inlet& inlet = p.inlets[n];
    if (const auto window = cut_window(setup, inlet))
      lines.push_back({fmt::format("window of inlet {} within the box", n + 1),
                       fmt::format("{:.4g} x {:.4g} mm", window->width / millimetre, window->depth / millimetre),
                       fmt::format("a face of the box cuts it; {:.4g} kg/s come in through what is left", inlet.rate),
                       window->by_wall});
    if (!inlet.to) continue;
    const double layers = (*inlet.to - inlet.from) / layer_of(setup, inlet).interval,
                 asked = inlet.rate * (*inlet.to - inlet.from);
    lines.push_back({fmt::format("layers of grains through inlet {}", n + 1), fmt::format("{:.3g}", layers),
                     fmt::format("of {:.3g} kg each, of which it lets whole ones in: with fewer than {:g} the mass of "
                                 "{:.4g} kg is missed by a tenth or more; take a smaller bed.spacing or inlet",
                                 asked / layers, min_layers, asked),
                     layers < min_layers});
  }
}

constexpr double max_depth_below_box = 5;  // heights of the box

void add_walls_beyond_box(const Setup& setup, std::vector<RegimeLine>& lines) {
  const Parameters& p = setup.given;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) {
    if (const double share = share_in_box(p, n); share < notable_part)
      lines.push_back({"share of " + name_of(p, n) + " within the box", fmt::format("{:.2g}", share),
                       extents_text(p, n) + ": are place and unit right?", true});
    else if (const double depth = -bounds_of(p, n).low.z; depth > max_depth_below_box * p.box.height)
      lines.push_back({"depth of " + name_of(p, n) + " below the box", fmt::format("{:.4g} m", depth),
                       extents_text(p, n) + ": a number for missing data among its heights?", true});
  }
}

/// Where grains may leave the vessel of a file before any gate opens.
void add_rims(const Setup& setup, std::vector<RegimeLine>& lines) {
  for (const OpenRim& rim : rims_below_bed(setup)) {
    const auto mm = [](double x) { return std::round(1e3 * x / millimetre) / 1e3 + 0.0; };
    lines.push_back(
        {"rim of " + name_of(setup.given, rim.part) + " below the top of the bed",
         fmt::format("{:.3g} x {:.3g} mm at ({:.4g}, {:.4g}, {:.4g}) mm", mm(rim.length), mm(rim.width),
                     mm(rim.middle.x), mm(rim.middle.y), mm(rim.middle.z)),
         "the surface ends there and nothing covers it: grains leave through it, unless it is meant as an outlet",
         true});
  }
}

/// Whether the air is a light gas about the grains, and its cells resolve bed and slit.
void add_air(const Setup& setup, std::vector<RegimeLine>& lines) {
  constexpr double max_density_ratio = 0.01, min_cells_of_bed = 8, max_difference = 0.1;
  const Parameters& p = setup.given;
  if (!p.air.enabled) return;
  const Grid grid = air_grid(p);
  const double ratio = p.air.gas.density() / p.grains.density;
  lines.push_back({"density of the air over the grains'", fmt::format("{:.3g}", ratio),
                   fmt::format("{:.4g} kg/m3; the air has no weight, and grains no buoyancy", p.air.gas.density()),
                   ratio > max_density_ratio});
  for (RegimeLine& line : air::regime_of_faces(p.air.gas, grid)) lines.push_back(std::move(line));
  if (!setup.has_no_bed()) {
    const double across = setup.depth / grid.spacing.z;
    lines.push_back({"cells of the air over the bed's height", fmt::format("{:.3g}", across),
                     fmt::format("{:.4g} mm each; with fewer than {:g} the drag on the bed is too small: its surface "
                                 "is spread over some of them",
                                 grid.spacing.z / millimetre, min_cells_of_bed),
                     across < min_cells_of_bed});
  }
  const std::optional<Outlet> slit = p.plate.height ? slit_of(p) : std::nullopt;
  if (!slit) return;
  double width = 0;
  for (int i = 0; i < grid.count[0]; ++i)
    if (const double x = grid.centre(i, 0, 0).x; x > slit->left && x < slit->right) width += grid.spacing.x;
  const double given = slit->right - slit->left;
  lines.push_back({"width of the slit for the air", fmt::format("{:.4g} mm", width / millimetre),
                   fmt::format("whole cells of {:.4g} mm; for the grains {:.4g} mm", grid.spacing.x / millimetre,
                               given / millimetre),
                   std::abs(width - given) > max_difference * given});
}

}  // namespace

std::vector<RegimeLine> regime_of_case(const Setup& setup) {
  const Parameters& p = setup.given;
  std::vector<RegimeLine> lines;
  add_range_of_law(setup, lines);
  add_range_of_material(setup, lines);
  add_pressure_at_start(setup, lines);
  lines.push_back({"particle spacing over grain diameter", fmt::format("{:.3g}", p.bed.spacing / p.grains.diameter),
                   "a particle stands for many grains; below 1 it would be smaller than one",
                   p.bed.spacing < p.grains.diameter});
  add_compression(setup, lines);
  add_sector(setup, lines);
  for (RegimeLine& line : regime_of_bed(setup)) lines.push_back(std::move(line));
  add_outlets(setup, lines);
  add_viscosity(setup, lines);
  add_inlets(setup, lines);
  add_air(setup, lines);
  add_walls_beyond_box(setup, lines);
  add_rims(setup, lines);
  return lines;
}

RegimeLine courant_line(Method method, double courant) {
  return {"Courant number", fmt::format("{:.3g}", courant),
          "time step times the sound speed over the smallest smoothing length; stable below about 0.5 (Runge-Kutta), "
          "1.5 (leapfrog)",
          courant > (method == Method::runge_kutta ? 0.5 : 1.5)};
}

RegimeLine courant_of_case(const Setup& setup) {
  return courant_line(setup.given.integration.method, courant_number(setup));
}

}  // namespace talus::continuum
