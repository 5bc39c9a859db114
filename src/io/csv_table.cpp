// SPDX-License-Identifier: Apache-2.0
#include "io/csv_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/file.hpp"

namespace talus {

namespace {

constexpr std::size_t max_problems = 20;

std::string_view bare(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(" \t\r\"");
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(" \t\r\"") + 1 - begin);
}

std::vector<std::string_view> split(std::string_view line, char separator) {
  std::vector<std::string_view> entries;
  while (true) {
    const std::size_t end = line.find(separator);
    entries.push_back(bare(line.substr(0, end)));
    if (end == std::string_view::npos) return entries;
    line.remove_prefix(end + 1);
  }
}

/// Of a header line.
char separator_of(std::string_view line) {
  for (const char separator : {',', ';', '\t'})
    if (line.find(separator) != std::string_view::npos) return separator;
  return ',';
}

/// A column as the header describes it.
struct Column : CsvColumn {
  std::string written_unit = {};  ///< "" if SI already: entries need no conversion
  std::string written_name = {};  ///< in the header
  double factor = 1;              ///< by which entries are multiplied
};

std::string si_unit(Dimension dimension) {
  return dimension == dimension::none ? "1" : dimension == dimension::angle ? "rad" : unit_name(dimension);
}

/// "mm, m": the units allowed for a column of a dimension.
std::string units_of(Dimension dimension) {
  const std::string usual = example_unit(dimension), si = unit_name(dimension);
  return usual == si ? si : usual + ", " + si;
}

class TableReader {
 public:
  TableReader(const std::filesystem::path& path, const CsvFormat& format) : path_(path.string()), format_(format) {}

  CsvTable read() {
    const std::string content = read_whole_file(path_);
    std::string_view rest = content;
    if (rest.starts_with("\xEF\xBB\xBF")) rest.remove_prefix(3);
    while (!rest.empty()) {
      ++line_;
      const std::size_t end = rest.find('\n');
      const std::string_view line = bare(rest.substr(0, end));
      rest.remove_prefix(end == std::string_view::npos ? rest.size() : end + 1);
      if (line.empty()) continue;
      if (columns_.empty()) {
        separator_ = separator_of(line);
        read_header(line);
        stop_at_problems();  // without the columns the lines mean nothing
      } else {
        read_line(line);
      }
    }
    if (columns_.empty()) problem({}, "has no header line", std::string(format_.header));
    stop_at_problems();
    CsvTable table{{}, std::move(lines_)};
    for (Column& column : columns_) table.columns.push_back(std::move(column));
    return table;
  }

 private:
  void problem(std::string_view key, const std::string& what, const std::string& allowed = {},
               std::string_view nearest = {}) {
    if (problems_.size() < max_problems)
      problems_.push_back({.where = path_,
                           .line = line_,
                           .key = std::string(key),
                           .what = what,
                           .allowed = allowed,
                           .nearest = std::string(nearest)});
    if (bad_lines_.empty() || bad_lines_.back() != line_) bad_lines_.push_back(line_);
  }

  void stop_at_problems() {
    if (problems_.empty()) return;
    const auto reported = std::upper_bound(bad_lines_.begin(), bad_lines_.end(), problems_.back().line);
    if (const auto more = bad_lines_.end() - reported; more > 0)
      problems_.push_back({.where = path_, .key = {}, .what = fmt::format("and {} more bad lines", more)});
    throw InputError(problems_);
  }

  void read_header(std::string_view line) {
    for (const std::string_view entry : split(line, separator_)) {
      const std::size_t bracket = entry.find('[');
      const std::string_view written = bare(entry.substr(0, bracket));
      const ColumnAlias* const alias = alias_of(written);
      const std::string_view name = alias ? alias->means : written;
      Column column{{std::string(name), si_unit(known(name) ? *known(name) : dimension::none), {}}};
      column.written_name = written;
      if (alias) column.factor = alias->factor;
      if (column.name.empty()) problem(entry, "column without a name");
      if (const Column* const other = find(name); other && other->written_name == written)
        problem(written, "stands twice in the header");
      else if (other)
        problem(written, fmt::format("is the column {} once more", other->written_name), "one of them");
      if (const RefusedColumn* const refused = refused_column(name))
        problem(written, std::string(refused->why), names_of_known());
      else if (format_.known_only && !known(name) && !column.name.empty())
        unknown(name);
      if (bracket != std::string_view::npos)
        read_unit(entry.substr(bracket + 1), column);
      else if (format_.needs_units && known(name))
        read_unit("]", column);
      columns_.push_back(std::move(column));
    }
    for (const std::string_view name : format_.required)
      if (!find(name))
        problem(name, "missing column",
                columns_.size() == 1 ? "columns separated by commas: " + std::string(format_.header) : std::string());
  }

