// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_reader.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "base/nearest.hpp"
#include "base/unit.hpp"

namespace talus {

namespace {

/// A value as it was written, for messages; long text is cut.
std::string given(const CaseValue& value) {
  struct Describe {
    std::string operator()(bool flag) const { return flag ? "true" : "false"; }
    std::string operator()(std::int64_t integer) const { return fmt::format("{}", integer); }
    std::string operator()(double number) const { return number_text(number); }
    std::string operator()(const std::string& text) const {
      constexpr std::size_t longest = 60;
      return quoted(text.size() > longest ? text.substr(0, longest) + "..." : text);
    }
    std::string operator()(const std::vector<CaseValue>& values) const {
      const bool tables = !values.empty() && std::holds_alternative<CaseTable>(values.front().value);
      return tables ? "an array of tables" : "an array";
    }
    std::string operator()(const CaseTable&) const { return "a table"; }
    std::string operator()(const CaseDate& date) const { return fmt::format("the date {}", date.text); }
  };
  return std::visit(Describe{}, value.value);
}

/// Why a value cannot be taken.
struct Fault {
  std::string what;
  std::string nearest = {};
};

/// Converts values of the file to the type of a parameter; the first fault is left in `fault`.
class Converter {
 public:
  Converter(const Parameter& parameter, const ValueType& type) : parameter_(parameter), type_(type) {}
  const Fault& fault() const { return fault_; }

  std::optional<ParameterValue> convert(const CaseEntry& entry) {
    if (type_.shape != ValueType::Shape::one) return wrap(numbers(entry.value));
    switch (type_.kind) {
      case ValueType::Kind::number:
        return wrap(number(entry.value));
      case ValueType::Kind::integer:
        return wrap(integer(entry.value));
      case ValueType::Kind::flag:
        if (const bool* flag = std::get_if<bool>(&entry.value.value)) return *flag;
        return wrong_type(entry.value);
      case ValueType::Kind::text:
        if (const auto* text = std::get_if<std::string>(&entry.value.value)) return *text;
        if (entry.is_option && !entry.raw.empty()) return entry.raw;  // --set title=2024
        return wrong_type(entry.value);
      case ValueType::Kind::choice:
        return wrap(choice(entry.value));
    }
    return std::nullopt;
  }

 private:
  template <class T>
  static std::optional<ParameterValue> wrap(std::optional<T> value) {
    if (!value) return std::nullopt;
    return ParameterValue{std::move(*value)};
  }

  std::nullopt_t fail(std::string what, std::string nearest = {}) {
    fault_ = {std::move(what), std::move(nearest)};
    return std::nullopt;
  }

  std::nullopt_t wrong_type(const CaseValue& value) {
    if (const auto* text = std::get_if<std::string>(&value.value)) {
      const auto number = parse_quantity(*text);
      const bool meant = type_.kind == ValueType::Kind::flag ? *text == "true" || *text == "false"
                                                             : number && number->dimension == dimension::none;
      if (meant) return fail(fmt::format("{} is text; write it without quotes", given(value)));
    }
    return fail(fmt::format("{} is not {}", given(value), type_text(parameter_, type_)));
  }

  std::optional<double> number(const CaseValue& value) {
    std::optional<double> result;
    if (const auto* text = std::get_if<std::string>(&value.value))
      result = quantity(*text);
    else if (const auto* whole = std::get_if<std::int64_t>(&value.value))
      result = plain(static_cast<double>(*whole), value);
    else if (const auto* real = std::get_if<double>(&value.value))
      result = plain(*real, value);
    else
      return fail(fmt::format("{} is not {}", given(value), type_text(parameter_, {})));
    if (result && !parameter_.range.contains(*result)) return fail(fmt::format("{} is out of range", given(value)));
    return result;
  }

  std::optional<double> plain(double value, const CaseValue& written) {
    if (!std::isfinite(value)) return fail(fmt::format("{} is not a finite number", given(written)));
    if (parameter_.dimension != dimension::none) return fail(fmt::format("{} has no unit", given(written)));
    return value;
  }

  std::optional<double> quantity(const std::string& text) {
    const std::string written = given({text});
    std::string why;
    const std::optional<Quantity> read = parse_quantity(text, &why);
    if (!read) return fail(fmt::format("{} {}", written, why));
    if (parameter_.dimension == dimension::none) {
      if (read->dimension == dimension::none) return wrong_type({text});
      return fail(fmt::format("{} has a unit where a plain number is due", written));
    }
    if (read->dimension == dimension::none) return fail(fmt::format("{} has no unit", written));
    if (read->dimension != parameter_.dimension)
      return fail(fmt::format("{} is not {} but {}", written, type_text(parameter_, {}),
                              type_text({.key = {}, .dimension = read->dimension, .text = {}}, {})));
    return read->value;
  }

