// SPDX-License-Identifier: Apache-2.0
#include "io/series.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <charconv>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"

namespace talus {

namespace {

std::string header_of(const std::vector<SeriesColumn>& columns) {
  std::string header;
  for (const SeriesColumn& column : columns) {
    if (column.name.empty() || (column.name + column.unit).find_first_of(",\n[]") != std::string::npos)
      throw std::invalid_argument("series: '" + column.name + " [" + column.unit + "]' cannot head a column");
    header += fmt::format("{}{} [{}]", header.empty() ? "" : ",", column.name, column.unit);
  }
  return header + '\n';
}

/// Where the header and the first `rows` rows end. \throws FileError if there are fewer
std::size_t end_of_rows(const std::filesystem::path& path, std::string_view content, std::uint64_t rows) {
  std::size_t end = 0;
  for (std::uint64_t line = 0; line <= rows; ++line) {
    const std::size_t line_end = content.find('\n', end);
    if (line_end == std::string::npos)
      throw FileError(path.string(), fmt::format("cannot be resumed: it has {} whole rows, the checkpoint was made "
                                                 "after {}",
                                                 line == 0 ? 0 : line - 1, rows));
    end = line_end + 1;
  }
  return end;
}

}  // namespace

SeriesWriter::SeriesWriter(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns)
    : columns_(columns.size()) {
  claim_file(path);
  file_ = Descriptor(path.string(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW);
  const std::string header = header_of(columns);
  file_.write(header);
  bytes_ = header.size();
  sum_ = checksum(header);
}

SeriesWriter SeriesWriter::resume(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns,
                                  std::uint64_t rows) {
  SeriesWriter writer;
  claim_file(path);
  writer.file_ = Descriptor(path.string(), O_RDWR | O_NOFOLLOW);
  writer.columns_ = columns.size();
  const std::string content = writer.file_.read();
  const std::string header = header_of(columns);
  if (!content.starts_with(header))
    throw FileError(path.string(),
                    fmt::format("cannot be resumed: its columns are not those of this run; found: {}; "
                                "expected: {}",
                                content.substr(0, content.find('\n')), header.substr(0, header.size() - 1)));
  writer.rows_ = rows;
  writer.bytes_ = end_of_rows(path, content, rows);
  writer.sum_ = checksum(std::string_view(content).substr(0, writer.bytes_));
  writer.file_.truncate(writer.bytes_);
  return writer;
}

namespace {

void add_row(std::span<const double> values, std::size_t columns, std::string& text) {
  if (values.size() != columns)
    throw std::invalid_argument(fmt::format("series: {} values for {} columns", values.size(), columns));
  fmt::format_to(std::back_inserter(text), "{}\n", fmt::join(values, ","));
}

}  // namespace

void write_table(const std::filesystem::path& path, const std::vector<SeriesColumn>& columns,
                 const std::vector<std::vector<double>>& rows) {
  std::string text = header_of(columns);
  for (const std::vector<double>& row : rows) add_row(row, columns.size(), text);
  write_atomically(path, text, Flush::later);
}

void SeriesWriter::append(std::span<const double> values) {
  line_.clear();
  add_row(values, columns_, line_);
  try {
    file_.write(line_);
  } catch (const FileError&) {
    file_.truncate(bytes_);
    throw;
  }
  bytes_ += line_.size();
  ++rows_;
  sum_ = checksum(line_, sum_);
}

std::uint32_t checksum_of_series(const std::filesystem::path& path, std::uint64_t rows) {
  const std::string content = read_whole_file(path);
  return checksum(std::string_view(content).substr(0, end_of_rows(path, content, rows)));
}

namespace {

std::vector<std::string_view> split(std::string_view line) {
  std::vector<std::string_view> parts;
  while (true) {
    const std::size_t comma = line.find(',');
    parts.push_back(line.substr(0, comma));
    if (comma == std::string_view::npos) return parts;
    line.remove_prefix(comma + 1);
  }
}

void read_header(const std::string& path, std::string_view line, Series& series) {
  for (const std::string_view part : split(line)) {
    const std::size_t bracket = part.find(" [");
    if (bracket == std::string_view::npos || bracket == 0 || part.back() != ']')
      throw FileError(path, fmt::format("line 1: '{}' is not of the form 'name [unit]'", part));
    series.names.emplace_back(part.substr(0, bracket));
    series.units.emplace_back(part.substr(bracket + 2, part.size() - bracket - 3));
  }
  series.columns.resize(series.names.size());
}

void read_row(const std::string& path, std::size_t line_number, std::string_view line, Series& series) {
  const std::vector<std::string_view> parts = split(line);
  if (parts.size() != series.columns.size())
    throw FileError(path,
                    fmt::format("line {}: {} values for {} columns", line_number, parts.size(), series.columns.size()));
  for (std::size_t i = 0; i < parts.size(); ++i) {
    double value = 0;
    const char* const end = parts[i].data() + parts[i].size();
    const auto [stop, error] = std::from_chars(parts[i].data(), end, value);
    if (error != std::errc{} || stop != end)
      throw FileError(path, fmt::format("line {}: {}: '{}' is not a number", line_number, series.names[i], parts[i]));
    series.columns[i].push_back(value);
  }
}

}  // namespace

Series read_series(const std::filesystem::path& path) {
  const std::string content = read_whole_file(path);
  Series series;
  std::size_t line_number = 1;
  for (std::size_t begin = 0, end; (end = content.find('\n', begin)) != std::string::npos; begin = end + 1) {
    const std::string_view line = std::string_view(content).substr(begin, end - begin);
    if (line_number == 1)
      read_header(path.string(), line, series);
    else
      read_row(path.string(), line_number, line, series);
    ++line_number;
  }
  if (line_number == 1) throw FileError(path.string(), "has no header line");
  return series;
}

}  // namespace talus
