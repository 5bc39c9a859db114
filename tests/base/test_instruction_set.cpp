// SPDX-License-Identifier: Apache-2.0
#include "base/instruction_set.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"

namespace talus {
namespace {

constexpr InstructionSet sets[] = {InstructionSet::avx512, InstructionSet::avx2, InstructionSet::portable};

TEST(InstructionSet, AutomaticIsTheFirstAvailableAndNeverItself) {
  for (const InstructionSet set : sets)
    if (is_available(set)) {
      EXPECT_EQ(resolve(InstructionSet::automatic), set);
      break;
    }
}

TEST(InstructionSet, ResolvesToItselfOrRefusesAndNamesTheOthers) {
  EXPECT_TRUE(is_available(InstructionSet::portable));
  for (const InstructionSet set : sets) {
    if (is_available(set)) {
      EXPECT_EQ(resolve(set), set);
    } else {
      try {
        resolve(set);
        FAIL() << choice_name(set);
      } catch (const InputError& error) {
        EXPECT_THAT(error.what(), testing::HasSubstr(std::string(choice_name(set))));
        EXPECT_THAT(error.what(), testing::HasSubstr("automatic"));
        EXPECT_THAT(error.what(), testing::HasSubstr("portable"));
      }
    }
  }
}

TEST(InstructionSet, HasTheCaseFilesNames) {
  EXPECT_EQ(choice_name(InstructionSet::automatic), "automatic");
  EXPECT_EQ(choice_name(InstructionSet::avx512), "avx512");
  EXPECT_EQ(choice_name(InstructionSet::avx2), "avx2");
  EXPECT_EQ(choice_name(InstructionSet::portable), "portable");
}

}  // namespace
}  // namespace talus