  std::optional<std::int64_t> integer(const CaseValue& value) {
    constexpr double exact = 9007199254740992;  // 2^53: up to here a double is the whole number that was written
    std::optional<std::int64_t> whole;
    if (const auto* written = std::get_if<std::int64_t>(&value.value)) whole = *written;
    if (const auto* real = std::get_if<double>(&value.value))  // 1e6
      if (std::abs(*real) <= exact && *real == std::floor(*real)) whole = static_cast<std::int64_t>(*real);
    if (!whole) return wrong_type(value);
    if (!parameter_.range.contains(static_cast<double>(*whole)))
      return fail(fmt::format("{} is out of range", given(value)));
    return whole;
  }

  std::optional<std::string> choice(const CaseValue& value) {
    const auto* text = std::get_if<std::string>(&value.value);
    if (text && std::find(type_.choices.begin(), type_.choices.end(), *text) != type_.choices.end()) return *text;
    return fail(fmt::format("{} is not {}", given(value), type_text(parameter_, type_)),
                text ? std::string(nearest(*text, type_.choices)) : std::string());
  }

  std::optional<std::vector<double>> numbers(const CaseValue& value) {
    const auto* values = std::get_if<std::vector<CaseValue>>(&value.value);
    if (!values) return fail(fmt::format("{} is not {}", given(value), type_text(parameter_, type_)));
    if (type_.shape == ValueType::Shape::three && values->size() != 3)
      return fail(fmt::format("has {} value{} and not 3", values->size(), values->size() == 1 ? "" : "s"));
    std::vector<double> result;
    for (const CaseValue& element : *values) {
      const auto one = number(element);
      if (!one) return fail(fmt::format("value {}: {}", result.size() + 1, fault_.what));
      result.push_back(*one);
    }
    return result;
  }

  const Parameter& parameter_;
  const ValueType& type_;
  Fault fault_;
};

/// Whether the words of a message name this key: whole, not as a part of a longer one.
bool names_key(std::string_view words, std::string_view key) {
  const auto in_key = [&](std::size_t i) {
    return i < words.size() && (std::isalnum(static_cast<unsigned char>(words[i])) || words[i] == '_');
  };
  for (std::size_t at = words.find(key); at != std::string_view::npos; at = words.find(key, at + 1))
    if (!in_key(at - 1) && !in_key(at + key.size())) return true;
  return false;
}

/// The key that an unknown one was probably meant to be. Its last part must be near; its table may be near, or quite
/// another one if the last part is nearer still.
std::string_view nearest_key(std::string_view word, const std::vector<std::string>& keys) {
  const std::string_view last = last_part(word), table = table_of(word);
  constexpr std::size_t other_table = 10;
  std::string_view best;
  std::size_t least = std::string_view::npos;
  for (const std::string& key : keys) {
    const auto key_slips = slips(last, last_part(key));
    if (!key_slips) continue;
    const auto table_slips = slips(table, table_of(key));
    if (!table_slips && *key_slips > last.size() / 4) continue;
    const std::size_t score = *key_slips + table_slips.value_or(other_table);
    if (score < least) best = key, least = score;
  }
  return best;
}

}  // namespace

ParameterReader::ParameterReader(const CaseFile& file) : file_(file) {
  for (const Problem& problem : file.problems()) found_.push_back({problem, false, true});
}

std::optional<ParameterValue> ParameterReader::read(const Parameter& parameter, const ValueType& type) {
  keys_.emplace_back(parameter.key);
  const CaseEntry* entry = file_.find(parameter.key);
  if (!entry) {
    if (parameter.required)
      found_.push_back({{.where = file_.name(),
                         .key = std::string(parameter.key),
                         .what = "missing",
                         .allowed = allowed_text(parameter, type)},
                        true});
    return std::nullopt;
  }
  Converter converter(parameter, type);
  auto value = converter.convert(*entry);
  if (!value) add(*entry, converter.fault().what, allowed_text(parameter, type), converter.fault().nearest);
  return value;
}

void ParameterReader::check(std::vector<Problem> contradictions) {
  const std::size_t known = found_.size();
  for (Problem& problem : contradictions) {
    const bool follows =
        std::any_of(found_.begin(), found_.begin() + static_cast<std::ptrdiff_t>(known), [&](const Found& found) {
          const std::string& key = found.problem.key;
          return !key.empty() &&
                 (key == problem.key || names_key(problem.what, key) || names_key(problem.allowed, key));
        });
    if (follows) continue;
    const CaseEntry* entry = file_.find(problem.key);
    problem.where = entry ? entry->where : file_.name();
    problem.line = entry ? entry->line : 0;
    found_.push_back({std::move(problem), !entry, entry && entry->is_option});
  }
}

void ParameterReader::finish() {
  report_unknown_keys();
  std::erase_if(found_, [&](const Found& found) { return found.is_missing && meant_.contains(found.problem.key); });
  raise();
}

void ParameterReader::raise() const {
  if (found_.empty()) return;
  std::vector<Found> sorted = found_;
  const auto rank = [](const Found& found) { return found.is_option ? 2 : found.problem.line == 0 ? 1 : 0; };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Found& a, const Found& b) {
    return std::pair(rank(a), a.problem.line) < std::pair(rank(b), b.problem.line);
  });
  std::vector<Problem> problems;
  for (Found& found : sorted) problems.push_back(std::move(found.problem));
  throw InputError(std::move(problems));
}

