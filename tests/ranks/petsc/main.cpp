// SPDX-License-Identifier: Apache-2.0
#include <gtest/gtest.h>

#include "ranks/petsc/petsc.hpp"
#include "ranks/petsc/processes.hpp"

namespace talus {
namespace {
const Ranks* all = nullptr;
}
const Ranks& processes() {
  return *all;
}
}  // namespace talus

int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const auto ranks = talus::mpi_processes();
  talus::all = ranks.get();
  if (!ranks->is_first())
    delete testing::UnitTest::GetInstance()->listeners().Release(
        testing::UnitTest::GetInstance()->listeners().default_result_printer());
  const int failed = RUN_ALL_TESTS();
  return talus::sum_of(*ranks, failed != 0) == 0 ? 0 : 1;
}
