// SPDX-License-Identifier: Apache-2.0
#include "io/points_csv.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <iterator>
#include <optional>

#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/atomic_file.hpp"

namespace talus {

namespace {

constexpr std::size_t most_problems = 20;

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"") + 1 - begin);
}

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> entries;
  while (true) {
    const std::size_t comma = line.find(',');
    entries.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return entries;
    line.remove_prefix(comma + 1);
  }
}

/// A column as the header describes it.
struct Column {
  std::string name;
  std::string written_unit;  ///< "" if SI already: entries need no conversion
  std::string unit;          ///< SI
  std::vector<double> values;
};

bool is_length(std::string_view name) {
  return name == "x" || name == "y" || name == "z" || name == "radius";
}

class TableReader {
 public:
  TableReader(const std::filesystem::path& path, std::span<const std::string_view> required)
      : path_(path.string()), required_(required) {}

  PointSet read() {
    const std::string content = read_whole_file(path_);
    std::string_view rest = content;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty()) {
      ++line_;
      const std::size_t end = rest.find('\n');
      const std::string_view line = trimmed(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (line.empty()) continue;
      if (columns_.empty()) {
        read_header(line);
        stop_at_problems();  // without the columns the lines mean nothing
      } else {
        read_line(line);
      }
    }
    if (columns_.empty()) problem({}, "has no header line", "x, y, z, radius with units: x [mm]");
    stop_at_problems();
    return points();
  }

 private:
  void problem(std::string_view key, const std::string& what, const std::string& allowed = {}) {
    if (problems_.size() < most_problems)
      problems_.push_back({.where = path_, .line = line_, .key = std::string(key), .what = what, .allowed = allowed});
    if (bad_lines_.empty() || bad_lines_.back() != line_) bad_lines_.push_back(line_);
  }

  void stop_at_problems() {
    if (problems_.empty()) return;
    const auto told = std::upper_bound(bad_lines_.begin(), bad_lines_.end(), problems_.back().line);
    if (const auto more = bad_lines_.end() - told; more > 0)
      problems_.push_back({.where = path_, .key = {}, .what = fmt::format("and {} more bad lines", more)});
    throw InputError(problems_);
  }

  void read_header(std::string_view line) {
    for (const std::string_view entry : split(line)) {
      const std::size_t bracket = entry.find('[');
      const std::string_view name = trimmed(entry.substr(0, bracket));
      Column column{std::string(name), {}, std::string(is_length(name) ? "m" : "1"), {}};
      if (column.name.empty()) problem(entry, "column without a name");
      if (find(column.name)) problem(column.name, "stands twice in the header");
      if (bracket != std::string_view::npos) read_unit(entry.substr(bracket + 1), column);
      columns_.push_back(std::move(column));
    }
    if (!find("x")) problem("x", "missing column", "columns separated by commas: x, y, z, radius, ...");
    for (const std::string_view name : required_)
      if (!find(name)) problem(name, "missing column");
  }

  void read_unit(std::string_view text, Column& column) {
    if (text.empty() || text.back() != ']') return problem(column.name, "unit without a closing bracket", "x [mm]");
    const std::string unit(trimmed(text.substr(0, text.size() - 1)));
    if (unit.empty() || unit == "1" || unit == "-") {
      if (is_length(column.name)) problem(column.name, "a length needs a unit of length", "mm, m, none for metres");
      return;
    }
    std::string why;
    const std::optional<Quantity> one = parse_quantity("1 " + unit, &why);
    if (!one) return problem(column.name, why);
    if (is_length(column.name) && one->dimension != dimension::length)
      return problem(column.name, "'" + unit + "' is no unit of length", "mm, m");
    column.unit = one->dimension == dimension::angle ? "rad" : one->value == 1 ? unit : unit_name(one->dimension);
    if (one->value != 1) column.written_unit = unit;
  }

  void read_line(std::string_view line) {
    const std::vector<std::string_view> entries = split(line);
    if (entries.size() != columns_.size())
      return problem({}, fmt::format("has {} entries for {} columns", entries.size(), columns_.size()));
    for (std::size_t k = 0; k < entries.size(); ++k) columns_[k].values.push_back(number(entries[k], columns_[k]));
  }

