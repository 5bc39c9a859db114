// SPDX-License-Identifier: Apache-2.0
/// The program: parses the command line, runs one command, and turns errors into messages and exit statuses.
#pragma once

#include "ranks/ranks.hpp"

namespace talus::app {

/// \param ranks the processes that run a case together; of several, the others than the first only follow it in `run`
/// and say nothing \returns the exit status, of several processes that of the first one
int run_command_line(int argc, char** argv, const Ranks& ranks);

}  // namespace talus::app
