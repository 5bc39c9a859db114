// SPDX-License-Identifier: Apache-2.0
/// The boundary of a case: the faces of the box, the plates and the parts of the vessel, each a patch with its name,
/// friction, gate and motion.
///
/// Patches act on particles in three ways. Faces and plates act by mirror images and periodic copies (Domain), the
/// vessel by integrals of the kernel over what lies behind its surface (vessel_walls.hpp). Friction, contact, loads and
/// gates are the same for all of them.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/vector.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/geometry/gate_times.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::continuum {

struct Parameters;

inline constexpr std::array<const char*, 6> face_names = {"left", "right", "front", "rear", "floor", "top"};

/// The motion of a wall's surface while the wall stays in place: a body of revolution that turns about its own axis, a
/// tube that slides along it, a belt.
struct WallMotion {
  Vector3 velocity;          ///< m/s
  Vector3 angular_velocity;  ///< rad/s
  Vector3 centre;            ///< a point of the axis, m

  Vector3 at(const Vector3& x) const { return velocity + cross(angular_velocity, x - centre); }
};

struct Patch {
  std::string name;
  double friction = 0;               ///< coefficient of Coulomb's friction
  double adhesion = 0;               ///< shear stress that it bears besides, Pa
  std::optional<GateTimes> gate;     ///< of one that is taken away
  std::optional<WallMotion> motion;  ///< from the opening of the gate of the case on

  bool is_away(double time) const { return gate && gate->is_away(time); }
};

class Boundary {
 public:
  /// All gates shut. \pre check_vessel() finds nothing
  explicit Boundary(const Parameters& parameters);

  /// By number: the six faces, the plates, the parts of the vessel.
  std::span<const Patch> patches() const { return patches_; }
  /// Whether a patch carries load: open and periodic faces do not.
  bool bears_load(std::size_t patch) const {
    return patch >= first_of_vessel() || domain_.bears_load(static_cast<int>(patch));
  }
  /// Number of the patch of a part of the vessel.
  std::size_t patch_of_part(std::size_t part) const { return first_of_vessel() + part; }

  const Domain& domain() const { return domain_; }
  const Surface& vessel() const { return vessel_; }  ///< patch n of the surface is part n of the vessel

  /// Whether a gate is to open or to close. \param time from the opening of the gate of the case, s
  bool has_gates_due(double time) const { return domain_.has_gates_due(time) || vessel_has_gates_due(time); }
  bool vessel_has_gates_due(double time) const;
  /// Opens and closes them.
  void move_gates(double time);
  /// Those that close later too.
  void open_all_gates();
  /// How many gates are open.
  int openings() const;
  /// Since when gates that were open are all shut again, the same; nothing if one is open, or none has closed.
  std::optional<double> shut_since(double time) const;

 private:
  std::size_t first_of_vessel() const { return static_cast<std::size_t>(domain_.wall_count()); }

  Domain domain_;
  Surface vessel_;
  std::vector<Patch> patches_;
};

}  // namespace talus::continuum