  void read_unit(std::string_view text, Column& column) {
    const Dimension* const meant = known(column.name);
    if (text.empty() || text.back() != ']')
      return problem(column.written_name, "unit without a closing bracket", "name [unit]");
    const std::string unit(bare(text.substr(0, text.size() - 1)));
    if (unit.empty() || unit == "1" || unit == "-") {
      if (meant && *meant != dimension::none)
        problem(column.written_name, fmt::format("needs a unit of {}", dimension_name(*meant)), units_of(*meant));
      return;
    }
    std::string why;
    const std::optional<Quantity> one = parse_quantity("1 " + unit, &why);
    if (!one) return problem(column.written_name, why);
    if (meant && one->dimension != *meant)
      return problem(column.written_name, fmt::format("'{}' is no unit of {}", unit, dimension_name(*meant)),
                     units_of(*meant));
    column.has_unit = true;
    column.unit = one->dimension == dimension::angle ? "rad" : one->value == 1 ? unit : unit_name(one->dimension);
    if (one->value != 1) column.written_unit = unit;
  }

  void read_line(std::string_view line) {
    const std::vector<std::string_view> entries = split(line, separator_);
    if (entries.size() != columns_.size())
      return problem({}, fmt::format("has {} entries for {} columns", entries.size(), columns_.size()));
    lines_.push_back(line_);
    for (std::size_t k = 0; k < entries.size(); ++k) columns_[k].values.push_back(number(entries[k], columns_[k]));
  }

  /// \returns 0 for a bad entry, after noting it
  double number(std::string_view entry, const Column& column) {
    std::string digits(entry.substr(entry.starts_with('+') ? 1 : 0));
    if (const std::size_t mark = digits.find_first_of(".,"); mark != std::string::npos && separator_ != ',') {
      if (decimal_mark_ != 0 && decimal_mark_ != digits[mark])
        problem(column.written_name, fmt::format("'{}' has another decimal mark than entries before", entry),
                "one mark, and no thousands");
      decimal_mark_ = digits[mark], digits[mark] = '.';
    }
    double value = 0;
    const auto [stop, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (entry.empty()) {
      problem(column.written_name, "missing entry");
    } else if (error == std::errc::result_out_of_range) {
      problem(column.written_name, fmt::format("'{}' is beyond what a double holds", entry));
    } else if (error != std::errc{} || stop != digits.data() + digits.size()) {
      problem(column.written_name, fmt::format("'{}' is not a number", entry));
    } else if (!std::isfinite(value)) {
      problem(column.written_name, fmt::format("'{}' is not finite", entry));
    } else if (column.written_unit.empty()) {
      return column.factor * value;
    } else if (const auto quantity = parse_quantity(fmt::format("{} {}", digits, column.written_unit))) {
      return column.factor * quantity->value;
    } else {
      problem(column.written_name, fmt::format("'{}' is beyond what a double holds in SI", entry));
    }
    return 0;
  }

  /// Null if there is none of that name yet.
  const Column* find(std::string_view name) const {
    const auto found =
        std::find_if(columns_.begin(), columns_.end(), [&](const Column& column) { return column.name == name; });
    return found == columns_.end() ? nullptr : &*found;
  }

  /// Null for a column that may be there.
  const RefusedColumn* refused_column(std::string_view name) const {
    const auto found = std::find_if(format_.refused.begin(), format_.refused.end(),
                                    [&](const RefusedColumn& column) { return column.name == name; });
    return found == format_.refused.end() ? nullptr : &*found;
  }

  /// Null for a column that means what it is called.
  const ColumnAlias* alias_of(std::string_view name) const {
    const auto found = std::find_if(format_.aliases.begin(), format_.aliases.end(),
                                    [&](const ColumnAlias& alias) { return alias.name == name; });
    return found == format_.aliases.end() ? nullptr : &*found;
  }

  const Dimension* known(std::string_view name) const {
    const auto found = std::find_if(format_.known.begin(), format_.known.end(),
                                    [&](const KnownColumn& column) { return column.name == name; });
    return found == format_.known.end() ? nullptr : &found->dimension;
  }

  void unknown(std::string_view name) {
    problem(name, "unknown column", names_of_known(), nearest(name, known_names()));
  }

  std::vector<std::string_view> known_names() const {
    std::vector<std::string_view> names;
    for (const KnownColumn& column : format_.known) names.push_back(column.name);
    for (const ColumnAlias& alias : format_.aliases) names.push_back(alias.name);
    return names;
  }

  std::string names_of_known() const { return fmt::format("{}", fmt::join(known_names(), ", ")); }

  std::string path_;
  const CsvFormat& format_;
  char separator_ = ',', decimal_mark_ = 0;  // 0: none yet
  int line_ = 0;
  std::vector<Column> columns_;
  std::vector<int> lines_;
  std::vector<Problem> problems_;
  std::vector<int> bad_lines_;
};

}  // namespace

const CsvColumn* CsvTable::find(std::string_view name) const {
  const auto found =
      std::find_if(columns.begin(), columns.end(), [&](const CsvColumn& column) { return column.name == name; });
  return found == columns.end() ? nullptr : &*found;
}

CsvTable read_csv_table(const std::filesystem::path& path, const CsvFormat& format) {
  return TableReader(path, format).read();
}

}  // namespace talus
