// SPDX-License-Identifier: Apache-2.0
/// The program `talus`: one process.
#include "app/handover.hpp"
#include "app/program.hpp"

int main(int argc, char** argv) {
  if (const auto status = talus::app::hand_over(argc, argv)) return *status;
  return talus::app::run_command_line(argc, argv, talus::one_process());
}
