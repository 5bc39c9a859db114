// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/material.hpp"

#include <gtest/gtest.h>

#include <utility>

#include "base/instruction_set.hpp"
#include "base/random.hpp"
#include "models/continuum/law_update/kernel.hpp"

namespace talus::continuum {
namespace {

/// Points in all states: loaded and loose, at yield and far from it.
struct Points {
  static constexpr std::size_t count = 83;  // no multiple of a block
  MaterialColumns old;
  GradientColumns gradient;
  std::vector<double> density;

  explicit Points(bool sticky) {
    Random random(11);
    for (auto* columns : {&old.stress, &old.collisional})
      for (auto& column : *columns) column.resize(count);
    old.history.assign(3, std::vector<double>(count));
    gradient.resize(count);
    for (std::size_t i = 0; i < count; ++i) {
      const double pressure = random.uniform(sticky ? -500 : 0, 2000);
      for (std::size_t c = 0; c < 6; ++c) old.stress[c][i] = (c < 3 ? pressure : 0) + random.uniform(-500, 500);
      for (auto& component : gradient.component) component[i] = random.uniform(-100, 100);
      density.push_back(2500 * random.uniform(0.5, 0.65));
      old.history[0][i] = random.uniform(-0.05, 0.05);
      old.history[1][i] = random.uniform(0, 1);
      old.history[2][i] = sticky ? random.uniform(-200e3, 100e3) : 0;
    }
  }
};

/// Both ways in which the strength at rest counts.
granular::CriticalState::Parameters grains(bool ageing_adds, bool sticky) {
  granular::CriticalState::Parameters p;
  p.ageing_adds = ageing_adds;
  if (sticky) p.tensile_strength = 100e3, p.consolidation_strength = 0.2, p.consolidation = 500e3;
  return p;
}

/// All that the law can be.
constexpr std::pair<bool, bool> kinds[] = {{false, false}, {true, false}, {false, true}, {true, true}};

/// The columns that the law uses, of all that there could be.
MaterialColumns in_use(const MaterialColumns& all, const granular::CriticalState& law) {
  MaterialColumns used{all.stress, all.collisional, {}};
  for (std::size_t slot = 0; slot < all.history.size(); ++slot)
    if (law.uses_slot(slot)) used.history.push_back(all.history[slot]);
  return used;
}

TEST(Material, TheLawInVectorsHasTheBitsOfTheLawByParticle) {
  for (const auto& [ageing_adds, sticky] : kinds) {
    Parameters p;
    p.law = grains(ageing_adds, sticky);
    p.collisions.form = granular::Collisions::none;
    const Points points(sticky);
    const granular::CriticalState law(grains(ageing_adds, sticky), p.grains.density, p.grains.diameter);
    const MaterialColumns used = in_use(points.old, law);
    MaterialColumns next = used;
    ThreadTeam team(2);
    Material(p).update(team, used, points.gradient, {}, points.density, 1e-5, next, true);
    std::size_t loose = 0, tension = 0;
    for (std::size_t i = 0; i < Points::count; ++i) {
      const auto h = [&](std::size_t k) { return points.old.history[k][i]; };
      const granular::MaterialPoint<granular::CriticalState> old{tensor_at(points.old.stress, i), {h(0), h(1), h(2)}};
      const auto expected = law.update(old, points.gradient[i], points.density[i], 1e-5);
      EXPECT_EQ(tensor_at(next.stress, i), expected.stress);
      EXPECT_EQ(next.history[0][i], expected.history.expansion);
      EXPECT_EQ(next.history[1][i], expected.history.contacts);
      if (sticky) {
        EXPECT_EQ(next.history.back()[i], expected.history.strengthening);
      }
      tension += trace(expected.stress) < 0;
      loose += expected.stress.xx == 0;
    }
    EXPECT_GT(loose, 10u);
    EXPECT_LT(loose, 70u);
    EXPECT_EQ(tension > 0, sticky);
  }
}

TEST(Material, EveryInstructionSetHasTheSameBits) {
  for (const auto& [ageing_adds, sticky] : kinds) {
    const Points points(sticky);
    const granular::CriticalState law(grains(ageing_adds, sticky), 2500, 200e-6);
    constexpr std::size_t end = Points::count / law_block * law_block;
    std::vector<MaterialColumns> found;
    for (const auto& [set, update] :
         {std::pair{InstructionSet::portable, &update_law_portable}, std::pair{InstructionSet::avx2, &update_law_avx2},
          std::pair{InstructionSet::avx512, &update_law_avx512}}) {
      if (!is_available(set)) continue;
      MaterialColumns next = points.old;
      LawColumns columns{};
      for (std::size_t c = 0; c < 6; ++c) columns.stress[c] = points.old.stress[c].data();
      for (std::size_t c = 0; c < 6; ++c) columns.next_stress[c] = next.stress[c].data();
      for (std::size_t c = 0; c < 9; ++c) columns.velocity_gradient[c] = points.gradient.component[c].data();
      columns.expansion = points.old.history[0].data(), columns.contacts = points.old.history[1].data();
      columns.next_expansion = next.history[0].data(), columns.next_contacts = next.history[1].data();
      columns.strengthening = points.old.history[2].data(), columns.next_strengthening = next.history[2].data();
      columns.density = points.density.data();
      columns.time_step = 1e-5;
      update(law.coefficients(), columns, 0, end);
      found.push_back(next);
    }
    for (const MaterialColumns& other : found) {
      EXPECT_EQ(other.stress, found.front().stress);
      EXPECT_EQ(other.history, found.front().history);
    }
  }
}

}  // namespace
}  // namespace talus::continuum
