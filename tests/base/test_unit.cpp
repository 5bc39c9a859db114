// SPDX-License-Identifier: Apache-2.0
#include "base/unit.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <utility>

#include "base/random.hpp"

namespace talus {
namespace {

double value_of(std::string_view text) {
  std::string why;
  const auto quantity = parse_quantity(text, &why);
  EXPECT_TRUE(quantity) << text << ": " << why;
  return quantity ? quantity->value : std::numeric_limits<double>::quiet_NaN();
}

std::string why_not(std::string_view text) {
  std::string why;
  EXPECT_FALSE(parse_quantity(text, &why)) << text;
  return why;
}

TEST(ParseQuantity, RoundsOnceFromWhatWasWritten) {
  EXPECT_EQ(value_of("200 um"), 200e-6);
  EXPECT_EQ(value_of("0.9 mm"), 0.9e-3);
  EXPECT_NE(0.9 * 1e-3, 0.9e-3);  // two roundings make another double
  EXPECT_EQ(value_of("1.1 km"), 1100.0);
  EXPECT_EQ(value_of("2500 kg/m3"), 2500.0);
  EXPECT_EQ(value_of("2.5 g/cm3"), 2500.0);
  EXPECT_EQ(value_of("1.82e-5 Pa s"), 1.82e-5);
  EXPECT_EQ(value_of("9.81 m/s2"), 9.81);
  EXPECT_EQ(value_of("0.7 hPa"), 70.0);
  EXPECT_EQ(value_of("1.5 mbar"), 150.0);
  EXPECT_EQ(value_of("0.1"), 0.1);
  EXPECT_EQ(value_of("7 min"), 420.0);
  EXPECT_EQ(value_of("36 km/h"), 10.0);
  EXPECT_EQ(value_of("1 m/min"), 1.0 / 60.0);
  EXPECT_EQ(value_of("90 deg"), std::numbers::pi / 2);
  EXPECT_EQ(value_of("45 deg"), std::numbers::pi / 4);
  EXPECT_EQ(value_of("180 deg"), std::numbers::pi);
  EXPECT_EQ(value_of("1 N/deg"), 57.295779513082320876798);
}

TEST(ParseQuantity, ReadsTheUnitsOfTheTrade) {
  EXPECT_EQ(value_of("80 t"), 80e3);
  EXPECT_EQ(value_of("1.5 kt"), 1.5e6);
  EXPECT_EQ(value_of("36 t/h"), 10.0);
  EXPECT_EQ(value_of("7.2 kg/h"), 0.002);
  EXPECT_EQ(value_of("60 rpm"), 2 * std::numbers::pi);
  EXPECT_EQ(value_of("1 rpm"), 0.10471975511965977461542144610931676280657);
  EXPECT_EQ(value_of("30 rev/min"), std::numbers::pi);
  EXPECT_EQ(value_of("1 rev"), 2 * std::numbers::pi);
  EXPECT_EQ(value_of("1 in"), 0.0254);
  EXPECT_EQ(value_of("2.7 in"), 0.06858);
  EXPECT_EQ(value_of("10 ft"), 3.048);
  EXPECT_EQ(value_of("1 lb"), 0.45359237);
  EXPECT_DOUBLE_EQ(value_of("62.4 lb/ft3"), 62.4 * 0.45359237 / (0.3048 * 0.3048 * 0.3048));
  EXPECT_EQ(value_of("1 psi"), 6894.757293168361336722673445346890693781);
  EXPECT_EQ(value_of("1 lbf"), 4.4482216152605);
  EXPECT_EQ(value_of("1 psf"), 47.880258980335842616);
  EXPECT_DOUBLE_EQ(value_of("1 lbf/ft2"), value_of("1 psf"));
  EXPECT_EQ(value_of("144 psf"), value_of("1 psi"));
  EXPECT_EQ(value_of("0.62 g/cc"), 620);
  EXPECT_EQ(value_of("0.62 kg/dm3"), 620);
  EXPECT_EQ(value_of("0.62 g/cm3"), 620);
  EXPECT_EQ(value_of("18.5 cP"), 0.0185);
  EXPECT_EQ(value_of("2 P"), 0.2);
  EXPECT_EQ(value_of("6 L/min"), 1e-4);
  EXPECT_EQ(value_of("250 mL"), 250e-6);
  EXPECT_EQ(value_of("2 d"), 172800.0);
  EXPECT_EQ(parse_quantity("3 rpm").value().dimension, (Dimension{0, 0, -1, 1}));
  EXPECT_EQ(parse_quantity("3 t/h").value().dimension, (Dimension{0, 1, -1, 0}));
  EXPECT_EQ(parse_quantity("3 cP").value().dimension, dimension::viscosity);
}

// Each overflowed an int: undefined behaviour.
TEST(ParseQuantity, RefusesPowersOfAnyLength) {
  for (const char* text : {"1 m2147483648", "1 m^99999999999999999999", "1 s^-99999999999", "1 (m s)99999999999"})
    EXPECT_EQ(why_not(text), "has a power that is no digit from 1 to 9") << text;
  EXPECT_EQ(why_not("1 m^00000000000000000002"), "has a power that is no digit from 1 to 9");
  EXPECT_EQ(why_not("1 ((((m9)9)9)9)9"), "has a power above 9");
}

// The product in double-double, which carries twice the digits of a double, must round to the same number.
TEST(ParseQuantity, DegreesAreCorrectlyRounded) {
  struct Factor {
    const char* unit;
    double high, low;
  };
  for (const Factor& factor : {Factor{"deg", 0x1.1df46a2529d39p-6, 0x1.5c1d8becdd291p-62},        // pi/180
                               Factor{"N/deg", 0x1.ca5dc1a63c1f8p+5, -0x1.1e7ab456405f9p-49}}) {  // 180/pi
    Random random(7);
    int differs_from_plain_product = 0;
    for (int i = 0; i < 2000; ++i) {
      const double number = std::floor(random.uniform(1, 36000)) / 64;  // exact in decimal and binary
      const double product = number * factor.high;
      const double rest = std::fma(number, factor.high, -product) + number * factor.low;
      EXPECT_EQ(value_of(std::to_string(number) + " " + factor.unit), product + rest) << number << " " << factor.unit;
      differs_from_plain_product += product != product + rest;
    }
    EXPECT_GT(differs_from_plain_product, 0);
  }
}

TEST(ParseQuantity, KnowsTheDimension) {
  const auto dimension_of = [](std::string_view text) { return parse_quantity(text).value().dimension; };
  EXPECT_EQ(dimension_of("5 mm"), dimension::length);
  EXPECT_EQ(dimension_of("0.5"), dimension::none);
  EXPECT_EQ(dimension_of("3 m/m"), dimension::none);
  EXPECT_EQ(dimension_of("1 kPa"), dimension::pressure);
  EXPECT_EQ(dimension_of("1 N m^-2"), dimension::pressure);
  EXPECT_EQ(dimension_of("1 N/m2"), dimension::pressure);
  EXPECT_EQ(dimension_of("1 J/m3"), dimension::pressure);
  EXPECT_EQ(dimension_of("1 W s/m3"), dimension::pressure);
  EXPECT_EQ(dimension_of("1 kg/(m s)"), dimension::viscosity);
  EXPECT_EQ(dimension_of("10 N/m"), dimension::stiffness);
  EXPECT_EQ(dimension_of("1 m Hz"), dimension::velocity);
  EXPECT_EQ(dimension_of("2 rad"), dimension::angle);
  EXPECT_EQ(dimension_of("3 deg/s"), (Dimension{0, 0, -1, 1}));
  EXPECT_EQ(dimension_of("4 min"), dimension::time);
}

TEST(ParseQuantity, AllWritingsOfAUnitAreTheSame) {
  for (const char* text :
       {"3 m/s2",   "3m/s2",     " 3  m / s2 ",  "3 m/s^2",      "3 m/s**2",  "3 m s^-2",  "3 m s-2",
        "3 m*s^-2", "3 m·s⁻²",   "3 m/s²",       "3 m/s/s",      "3 m/(s s)", "3 m/(s^2)", "3 m (1/s)^2",
        "3 m.s-2",  "+3.0 m/s2", "3000e-3 m/s2", "0.3e1 m s^-2", "3 /s2 m",   "3 1/s2 m"}) {
    const auto quantity = parse_quantity(text);
    ASSERT_TRUE(quantity) << text;
    EXPECT_EQ(quantity->value, 3.0) << text;
    EXPECT_EQ(quantity->dimension, dimension::acceleration) << text;
  }
  EXPECT_EQ(value_of("200 \u00b5m"), 200e-6);  // micro sign
  EXPECT_EQ(value_of("200 \u03bcm"), 200e-6);  // Greek mu
  EXPECT_EQ(value_of("45°"), std::numbers::pi / 4);
}

TEST(ParseQuantity, PrefixesAreNotMistakenForUnits) {
  EXPECT_EQ(value_of("1 m"), 1.0);
  EXPECT_EQ(value_of("1 mm"), 1e-3);
  EXPECT_EQ(value_of("1 ms"), 1e-3);
  EXPECT_EQ(value_of("1 Mg"), 1e3);
  EXPECT_EQ(value_of("1 mg"), 1e-6);
  EXPECT_EQ(value_of("1 kg"), 1.0);
  EXPECT_EQ(value_of("1 g"), 1e-3);
  EXPECT_EQ(value_of("1 min"), 60.0);
  EXPECT_EQ(value_of("1 h"), 3600.0);
  EXPECT_EQ(value_of("1 hPa"), 100.0);
  EXPECT_EQ(value_of("1 pm"), 1e-12);
  EXPECT_EQ(value_of("1 nm"), 1e-9);
  EXPECT_EQ(value_of("1 cm"), 1e-2);
  EXPECT_EQ(value_of("1 MPa"), 1e6);
  EXPECT_EQ(value_of("1 mPa"), 1e-3);
  EXPECT_EQ(value_of("1 GPa"), 1e9);
  EXPECT_EQ(value_of("1 mm2"), 1e-6);
  EXPECT_EQ(value_of("1 cm^3"), 1e-6);
}

TEST(ParseQuantity, SaysWhatIsWrong) {
  EXPECT_EQ(why_not(""), "is empty");
  EXPECT_EQ(why_not("fast"), "does not begin with a number");
  EXPECT_EQ(why_not("mm"), "does not begin with a number");
  EXPECT_EQ(why_not("nan m"), "does not begin with a number");
  EXPECT_EQ(why_not("inf m"), "does not begin with a number");
  EXPECT_EQ(why_not("- 5 mm"), "does not begin with a number");
  EXPECT_EQ(why_not("0,5 mm"), "has a comma; write a decimal point");
  EXPECT_EQ(why_not("5 %"), "is in percent, which is no unit; write 0.05 for 5 %");
  EXPECT_EQ(why_not("5 quux"), "has the unknown unit 'quux'");
  EXPECT_EQ(why_not("5 meters"), "has the unknown unit 'meters'; write 'm'");
  EXPECT_EQ(why_not("5 Mm/sec"), "has the unknown unit 'sec'; write 's'");
  EXPECT_EQ(why_not("5 inches"), "has the unknown unit 'inches'; write 'in'");
  EXPECT_EQ(why_not("5 tph"), "has the unknown unit 'tph'; write 't/h'");
  EXPECT_EQ(why_not("5 lbs"), "has the unknown unit 'lbs'; write 'lb'");
  EXPECT_EQ(why_not("5 kin"), "has the unknown unit 'kin'");
  EXPECT_EQ(why_not("5 KPA"), "has the unknown unit 'KPA'; write 'kPa'");
  EXPECT_EQ(why_not("5 MPA"), "has the unknown unit 'MPA'; write 'MPa'");
  EXPECT_EQ(why_not("5 mpa"), "has the unknown unit 'mpa'; write 'mPa'");
  EXPECT_EQ(why_not("5 kmin"), "has the unknown unit 'kmin'");
  EXPECT_EQ(why_not("5 12"), "has a second number after the first");
  EXPECT_EQ(why_not("5 mm 3"), "has '3' where a unit is due");
  EXPECT_EQ(why_not("5 m/"), "lacks a unit at the end");
  EXPECT_EQ(why_not("5 (m"), "has a parenthesis that is not closed");
  EXPECT_EQ(why_not("5 m)"), "has ')' where a unit is due");
  EXPECT_EQ(why_not("5 m0"), "has a power that is no digit from 1 to 9");
  EXPECT_EQ(why_not("5 m^x"), "has a power that is no digit from 1 to 9");
  EXPECT_EQ(why_not("5 m2.5"), "has a power that is no digit from 1 to 9");
  EXPECT_EQ(why_not("5 m12"), "has a power that is no digit from 1 to 9");
  EXPECT_EQ(why_not("5 (m9)9"), "has a power above 9");
  EXPECT_EQ(why_not("5 m m m m m m m m m"), "has too many units");
  EXPECT_EQ(why_not("5 " + std::string(500, '(')), "is too long");
  EXPECT_EQ(why_not("1e400 m"), "is outside the range of numbers");
  EXPECT_EQ(why_not("1e308 km"), "is outside the range of numbers");
  EXPECT_EQ(why_not("1e-400 m"), "is outside the range of numbers");
  EXPECT_EQ(why_not("1e99999999999999999999 m"), "is outside the range of numbers");
  EXPECT_EQ(value_of("0e99999999999999999999 m"), 0.0);
}

TEST(FormatQuantity, ShortestText) {
  EXPECT_EQ(format_quantity(200e-6, "m"), "0.0002 m");
  EXPECT_EQ(format_quantity(200e-6, "um"), "200 um");
  EXPECT_EQ(format_quantity(1e-7, "m"), "1e-07 m");
  EXPECT_EQ(format_quantity(1.5e-7, "m"), "1.5e-07 m");
  EXPECT_EQ(format_quantity(2500, "kg/m3"), "2500 kg/m3");
  EXPECT_EQ(format_quantity(-0.25, ""), "-0.25");
  EXPECT_EQ(format_quantity(std::numbers::pi / 4, "deg"), "45 deg");
  EXPECT_EQ(format_quantity(std::numbers::pi / 4, "°"), "45 °");
  EXPECT_EQ(format_quantity(420, "min"), "7 min");
  EXPECT_EQ(format_quantity(0.0, "deg"), "0 deg");
  EXPECT_EQ(format_quantity(1e22, "m"), "1e+22 m");
}

TEST(FormatQuantity, ReadsBackToTheSameBits) {
  Random random(3);
  for (const char* unit : {"",    "m",  "um", "kg/m3", "deg", "rad/s", "km/h", "min",  "deg^-2", "m^2 kg s^-3",
                           "rpm", "in", "ft", "lb",    "lbf", "psi",   "psf",  "g/cc", "dm",     "t/h"}) {
    for (int i = 0; i < 500; ++i) {
      const double value = std::ldexp(random.uniform(-1, 1), static_cast<int>(random.uniform(-200, 200)));
      const std::string text = format_quantity(value, unit);
      EXPECT_EQ(value_of(text), value) << text;
    }
    EXPECT_TRUE(std::signbit(value_of(format_quantity(-0.0, unit)))) << unit;
  }
}

TEST(Dimensions, NamesUnitsAndExamplesAgree) {
  for (int length = -3; length <= 3; ++length)
    for (int mass = -1; mass <= 1; ++mass)
      for (int time = -3; time <= 2; ++time)
        for (int angle = -1; angle <= 1; ++angle) {
          const Dimension dimension{length, mass, time, angle};
          const auto example = parse_quantity(unit_example(dimension));
          ASSERT_TRUE(example) << unit_example(dimension);
          EXPECT_EQ(example->dimension, dimension) << unit_example(dimension);
          EXPECT_EQ(parse_quantity("1 " + unit_name(dimension)).value().dimension, dimension) << unit_name(dimension);
          EXPECT_EQ(parse_quantity("1 " + example_unit(dimension)).value().dimension, dimension);
          EXPECT_FALSE(dimension_name(dimension).empty());
        }
  EXPECT_EQ(unit_name(dimension::viscosity), "Pa s");
  EXPECT_EQ(unit_name(dimension::angle), "deg");
  EXPECT_EQ(unit_name(dimension::none), "");
  EXPECT_EQ(unit_name({2, 1, -3, 0}), "m^2 kg s^-3");
  EXPECT_EQ(dimension_name(dimension::viscosity), "dynamic viscosity");
  EXPECT_EQ(dimension_name({2, 1, -3, 0}), "quantity in m^2 kg s^-3");
}

}  // namespace
}  // namespace talus
