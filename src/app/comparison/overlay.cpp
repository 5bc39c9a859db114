// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/overlay.hpp"

#include <fmt/format.h>

#include "app/comparison/python.hpp"
#include "base/text.hpp"
#include "io/parameter_writer.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"

namespace talus::app {

namespace {

void print_different_keys(const Manifest& a, const Manifest& b) {
  auto first = resolved_values(a.case_text), second = resolved_values(b.case_text);
  for (const auto& [key, value] : second) first.try_emplace(key);
  for (const auto& [key, value] : first)
    if (value != second[key])
      print("  {}: {}   |   {}\n", key, value.empty() ? "-" : value, second[key].empty() ? "-" : second[key]);
}

/// The last part of a path, also of one that ends in '/'.
std::string name_of(const std::filesystem::path& path) {
  return (path.has_filename() ? path : path.parent_path()).filename().string();
}

}  // namespace

ExitStatus compare_runs(const std::filesystem::path& a, const std::filesystem::path& b,
                        const std::filesystem::path& picture) {
  const RunFolder first(a), second(b);
  print("Keys that differ:\n");
  print_different_keys(read_manifest(first.manifest()), read_manifest(second.manifest()));

  const Summary one = read_summary(first.summary()), two = read_summary(second.summary());
  print("{:32} {:>14} {:>14} {:>12}\n", "quantity", name_of(a), name_of(b), "difference");
  const auto print_row = [](const std::string& name, const NamedValue* first_value, const NamedValue* second_value) {
    const auto text = [](const NamedValue* value) { return value ? fmt::format("{:.6g}", value->value) : "-"; };
    const std::string difference =
        first_value && second_value ? fmt::format("{:.3g}", second_value->value - first_value->value) : "-";
    const std::string& unit = (first_value ? first_value : second_value)->unit;
    print("{:32} {:>14} {:>14} {:>12} {}\n", name, text(first_value), text(second_value), difference,
          unit == "1" ? "" : unit);
  };
  for (const NamedValue& value : one.quantities) print_row(value.name, &value, two.find(value.name));
  for (const NamedValue& value : two.quantities)
    if (!one.find(value.name)) print_row(value.name, nullptr, &value);

  if (picture.empty()) return ExitStatus::done;
  for (const std::filesystem::path& drawn : draw_charts({"runs", a.string(), b.string(), picture.string()}, picture))
    print("Picture: {}\n", drawn.string());
  return ExitStatus::done;
}

}  // namespace talus::app
