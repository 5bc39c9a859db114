// SPDX-License-Identifier: Apache-2.0
/// The numbers of a reference's row, from runs and a list of measures.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "analysis/measure.hpp"

namespace talus {

template <class Run>
class RowValues {
 public:
  /// \param groups the members of each of the row's variants; null where there are none
  RowValues(const ComparisonRow& row, std::vector<const std::vector<Run>*> groups,
            std::span<const Measure<Run>> measures)
      : row_(row), groups_(std::move(groups)), measure_(find_row(measures, row.quantity)) {}

  /// One a variant, or one of two variants together; nothing where the runs are not there, end before the window does,
  /// or are too few. \throws std::out_of_range if there is no such measure, or none of several variants
  std::vector<std::optional<double>> values() const {
    if (row_.from == From::variants) return {of_variants()};
    std::vector<std::optional<double>> values;
    for (const auto* members : groups_) values.push_back(is_there(members) ? of_members(*members) : std::nullopt);
    return values;
  }

  /// Whether the members of each variant are there and go on to the end of the window.
  std::vector<bool> are_there() const {
    std::vector<bool> there;
    for (const auto* members : groups_) there.push_back(is_there(members));
    return there;
  }

 private:
  bool is_there(const std::vector<Run>* members) const {
    const Window& window = row_.window;
    const double last = window.at.value_or(std::isfinite(window.to) ? window.to : window.from);
    return members && !members->empty() && std::all_of(members->begin(), members->end(), [&](const Run& run) {
             return !std::isfinite(last) || run.reaches(last);
           });
  }

  double of_run(const Run& run) const {
    if (!measure_) throw std::out_of_range("'" + row_.quantity + "' is no measure of such a run");
    return measure_->estimator.of(run, row_.window);
  }

  std::optional<double> of_members(const std::vector<Run>& members) const {
    if (row_.from == From::parameters) return of_run(members.front());
    if (row_.statistic == Statistic::standard_deviation && members.size() < 2) return std::nullopt;
    return of_each(members, row_.statistic);
  }

  double of_each(const std::vector<Run>& members, Statistic statistic) const {
    std::vector<double> numbers;
    for (const Run& member : members) numbers.push_back(of_run(member));
    return evaluate_members(statistic, std::move(numbers), measure_->may_be_missing);
  }

  std::optional<double> of_variants() const {
    if (!std::all_of(groups_.begin(), groups_.end(), [&](const auto* members) { return is_there(members); }))
      return std::nullopt;
    if (row_.statistic != Statistic::ratio && row_.statistic != Statistic::difference)
      throw std::out_of_range("'" + row_.quantity + "' is a measure of one run: of variants, its ratio or difference");
    std::vector<double> numbers;
    for (const auto* members : groups_) numbers.push_back(of_each(*members, Statistic::mean));
    return evaluate(row_.statistic, numbers);
  }

  const ComparisonRow& row_;
  std::vector<const std::vector<Run>*> groups_;
  const Measure<Run>* measure_;
};

}  // namespace talus
