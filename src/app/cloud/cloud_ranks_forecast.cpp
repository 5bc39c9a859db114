// SPDX-License-Identifier: Apache-2.0
#include "app/cloud/cloud_ranks_forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/cloud/mobility_sum.hpp"
#include "models/cloud/model.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

// Assumed of an ordinary network.
constexpr double of_message = 3e-6;  // s, for each doubling of the processes
constexpr double messages = 3;       // of an evaluation: sums of tasks to rows, number of rows and velocities to all
constexpr double of_byte = 1e-9;     // s
constexpr double libraries = 47e6;   // of talus-mpi, bytes

}  // namespace

Lines forecast_on_ranks(const cloud::Parameters& p, double evaluations, const CloudEvaluation& seconds, int ranks) {
  const auto grains = static_cast<double>(p.particles.count);
  const auto lines = [&](const std::string& shared, double on_each) {
    const double memory = libraries + cloud::memory_of(grains);
    return Lines{{"grains", shared},
                 {"evaluation", fmt::format("{:.3g} ms in place of {:.3g} ms on one process: efficiency {:.2f}",
                                            1e3 * on_each, 1e3 * seconds.all, seconds.all / (ranks * on_each))},
                 {"time", run::format_seconds(evaluations * on_each)},
                 {"memory", fmt::format("{:.0f} MB on each, {:.3g} MB in all", 1e-6 * memory, 1e-6 * ranks * memory)}};
  };
  const std::string all = fmt::format("all {:.0f} on each", grains);
  if (cloud::spectral_accuracy_of(p, grains))
    return lines(all +
                     "; the first process computes the spectral sum, the others wait: threads make it faster, "
                     "processes do not",
                 seconds.all);
  const auto tasks = static_cast<double>(cloud::PairSum::max_tasks(static_cast<std::size_t>(p.particles.count)));
  // Two thirds of the tasks reach a row in the mean.
  const double of_row = 2.0 / 3 * tasks * (p.motion == cloud::Motion::xyz ? 24 : 16);
  const double bytes = grains * (of_row / ranks + 24);
  const double own = std::min(seconds.not_shared, seconds.all);
  return lines(fmt::format("{}; {:.0f} tasks of the sum are shared, by at most as many processors", all, tasks),
               own + (seconds.all - own) * std::ceil(tasks / ranks) / tasks + messages * of_message * std::log2(ranks) +
                   of_byte * bytes);
}

}  // namespace talus::app