  /// \returns 0 for a bad entry, after noting it
  double number(std::string_view entry, const Column& column) {
    const std::string_view digits = entry.substr(entry.starts_with('+') ? 1 : 0);
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (entry.empty()) {
      problem(column.name, "missing entry");
    } else if (error == std::errc::result_out_of_range) {
      problem(column.name, fmt::format("'{}' is beyond what a double holds", entry));
    } else if (error != std::errc{} || stop != digits.data() + digits.size()) {
      problem(column.name, fmt::format("'{}' is not a number", entry));
    } else if (!std::isfinite(value)) {
      problem(column.name, fmt::format("'{}' is not finite", entry));
    } else if (column.written_unit.empty()) {
      return value;
    } else if (const auto quantity = parse_quantity(fmt::format("{} {}", entry, column.written_unit))) {
      return quantity->value;
    } else {
      problem(column.name, fmt::format("'{}' is beyond what a double holds in SI", entry));
    }
    return 0;
  }

  Column* find(std::string_view name) {
    const auto found = std::find_if(columns_.begin(), columns_.end(), [&](const Column& c) { return c.name == name; });
    return found == columns_.end() ? nullptr : &*found;
  }

  std::vector<Vector3> vectors(const Column* x, const Column* y, const Column* z) const {
    std::vector<Vector3> vectors(columns_.front().values.size());
    for (std::size_t i = 0; i < vectors.size(); ++i)
      vectors[i] = {x ? x->values[i] : 0, y ? y->values[i] : 0, z ? z->values[i] : 0};
    return vectors;
  }

  /// The columns as the header orders them, those of a vector at the place of its first.
  PointSet points() {
    PointSet points;
    points.columns.push_back({"position", "m", vectors(find("x"), find("y"), find("z"))});
    for (const Column& column : columns_) {
      const std::string& name = column.name;
      if (name == "x" || name == "y" || name == "z") continue;
      const std::string stem = name.size() > 2 && name[name.size() - 2] == '_' ? name.substr(0, name.size() - 2) : "";
      const Column *x = find(stem + "_x"), *y = find(stem + "_y"), *z = find(stem + "_z");
      const bool is_vector = !stem.empty() && x && y && z && x->unit == y->unit && y->unit == z->unit;
      if (!is_vector || (&column != x && &column != y && &column != z))
        points.columns.push_back({name, column.unit, column.values});
      else if (&column == std::min({x, y, z}))
        points.columns.push_back({stem, column.unit, vectors(x, y, z)});
    }
    return points;
  }

  std::string path_;
  std::span<const std::string_view> required_;
  int line_ = 0;
  std::vector<Column> columns_;
  std::vector<Problem> problems_;
  std::vector<int> bad_lines_;
};

}  // namespace

PointSet read_points_csv(const std::filesystem::path& path, std::span<const std::string_view> required) {
  return TableReader(path, required).read();
}

void write_points_csv(const std::filesystem::path& path, const Snapshot& snapshot) {
  std::string text = "x [m],y [m],z [m]";
  const auto add = [&]<class... T>(fmt::format_string<T...> format, T&&... values) {
    fmt::format_to(std::back_inserter(text), format, std::forward<T>(values)...);
  };
  for (const ColumnView& column : snapshot.columns) {
    if (column.name == "position") continue;
    const char* const letters = std::holds_alternative<std::span<const Vector3>>(column.values) ? "xyz" : nullptr;
    if (letters == nullptr) add(",{} [{}]", column.name, column.unit);
    for (const char* letter = letters; letter && *letter; ++letter)
      add(",{}_{} [{}]", column.name, *letter, column.unit);
  }
  const std::span<const Vector3> position = snapshot.positions();
  for (std::size_t i = 0; i < position.size(); ++i) {
    add("\n{},{},{}", position[i].x, position[i].y, position[i].z);
    for (const ColumnView& column : snapshot.columns) {
      if (column.name == "position") continue;
      if (const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values))
        add(",{},{},{}", (*vectors)[i].x, (*vectors)[i].y, (*vectors)[i].z);
      else if (const auto* scalars = std::get_if<std::span<const double>>(&column.values))
        add(",{}", (*scalars)[i]);
      else
        add(",{}", std::get<std::span<const std::int64_t>>(column.values)[i]);
    }
  }
  text += '\n';
  write_atomically(path, text);
}

}  // namespace talus
