// SPDX-License-Identifier: Apache-2.0
/// A run of grains in a vessel: a box, with a plate or the walls of a wedge above whose outlet they begin, or without.
/// What is below the outlet is called the bin, what is above it the hopper; a box without an outlet is a bin alone. x
/// across, z up from the bin's floor.
#pragma once

#include <array>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/free_surface.hpp"
#include "analysis/granular_state.hpp"
#include "analysis/measure.hpp"
#include "analysis/wall_loads.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/geometry/gate_times.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// The two vessels, one above the other; without an outlet between them the box alone, as a bin.
struct HopperShape {
  double width = 0, depth = 0, height = 0;  ///< of the box, from 0, m
  struct Outlet {
    double height = 0;           ///< between the vessels, m
    double left = 0, right = 0;  ///< its ends along x, m
  };
  std::optional<Outlet> outlet = {};
  double spacing = 0;  ///< h, of the particles at the start, m

  double middle() const { return 0.5 * width; }
  Vessel bin() const;
  /// \throws std::bad_optional_access without an outlet
  Vessel hopper() const;
};

/// Free surfaces at one time; the surface of the hopper has no heights if there is no outlet.
struct HopperSurfaces {
  FreeSurface bin, hopper;
};
HopperSurfaces hopper_surfaces(const Section& packing, const HopperShape& shape);

/// The particles deeper than 3 h below the free surface of their vessel, and not within 3 h of the slit's opening in z.
std::vector<bool> deep_particles(std::span<const Vector3> position, const HopperSurfaces& surfaces,
                                 const HopperShape& shape);

/// Mean of a column over the particles with from < z < to; nan if there are none.
double mean_between(std::span<const Vector3> position, std::span<const double> values, double from, double to);

/// The particles at or above the plate; without one, above the floor.
std::vector<bool> above_outlet(std::span<const Vector3> position, const HopperShape& shape);

/// One of several outlets of a vessel.
struct OutletSetting {
  std::string name;
  double hand_discharge = 0;  ///< by an analytical estimate, kg/s; 0: none
  double across = 0;          ///< its narrower side, m
  std::optional<GateTimes> gate = {};
};

/// What the case says. SI.
struct HopperSetting {
  HopperShape shape;
  Domain domain;             ///< as at the start: the gate shut; of a sector the whole
  Domain computed = domain;  ///< with its sector
  double particle_mass = 0;  ///< kg
  double particles = 0;      ///< at the start
  double grain_density = 0, grain_diameter = 0, gravity = 0;
  double tilt = 0;                              ///< of what is level against the floor, rising along x, rad
  std::optional<double> smoothing_length = {};  ///< of all particles; left out: of each from its density
  bool air = false;
  bool has_floor = true;     ///< what falls out of the outlet stays in the bin
  bool level_ground = true;  ///< the bed rests on the floor, or on a horizontal plate from wall to wall
  /// The walls of a vessel in space, where the plane through its middle meets them, m; empty: what is seen from the
  /// side is all there is.
  std::vector<std::array<Vector3, 2>> section = {};
  double middle = 0;                        ///< y of that plane, m
  double outlet_length = 0;                 ///< of an outlet that is not round, its longer side, m; 0: round, or none
  std::vector<BandOfWall> bands = {};       ///< of the vessel's walls
  double hand_discharge = 0;                ///< by an analytical estimate, kg/s; 0: none for this outlet
  double hand_emptying_time = no_value;     ///< by it, while the gates are open, s; nan: none, or never
  std::vector<OutletSetting> outlets = {};  ///< where there are several
  double mass_flow_half_angle = no_value;   ///< by an analytical estimate, rad; nan: none
  double averaging_time = 20e-3;            ///< T, of rates, loads and speeds; peaks are averages over half of it, s
  double time_scale = 64e-3;                ///< (D/g)^½ of the outlet's width D, without one of the bed's height, s
  double outlet_width = 0;                  ///< D, its narrower side or diameter; 0: no outlet, m
  double outlet_depth = 0;                  ///< along y, m
  bool outlet_is_round = false;
  double bed_packing = 0.6;  ///< at the start
  double stress_share = 1;   ///< of the stress, that moves grains and loads walls: 1 - Phi in Eq. 17 as printed

