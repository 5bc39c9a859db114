// SPDX-License-Identifier: Apache-2.0
/// The density at which grains touch, as they remember it.
///
///     e_v = ln(rho_b/rho_ref)/3 + d,   d >= 0,   d' >= -ln(rho_b/rho_ref)/3,   dd/dgamma = -k d while e_v > 0
///
/// Grains that come apart and are pressed again carry pressure from where they last touched, not first at the reference
/// packing: the dilation d grows with the expansion beyond e_v = 0. It is the paper's rule, "at the end of the
/// unloading process, the point x_i was set to the initial point X_i", for the volume, with two bounds. Below the
/// gate's packing there is no contact to remember; and shear packs loose grains again, at the rate k per shear strain
/// gamma. Source: Yuu & Umekage 2011, section 2.1; relaxation to a critical packing under shear as in Roux & Radjai,
/// Physics of Dry Granular Media (1998), with the reference packing for the critical one. completed: k and the bounds.
/// Tied to the density, the volume cannot drift from the packing, as that of a strain does which is integrated and
/// reset.
#pragma once

#include <cstdint>

#include "base/parameter.hpp"
#include "base/tensor.hpp"
#include "physics/granular/equation_of_state.hpp"
#include "physics/granular/law_readings.hpp"

namespace talus::granular {

/// Where grains touch and where they lose contact: the keys that the fitted laws have in common.
struct Contact {
  double reference_packing = 0.6;  ///< rho_ref/rho_p, at which grains at rest just touch
  Volume volume = Volume::density;
  double compaction = 3;         ///< k, per shear strain, by which shear makes grains forget that they came apart
  double gate_packing = 0.5;     ///< packing below which contacts are lost
  std::int64_t gate_power = 96;  ///< of the factor by which stress then vanishes
};

template <class Visit, class C>
void for_each_contact_parameter(Visit&& visit, C& contact) {
  visit(Parameter{"reference_packing", dimension::none, between(0.1, 0.74),
                  "packing at which grains at rest just touch; denser, they bear pressure"},
        contact.reference_packing);
  visit(Parameter{"volume",
                  {},
                  {},
                  "measure of the volumetric strain: the density over that of the reference packing, the density over "
                  "that at which the grains last touched, or the strain since the last reset"},
        contact.volume);
  auto remembered = only_if(where("volume", contact.volume, Volume::contact), visit);
  remembered(
      Parameter{"compaction", dimension::none, at_least(0),
                "volume by contact: rate at which shear compacts dilated grains again, per unit of shear strain"},
      contact.compaction);
  visit(Parameter{"gate_packing", dimension::none, between(0, 0.74),
                  "packing below which grains lose contact and stress vanishes by a power of the packing"},
        contact.gate_packing);
  visit(Parameter{"gate_power", dimension::none, between(0, 1e6), "that power; 96 in the paper"}, contact.gate_power);
}

class ContactMemory {
 public:
  explicit ContactMemory(const Contact& contact)
      : remembers_(contact.volume == Volume::contact),
        max_dilation_(maximum(volumetric_strain(contact.reference_packing, contact.gate_packing), 0.0)),
        compaction_(contact.compaction) {}

  /// d at the end of a step; 0 if nothing is remembered.
  /// \param old d at its start; \param by_density ln(rho_b/rho_ref)/3 at its end; \param velocity_gradient 1/s
  template <class Number>
  Number dilation(const Number& old, const Number& by_density, const Tensor3<Number>& velocity_gradient,
                  double time_step) const {
    if (!remembers_) return 0.0;
    const Number apart = minimum(maximum(old, -1.0 * by_density), Number(max_dilation_));
    const Number sheared = (sqrt2 * time_step) * norm(deviator(symmetric_part(velocity_gradient)));
    return select(by_density + apart > Number(0.0), apart / (1.0 + compaction_ * sheared), apart);
  }

 private:
  static constexpr double sqrt2 = 1.4142135623730951;

  bool remembers_;
  double max_dilation_;
  double compaction_;
};

}  // namespace talus::granular
