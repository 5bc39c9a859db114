// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/setup.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "models/continuum/cases.hpp"
#include "models/continuum/regime.hpp"

namespace talus::continuum {
namespace {

/// A slit of 40 mm under 80 mm of grains.
Parameters hopper(double spacing) {
  Parameters p;
  p.box.width = 0.1, p.box.depth = 5 * spacing, p.box.height = 0.25;
  p.plate.height = 0.1, p.plate.slit_left = 0.03, p.plate.slit_right = 0.07;
  p.bed.spacing = spacing, p.bed.height = 0.08;
  return p;
}

TEST(ViscosityAtOutlet, IsThatOfTheCoefficientOverSpeedAndWidth) {
  const auto setup = setup_of(hopper(2e-3));
  EXPECT_NEAR(
      setup.viscosity_at_outlet(0.07),
      0.07 * setup.sound_speed * setup.smoothing_length / (0.04 * std::sqrt(setup.given.gravity.acceleration * 0.04)),
      1e-12);
  Parameters closed = hopper(2e-3);
  closed.plate = {};
  EXPECT_TRUE(std::isnan(setup_of(closed).viscosity_at_outlet(0.1)));
  EXPECT_EQ(setup_of(closed).default_viscosity(), 0.1);
}

TEST(ViscosityAtOutlet, OfADefaultIsSmallWhateverTheStiffness) {
  for (const double stiffness : {0.125, 0.25, 1.0}) {
    Parameters p = hopper(2e-3);
    auto& law = p.law.of<granular::CriticalState>();
    law.bulk_modulus *= stiffness, law.shear_modulus *= stiffness;
    p.sph.viscosity_alpha = setup_of(p).default_viscosity();
    EXPECT_NEAR(setup_of(p).viscosity_at_outlet(p.sph.viscosity_alpha), max_viscosity, 1e-12);
    EXPECT_LT(p.sph.viscosity_alpha, 0.1);
  }
  Parameters stiff = hopper(2e-3);
  stiff.law.of<granular::CriticalState>().bulk_modulus *= 100;
  EXPECT_EQ(setup_of(stiff).default_viscosity(), 0.01) << "never less";
  Parameters soft = hopper(2e-3);
  auto& law = soft.law.of<granular::CriticalState>();
  law.bulk_modulus *= 1e-4, law.shear_modulus *= 1e-4;
  EXPECT_EQ(setup_of(soft).default_viscosity(), 0.1) << "never more";
}

TEST(ViscosityAtOutlet, WarnsOfADischargeThatItSlows) {
  const auto line = [](const Parameters& p) {
    for (const RegimeLine& l : regime_of_case(setup_of(p)))
      if (l.quantity == "viscosity at the outlet") return l;
    return RegimeLine{};
  };
  Parameters p = hopper(2e-3);
  const double allowed = setup_of(p).default_viscosity();
  p.sph.viscosity_alpha = allowed;
  EXPECT_FALSE(line(p).warning);
  EXPECT_NE(line(p).meaning.find("some 1.7 %"), std::string::npos) << line(p).meaning;
  p.sph.viscosity_alpha = 5 * allowed;
  EXPECT_TRUE(line(p).warning);
  EXPECT_NE(line(p).meaning.find("take sph.viscosity_alpha = "), std::string::npos) << line(p).meaning;
}

}  // namespace
}  // namespace talus::continuum