  double mass() const { return particles * particle_mass; }
};

/// One snapshot of a run, and what several measures need of it, made when it is first asked for.
class HopperSnapshot {
 public:
  /// \param now with the columns position, velocity, density, packing, shear_rate, stress_xx, stress_yy, stress_zz
  /// \param gate_time when the gate opened, in the run's time, s
  HopperSnapshot(const HopperSetting& of, Snapshot particles, double gate_time)
      : setting(of), now(std::move(particles)), time(now.time - gate_time) {}

  const HopperSetting& setting;
  const Snapshot now;
  const double time;  ///< from the opening of the gate, s
  /// An earlier snapshot, about T before, over which speeds are means; null if there is none. Not set: none.
  std::function<const Snapshot*()> before = {};

  const HopperShape& shape() const { return setting.shape; }
  const Section& packing_section() const;  ///< cells of h by h/2
  const HopperSurfaces& surfaces() const;
  const std::vector<bool>& deep() const;                     ///< deep_particles()
  const std::vector<double>& inertial() const;               ///< inertial_numbers()
  const std::vector<Tensor3<>>& velocity_gradients() const;  ///< of each particle, 1/s
  const GradientSizes& gradient_sizes() const;

 private:
  Domain domain() const;
  Particles particles() const;

  mutable std::optional<Section> packing_section_;
  mutable std::optional<HopperSurfaces> surfaces_;
  mutable std::optional<std::vector<bool>> deep_;
  mutable std::optional<std::vector<double>> inertial_;
  mutable std::optional<std::vector<Tensor3<>>> velocity_gradients_;
  mutable std::optional<GradientSizes> gradient_sizes_;
};

struct HopperRun {
  using Snapshot = HopperSnapshot;
  using Numbers = SnapshotNumbers<HopperSnapshot>;

  HopperSetting setting;
  /// In the run's time: the columns of app/continuum/hopper_observers.hpp and the model's impulses.
  Series series;
  double gate_time = 0;    ///< in the run's time, s; its end if the gate never opened
  Numbers snapshots = {};  ///< against the time from the opening of the gate

  double end() const;  ///< from the opening of the gate, s
  /// Whether the run went on to that time, but for a few steps: it ends with the step that reaches its end.
  bool reaches(double time) const { return end() >= time - 0.05 * setting.averaging_time; }
  /// A column of the series against the time from the gate's opening; without points if there is none.
  Curve curve(std::string_view column) const;
  /// A number of the snapshots from the gate's opening on; those without one are left out.
  Curve curve(Numbers::Number number) const;
};

/// When the gate opened: the column gate_time of a series is below 0 until then. The series' last time if it never did.
double gate_time_of(const Series& series);

/// Every measure of one run, each once. Definitions in full: validation/yuu2011/reference.toml. A number that a run
/// does not have, or a window that it does not cover, is nan.
std::span<const Measure<HopperRun>> hopper_measures();
/// Mass of the particles below the outlet, and of those that were taken away, against the time from the gate's opening,
/// kg. Without points if the series lacks the column.
Curve discharged_mass(const HopperRun& run);
/// The same over the mass of all particles at the start and of those that have come in since.
Curve discharged_share(const HopperRun& run);
/// Integral of the discharge Q, kg: of particles spread along z by the kernel. Of this all rates are made: counted
/// whole, the particles' layers would pass one by one, with a period h/u of their own.
Curve passed_mass(const HopperRun& run);

/// Of each of several outlets the mass that passed it, the mean rate in a steady stretch of the whole discharge, its
/// analytical estimate, and how many particles and grains its narrower side is across; rates of a stretch that is not a
/// number are left out. \param from, to of the stretch, from the opening of the gate, s
std::vector<NamedValue> outlet_quantities(const HopperRun& run, double from, double to);

}  // namespace talus
