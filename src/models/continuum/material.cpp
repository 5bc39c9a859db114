// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/material.hpp"

#include <algorithm>
#include <cmath>
#include <concepts>
#include <string_view>

#include "base/instruction_set.hpp"
#include "models/continuum/law_update/kernel.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::continuum {

namespace {

/// Calls visit(column, value) for the slots of the history that have a column.
template <class Law, class Visit, class History>
void for_each_column(std::span<const std::size_t> used, History& history, Visit&& visit) {
  std::size_t slot = 0, column = 0;
  const auto meet = [&](granular::HistorySlot, double& value) {
    if (column < used.size() && used[column] == slot++) visit(column++, value);
  };
  Law::for_each_slot(meet, history);
}

/// Slots that the law does not use stay as they are.
template <class Law>
granular::MaterialPoint<Law> load(const MaterialColumns& columns, std::span<const std::size_t> used, std::size_t i) {
  granular::MaterialPoint<Law> point{tensor_at(columns.stress, i), {}};
  for_each_column<Law>(used, point.history, [&](std::size_t c, double& value) { value = columns.history[c][i]; });
  return point;
}

template <class Law>
void store(granular::MaterialPoint<Law>& point, std::span<const std::size_t> used, MaterialColumns& columns,
           std::size_t i, bool keep_history) {
  set_tensor(columns.stress, i, point.stress);
  if (!keep_history) return;
  for_each_column<Law>(used, point.history, [&](std::size_t c, double& value) { columns.history[c][i] = value; });
}

template <class Law>
concept TakesAStrain = requires(const Law law, const granular::MaterialPoint<Law>& old) {
  law.update_at_strain(old, SymmetricTensor3<>{}, Tensor3<>{}, 1.0, 1.0);
};

bool uses_slot(const granular::AnyLaw& any, std::size_t slot) {
  return std::visit(
      [&](const auto& law) {
        if constexpr (requires { law.uses_slot(slot); }) return law.uses_slot(slot);
        return true;
      },
      any);
}

LawColumns columns_of(const granular::CriticalStateParameters& p, const MaterialColumns& old,
                      const GradientColumns& velocity_gradient, std::span<const double> density, double time_step,
                      MaterialColumns& next, bool keep_history) {
  LawColumns columns{};
  for (std::size_t c = 0; c < 6; ++c) columns.stress[c] = old.stress[c].data();
  for (std::size_t c = 0; c < 6; ++c) columns.next_stress[c] = next.stress[c].data();
  for (std::size_t c = 0; c < 9; ++c) columns.velocity_gradient[c] = velocity_gradient.component[c].data();
  columns.expansion = old.history[0].data(), columns.contacts = old.history[1].data();
  if (keep_history) columns.next_expansion = next.history[0].data(), columns.next_contacts = next.history[1].data();
  if (p.has_cohesion()) {
    columns.strengthening = old.history.back().data();
    if (keep_history) columns.next_strengthening = next.history.back().data();
  }
  columns.density = density.data();
  columns.time_step = time_step;
  return columns;
}

}  // namespace

Material::Material(const Parameters& p) : law_(granular::make_law(p.law, p.grains.density, p.grains.diameter)) {
  const std::vector<granular::HistorySlot> all = granular::history_of(law_);
  for (std::size_t slot = 0; slot < all.size(); ++slot) {
    if (!uses_slot(law_, slot)) continue;
    used_slots_.push_back(slot);
    slots_.push_back(all[slot]);
  }
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    if (slots_[k].name == std::string_view("strain_xx")) first_strain_slot_ = k;
    if (slots_[k].name == std::string_view("resets")) resets_slot_ = k;
  }
  if (p.collisions.form != granular::Collisions::none) {
    collisions_ = p.collisions;
    fall_time_ = std::sqrt(p.grains.diameter / p.gravity.acceleration);
  }
}

