// SPDX-License-Identifier: Apache-2.0
/// The constitutive law of a case, applied to all particles: the one place where the choice of the law is met.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "models/continuum/state.hpp"
#include "physics/granular/collisional_stress.hpp"
#include "physics/granular/law.hpp"

namespace talus::continuum {

class Material {
 public:
  explicit Material(const Parameters& parameters);

  /// What the law with its parameters remembers of each particle.
  const std::vector<granular::HistorySlot>& slots() const { return slots_; }

  /// Whether the law takes the strain from displacements (displacement.hpp) in place of its rate.
  bool by_displacements() const;

  /// What the law was made for.
  granular::LawRange range() const;

  /// Upper bound of the speed of pressure waves, m/s.
  double sound_speed(double density) const;

  /// Applies the law to every particle over a time step, from `old` to `next`, which may be the same.
  /// \param velocity_gradient 1/s; \param measured_strain at the end of the step, one per particle if
  /// by_displacements(),
  ///        else empty; \param density at the end of the step, kg/m^3; \param keep_history false: only the stress of
  ///        `next` is written, for a stage within a step
  void update(ThreadTeam& team, const MaterialColumns& old, const GradientColumns& velocity_gradient,
              std::span<const SymmetricTensor3<>> measured_strain, std::span<const double> density, double time_step,
              MaterialColumns& next, bool keep_history) const;

  /// How often the law has reset the strain of each particle. \pre by_displacements()
  std::span<const double> resets(const MaterialColumns& columns) const { return columns.history[*resets_slot_]; }

  /// Norm of the strain that the law remembers of a particle; 0 if it remembers none.
  double strain(const MaterialColumns& columns, std::size_t particle) const;

  /// Turns what the law knows of a particle as a mirror does.
  void mirror(MaterialColumns& columns, std::size_t particle, const Image& image) const;

 private:
  granular::AnyLaw law_;
  std::vector<granular::HistorySlot> slots_;
  std::vector<std::size_t> used_slots_;  // their places in the law's history
  std::optional<std::size_t> first_strain_slot_, resets_slot_;
  std::optional<granular::CollisionParameters> collisions_;
  double fall_time_ = 0;  // (D_p/g)^(1/2), s
};

inline SymmetricTensor3<> tensor_at(const std::array<std::vector<double>, 6>& s, std::size_t i) {
  return {s[0][i], s[1][i], s[2][i], s[3][i], s[4][i], s[5][i]};
}

inline void set_tensor(std::array<std::vector<double>, 6>& s, std::size_t i, const SymmetricTensor3<>& t) {
  s[0][i] = t.xx, s[1][i] = t.yy, s[2][i] = t.zz, s[3][i] = t.xy, s[4][i] = t.yz, s[5][i] = t.zx;
}

/// The whole stress of a particle, Eq. 7: the law's and that by collisions, Pa.
inline SymmetricTensor3<> stress_of(const MaterialColumns& columns, std::size_t i) {
  const SymmetricTensor3<> stress = tensor_at(columns.stress, i);
  return columns.collisional[0].empty() ? stress : stress + tensor_at(columns.collisional, i);
}

}  // namespace talus::continuum
