// SPDX-License-Identifier: Apache-2.0
#include "base/decimal.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <string>

namespace talus {
namespace {

/// What is taken from the front of a text, and what is left.
std::string taken(std::string_view text) {
  const auto decimal = take_decimal(text);
  return (decimal ? to_string(*decimal) : "nothing") + "|" + std::string(text);
}

TEST(Decimal, IsTakenFromTheFront) {
  EXPECT_EQ(taken("12.50 mm"), "12.5| mm");
  EXPECT_EQ(taken("-.5"), "-0.5|");
  EXPECT_EQ(taken("+2."), "2|");
  EXPECT_EQ(taken("1.82e-5Pa"), "1.82e-05|Pa");
  EXPECT_EQ(taken("5e"), "5|e");
  EXPECT_EQ(taken("5e+x"), "5|e+x");
  EXPECT_EQ(taken("5 e3"), "5| e3");
  EXPECT_EQ(taken("007"), "7|");
  EXPECT_EQ(taken("1.2.3"), "1.2|.3");
  for (const char* text : {"", "m", "-", ".", "e5", "+-5", "nan"})
    EXPECT_EQ(taken(text), "nothing|" + std::string(text));
}

TEST(Decimal, IsWrittenPositionallyWhereThatIsShort) {
  const auto text = [](std::string digits, int exponent) { return to_string(Decimal{digits, exponent}); };
  EXPECT_EQ(text("1", -4), "0.0001");
  EXPECT_EQ(text("1", -5), "1e-05");
  EXPECT_EQ(text("15", -6), "1.5e-05");
  EXPECT_EQ(text("15", -1), "1.5");
  EXPECT_EQ(text("15", 3), "15000");
  EXPECT_EQ(text("1", 15), "1000000000000000");
  EXPECT_EQ(text("1", 16), "1e+16");
  EXPECT_EQ(text("1234", 200), "1.234e+203");
  EXPECT_EQ(text("00120", -2), "1.2");
  EXPECT_EQ(text("000", 7), "0");
}

TEST(Decimal, MultipliesExactly) {
  const Decimal nines{std::string(40, '9')};
  EXPECT_EQ((nines * nines).digits, fmt::format("{:9<39}8{:0<39}1", "", ""));
  EXPECT_EQ(to_string(Decimal{"25", -1, true} * Decimal{"4", 3}), "-10000");
}

TEST(Decimal, RoundsHalfAwayFromZero) {
  const auto text = [](std::string digits, std::size_t count) { return to_string(rounded(Decimal{digits}, count)); };
  EXPECT_EQ(text("25", 1), "30");
  EXPECT_EQ(text("24", 1), "20");
  EXPECT_EQ(text("1249", 2), "1200");
  EXPECT_EQ(text("1996", 3), "2000");
  EXPECT_EQ(text("9996", 3), "10000");
  EXPECT_EQ(text("12", 5), "12");
  EXPECT_EQ(text("0012", 1), "10");
}

TEST(Decimal, BecomesTheNearestDouble) {
  EXPECT_EQ(to_double({"1", -1}), 0.1);
  EXPECT_EQ(to_double({"9007199254740993", 0}), 9007199254740992.0);         // a tie goes to even
  EXPECT_EQ(to_double({"9007199254740993000001", -6}), 9007199254740994.0);  // just above the tie
  EXPECT_EQ(to_double({"5", -324}), 4.9406564584124654e-324);
  EXPECT_FALSE(to_double({"1", 400}));
  EXPECT_FALSE(to_double({"1", -400}));
  EXPECT_EQ(to_double({"0", -400}), 0.0);
  EXPECT_EQ(to_string(to_decimal(0.1)), "0.1000000000000000055511151231257827021182");
  EXPECT_EQ(to_string(shortest_decimal(0.1)), "0.1");
}

}  // namespace
}  // namespace talus
