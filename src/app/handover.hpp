// SPDX-License-Identifier: Apache-2.0
/// `mpirun -n 8 talus run CASE.toml`: `talus` itself is one process, and hands over to `talus-mpi` beside it.
#pragma once

#include <optional>

namespace talus::app {

/// How many processes were started with this one, itself among them, by what Open MPI, MPICH and Slurm say.
int started_processes();

/// Where mpirun or srun has started several processes of `talus run`, becomes `talus-mpi` and does not return.
/// \returns nothing if this process is to run by itself; else the exit status of what kept it from that, which the
/// first process has said on stderr
std::optional<int> hand_over(int argc, char** argv);

}  // namespace talus::app
