// SPDX-License-Identifier: Apache-2.0
#include "analysis/measure.hpp"

#include <gtest/gtest.h>

#include <set>

namespace talus {
namespace {

TEST(Measures, AreNamedOnce) {
  std::set<std::string_view> names;
  const std::vector<MeasureText> all = all_measures();
  for (const MeasureText& measure : all) {
    EXPECT_TRUE(names.insert(measure.name).second) << measure.name;
    EXPECT_FALSE(measure.text.empty()) << measure.name;
  }
  ASSERT_TRUE(find_measure("overlap_max"));
  EXPECT_EQ(find_measure("overlap_max")->unit, "1");
  EXPECT_FALSE(find_measure("overlaps_max"));
}

}  // namespace
}  // namespace talus
