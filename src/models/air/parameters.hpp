// SPDX-License-Identifier: Apache-2.0
/// What the air of a case is: an incompressible gas between grains (Yuu & Umekage 2011, Eqs 18-21). SI; the initial
/// values are the defaults.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "numerics/grid/face_apertures.hpp"
#include "numerics/run_record.hpp"
#include "physics/air/gas.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

/// What has no divergence.
enum class Continuity {
  mixture,   ///< Phi u + (1-Phi) u_p: Eq. 19 and the grains' own continuity; grains that leave a vessel change places
             ///< with air
  air_alone  ///< Phi u: Eq. 19 without the change of Phi with time; air need not make room for grains
};

/// Whom the gradient of the air's pressure moves.
enum class Formulation {
  model_a,  ///< air and grains, each by its share of the volume: Eqs 17 and 18 as printed
  model_b   ///< the air; the grains feel the drag of Eq. 20 and nothing else
};

/// Whether the air makes room by a change of its density.
enum class Compressibility {
  none,       ///< Eq. 19: one density everywhere, always
  isothermal  ///< an ideal gas at one temperature: a closed volume that grows loses pressure, P V = const
};

enum class Motion {
  flowing,  ///< Eqs 18 and 19
  frozen    ///< at rest and everywhere at one pressure: it only drags
};

struct Parameters {
  double pressure = 101325;     ///< of the surroundings, Pa
  double temperature = 293.15;  ///< K; not a key
  double viscosity = 1.82e-5;   ///< Pa s
  Motion motion = Motion::flowing;
  Continuity continuity = Continuity::mixture;
  Formulation formulation = Formulation::model_a;
  Compressibility compressibility = Compressibility::none;
  coupling::DragLaw drag = coupling::DragLaw::schiller_naumann_umekage_yuu;
  double grain_diameter = 200e-6;  ///< m
  double grain_density = 2500;     ///< kg/m^3
  double upwind = 0.25;      ///< upstream weight of convection: 0 the printed central scheme, 1 third-order upstream
  double courant = 0.5;      ///< most that the air moves in a step, cells
  double response = 0.1;     ///< most of the time step over the time in which the pressure stops the grains' dilation
  double max_step = 100e-6;  ///< s
  double tolerance = 1e-6;   ///< of the pressure equation, relative
  std::int64_t max_iterations = 200;
  /// A vessel: walls left, right and below, planes of symmetry before and behind, open above.
  FlowBoundaries boundaries{.kind = {FlowBoundary::no_slip, FlowBoundary::no_slip, FlowBoundary::free_slip,
                                     FlowBoundary::free_slip, FlowBoundary::no_slip, FlowBoundary::open},
                            .pressure = {},
                            .wall_velocity = {}};
  std::array<std::array<double, 3>, 6> wall_velocity{};  ///< of walls and of what comes in, by face_number, m/s
  std::optional<std::array<double, 3>> inflow_low, inflow_high;

  double density() const { return air::density(pressure, temperature); }
  coupling::DragMedium medium() const {
    return {.density = density(),
            .viscosity = viscosity,
            .diameter = grain_diameter,
            .slip_factor = slip_factor(mean_free_path(viscosity, pressure, temperature), grain_diameter)};
  }
};

/// Walls that move across themselves, faces that move and are no walls, inflow that does not come in or cannot leave.
std::vector<Problem> check(const Parameters& parameters);
/// The inflows none of whose cells air.inflow_low and inflow_high hold: no air would come in.
std::vector<Problem> check_inflows(const Parameters& parameters, const Grid& grid);
/// Whether air comes in at a face of the box through a cell beside it.
bool comes_in_at(const Parameters& parameters, const Grid& grid, std::size_t face, const std::array<int, 3>& cell);
/// Ranges that walls which face each other and inflows keep to, or not.
std::vector<RegimeLine> regime_of_faces(const Parameters& parameters, const Grid& grid);

/// Cells a step. A steady jet overshoots its velocity by nothing at 0.5, 4 % at 0.7, up to 15 % at 0.9; beyond 1.5 the
/// explicit convection is unstable.
inline constexpr double max_courant = 0.7;

inline constexpr RenamedKey renamed_keys[] = {
    {"air.longest_step", "air.max_step"},
    {"air.most_iterations", "air.max_iterations"},
};

