// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/design_code.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <utility>

#include "app/continuum/engineering_units.hpp"
#include "app/continuum/hand_formulas.hpp"
#include "app/materials/materials.hpp"
#include "base/unit.hpp"
#include "io/series.hpp"

namespace talus::app {

namespace {

using granular::en1991::Limit;
using granular::en1991::Load;
using granular::en1991::Values;
namespace code = granular::en1991;

bool has_hopper_at(const SiloShape& shape, const SiloPiece& wall, double height) {
  return std::any_of(shape.pieces.begin(), shape.pieces.end(), [&](const SiloPiece& piece) {
    return piece.is_hopper() && std::abs(piece.top - height) <= shape.layout.given.bed.spacing &&
           std::hypot(piece.axis.x - wall.axis.x, piece.axis.y - wall.axis.y) < 0.5 * wall.width;
  });
}

/// Of the case's material, if the code lists it.
std::optional<code::Solid> listed_solid(const continuum::Parameters& p) {
  return p.grains.material ? solid_of_code(*p.grains.material) : std::nullopt;
}

/// That, or one by the friction that the law has in a shear tester.
code::Solid solid_of(const continuum::Parameters& p) {
  const auto listed = listed_solid(p);
  return listed ? *listed : code::unknown_solid(internal_friction_by_hand(p, granular::FrictionTest::shear_plane));
}

double eccentricity_of_outlets(const continuum::Layout& layout, const Vector3& axis) {
  double largest = 0;
  for (const continuum::VesselOutlet& outlet : layout.vessel_outlets)
    largest = std::max(largest, std::hypot(outlet.endless_along_x ? 0 : outlet.middle.x - axis.x,
                                           outlet.endless_along_y ? 0 : outlet.middle.y - axis.y));
  return largest;
}

}  // namespace

bool CodeSilo::has_channel() const {
  return silo.is_round && eccentricity > code::large_eccentricity * silo.width;
}

Values CodeSilo::values(Load load, Limit limit) const {
  return code::values_for(solid, friction, load, limit);
}

double CodeSilo::weight(Limit limit) const {
  return code::weight_for(solid, own_weight, limit);
}

code::Stresses CodeSilo::filling(Load load, Limit limit, double height) const {
  code::Stresses found = code::filling(silo, solid.repose, values(load, limit), weight(limit), top - height);
  found.shear = code::values_for(solid, own_friction, load, limit).friction * found.pressure;
  return found;
}

std::optional<CodeSilo> silo_of_code(const SiloShape& shape, double top, const Vector3& place) {
  const continuum::Layout& layout = shape.layout;
  const continuum::Parameters& p = layout.given;
  const SiloPiece* wall = shape.upright_at(place);
  const double height = place.z;
  if (!wall || wall->bottom > height + p.bed.spacing || !(top > height)) return std::nullopt;
  const double bottom = shape.bottom_of(*wall, top);
  if (bottom > height + p.bed.spacing) return std::nullopt;  // a skirt about a hopper
  double friction = 0, beside = 0;
  for (const SiloShape::Ring& ring : shape.rings_above(*wall, height, top))
    friction += ring.friction * ring.height, beside += ring.height;
  CodeSilo found{.name = shape.name_of(*wall),
                 .part = wall->parts.front(),
                 .silo = {.area = wall->area,
                          .circumference = wall->circumference,
                          .width = wall->width,
                          .is_round = wall->is_round},
                 .solid = solid_of(p),
                 .is_listed = listed_solid(p).has_value(),
                 .friction = beside > 0 ? friction / beside : wall->friction,
                 .own_friction = wall->friction,
                 .own_weight = bulk_density(p) * p.gravity.acceleration,
                 .top = top,
                 .bottom = bottom,
                 .eccentricity = eccentricity_of_outlets(layout, wall->axis)};
  found.silo.height = top - found.bottom;
  found.silo.has_flat_bottom = !has_hopper_at(shape, *wall, found.bottom);
  return found;
}

namespace {

CodeLoads loads_on_upright(const CodeSilo& s, double height) {
  const code::DischargeFactors factors = code::discharge_factors(s.silo);
  CodeLoads loads;
  loads.pressure_filling = s.filling(Load::wall_pressure, Limit::upper, height).pressure;
  loads.pressure_filling_lower = s.filling(Load::wall_pressure, Limit::lower, height).pressure;
  loads.shear_filling = s.filling(Load::wall_shear, Limit::upper, height).shear;
  loads.pressure_discharge = factors.pressure * loads.pressure_filling;
  loads.pressure_discharge_lower = factors.pressure * loads.pressure_filling_lower;
  loads.shear_discharge = factors.shear * loads.shear_filling;
  if (!s.has_channel()) return loads;
  // The channels press less than the bed at rest, and that beside them by as much more.
  const Values values = s.values(Load::wall_pressure, Limit::upper);
  for (const double share : code::channel_radii) {
    const double within = code::channel_pressure(code::flow_channel(0.5 * s.silo.width, share, values),
                                                 s.weight(Limit::upper), s.top - height);
    const double beside = 2 * loads.pressure_filling - within;
    loads.in_channel = std::fmin(loads.in_channel, within);  // of nan and a number the number
    loads.beside_channel = std::fmax(loads.beside_channel, beside);
  }
  return loads;
}

CodeLoads loads_on_floor(CodeSilo s, double height) {
  s.silo.height = s.top - height, s.silo.has_flat_bottom = true;
  const auto pressure = [&](Limit limit) {
    return code::bottom_pressure(s.silo, s.solid.repose, s.values(Load::bottom, limit), s.weight(limit));
  };
  CodeLoads loads;
  loads.pressure_filling = loads.pressure_discharge = pressure(Limit::upper);
  loads.pressure_filling_lower = loads.pressure_discharge_lower = pressure(Limit::lower);
  return loads;
}

/// Whether a hopper is steep does not depend on the load: by the lower K, as an upper one of 1 leaves none steep.
double ratio_of_hopper(const code::Solid& solid) {
  return solid.ratio / solid.ratio_factor;
}

CodeLoads loads_on_hopper(const SiloShape& shape, const SiloPiece& hopper, double top, double height) {
  const auto above = silo_of_code(shape, top, {hopper.axis.x, hopper.axis.y, hopper.top});
  if (top > hopper.top && !above) return {};
  const continuum::Parameters& p = shape.layout.given;
  const double angle = std::atan(hopper.tangent), mean = hopper.friction, apex = hopper.apex(),
               end = std::min(top, hopper.top) - apex;
  const double own_weight = bulk_density(p) * p.gravity.acceleration;
  const code::Solid solid = solid_of(p);
  const double ratio = ratio_of_hopper(solid);
  const auto stresses = [&](Load load, Limit limit) {
    const double weight = code::weight_for(solid, own_weight, limit);
    Values values = code::values_for(solid, mean, load, limit);
    values.ratio = ratio;
    const granular::ConeBearing bearing =
        load == Load::hopper_filling ? code::hopper_filling(hopper.shape(), angle, values.friction, values.ratio)
                                     : code::hopper_discharge(hopper.shape(), angle, values);
    const double surcharge = above ? above->filling(Load::bottom, limit, hopper.top).vertical : 0;
    const double pressure = bearing.ratio * granular::cone_stress(bearing, weight, height - apex, end, surcharge);
    return code::Stresses{pressure, code::hopper_friction(angle, values.friction, values.ratio) * pressure, 0};
  };
  const code::Stresses filled = stresses(Load::hopper_filling, Limit::upper),
                       flows = stresses(Load::hopper_discharge, Limit::upper);
  CodeLoads loads;
  loads.pressure_filling = filled.pressure, loads.shear_filling = filled.shear;
  loads.pressure_discharge = flows.pressure, loads.shear_discharge = flows.shear;
  loads.pressure_filling_lower = stresses(Load::hopper_filling, Limit::lower).pressure;
  loads.pressure_discharge_lower = stresses(Load::hopper_discharge, Limit::lower).pressure;
  return loads;
}

}  // namespace

CodeLoads code_loads(const SiloShape& shape, const BandOfWall& band, double top, double height) {
  if (!(height < top)) return {};
  const auto on = wall_of(shape, band, height);
  if (!on) return {};
  if (on->piece && on->piece->is_hopper()) return loads_on_hopper(shape, *on->piece, top, height);
  const auto silo = silo_of_code(shape, top, on->place);
  if (!silo) return {};
  return on->piece ? loads_on_upright(*silo, height) : loads_on_floor(*silo, height);
}

CodePatch patch_of_code(const CodeSilo& s) {
  const double depth =
      std::min(code::characteristic_depth(s.silo, s.values(Load::wall_pressure, Limit::upper)), 0.5 * s.silo.height);
  const double filled = (s.silo.is_round ? 1 : code::patch_of_straight_walls) *
                        s.filling(Load::wall_pressure, Limit::upper, s.top - depth).pressure;
  return {.filling = code::patch_of_filling(s.silo, s.solid.patch, 0) * filled,
          .discharge = code::patch_of_discharge(s.silo, s.solid.patch, s.eccentricity) *
                       code::discharge_factors(s.silo).pressure * filled,
          .height = s.top - depth,
          .extent = code::patch_extent(s.silo)};
}

namespace {

/// Each of the upright walls that the bed reaches.
std::vector<CodeSilo> silos_of(const SiloShape& shape, double top) {
  std::vector<CodeSilo> silos;
  for (const SiloPiece& piece : shape.pieces) {
    if (piece.is_hopper() || !(piece.bottom < top)) continue;
    const double height = std::max(piece.bottom, shape.bottom_of(piece, top));
    const auto silo = silo_of_code(shape, top, {piece.axis.x, piece.axis.y, height});
    if (silo && silo->part == piece.parts.front()) silos.push_back(*silo);
  }
  return silos;
}

}  // namespace

void write_design_code(const std::filesystem::path& run_folder, const SiloShape& shape, double top,
                       const std::set<std::size_t>& bare) {
  std::vector<std::vector<double>> rows;
  for (const CodeSilo& s : silos_of(shape, top)) {
    if (bare.contains(s.part)) continue;
    const CodePatch patch = patch_of_code(s);
    const code::DischargeFactors factors = code::discharge_factors(s.silo);
    const Values pressure = s.values(Load::wall_pressure, Limit::upper),
                 shear = s.values(Load::wall_shear, Limit::upper), bottom = s.values(Load::bottom, Limit::upper);
    rows.push_back({static_cast<double>(s.part + 1),
                    s.top,
                    s.silo.height,
                    s.silo.width,
                    s.weight(Limit::upper),
                    s.solid.ratio,
                    s.friction,
                    s.solid.internal / degree,
                    s.solid.repose / degree,
                    pressure.ratio,
                    pressure.friction,
                    pressure.internal / degree,
                    shear.ratio,
                    shear.friction,
                    bottom.ratio,
                    bottom.friction,
                    bottom.internal / degree,
                    factors.pressure,
                    factors.shear,
                    s.solid.patch,
                    s.eccentricity,
                    patch.filling,
                    patch.discharge,
                    patch.height,
                    patch.extent});
  }
  if (rows.empty()) return;
  write_table(run_folder / "analysis" / "en1991.csv",
              {{"patch", "1"},
               {"top", "m"},
               {"h_c", "m"},
               {"d_c", "m"},
               {"unit_weight", "N/m3"},
               {"K_mean", "1"},
               {"mu_mean", "1"},
               {"phi_i_mean", "deg"},
               {"phi_r", "deg"},
               {"K_for_pressure", "1"},
               {"mu_for_pressure", "1"},
               {"phi_i_for_pressure", "deg"},
               {"K_for_shear", "1"},
               {"mu_for_shear", "1"},
               {"K_for_bottom", "1"},
               {"mu_for_bottom", "1"},
               {"phi_i_for_bottom", "deg"},
               {"C_h", "1"},
               {"C_w", "1"},
               {"C_op", "1"},
               {"e_o", "m"},
               {"p_pf", "Pa"},
               {"p_pe", "Pa"},
               {"patch_height", "m"},
               {"patch_extent", "m"}},
              rows);
}

namespace {

const char* name_of_class(const code::Silo& silo) {
  switch (code::class_of(silo)) {
    case code::Class::slender:
      return "slender";
    case code::Class::intermediate:
      return "intermediate";
    case code::Class::squat:
      return "squat";
    case code::Class::retaining:
      return "retaining, as squat";
  }
  return "";
}

const char* side_of(double value, double mean) {
  return value > mean ? "upper" : "lower";
}

/// "K 0.6 (upper), mu 0.33 (lower), phi_i 26.8° (lower)".
std::string values_text(const CodeSilo& s, Load load) {
  const Values taken = s.values(load, Limit::upper), mean = s.values(load, Limit::mean);
  return fmt::format("K {:.3g} ({}), μ {:.3g} ({}), φ_i {:.3g}° ({})", taken.ratio, side_of(taken.ratio, mean.ratio),
                     taken.friction, side_of(taken.friction, mean.friction), taken.internal / degree,
                     side_of(taken.internal, mean.internal));
}

/// Of a hopper: whether it is steep, and the limits of its loads.
Answer answer_of_hopper(const SiloShape& shape, const SiloPiece& hopper) {
  const code::Solid solid = solid_of(shape.layout.given);
  const double angle = std::atan(hopper.tangent), ratio = ratio_of_hopper(solid);
  const auto friction = [&](Load load) {
    return code::values_for(solid, hopper.friction, load, Limit::upper).friction;
  };
  const double filled = friction(Load::hopper_filling), flows = friction(Load::hopper_discharge),
               internal = code::values_for(solid, 0, Load::hopper_discharge, Limit::upper).internal;
  const bool steep = code::is_steep(angle, flows, ratio);
  std::string text = fmt::format("filling by μ {:.3g} ({})", filled, side_of(filled, hopper.friction));
  text += steep ? fmt::format("; discharge by μ {:.3g} ({}), φ_i {:.3g}° ({})", flows, side_of(flows, hopper.friction),
                              internal / degree, side_of(internal, solid.internal))
                : "; discharge as filling";
  if (constexpr double slack = 0.05; steep && std::abs(hopper.shape() - code::conical) > slack)
    text += ", n by the balance of a slice; the code's n is smaller by 2 - S and gives larger pressures";
  return {fmt::format("EN 1991-4 takes, {}", shape.name_of(hopper)),
          fmt::format("{}: half angle {:.3g}°, K {:.3g} (lower)", steep ? "steep" : "shallow", angle / degree, ratio),
          text};
}

}  // namespace

std::vector<Answer> answers_of_code(const SiloShape& shape, const std::filesystem::path& run_folder) {
  const std::filesystem::path path = run_folder / "analysis" / "en1991.csv";
  if (!std::filesystem::exists(path)) return {};
  const Series table = read_series(path);
  std::vector<Answer> answers;
  if (table.rows() == 0) return answers;
  const double top = table.column("top").front();
  for (const SiloPiece& piece : shape.pieces)
    if (piece.is_hopper() && piece.bottom < top) answers.push_back(answer_of_hopper(shape, piece));
  const auto written = table.column("patch");
  for (const CodeSilo& s : silos_of(shape, top)) {
    if (std::find(written.begin(), written.end(), static_cast<double>(s.part + 1)) == written.end()) continue;
    const std::string solid = s.is_listed
                                  ? std::string(choice_name(*shape.layout.given.grains.material)) + ", Table E.1"
                                  : "without values of Table E.1: φ_i of the law in a shear tester";
    answers.push_back(
        {fmt::format("EN 1991-4 takes, {}", s.name),
         fmt::format("{}: h_c/d_c {:.4g}, {:.3g} kN/m³{}", name_of_class(s.silo), s.silo.slenderness(),
                     1e-3 * s.weight(Limit::upper), s.weight(Limit::upper) > s.own_weight ? " (upper)" : " of the bed"),
         fmt::format("{}; wall pressure by {}; floor and cone's top by C_b 1, {}", solid,
                     values_text(s, Load::wall_pressure), values_text(s, Load::bottom))});
    const CodePatch patch = patch_of_code(s);
    if (patch.filling > 0 || patch.discharge > 0)
      answers.push_back(
          {fmt::format("Patch load, {}", s.name),
           s.silo.is_round ? "a local load that EN 1991-4 adds" : "on all sides over that height, which EN 1991-4 adds",
           fmt::format("EN 1991-4: {} filling, {} discharge, upper values, at z = {} over {} of height",
                       pressure_text(patch.filling), pressure_text(patch.discharge), length_text(patch.height),
                       length_text(patch.extent))});
    if (!s.has_channel()) continue;
    const CodeLoads lowest = loads_on_upright(s, s.bottom);
    answers.push_back(
        {fmt::format("Flow channel, {}", s.name),
         fmt::format("outlet off the axis by {:.2g} d_c, above {:.2g}", s.eccentricity / s.silo.width,
                     code::large_eccentricity),
         fmt::format("EN 1991-4: {} at least in it, {} at most beside it, at z = {}", pressure_text(lowest.in_channel),
                     pressure_text(lowest.beside_channel), length_text(s.bottom))});
  }
  return answers;
}

}  // namespace talus::app
