// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/figures_script.hpp"

#include <string>
#include <vector>

#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

namespace {

/// Whether a program ends with status 0.
bool succeeds(std::vector<std::string> arguments, const std::filesystem::path& output) {
  int status = -1;
  run::run_jobs(
      {{.arguments = std::move(arguments), .output = output}}, 1, [&](const run::JobEnd& end) { status = end.status; },
      [] {}, [] { return run::signal_has_come(); });
  return status == 0;
}

}  // namespace

bool run_figures_script(const std::filesystem::path& python, const std::filesystem::path& script,
                        const std::filesystem::path& folder) {
  // -B: nothing is left beside the script.
  return succeeds({python.string(), "-B", script.string(), folder.string()}, folder / "figures.txt");
}

}  // namespace talus::app
