// SPDX-License-Identifier: Apache-2.0
/// A row of a comparison with what a source prints: which quantity, where and when, and the criterion that a value
/// meets or not. It uses names only; the lists of measures (measure.hpp) define them. The files are
/// validation/*/reference.toml.
#pragma once

#include <functional>
#include <limits>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace talus {

struct Criterion {
  enum class Kind {
    between,   ///< first <= value <= second
    within,    ///< |value - first| <= second
    above,     ///< value > first
    below,     ///< value < first
    positive,  ///< value > 0: the source says a sign only
    negative,  ///< value < 0
    reported   ///< shown, counts neither way
  };
  Kind kind = Kind::reported;
  double first = 0;
  double second = 0;
};

enum class Verdict { met, not_met, reported, not_evaluated };

/// \param value nothing: the runs it needs are not there (not_evaluated, unless reported); nan: it has no value (not
/// met)
Verdict judge(const Criterion& criterion, std::optional<double> value);

/// A row for several variants is judged in those that are present: not met if it is not met in one, met if it is met in
/// all of them, not evaluated if there are none.
Verdict judge(const Criterion& criterion, std::span<const std::optional<double>> values);

/// "30 to 70", "17.2 ± 2", "> 0.9", "positive", "reported".
std::string to_string(const Criterion& criterion);
/// "met", "not met", "reported", "not evaluated".
std::string to_string(Verdict verdict);

/// The time window of a quantity, in the time unit of the reference (a/v_s).
struct Window {
  static constexpr double end_of_run = std::numeric_limits<double>::infinity();

  std::optional<double> at = {};  ///< the data nearest to this time, of two the earlier; or
  double from = 0;                ///< from < t
  double to = end_of_run;         ///< t <= to
};

/// Where a measure is taken: lengths by name, m. A row of a reference brings them: place = { height = "120 mm" }.
using Place = std::map<std::string, double, std::less<>>;

/// From what a number is made.
enum class From {
  each,       ///< the number of each member, then a statistic over the members
  curves,     ///< the members' series together
  values,     ///< the values of all members in one sample
  variants,   ///< several variants of the case together
  parameters  ///< the case alone ("case" in the file)
};

enum class Statistic {
  mean,
  median,
  standard_deviation,
  ratio,      ///< of the first of two variants over the second
  difference  ///< the first less the second
};

/// The statistic of numbers, one per member; nan as those of statistics.hpp. Ratio and difference take two, one per
/// variant.
double evaluate(Statistic statistic, std::span<const double> numbers);

struct ComparisonRow {
  std::string id = {};
  int line = 0;           ///< in the file
  bool of_study = false;  ///< the quantity is one of the study's measures.py, not of the program's list
  int number = 0;         ///< the group of rows it belongs to
  std::string quantity = {};
  std::string case_name = {};
  std::vector<std::string> variants = {};
  std::string estimator = {};
  From from = From::each;
  Statistic statistic = Statistic::mean;
  Window window = {};
  Place place = {};
  std::string printed = {};
  std::string unit = {};
  Criterion criterion = {};
  std::string source = {};
};

/// The numbers from which a row is made: of each variant one a member, or one of all its members; or one of all
/// variants together. A list is empty where the runs are not there, a number nothing where it could not be evaluated.
struct RowNumbers {
  std::vector<std::vector<std::optional<double>>> of_variants = {};
  bool may_be_missing = false;  ///< members whose number is nan are left out while they are the fewer
};

/// Of two variants.
inline bool is_of_two(Statistic statistic) {
  return statistic == Statistic::ratio || statistic == Statistic::difference;
}

/// One a variant of the row, or one alone of From::variants; nothing where numbers are not there or too few.
/// \throws std::invalid_argument for a ratio or difference that is not of two variants
std::vector<std::optional<double>> row_values(const ComparisonRow& row, const RowNumbers& numbers);

}  // namespace talus
