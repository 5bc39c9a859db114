// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/workspace.hpp"

#include <algorithm>
#include <cmath>

#include "models/continuum/population.hpp"
#include "models/continuum/sector.hpp"
#include "models/continuum/splitting.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_contact.hpp"

namespace talus::continuum {

namespace {

constexpr std::uint64_t builds_between_sorts = 16;
constexpr double passages_that_last = 20;  // of the fastest wave over a spacing: jitter is quicker, flow far slower

}  // namespace

Workspace::Workspace(const Setup& setup, const State& state, const Ranks& ranks)
    : share(ranks),
      boundary(*setup.boundary),
      material(setup.material),
      levels(setup),
      contact_distance(sph::contact_distance * sph::smoothing_length(state.mass, setup.density)),
      lasting_time(passages_that_last * setup.given.bed.spacing / setup.sound_speed),
      load_fields(continuum::load_fields(setup)),
      load_bands(continuum::load_bands(setup.given, load_fields)),
      pairs(setup, boundary.domain(), boundary.vessel(), &load_fields),
      air(setup.given.air.enabled ? std::make_unique<Atmosphere>(setup.given, levels, boundary, share) : nullptr),
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
  w.pairs.find_smoothing_lengths(team, s.density, s.mass_ratio, w.smoothing_length);
}

void set_list_reference(const Parameters& p, State& s, const Workspace& w) {
  const double most = 0.5 * w.pairs.skin();
  s.list_position = s.position;
  s.list_smoothing_length = w.smoothing_length;
  s.list_margin.resize(s.position.size());
  for (std::size_t i = 0; i < s.position.size(); ++i)
    s.list_margin[i] =
        std::clamp(steps_of_margin * s.last_step * norm(s.velocity[i]), p.integration.skin_at_rest * most, most);
}

void drop_halo(const Parameters& p, State& s, Workspace& w) {
  w.share.keep_owned(w.smoothing_length);
  if (w.share.drop_halo(s)) fit(p, s, w);
}

void build_lists(ThreadTeam& team, const Parameters& p, State& s, Workspace& w,
                 std::vector<std::vector<double>*> carried) {
  if (!w.share.is_all()) {
    carried.push_back(&w.smoothing_length);
    w.share.distribute(s, w.boundary.domain(), carried);
    fit(p, s, w);
  }
  w.pairs.find_neighbours(team, s.list_position, s.list_smoothing_length, s.list_margin, s.mass_ratio, w.share.part());
  w.share.weigh(w.pairs.neighbourhood().pairs());
}

void find_neighbours(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  drop_halo(p, s, w);
  return_to_sector(w.boundary.domain(), w.material, s);
  if (s.has.mass_ratio) {
    split_and_merge(w.levels, w.boundary, p, w.share, s);
    return_to_sector(w.boundary.domain(), w.material, s);
    fit(p, s, w);
    update_smoothing_lengths(team, s, w);
  }
  if (s.list_builds % builds_between_sorts == 0) {
    sort_for_locality(s, w.share, sph::support * p.bed.spacing);
    update_smoothing_lengths(team, s, w);
  }
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const Vector3 wrapped = w.boundary.domain().wrap(s.position[i]);
    if (!s.reset_position.empty()) s.reset_position[i] += wrapped - s.position[i];
    s.position[i] = wrapped;
  }
  set_list_reference(p, s, w);
  ++s.list_builds;
  build_lists(team, p, s, w);
}

void refresh_halo(Workspace& w, const SummedColumns& c) {
  if (w.share.is_all()) return;
  std::vector<Halo::Column> columns{Halo::column(std::span(c.position)), Halo::column(std::span(c.velocity)),
                                    Halo::column(std::span(c.density)), Halo::column(std::span(c.smoothing_length))};
  for (auto* const tensor : {&c.material.stress, &c.material.collisional})
    for (std::vector<double>& component : *tensor)
      if (!component.empty()) columns.push_back(Halo::column(std::span(component)));
  w.share.refresh(columns);
}

void evaluate(ThreadTeam& team, const Parameters& p, State& s, Workspace& w) {
  const SummedColumns columns{s.position, s.velocity, s.density, w.smoothing_length, s.material, s.mass_ratio};
  refresh_halo(w, columns);
  // The forces at the moment of the opening are still those of the settled bed, in a resumed run too.
  const bool flows = s.gate_time >= 0 && s.time > s.gate_time;
  w.pairs.set_viscosity(flows ? p.sph.viscosity_alpha : p.settle.viscosity_alpha.value_or(p.sph.viscosity_alpha));
  w.pairs(team, columns.view(), p.integration.method == Method::runge_kutta ? PairTerms::all : PairTerms::forces,
          w.rates);
  s.packing.resize(s.position.size());
  s.strain.resize(s.position.size());
  for_each(team, s.position.size(), [&](std::size_t i) {
    s.packing[i] = w.rates.kernel_density[i] / p.grains.density;
    s.strain[i] = w.material.strain(s.material, i);
  });
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
