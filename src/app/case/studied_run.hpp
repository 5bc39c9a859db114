// SPDX-License-Identifier: Apache-2.0
/// A run that is compared with a reference, whatever its model.
#pragma once

#include <functional>
#include <memory>
#include <span>
#include <stdexcept>
#include <string>

#include "analysis/measure.hpp"

namespace talus::app {

struct StudiedRun {
  /// \throws std::logic_error if there is no such quantity of such a run, or it has no data for it
  std::function<double(const std::string& quantity, const Window& window)> number;
  std::function<bool(double time)> reaches;  ///< whether it went on to that time
};

/// \param run lives as long as what is returned
template <class Run>
StudiedRun studied(std::shared_ptr<const Run> run, std::span<const Measure<Run>> measures) {
  return {[run, measures](const std::string& quantity, const Window& window) {
            const Measure<Run>* measure = find_row(measures, quantity);
            if (!measure) throw std::out_of_range("'" + quantity + "' is no measure of such a run");
            return measure->estimator.of(*run, window);
          },
          [run](double time) { return run->reaches(time); }};
}

}  // namespace talus::app