bool Material::by_displacements() const {
  return std::visit(
      []<class Law>(const Law& law) {
        if constexpr (TakesAStrain<Law>) return law.by_displacements();
        return false;
      },
      law_);
}

granular::LawRange Material::range() const {
  return std::visit([](const auto& law) { return law.range(); }, law_);
}

double Material::sound_speed(double density) const {
  return std::visit([&](const auto& law) { return law.sound_speed(density); }, law_);
}

void Material::update(ThreadTeam& team, const MaterialColumns& old, const GradientColumns& velocity_gradient,
                      std::span<const SymmetricTensor3<>> measured_strain, std::span<const double> density,
                      double time_step, MaterialColumns& next, bool keep_history) const {
  std::visit(
      [&]<class Law>(const Law& law) {
        const auto updated = [&](std::size_t i) {
          if constexpr (TakesAStrain<Law>)
            if (!measured_strain.empty())
              return law.update_at_strain(load<Law>(old, used_slots_, i), measured_strain[i], velocity_gradient[i],
                                          density[i], time_step);
          return law.update(load<Law>(old, used_slots_, i), velocity_gradient[i], density[i], time_step);
        };
        // Whole blocks in vectors where the law has them, bitwise identical.
        std::size_t done = 0;
        if constexpr (std::same_as<Law, granular::CriticalState>) {
          static UpdateCriticalState* const update_blocks =
              TALUS_COMPILED_FOR(resolve(InstructionSet::automatic), update_law);
          const LawColumns columns =
              columns_of(law.parameters(), old, velocity_gradient, density, time_step, next, keep_history);
          constexpr std::size_t at_once = 32 * law_block;
          done = density.size() / law_block * law_block;
          team.run((done + at_once - 1) / at_once, [&](std::size_t task) {
            update_blocks(law.coefficients(), columns, task * at_once, std::min(done, (task + 1) * at_once));
          });
        }
        for_each(team, density.size() - done, [&](std::size_t n) {
          auto point = updated(done + n);
          store(point, used_slots_, next, done + n, keep_history);
        });
      },
      law_);
  if (!collisions_) return;
  for_each(team, density.size(), [&](std::size_t i) {
    const double mean_stress = std::max(trace(tensor_at(next.stress, i)) / 3, 0.0);
    set_tensor(next.collisional, i,
               granular::collisional_stress(*collisions_, fall_time_, mean_stress, velocity_gradient[i]));
  });
}

double Material::strain(const MaterialColumns& columns, std::size_t i) const {
  if (!first_strain_slot_) return 0;
  const auto e = [&](std::size_t c) { return columns.history[*first_strain_slot_ + c][i]; };
  return norm(SymmetricTensor3<>{e(0), e(1), e(2), e(3), e(4), e(5)});
}

void Material::mirror(MaterialColumns& columns, std::size_t particle, const Image& image) const {
  set_tensor(columns.stress, particle, image.tensor(tensor_at(columns.stress, particle)));
  if (!columns.collisional[0].empty())
    set_tensor(columns.collisional, particle, image.tensor(tensor_at(columns.collisional, particle)));
  constexpr int axes[6][2] = {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {2, 0}};
  const auto begins_tensor = [&](std::size_t k) {
    if (k + 6 > slots_.size()) return false;
    for (std::size_t c = 0; c < 6; ++c)
      if (slots_[k + c].axis != axes[c][0] || slots_[k + c].other_axis != axes[c][1]) return false;
    return true;
  };
  for (std::size_t k = 0; k < slots_.size(); ++k) {
    if (!begins_tensor(k)) continue;
    const auto at = [&](std::size_t c) -> double& { return columns.history[k + c][particle]; };
    const SymmetricTensor3<> t = image.tensor({at(0), at(1), at(2), at(3), at(4), at(5)});
    at(0) = t.xx, at(1) = t.yy, at(2) = t.zz, at(3) = t.xy, at(4) = t.yz, at(5) = t.zx;
  }
}

}  // namespace talus::continuum
