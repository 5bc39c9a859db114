// SPDX-License-Identifier: Apache-2.0
#include "analysis/comparison.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "analysis/statistics.hpp"

namespace talus {

namespace {

bool holds(const Criterion& criterion, double value) {
  switch (criterion.kind) {
    case Criterion::Kind::between:
      return value >= criterion.first && value <= criterion.second;
    case Criterion::Kind::within:
      return std::abs(value - criterion.first) <= criterion.second;
    case Criterion::Kind::above:
      return value > criterion.first;
    case Criterion::Kind::below:
      return value < criterion.first;
    case Criterion::Kind::positive:
      return value > 0;
    case Criterion::Kind::negative:
      return value < 0;
    case Criterion::Kind::reported:
      break;
  }
  return true;
}

}  // namespace

Verdict judge(const Criterion& criterion, std::optional<double> value) {
  if (criterion.kind == Criterion::Kind::reported) return Verdict::reported;
  if (!value) return Verdict::not_evaluated;
  return holds(criterion, *value) ? Verdict::met : Verdict::not_met;
}

Verdict judge(const Criterion& criterion, std::span<const std::optional<double>> values) {
  if (criterion.kind == Criterion::Kind::reported) return Verdict::reported;
  auto any = [&](Verdict verdict) {
    return std::any_of(values.begin(), values.end(),
                       [&](const auto& value) { return judge(criterion, value) == verdict; });
  };
  if (any(Verdict::not_met)) return Verdict::not_met;
  return any(Verdict::met) ? Verdict::met : Verdict::not_evaluated;
}

std::string to_string(const Criterion& criterion) {
  switch (criterion.kind) {
    case Criterion::Kind::between:
      return criterion.first == criterion.second ? fmt::format("{:g}", criterion.first)
                                                 : fmt::format("{:g} to {:g}", criterion.first, criterion.second);
    case Criterion::Kind::within:
      return fmt::format("{:g} ± {:g}", criterion.first, criterion.second);
    case Criterion::Kind::above:
      return fmt::format("> {:g}", criterion.first);
    case Criterion::Kind::below:
      return fmt::format("< {:g}", criterion.first);
    case Criterion::Kind::positive:
      return "positive";
    case Criterion::Kind::negative:
      return "negative";
    case Criterion::Kind::reported:
      break;
  }
  return "reported";
}

std::string to_string(Verdict verdict) {
  switch (verdict) {
    case Verdict::met:
      return "met";
    case Verdict::not_met:
      return "not met";
    case Verdict::reported:
      return "reported";
    case Verdict::not_evaluated:
      break;
  }
  return "not evaluated";
}

double evaluate(Statistic statistic, std::span<const double> numbers) {
  switch (statistic) {
    case Statistic::mean:
      return mean(numbers);
    case Statistic::median:
      return median(numbers);
    case Statistic::standard_deviation:
      return standard_deviation(numbers);
    case Statistic::ratio:
    case Statistic::difference:
      break;
  }
  if (numbers.size() != 2) throw std::invalid_argument("a ratio and a difference are of two variants");
  return statistic == Statistic::ratio ? numbers[0] / numbers[1] : numbers[0] - numbers[1];
}

namespace {

/// Without those that are nan, as long as these are the fewer; else none at all.
std::vector<double> finite_values(std::vector<double> numbers) {
  const std::size_t members = numbers.size();
  std::erase_if(numbers, [](double number) { return std::isnan(number); });
  if (2 * numbers.size() < members) numbers.clear();
  return numbers;
}

std::optional<double> value_of_variant(const ComparisonRow& row, const std::vector<std::optional<double>>& members,
                                       bool may_be_missing) {
  if (members.empty() || std::any_of(members.begin(), members.end(), [](const auto& one) { return !one; }))
    return std::nullopt;
  std::vector<double> numbers;
  for (const std::optional<double>& member : members) numbers.push_back(*member);
  if (row.from != From::each && row.from != From::variants) return numbers.front();
  if (row.statistic == Statistic::standard_deviation && numbers.size() < 2) return std::nullopt;
  if (may_be_missing) numbers = finite_values(std::move(numbers));
  return numbers.empty() ? std::nan("") : evaluate(is_of_two(row.statistic) ? Statistic::mean : row.statistic, numbers);
}

}  // namespace

std::vector<std::optional<double>> row_values(const ComparisonRow& row, const RowNumbers& numbers) {
  std::vector<std::optional<double>> values;
  for (const auto& members : numbers.of_variants)
    values.push_back(value_of_variant(row, members, numbers.may_be_missing));
  if (row.from != From::variants) return values;
  if (!is_of_two(row.statistic)) return {values.empty() ? std::nullopt : values.front()};
  if (std::any_of(values.begin(), values.end(), [](const auto& value) { return !value; })) return {std::nullopt};
  std::vector<double> of_both;
  for (const std::optional<double>& value : values) of_both.push_back(*value);
  return {evaluate(row.statistic, of_both)};
}

}  // namespace talus
