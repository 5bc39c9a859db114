// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/workspace.hpp"

#include <algorithm>
#include <cmath>

#include "models/continuum/population.hpp"
#include "models/continuum/sector.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr std::uint64_t builds_between_sorts = 16;
constexpr double passages_that_last = 20;  // of the fastest wave over a spacing: jitter is quicker, flow far slower
constexpr double edge_of_drawn_field = 3;  // in spacings

}  // namespace

Workspace::Workspace(const Setup& setup, const State& state)
    : boundary(*setup.boundary),
      material(setup.material),
      contact_distance(sph::contact_distance * sph::smoothing_length(state.mass, setup.density)),
      lasting_time(passages_that_last * setup.given.bed.spacing / setup.sound_speed),
      load_fields(continuum::load_fields(setup)),
      load_bands(continuum::load_bands(setup.given, load_fields)),
      load_mesh(mesh_of(boundary.vessel(), load_fields, edge_of_drawn_field * setup.given.bed.spacing)),
      pairs(setup, boundary.domain(), boundary.vessel(), &load_fields),
      air(setup.given.air.enabled ? std::make_unique<Atmosphere>(setup.given, boundary) : nullptr),
      position(state.position.size()),
      smoothing_length(state.position.size()) {
  const Parameters& parameters = setup.given;
  for (const Inlet& inlet : parameters.inlets) inlets.push_back(layer_of(setup, inlet));
  if (parameters.integration.method != Method::runge_kutta) return;
  velocity.resize(state.position.size());
  density.resize(state.position.size());
  midpoint_smoothing_length.resize(state.position.size());
  columns = state.material;
}

void update_smoothing_lengths(ThreadTeam& team, const State& s, Workspace& w) {
  w.pairs.find_smoothing_lengths(team, s.density, w.smoothing_length);
}

void set_list_reference(const Parameters& p, State& s, const Workspace& w) {
  constexpr double steps = 20;
  const double most = 0.5 * w.pairs.skin();
  s.list_position = s.position;
  s.list_smoothing_length = w.smoothing_length;
  s.list_margin.resize(s.position.size());
  for (std::size_t i = 0; i < s.position.size(); ++i)
    s.list_margin[i] = std::clamp(steps * s.last_step * norm(s.velocity[i]), p.integration.skin_at_rest * most, most);
}

void find_neighbours(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  return_to_sector(w.boundary.domain(), w.material, s);
  if (s.list_builds % builds_between_sorts == 0) {
    sort_for_locality(s, sph::support * p.bed.spacing);
    update_smoothing_lengths(team, s, w);
  }
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3 wrapped = w.boundary.domain().wrap(s.position[i]);
    if (!s.reset_position.empty()) s.reset_position[i] += wrapped - s.position[i];
    s.position[i] = wrapped;
  }
  set_list_reference(p, s, w);
  ++s.list_builds;
  w.pairs.find_neighbours(team, s.list_position, s.list_smoothing_length, s.list_margin);
}

void evaluate(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  w.pairs(team, {s.position, s.velocity, s.density, w.smoothing_length, s.material, s.deformation_rate},
          p.integration.method == Method::runge_kutta ? PairTerms::all : PairTerms::forces, w.rates);
  s.packing.resize(s.position.size());
  s.strain.resize(s.position.size());
  for_each(team, s.position.size(), [&](std::size_t i) {
    s.packing[i] = w.rates.kernel_density[i] / p.grains.density;
    s.strain[i] = w.material.strain(s.material, i);
  });
}

void keep_deformation_rate(ThreadTeam& team, State& s, const Workspace& w) {
  if (s.deformation_rate[0].empty()) return;
  for_each(team, s.position.size(),
           [&](std::size_t i) { set_tensor(s.deformation_rate, i, symmetric_part(w.rates.velocity_gradient[i])); });
}

void measure_shear_rate(ThreadTeam& team, State& s, const Workspace& w) {
  s.shear_rate.resize(s.position.size());
  const double share = s.last_step / (s.last_step + w.lasting_time);
  for_each(team, s.position.size(), [&](std::size_t i) {
    const SymmetricTensor3<> rate = deviator(symmetric_part(w.rates.velocity_gradient[i]));
    s.shear_rate[i] = shear_of(rate);
    if (s.lasting_rate[0].empty()) return;
    const SymmetricTensor3<> before = tensor_at(s.lasting_rate, i);
    set_tensor(s.lasting_rate, i, before + share * (rate - before));
  });
}

}  // namespace talus::continuum
