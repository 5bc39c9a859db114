// SPDX-License-Identifier: Apache-2.0
/// A run whose folder is open for analysis: tables, pictures, answers, report and comparisons ask the same one, so that
/// its case and its series are read once and the numbers of its snapshots are made once. Valid while the run does not
/// go on.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "analysis/measure.hpp"
#include "app/case/scene.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

class OpenedRun {
 public:
  /// Bytes of a run's snapshots that are kept in memory while they are measured, about: at the end of a run, whose
  /// numbers are made snapshot by snapshot, and in a comparison, whose rows ask for the same snapshots again and again.
  static constexpr std::size_t one_by_one = 16'000'000, many_times = 256'000'000;

  explicit OpenedRun(std::filesystem::path folder) : folder_(std::move(folder)) {}
  OpenedRun(const OpenedRun&) = delete;
  OpenedRun& operator=(const OpenedRun&) = delete;
  virtual ~OpenedRun() = default;

  const std::filesystem::path& folder() const { return folder_; }

  /// Writes its tables and returns the quantities of its summary. \throws FileError
  virtual std::vector<NamedValue> analyse() = 0;
  /// Draws its pictures and returns their paths, the most important one first. \throws FileError
  virtual std::vector<std::filesystem::path> draw() { return {}; }
  /// Its key results. \pre analyse() has been called, now or before \throws FileError
  virtual std::vector<Answer> answers(const std::vector<NamedValue>& /*quantities*/) { return {}; }
  /// The time at which a picture says most of it, in the time of its report; nothing: the middle of it.
  virtual std::optional<double> telling_time() { return std::nullopt; }
  /// What stands around its particles, for a viewer.
  virtual Scene scene() = 0;

  /// Whether it went on to that time.
  virtual bool reaches(double /*time*/) { return true; }
  /// A quantity over a window. \throws std::logic_error if there is none of such a run, or it has no data for it
  virtual double number(const std::string& quantity, const Window& /*window*/) {
    throw std::out_of_range("'" + quantity + "' is no measure of such a run");
  }

 protected:
  template <class Run>
  static double number_of(const Run& run, std::span<const Measure<Run>> measures, const std::string& quantity,
                          const Window& window) {
    const Measure<Run>* measure = find_row(measures, quantity);
    if (!measure) throw std::out_of_range("'" + quantity + "' is no measure of such a run");
    return measure->estimator.of(run, window);
  }

 private:
  std::filesystem::path folder_;
};

}  // namespace talus::app
