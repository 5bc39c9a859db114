// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/overlay.hpp"

#include <fmt/format.h>

#include "io/case_file.hpp"
#include "io/figure/figure.hpp"
#include "io/manifest.hpp"
#include "io/run_folder.hpp"
#include "io/series.hpp"
#include "io/summary.hpp"

namespace talus::app {

namespace {

void print_different_keys(const Manifest& a, const Manifest& b) {
  // Both are written by the same list of parameters, one key a line, in the same order.
  auto lines = [](const std::string& text) {
    std::vector<std::string> list;
    for (std::size_t start = 0; start < text.size();) {
      const std::size_t end = std::min(text.find('\n', start), text.size());
      list.push_back(text.substr(start, end - start));
      start = end + 1;
    }
    return list;
  };
  const auto first = lines(a.case_text), second = lines(b.case_text);
  std::string table;
  for (std::size_t n = 0; n < std::min(first.size(), second.size()); ++n) {
    if (first[n].starts_with("[")) table = first[n];
    if (first[n] != second[n]) fmt::print("  {} {}   |   {}\n", table, first[n], second[n]);
  }
}

}  // namespace

ExitStatus compare_runs(const std::filesystem::path& a, const std::filesystem::path& b,
                        const std::filesystem::path& picture) {
  const RunFolder first(a), second(b);
  fmt::print("Keys that differ:\n");
  print_different_keys(read_manifest(first.manifest()), read_manifest(second.manifest()));

  const Summary one = read_summary(first.summary()), two = read_summary(second.summary());
  fmt::print("{:32} {:>14} {:>14} {:>12}\n", "quantity", a.filename().string(), b.filename().string(), "difference");
  for (const NamedValue& value : one.quantities)
    if (const NamedValue* other = two.find(value.name))
      fmt::print("{:32} {:>14.6g} {:>14.6g} {:>12.3g} {}\n", value.name, value.value, other->value,
                 other->value - value.value, value.unit == "1" ? "" : value.unit);

  const Series s = read_series(first.series()), t = read_series(second.series());
  figure::Figure figure{.title = a.filename().string() + " and " + b.filename().string()};
  for (std::size_t c = 1; c < s.names.size(); ++c) {
    if (!t.has(s.names[c])) continue;
    const auto other_time = t.column("time"), other = t.column(s.names[c]);
    figure.panels.emplace_back(
        figure::Chart{.x = {.label = "time", .unit = "s"},
                      .y = {.label = s.names[c], .unit = s.units[c] == "1" ? "" : s.units[c]},
                      .series = {figure::Line{.x = s.columns[0], .y = s.columns[c], .label = a.filename().string()},
                                 figure::Line{.x = {other_time.begin(), other_time.end()},
                                              .y = {other.begin(), other.end()},
                                              .label = b.filename().string(),
                                              .dash = figure::Dash::dashed}}});
  }
  if (!figure.panels.empty()) {
    figure::write_png(figure, picture);
    fmt::print("Picture: {}\n", picture.string());
  }
  return ExitStatus::done;
}

}  // namespace talus::app
