// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "physics/granular/appendix_b.hpp"
#include "physics/granular/material_path.hpp"

namespace talus::granular {
namespace {

std::vector<LawParameters> many_laws() {
  using Isotropic = YuuUmekageIsotropic::Parameters;
  using Printed = YuuUmekagePrinted::Parameters;
  return {Isotropic{},
          Isotropic{.fits = {.tables = Tables::printed}, .unloading = Unloading::none},
          Isotropic{.contact = {.volume = Volume::strain},
                    .unloading = Unloading::pressure,
                    .rule = {.reset = Reset::strain, .smoothing_time = 1e-5}},
          Isotropic{.unloading = Unloading::shear, .rule = {.reset = Reset::deviator}},
          Printed{.fits = {.tables = Tables::printed},
                  .contact = {.volume = Volume::strain},
                  .shear_sum = ShearSum::with_signs,
                  .rule = {.reset = Reset::strain, .smoothing_time = 0}},
          Printed{.rule = {.reset = Reset::deviator, .smoothing_time = 1e-4}},
          Printed{.unloading = PrintedUnloading::none},
          DruckerPrager::Parameters{},
          DruckerPrager::Parameters{.friction = 0.4, .contact = {.volume = Volume::strain}},
          CriticalState::Parameters{},
          CriticalState::Parameters{.dilatancy = 0, .ageing_strength = 0},
          LinearElastic::Parameters{}};
}

TEST(Law, LanesEqualNumbersAlone) {
  // Every lane with its own path, kicks of all kinds; all laws with all their branches.
  using Many = SimdVector<double>;
  for (const LawParameters& parameters : many_laws())
    std::visit(
        []<class Law>(const Law& law) {
          MaterialPoint<Law, Many> together{};
          MaterialPoint<Law> alone[Many::lanes] = {};
          double density[Many::lanes];
          std::fill(std::begin(density), std::end(density), 1490.0);
          Random random(7);
          for (int step = 0; step < 2000; ++step) {
            Tensor3<Many> gradients;
            Many densities;
            for (int lane = 0; lane < Many::lanes; ++lane) {
              Tensor3<> gradient;
              for (double* component : {&gradient.xx, &gradient.xy, &gradient.xz, &gradient.yx, &gradient.yy,
                                        &gradient.yz, &gradient.zx, &gradient.zy, &gradient.zz})
                *component = 20 * (random.uniform() - 0.5) * (step % 100 < 50 ? 1 : 0.1);
              gradient.zz -= step % 300 < 120 ? 5 : -2;
              density[lane] *= 1 - 1e-5 * trace(gradient);
              alone[lane] = law.update(alone[lane], gradient, density[lane], 1e-5);
              gradients.xx.row[0][lane] = gradient.xx, gradients.xy.row[0][lane] = gradient.xy;
              gradients.xz.row[0][lane] = gradient.xz, gradients.yx.row[0][lane] = gradient.yx;
              gradients.yy.row[0][lane] = gradient.yy, gradients.yz.row[0][lane] = gradient.yz;
              gradients.zx.row[0][lane] = gradient.zx, gradients.zy.row[0][lane] = gradient.zy;
              gradients.zz.row[0][lane] = gradient.zz;
              densities.row[0][lane] = density[lane];
            }
            together = law.update(together, gradients, densities, 1e-5);
            for (int lane = 0; lane < Many::lanes; ++lane) {
              ASSERT_EQ(together.stress.xx.row[0][lane], alone[lane].stress.xx) << step;
              ASSERT_EQ(together.stress.zx.row[0][lane], alone[lane].stress.zx) << step;
              std::vector<double> many, one;
              Law::for_each_slot([&](HistorySlot, Many& value) { many.push_back(value.row[0][lane]); },
                                 together.history);
              Law::for_each_slot([&](HistorySlot, double& value) { one.push_back(value); }, alone[lane].history);
              ASSERT_EQ(many, one) << step;
            }
          }
        },
        make_law(parameters, 2500));
}

TEST(Law, PathsRepeatToTheBit) {
  const std::vector<PathStretch> path = {{1, squash(2e-4)}, {1, shear(3e-3)}, {1, squash(-1e-4)}, {1, shear(-1e-3)}};
  for (const LawParameters& parameters : many_laws()) {
    const auto first = follow_path(make_law(parameters, 2500), path),
               second = follow_path(make_law(parameters, 2500), path);
    for (std::size_t k = 0; k < first.size(); ++k) {
      ASSERT_EQ(first[k].stress, second[k].stress);
      ASSERT_EQ(first[k].history, second[k].history);
    }
  }
}

TEST(Law, NewPointsAreFreeOfStressAndStaySoAtRest) {
  for (const LawParameters& parameters : many_laws()) {
    const auto points = follow_path(make_law(parameters, 2500), std::vector<PathStretch>{{1, {}}});
    EXPECT_EQ(points.front().stress, SymmetricTensor3<>{});
    EXPECT_EQ(points.back().stress, SymmetricTensor3<>{});
  }
}

TEST(Law, NamesItsSlotsOnceAndTensorsByTheirAxes) {
  for (const LawParameters& parameters : many_laws()) {
    const AnyLaw law = make_law(parameters, 2500);
    std::set<std::string> names;
    for (const HistorySlot& slot : history_of(law)) {
      EXPECT_TRUE(names.insert(slot.name).second) << slot.name;
      EXPECT_EQ(slot.axis + slot.other_axis == 2 && slot.axis != slot.other_axis,
                std::string(slot.name).ends_with("_zx"));
    }
  }
}

TEST(Law, KeysReachTheLaw) {
  const AnyLaw law = make_law(YuuUmekageIsotropic::Parameters{.fits = {.scale = 4, .max_deviator = 0.02},
                                                              .contact = {.volume = Volume::strain, .gate_power = 300},
                                                              .unloading = Unloading::shear,
                                                              .rule = {.unloading_stiffness = 3}},
                              2600);
  const YuuUmekageIsotropic::Parameters& p = std::get<YuuUmekageIsotropic>(law).parameters();
  EXPECT_EQ(p.fits.scale, 4);
  EXPECT_EQ(p.contact.volume, Volume::strain);
  EXPECT_EQ(p.fits.max_deviator, 0.02);
  EXPECT_EQ(p.unloading, Unloading::shear);
  EXPECT_EQ(p.rule.unloading_stiffness, 3);
  EXPECT_EQ(p.contact.gate_power, 300);
}

struct Key {
  bool holds;
  bool has_text;
  bool default_in_range;
};
std::map<std::string, Key> keys_of(const LawParameters& parameters) {
  std::map<std::string, Key> keys;
  for_each_parameter(
      [&]<class T>(const Parameter& parameter, const T& value) {
        Key key{parameter.condition.holds, !parameter.text.empty(), true};
        if constexpr (std::is_arithmetic_v<T>) key.default_in_range = parameter.range.contains(double(value));
        EXPECT_TRUE(keys.emplace(parameter.key, key).second) << parameter.key;
      },
      parameters);
  return keys;
}

TEST(Law, HasAllItsKeysInItsOwnTable) {
  std::size_t count = 1;
  LawParameters defaults;
  for_each_law(defaults, [&]<class Law>(const auto& own, LawName) {
    Law::for_each_parameter([&](const Parameter&, const auto&) { ++count; }, own);
  });
  const auto keys = keys_of(defaults);
  EXPECT_EQ(keys.size(), count);
  for (const auto& [key, what] : keys) {
    EXPECT_TRUE(key == "law.name" || key.starts_with("law.")) << key;
    EXPECT_TRUE(what.has_text) << key;
    EXPECT_TRUE(what.default_in_range) << key;
  }
  for (const std::string_view name : Laws::names)
    EXPECT_EQ(std::count(Laws::names.begin(), Laws::names.end(), name), 1);
}

TEST(Law, OnlyTheKeysOfTheChosenOneHold) {
  LawParameters defaults;
  for_each_law(defaults, [&]<class Law>(const auto&, LawName) {
    const LawParameters parameters = typename Law::Parameters{};
    EXPECT_TRUE(parameters.is<Law>());
    std::size_t holding = 0;
    for (const auto& [key, what] : keys_of(parameters)) {
      const bool own = key.starts_with(table_of_law<Law>() + ".");
      if (what.holds && key != "law.name") {
        EXPECT_TRUE(own) << key;
      }
      holding += what.holds;
    }
    EXPECT_GT(holding, 1u) << Law::name;
  });
}

TEST(Law, ContradictionsAreNamed) {
  for (const LawParameters& parameters : many_laws()) EXPECT_TRUE(check(parameters).empty());
  const auto problems = check(YuuUmekagePrinted::Parameters{.rule = {.reset = Reset::strain}});
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_EQ(problems[0].key, "law.yuu-umekage-printed.reset");
  EXPECT_THAT(problems[0].what, testing::HasSubstr("density"));
  EXPECT_EQ(check(YuuUmekageIsotropic::Parameters{.rule = {.reset = Reset::strain}})[0].key, "law.yuu-umekage.reset");
  const Fits beyond{.max_deviator = 0.04};
  EXPECT_THROW(make_law(YuuUmekageIsotropic::Parameters{.fits = beyond}, 2500), std::invalid_argument);
  EXPECT_THROW(make_law(DruckerPrager::Parameters{.fits = beyond}, 2500), std::invalid_argument);
  EXPECT_NO_THROW(make_law(YuuUmekagePrinted::Parameters{.fits = beyond}, 2500));
  EXPECT_FALSE(within_fits().contains(0.04));
}

TEST(Law, SaysWhatItWasMadeFor) {
  const auto range = [](const LawParameters& parameters) {
    return std::visit([](const auto& law) { return law.range(); }, make_law(parameters, 2500));
  };
  EXPECT_EQ(range(YuuUmekageIsotropic::Parameters{}).grain_diameter, 200e-6);
  EXPECT_NEAR(range(YuuUmekageIsotropic::Parameters{}).max_pressure,
              4 * range(YuuUmekageIsotropic::Parameters{.fits = {.scale = 2.45}}).max_pressure, 1e-9);
  EXPECT_EQ(range(DruckerPrager::Parameters{}).grain_diameter, 200e-6);
  EXPECT_EQ(range(DruckerPrager::Parameters{.friction = 0.5}).grain_diameter, 0);
  EXPECT_EQ(range(LinearElastic::Parameters{}).grain_diameter, 0);
}

}  // namespace
}  // namespace talus::granular