void ParameterReader::add(const CaseEntry& entry, std::string what, std::string allowed, std::string nearest) {
  found_.push_back({{.where = entry.where,
                     .line = entry.line,
                     .key = entry.key,
                     .what = std::move(what),
                     .allowed = std::move(allowed),
                     .nearest = std::move(nearest)},
                    false,
                    entry.is_option});
}

bool ParameterReader::is_table(std::string_view key) const {
  return std::any_of(keys_.begin(), keys_.end(), [&](const std::string& known) { return lies_in(known, key); });
}

void ParameterReader::report_unknown_keys() {
  std::vector<std::string_view> closed;  // what lies in these is reported with them; an option is, for itself
  for (const CaseEntry& entry : file_.entries()) {
    const bool is_table_here = std::holds_alternative<CaseTable>(entry.value.value);
    const auto holds_it = [&](std::string_view table) { return lies_in(entry.key, table); };
    if (!entry.is_option && std::any_of(closed.begin(), closed.end(), holds_it)) continue;
    if (std::find(keys_.begin(), keys_.end(), entry.key) != keys_.end()) {
      closed.push_back(entry.key);
    } else if (is_table(entry.key)) {
      if (is_table_here) continue;
      add(entry, fmt::format("{} is not a table", given(entry.value)), fmt::format("a table: [{}]", entry.key));
      for (const std::string& key : keys_)
        if (lies_in(key, entry.key)) meant_.insert(key);
    } else if (is_table_here) {
      std::vector<const CaseEntry*> keys;
      for (const CaseEntry& other : file_.entries())
        if (lies_in(other.key, entry.key) && !std::holds_alternative<CaseTable>(other.value.value) && !other.is_option)
          keys.push_back(&other);
      if (keys.size() == 1 && !nearest_key(keys.front()->key, keys_).empty()) continue;  // the key itself is reported
      report_unknown_table(entry, keys);
      closed.push_back(entry.key);
    } else {
      report_unknown_key(entry);
    }
  }
}

void ParameterReader::report_unknown_table(const CaseEntry& table, const std::vector<const CaseEntry*>& keys) {
  std::vector<std::string_view> tables;
  for (const std::string& key : keys_)
    if (const auto name = table_of(key); !name.empty() && std::find(tables.begin(), tables.end(), name) == tables.end())
      tables.push_back(name);
  std::string_view best = nearest(table.key, tables);
  if (best.empty()) {  // the table that has most of these keys
    std::size_t most = keys.size() / 2;
    for (const std::string_view candidate : tables) {
      const auto has = [&](const CaseEntry* entry) {
        return std::find(keys_.begin(), keys_.end(), fmt::format("{}.{}", candidate, last_part(entry->key))) !=
               keys_.end();
      };
      const auto count = static_cast<std::size_t>(std::count_if(keys.begin(), keys.end(), has));
      if (count > most) best = candidate, most = count;
    }
  }
  for (const CaseEntry* entry : keys) meant_.insert(fmt::format("{}.{}", best, last_part(entry->key)));
  add(table, "unknown table", best.empty() ? fmt::format("[{}]", fmt::join(tables, "], [")) : std::string(),
      std::string(best));
}

void ParameterReader::report_unknown_key(const CaseEntry& entry) {
  std::string_view table = table_of(entry.key);
  const bool in_parameter = std::find(keys_.begin(), keys_.end(), table) != keys_.end();
  const std::string_view best = in_parameter ? table : nearest_key(entry.key, keys_);
  if (!is_table(table)) table = "";
  std::vector<std::string_view> beside;  // the keys of its table, or at the top if there is no such table
  for (const std::string& key : keys_)
    if (best.empty() && table_of(key) == table) beside.push_back(key);
  meant_.emplace(best);
  add(entry, "unknown key", fmt::format("{}", fmt::join(beside, ", ")), std::string(best));
}

}  // namespace talus
