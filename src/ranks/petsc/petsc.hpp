// SPDX-License-Identifier: Apache-2.0
/// The processes of an MPI program: messages by PETSc's PetscSF, parts of space by Zoltan's recursive bisection.
#pragma once

#include <memory>

#include "ranks/ranks.hpp"

namespace talus {

/// Starts MPI and PETSc, and ends them with its life. One at a time in a program, and the last thing that ends.
std::unique_ptr<Ranks> mpi_processes();

}  // namespace talus
