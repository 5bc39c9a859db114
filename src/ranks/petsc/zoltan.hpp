// SPDX-License-Identifier: Apache-2.0
/// Parts of space by recursive bisection (RCB) of Zoltan. Only for the files of this folder: it knows MPI.
#pragma once

#include <mpi.h>

#include <memory>

#include "ranks/ranks.hpp"

namespace talus {

/// \param communicator outlives it
std::unique_ptr<Partition> recursive_bisection(MPI_Comm communicator);

}  // namespace talus
