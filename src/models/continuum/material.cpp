// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/material.hpp"

namespace talus::continuum {

namespace {

std::variant<granular::LinearElastic> law_of(const Parameters& p) {
  switch (p.law.name) {
    case LawName::linear_elastic:
      return granular::LinearElastic(p.law.lambda, p.law.shear_modulus);
  }
  throw std::invalid_argument("no such law");
}

template <class Law>
granular::MaterialPoint<Law> load(const MaterialColumns& columns, std::size_t i) {
  granular::MaterialPoint<Law> point{stress_of(columns, i), {}};
  std::size_t slot = 0;
  Law::for_each_slot([&](granular::HistorySlot, double& value) { value = columns.history[slot++][i]; }, point.history);
  return point;
}

template <class Law>
void store(granular::MaterialPoint<Law>& point, MaterialColumns& columns, std::size_t i, bool keep_history) {
  auto& s = columns.stress;
  const SymmetricTensor3<>& t = point.stress;
  s[0][i] = t.xx, s[1][i] = t.yy, s[2][i] = t.zz, s[3][i] = t.xy, s[4][i] = t.yz, s[5][i] = t.zx;
  if (!keep_history) return;
  std::size_t slot = 0;
  Law::for_each_slot([&](granular::HistorySlot, double& value) { columns.history[slot++][i] = value; }, point.history);
}

}  // namespace

Material::Material(const Parameters& parameters) : law_(law_of(parameters)) {}

std::vector<granular::HistorySlot> Material::slots() const {
  return std::visit(
      []<class Law>(const Law&) {
        std::vector<granular::HistorySlot> slots;
        typename Law::template History<double> history{};
        Law::for_each_slot([&](granular::HistorySlot slot, double&) { slots.push_back(slot); }, history);
        return slots;
      },
      law_);
}

double Material::sound_speed(double density) const {
  return std::visit([&](const auto& law) { return law.sound_speed(density); }, law_);
}

void Material::update(ThreadTeam& team, const MaterialColumns& old, std::span<const Tensor3<>> velocity_gradient,
                      std::span<const double> density, double time_step, MaterialColumns& next,
                      bool keep_history) const {
  std::visit(
      [&]<class Law>(const Law& law) {
        for_each(team, density.size(), [&](std::size_t i) {
          auto point = law.update(load<Law>(old, i), velocity_gradient[i], density[i], time_step);
          store(point, next, i, keep_history);
        });
      },
      law_);
}

void Material::mirror(MaterialColumns& columns, std::size_t lump, const Vector3& sign) const {
  constexpr int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  for (std::size_t c = 0; c < 6; ++c) columns.stress[c][lump] *= sign[axes[c][0]] * sign[axes[c][1]];
  const auto remembered = slots();
  for (std::size_t k = 0; k < remembered.size(); ++k)
    columns.history[k][lump] *= sign[remembered[k].axis] * sign[remembered[k].other_axis];
}

}  // namespace talus::continuum
