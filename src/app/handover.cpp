// SPDX-License-Identifier: Apache-2.0
#include "app/handover.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <string_view>

#include "base/error.hpp"
#include "base/text.hpp"
#include "run/program.hpp"

namespace talus::app {

namespace {

int number_in(const char* variable) {
  const char* const text = std::getenv(variable);
  return text ? std::atoi(text) : 0;
}

bool is_first_of_many() {
  return number_in("OMPI_COMM_WORLD_RANK") == 0 && number_in("PMI_RANK") == 0 && number_in("PMIX_RANK") == 0 &&
         number_in("SLURM_PROCID") == 0;
}

}  // namespace

int started_processes() {
  return std::max({1, number_in("OMPI_COMM_WORLD_SIZE"), number_in("PMI_SIZE"), number_in("SLURM_STEP_NUM_TASKS")});
}

std::optional<int> hand_over(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "run" || started_processes() == 1) return std::nullopt;
  const std::filesystem::path program = std::filesystem::path(run::own_program()).parent_path() / "talus-mpi";
  execv(program.c_str(), argv);
  if (is_first_of_many())
    print_error("{}\n", to_string(Problem{.where = program.string(),
                                          .what = "cannot be started: several processes of one run need it",
                                          .allowed = "a program built with -DTALUS_MPI=ON (docs/how-to/cluster.md), or "
                                                     "one process: talus run without mpirun or srun"}));
  return static_cast<int>(ExitStatus::bad_input);
}

}  // namespace talus::app
