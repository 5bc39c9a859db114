// SPDX-License-Identifier: Apache-2.0
#include "numerics/run_record.hpp"

#include <gtest/gtest.h>

namespace talus {
namespace {

TEST(Warnings, AreTheLinesThatWarnUnderNamesThatStay) {
  const std::vector<RegimeLine> lines = {{"Mach number", "0.4", "largest speed over that of waves", true},
                                         {"packing", "0.6", "at most 0.74", false},
                                         {"contact over weight (gamma, Eq. 9)", "0.5", "above 1", true}};
  const std::vector<Warning> warnings = warnings_of(lines);
  ASSERT_EQ(warnings.size(), 2u);
  EXPECT_EQ(to_string(warnings[0]), "mach-number: Mach number = 0.4: largest speed over that of waves");
  EXPECT_EQ(warnings[1].id, "contact-over-weight-gamma-eq-9");
}

}  // namespace
}  // namespace talus
