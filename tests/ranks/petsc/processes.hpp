// SPDX-License-Identifier: Apache-2.0
/// The processes of a test program that mpirun starts.
#pragma once

#include "ranks/ranks.hpp"

namespace talus {

const Ranks& processes();

}  // namespace talus