/// The keys of any flow of air, once. \param flowing visits those that mean something only where the air flows
template <class Visit, class Flowing, class P>
void for_each_parameter_of_flow(Visit&& visit, Flowing&& flowing, P& p) {
  visit(Parameter{"air.pressure", dimension::pressure, above(0),
                  "pressure of the surroundings; density (dry air at 20 degrees C) and slip factor of the drag follow"},
        p.pressure);
  visit(Parameter{"air.viscosity", dimension::viscosity, above(0), "viscosity of the air"}, p.viscosity);
  visit(Parameter{"air.left",
                  {},
                  {},
                  "boundary condition of the air at the left face, independent of that of the grains: a no-slip wall, "
                  "a plane of symmetry (or a slip wall), periodic (with its opposite), open at a given pressure, or "
                  "inflow: a wall through which air comes in at a given velocity, from the opening of the gate on"},
        p.boundaries.kind[0]);
  visit(Parameter{"air.right", {}, {}, "the right face"}, p.boundaries.kind[1]);
  visit(Parameter{"air.front", {}, {}, "the front face"}, p.boundaries.kind[2]);
  visit(Parameter{"air.rear", {}, {}, "the rear face"}, p.boundaries.kind[3]);
  visit(Parameter{"air.floor", {}, {}, "the floor"}, p.boundaries.kind[4]);
  visit(Parameter{"air.top", {}, {}, "the top"}, p.boundaries.kind[5]);
  constexpr struct {
    const char *face, *pressure, *velocity;
  } faces[6] = {{"left", "pressure beyond the left face if it is open, relative to air.pressure",
                 "velocity along x, y and z of the left face if it is a wall that moves tangentially, or of the air "
                 "that comes in there: volume flow over area, as if there were no grains"},
                {"right", "beyond the right face", "of the right face"},
                {"front", "beyond the front face", "of the front face"},
                {"rear", "beyond the rear face", "of the rear face"},
                {"floor", "below the floor", "of the floor"},
                {"top", "above the top", "of the top"}};
  for (std::size_t k = 0; k < 6; ++k) {
    const std::string key = std::string("air.") + faces[k].face;
    auto open = only_if(where(key, p.boundaries.kind[k], FlowBoundary::open), visit);
    open(Parameter{key + "_pressure", dimension::pressure, any(), faces[k].pressure}, p.boundaries.pressure[k]);
    visit(Parameter{key + "_velocity", dimension::velocity, any(), faces[k].velocity}, p.wall_velocity[k]);
  }
  const bool comes_in = std::any_of(p.boundaries.kind.begin(), p.boundaries.kind.end(),
                                    [](FlowBoundary kind) { return kind == FlowBoundary::inflow; });
  auto inflow =
      only_if({"air.floor", "is no inflow, nor is another face", "or another face \"inflow\"", comes_in}, visit);
  inflow(Parameter{"air.inflow_low",
                   dimension::length,
                   {},
                   "lower corner of a box: air comes in through what of the inflow's faces lies in it, the rest are "
                   "walls; left out: through all of them"},
         p.inflow_low);
  inflow(Parameter{"air.inflow_high", dimension::length, {}, "its upper corner"}, p.inflow_high);
  flowing(Parameter{"air.upwind", dimension::none, between(0, 1),
                    "upwind weight of the convection of the air: 0 the printed fourth-order central scheme, 1 the "
                    "third-order upwind-biased one"},
          p.upwind);
  visit(Parameter{"air.courant", dimension::none, between(1e-6, max_courant),
                  "largest number of cells that the air may move in one of its steps"},
        p.courant);
  visit(Parameter{"air.max_step", dimension::time, above(0), "upper limit of the step of the air"}, p.max_step);
  flowing(Parameter{"air.tolerance", dimension::none, between(1e-12, 0.1),
                    "residual of the pressure equation over its source at which the iteration stops"},
          p.tolerance);
  flowing(Parameter{"air.max_iterations", dimension::none, at_least(1),
                    "iterations after which a pressure that has not converged ends the run"},
          p.max_iterations);
}

/// Every key of the air among grains, once; keys of a grain belong to the grains.
template <class Visit, class P>
void for_each_parameter(Visit&& visit, P& p) {
  visit(Parameter{"air.motion", {}, {}, "flowing, or frozen: at rest at uniform pressure, so that it only exerts drag"},
        p.motion);
  auto flowing = only_if(where("air.motion", p.motion, Motion::flowing), visit);
  flowing(Parameter{"air.continuity",
                    {},
                    {},
                    "which volume flow is divergence-free: that of air and grains together (Eq. 19), or that of the "
                    "air alone, as if the void fraction did not change with time"},
          p.continuity);
  flowing(Parameter{"air.formulation",
                    {},
                    {},
                    "what the pressure gradient acts on: air and grains by their volume fractions (model A, Eqs 17 and "
                    "18), or the air alone, so that the drag is the only force on the grains (model B)"},
          p.formulation);
  flowing(Parameter{"air.compressibility",
                    {},
                    {},
                    "none: the density of the air is constant, which is valid while pressures differ by less than a "
                    "tenth of air.pressure; or isothermal, for thin air in closed vessels: an ideal gas"},
          p.compressibility);
  visit(Parameter{"air.drag",
                  {},
                  {},
                  "law of the drag: Schiller and Naumann's with Umekage and Yuu's factor (Eqs 20-21), or Gidaspow's of "
                  "Ergun, Wen and Yu"},
        p.drag);
  visit(Parameter{"air.response", dimension::none, above(0),
                  "longest step of the air over the time in which the pressure it causes stops a dilating bed"},
        p.response);
  for_each_parameter_of_flow(visit, flowing, p);
}

}  // namespace talus::air

namespace talus {
template <>
inline constexpr auto choices<air::Motion> = std::to_array<std::string_view>({"flowing", "frozen"});
template <>
inline constexpr auto choices<air::Continuity> = std::to_array<std::string_view>({"mixture", "air-alone"});
template <>
inline constexpr auto choices<air::Formulation> = std::to_array<std::string_view>({"model-a", "model-b"});
template <>
inline constexpr auto choices<air::Compressibility> = std::to_array<std::string_view>({"none", "isothermal"});
template <>
inline constexpr auto choices<coupling::DragLaw> = std::to_array<std::string_view>({"schiller-naumann+umekage-yuu",
                                                                                    "ergun-wen-yu"});
template <>
inline constexpr auto choices<FlowBoundary> = std::to_array<std::string_view>({"wall", "symmetry", "periodic", "open",
                                                                               "inflow"});
}  // namespace talus
