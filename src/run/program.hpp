// SPDX-License-Identifier: Apache-2.0
/// Other programs as processes of their own.
#pragma once

#include <string>
#include <vector>

namespace talus::run {

struct ProgramEnd {
  int status = 0;              ///< exit status; 128 + signal if it was killed
  std::string output, errors;  ///< stdout and stderr
};

/// Runs a program without input. After a signal to this one (interrupt.hpp) it gets SIGTERM, and its end is waited for.
/// \param arguments the program's path first \throws FileError if the process cannot be made
ProgramEnd run_program(const std::vector<std::string>& arguments);

/// The path of the running program, to start it again.
std::string own_program();

}  // namespace talus::run
