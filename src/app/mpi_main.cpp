// SPDX-License-Identifier: Apache-2.0
/// The program `talus-mpi`: as many processes as mpirun or srun starts.
#include <csignal>
#include <cstdio>

#include "app/handover.hpp"
#include "app/program.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "ranks/petsc/petsc.hpp"

int main(int argc, char** argv) {
  const std::unique_ptr<talus::Ranks> ranks = talus::mpi_processes();
  if (const int started = talus::app::started_processes(); ranks->size() != started) {
    if (ranks->is_first())
      talus::print_error(
          "talus-mpi: of {} processes {} know of each other; srun --mpi=pmix, or the mpirun of the MPI "
          "that the program was built with\n",
          started, ranks->size());
    return static_cast<int>(talus::ExitStatus::bad_input);
  }
  if (!ranks->is_first()) {
    // The first process speaks for all, and has them stop where it does.
    if (std::freopen("/dev/null", "w", stdout) == nullptr) return 1;
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, SIG_IGN);
  }
  return ranks->value_from_first(talus::app::run_command_line(argc, argv, *ranks));
}
