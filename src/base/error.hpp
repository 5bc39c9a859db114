// SPDX-License-Identifier: Apache-2.0
/// The three kinds of failure of a run, each with the information that the user needs to fix it. `app` turns them into
/// exit statuses. The grammar of a message: what is wrong, why or what is allowed, what to try.
#pragma once

#include <cstdint>
#include <stdexcept>
#include <string>
#include <vector>

namespace talus {

/// Exit statuses of every command.
enum class ExitStatus : int { done = 0, not_met = 1, bad_input = 2, numerical = 3, files = 4, interrupted = 130 };

/// \throws std::invalid_argument if what a function asks of its caller does not hold
inline void require(bool condition, const char* what) {
  if (!condition) throw std::invalid_argument(what);
}

/// One fault of the user's input.
struct Problem {
  std::string where = {};    ///< file name, or the option ("--set particles.count=x")
  int line = 0;              ///< 1-based; 0: no line (a missing key, an option)
  int column = 0;            ///< 1-based; 0: not known
  std::string key = {};      ///< dotted key, empty if none
  std::string what = {};     ///< what is wrong
  std::string allowed = {};  ///< what is allowed, empty if `what` says it
  std::string nearest = {};  ///< nearest valid key or choice, empty if none is near
};

/// `case.toml:12: particles.raduis: unknown key; did you mean 'particles.radius'?`
std::string to_string(const Problem& problem);

/// The input is wrong: every problem at once. Exit status 2; nothing has been written.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Problem> problems);
  const std::vector<Problem>& problems() const { return problems_; }

 private:
  std::vector<Problem> problems_;
};

/// Numerical failure: a non-finite value, an impossible overlap, a solver that does not converge. Exit status 3; the
/// last good checkpoint is kept.
class NumericalError : public std::runtime_error {
 public:
  struct Report {
    std::string what;        ///< "velocity is not finite"
    std::string term;        ///< which term of which equation
    std::string place;       ///< which particle or cell, with its position
    std::uint64_t step = 0;  ///< which step
    double time = 0;         ///< s
    std::string advice;      ///< what to try
  };
  explicit NumericalError(Report report);
  const Report& report() const { return report_; }

 private:
  Report report_;
};

/// A file cannot be read or written. Exit status 4; files written before remain intact.
class FileError : public std::runtime_error {
 public:
  /// \param path file or folder; \param what what was attempted and why it failed ("write failed: No space left")
  FileError(std::string path, const std::string& what);
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

}  // namespace talus
