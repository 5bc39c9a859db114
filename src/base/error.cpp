// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

#include <fmt/format.h>

#include <utility>

#include "base/text.hpp"

namespace talus {

std::string to_string(const Problem& problem) {
  std::string text = printable(problem.where);
  if (problem.line > 0) text += fmt::format(":{}", problem.line);
  if (problem.column > 0) text += fmt::format(":{}", problem.column);
  if (!text.empty()) text += ": ";
  if (!problem.key.empty()) text += printable(problem.key) + ": ";
  text += printable(problem.what);
  if (!problem.allowed.empty()) text += "; allowed: " + printable(problem.allowed);
  if (!problem.nearest.empty()) text += fmt::format("; did you mean '{}'?", printable(problem.nearest));
  return text;
}

namespace {

std::string join(const std::vector<Problem>& problems) {
  std::string text;
  for (const Problem& problem : problems) {
    if (!text.empty()) text += '\n';
    text += to_string(problem);
  }
  return text;
}

std::string sentence(const NumericalError::Report& report) {
  return fmt::format("{} ({}) at {}, step {}, t = {:.6g} s; try: {}", report.what, report.term, report.place,
                     report.step, report.time, report.advice);
}

}  // namespace

InputError::InputError(std::vector<Problem> problems)
    : std::runtime_error(join(problems)), problems_(std::move(problems)) {}

NumericalError::NumericalError(Report report) : std::runtime_error(sentence(report)), report_(std::move(report)) {}

FileError::FileError(std::string path, const std::string& what)
    : std::runtime_error(printable(path + ": " + what)), path_(std::move(path)) {}

}  // namespace talus
