// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/law.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

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
  return {{},
          {.tables = Tables::printed, .unloading = Unloading::none},
          {.volume = Volume::strain, .unloading = Unloading::pressure, .reset = Reset::strain, .smoothing_time = 1e-5},
          {.unloading = Unloading::shear, .reset = Reset::deviator, .main_strain = MainStrain::volume},
          {.form = Form::printed,
           .tables = Tables::printed,
           .volume = Volume::strain,
           .reset = Reset::strain,
           .smoothing_time = 0,
           .shear_sum = ShearSum::with_signs},
          {.form = Form::printed, .reset = Reset::deviator, .smoothing_time = 1e-4},
          {.form = Form::printed, .unloading = Unloading::none},
          {.name = LawName::drucker_prager},
          {.name = LawName::drucker_prager, .volume = Volume::strain, .friction = 0.4},
          {.name = LawName::linear_elastic}};
}

TEST(Law, LanesEqualNumbersAlone) {
  // Every lane with its own path, kicks of all kinds; all laws with all their branches.
  using Many = Lanes<double>;
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
                std::string(slot.name) == "strain_zx");
    }
  }
}

TEST(Law, KeysReachTheLaw) {
  const AnyLaw law = make_law({.scale = 4,
                               .volume = Volume::strain,
                               .largest_deviator = 0.02,
                               .unloading = Unloading::shear,
                               .unloading_stiffness = 3,
                               .gate_power = 300},
                              2600);
  const YuuUmekageOptions& options = std::get<YuuUmekageIsotropic>(law).options();
  EXPECT_EQ(options.scale, 4);
  EXPECT_EQ(options.grain_density, 2600);
  EXPECT_EQ(options.volume, Volume::strain);
  EXPECT_EQ(options.largest_deviator, 0.02);
  EXPECT_EQ(options.unloading, Unloading::shear);
  EXPECT_EQ(options.unloading_stiffness, 3);
  EXPECT_EQ(options.gate_power, 300);
  // Every key once, with a text and a default within its range.
  LawParameters defaults;
  std::set<std::string_view> keys;
  for_each_parameter(
      [&]<class T>(const Parameter& parameter, const T& value) {
        EXPECT_TRUE(keys.insert(parameter.key).second) << parameter.key;
        EXPECT_TRUE(parameter.key.starts_with("law.")) << parameter.key;
        EXPECT_FALSE(parameter.text.empty()) << parameter.key;
        if constexpr (std::is_arithmetic_v<T>) {
          EXPECT_TRUE(parameter.range.contains(static_cast<double>(value)));
        }
      },
      defaults);
}

TEST(Law, ContradictionsAreNamed) {
  EXPECT_TRUE(check(LawParameters{}).empty());
  EXPECT_TRUE(check({.name = LawName::drucker_prager, .reset = Reset::strain}).empty());
  const auto problems = check({.form = Form::printed, .unloading = Unloading::pressure, .reset = Reset::strain});
  ASSERT_EQ(problems.size(), 2);
  EXPECT_EQ(problems[0].key, "law.reset");
  EXPECT_EQ(problems[1].key, "law.unloading");
  EXPECT_THAT(problems[0].what, testing::HasSubstr("density"));
  EXPECT_EQ(check({.form = Form::printed, .unloading = Unloading::none, .reset = Reset::deviator}).size(), 1);
  EXPECT_EQ(check({.largest_deviator = 0.04})[0].key, "law.largest_deviator");
  EXPECT_THROW(make_law({.largest_deviator = 0.04}, 2500), std::invalid_argument);
  EXPECT_THROW(make_law({.name = LawName::drucker_prager, .largest_deviator = 0.04}, 2500), std::invalid_argument);
  EXPECT_TRUE(check({.form = Form::printed, .largest_deviator = 1}).empty());
  EXPECT_EQ(check({.strain = Strain::displacements})[0].key, "law.strain");
  EXPECT_EQ(check({.name = LawName::linear_elastic, .form = Form::printed, .strain = Strain::displacements}).size(), 1);
  EXPECT_TRUE(check({.form = Form::printed, .strain = Strain::displacements}).empty());
}

TEST(Law, CollisionsCanBeLeftOut) {
  EXPECT_EQ(collision_options({.collisions = Collisions::none}, 2e-4, 9.8).normal, 0);
  EXPECT_EQ(collision_options({.collisions = Collisions::none}, 2e-4, 9.8).shear, 0);
  EXPECT_TRUE(collision_options({.collisions = Collisions::isotropic}, 2e-4, 9.8).isotropic);
  EXPECT_EQ(collision_options({}, 3e-4, 9.81).diameter, 3e-4);
}

}  // namespace
}  // namespace talus::granular
