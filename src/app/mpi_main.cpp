// SPDX-License-Identifier: Apache-2.0
/// The program `talus-mpi`: as many processes as mpirun or srun starts.
#include <csignal>
#include <cstdio>

#include "app/program.hpp"
#include "ranks/petsc/petsc.hpp"

int main(int argc, char** argv) {
  const std::unique_ptr<talus::Ranks> ranks = talus::mpi_processes();
  if (!ranks->is_first()) {
    // The first process speaks for all, and has them stop where it does.
    if (std::freopen("/dev/null", "w", stdout) == nullptr) return 1;
    for (const int signal : {SIGINT, SIGTERM, SIGUSR1}) std::signal(signal, SIG_IGN);
  }
  return ranks->value_from_first(talus::app::run_command_line(argc, argv, *ranks));
}
