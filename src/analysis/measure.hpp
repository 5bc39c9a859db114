// SPDX-License-Identifier: Apache-2.0
/// A measure: a name, a unit, what it means, and the function that makes the number from a run and a window of
/// time. Each is one row of one list, hopper_measures() or avalanche_measures(); the summary of a run, its table of
/// snapshots, the rows of a reference and docs/quantities.md follow from the lists.
#pragma once

#include <cstddef>
#include <functional>
#include <limits>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "analysis/curve.hpp"
#include "numerics/run_record.hpp"

namespace talus {

/// The time window of a quantity, in the time unit of the reference (a/v_s).
struct Window {
  static constexpr double end_of_run = std::numeric_limits<double>::infinity();

  std::optional<double> at = {};  ///< the data nearest to this time, of two the earlier; or
  double from = 0;                ///< from < t
  double to = end_of_run;         ///< t <= to
};

/// The numbers of the snapshots of a run, each made when it is first asked for and then remembered.
template <class Snapshot>
class SnapshotNumbers {
 public:
  /// A number of one snapshot; nan where it has no meaning.
  using Number = double (*)(const Snapshot& snapshot);
  using Value = std::function<double(std::size_t n, Number number)>;

  SnapshotNumbers() = default;
  /// \param time of each snapshot, rising \param value the number of the n-th
  SnapshotNumbers(std::vector<double> time, Value value) : time_(std::move(time)), memory_(std::make_shared<Memory>()) {
    memory_->value = std::move(value);
  }
  /// \param load reads the n-th snapshot \param kept how many are kept in memory
  static SnapshotNumbers of(std::vector<double> time,
                            std::function<std::shared_ptr<const Snapshot>(std::size_t n)> load, std::size_t kept) {
    auto loaded = std::make_shared<std::map<std::size_t, std::shared_ptr<const Snapshot>>>();
    return {std::move(time), [=](std::size_t n, Number number) {
              if (!loaded->contains(n)) {
                if (loaded->size() >= kept) loaded->erase(loaded->begin());
                loaded->emplace(n, load(n));
              }
              return number(*loaded->at(n));
            }};
  }

  const std::vector<double>& time() const { return time_; }

  double value(std::size_t n, Number number) const {
    const auto [found, is_new] = memory_->numbers.try_emplace({n, number});
    if (is_new) found->second = memory_->value(n, number);
    return found->second;
  }

  /// The number against time, from snapshot `first` on.
  Curve curve(Number number, std::size_t first = 0) const {
    Curve curve;
    for (std::size_t n = first; n < time_.size(); ++n) {
      curve.time.push_back(time_[n]);
      curve.value.push_back(value(n, number));
    }
    return curve;
  }

 private:
  struct Memory {
    Value value;
    std::map<std::pair<std::size_t, Number>, double> numbers;
  };
  std::vector<double> time_;
  std::shared_ptr<Memory> memory_;
};

/// How a measure makes its number from a run.
template <class Run>
struct Estimator {
  using Number = typename SnapshotNumbers<typename Run::Snapshot>::Number;
  std::function<double(const Run& run, const Window& window)> of;
  Number number = nullptr;  ///< of a snapshot, if the measure is one number of a snapshot, or a mean or extreme of it
};

/// Where a summary lists a measure: in runs to which it applies, over that window.
template <class Run>
struct InSummary {
  bool (*applies)(const Run& run);
  Window (*window)(const Run& run) = nullptr;  ///< null: the whole run, and its end
};

template <class Run>
struct Measure {
  Measure(std::string_view its_name, std::string_view its_unit, std::string_view its_text, Estimator<Run> its_estimator,
          InSummary<Run> listed, bool can_be_missing = false)
      : name(its_name),
        unit(its_unit),
        text(its_text),
        estimator(std::move(its_estimator)),
        in_summary(listed),
        may_be_missing(can_be_missing) {}

  std::string_view name;
  std::string_view unit;  ///< SI; "deg" for angles, "1" for numbers
  std::string_view text;
  Estimator<Run> estimator;
  InSummary<Run> in_summary;
  bool may_be_missing;  ///< members of an ensemble that have no such number are left out while they are the fewer
};

/// What a table or a document says of a measure.
struct MeasureText {
  std::string_view name, unit, text;
  bool may_be_missing;
};
/// All measures of a model.
std::vector<MeasureText> texts_of_hopper_measures();
std::vector<MeasureText> texts_of_avalanche_measures();
inline std::vector<MeasureText> all_measures() {
  std::vector<MeasureText> texts = texts_of_hopper_measures();
  for (const MeasureText& text : texts_of_avalanche_measures()) texts.push_back(text);
  return texts;
}
/// Of any model; nothing if there is no such measure.
inline std::optional<MeasureText> find_measure(std::string_view name) {
  for (const MeasureText& text : all_measures())
    if (text.name == name) return text;
  return std::nullopt;
}

template <class Run>
std::vector<MeasureText> texts_of(std::span<const Measure<Run>> measures) {
  std::vector<MeasureText> texts;
  for (const auto& m : measures) texts.push_back({m.name, m.unit, m.text, m.may_be_missing});
  return texts;
}

/// What summary.json lists of a run.
template <class Run>
std::vector<NamedValue> summary_of(const Run& run, std::span<const Measure<Run>> measures) {
  std::vector<NamedValue> summary;
  for (const Measure<Run>& m : measures)
    if (m.in_summary.applies(run))
      summary.push_back({std::string(m.name), std::string(m.unit),
                         m.estimator.of(run, m.in_summary.window ? m.in_summary.window(run) : Window{})});
  return summary;
}

/// The measures that are numbers of a snapshot: the columns of a run's table of snapshots.
template <class Run>
std::vector<Measure<Run>> columns_of_snapshots(std::span<const Measure<Run>> measures) {
  std::vector<Measure<Run>> columns;
  for (const Measure<Run>& m : measures)
    if (m.estimator.number) columns.push_back(m);
  return columns;
}

template <class Row>
const Row* find_row(std::span<const Row> rows, std::string_view name) {
  for (const Row& row : rows)
    if (row.name == name) return &row;
  return nullptr;
}

}  // namespace talus
