// SPDX-License-Identifier: Apache-2.0
#include "app/handover.hpp"

#include <unistd.h>

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

/// Whether more than one process was started with this one: what Open MPI, and the PMI of Slurm and MPICH, say.
/// A batch script of Slurm knows how many tasks its steps will have; it is not one of them.
bool is_one_of_many() {
  return number_in("OMPI_COMM_WORLD_SIZE") > 1 || number_in("PMI_SIZE") > 1 ||
         (std::getenv("PMIX_RANK") && number_in("SLURM_STEP_NUM_TASKS") > 1);
}

bool is_first_of_many() {
  return number_in("OMPI_COMM_WORLD_RANK") == 0 && number_in("PMI_RANK") == 0 && number_in("PMIX_RANK") == 0;
}

}  // namespace

std::optional<int> hand_over(int argc, char** argv) {
  if (argc < 2 || std::string_view(argv[1]) != "run" || !is_one_of_many()) return std::nullopt;
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
