// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

#include "app/ensemble/sweep.hpp"
#include "base/error.hpp"
#include "base/nearest.hpp"
#include "io/figure/figure.hpp"

namespace talus::app {

namespace {

using namespace figure;

constexpr std::size_t most_panels = 12;

/// What stands across: a value for each group, and which line a group belongs to.
struct Across {
  Axis axis = {};
  std::vector<double> values = {};
  std::vector<std::string> lines = {};
};

/// In the unit of the first value as it was given: "5 mm" is drawn at 5.
Across across_of(const std::vector<SweptGroup>& groups) {
  std::vector<std::vector<Setting>> settings;
  for (const SweptGroup& swept : groups) settings.push_back(settings_of(*swept.group));
  const std::size_t keys = settings.front().size();
  std::size_t number = 0;
  const auto is_number = [&](std::size_t key) {
    return std::all_of(settings.begin(), settings.end(), [&](const auto& s) { return s[key].quantity.has_value(); });
  };
  while (number < keys && !is_number(number)) ++number;
  Across across;
  if (number == keys) {
    std::vector<std::string> names;
    for (std::size_t n = 0; n < groups.size(); ++n) {
      across.values.push_back(static_cast<double>(n + 1));
      names.push_back(fmt::format("{}: {}", n + 1, groups[n].group->name));
    }
    across.axis.label = fmt::format("{}", fmt::join(names, ", "));
    across.lines.assign(groups.size(), "");
    return across;
  }
  const std::string& text = settings.front()[number].text;
  const std::size_t digits = text.find_last_of("0123456789.") + 1, blank = text.find(' ');
  across.axis.unit = blank == std::string::npos ? text.substr(std::min(digits, text.size())) : text.substr(blank + 1);
  const auto one = across.axis.unit.empty() ? std::nullopt : parse_quantity("1 " + across.axis.unit);
  if (!one) across.axis.unit = unit_name(settings.front()[number].quantity->dimension);
  across.axis.label = settings.front()[number].key;
  for (const auto& of_group : settings) {
    across.values.push_back(of_group[number].quantity->value / (one ? one->value : 1));
    std::vector<std::string> others;
    for (std::size_t key = 0; key < keys; ++key)
      if (key != number) others.push_back(fmt::format("{} = {}", of_group[key].key, of_group[key].text));
    across.lines.push_back(fmt::format("{}", fmt::join(others, ", ")));
  }
  return across;
}

bool differs(const std::vector<SweptGroup>& groups, const std::string& name) {
  double low = INFINITY, high = -INFINITY;
  for (const SweptGroup& swept : groups)
    if (const QuantitySpread* spread = find_quantity(swept, name))
      low = std::min(low, spread->mean), high = std::max(high, spread->mean);
  return high - low > 1e-12 * std::max(std::abs(low), std::abs(high));
}

std::vector<const QuantitySpread*> chosen(const std::vector<SweptGroup>& groups,
                                          const std::vector<std::string>& asked) {
  const std::vector<const QuantitySpread*> all = all_quantities(groups);
  std::vector<std::string> names;
  for (const QuantitySpread* q : all) names.push_back(q->name);
  check_quantities(asked, names);
  std::vector<const QuantitySpread*> chosen;
  for (const std::string& name : asked)
    chosen.push_back(*std::find_if(all.begin(), all.end(), [&](const auto* q) { return q->name == name; }));
  for (const QuantitySpread* q : all)
    if (asked.empty() && chosen.size() < most_panels && differs(groups, q->name)) chosen.push_back(q);
  return chosen;
}

}  // namespace

void check_quantities(const std::vector<std::string>& asked, const std::vector<std::string>& known) {
  const std::vector<std::string_view> names(known.begin(), known.end());
  std::vector<Problem> problems;
  for (const std::string& name : asked)
    if (std::find(names.begin(), names.end(), name) == names.end())
      problems.push_back({.where = "--plot " + name,
                          .what = "no member has such a quantity",
                          .allowed = fmt::format("{}", fmt::join(names, ", ")),
                          .nearest = std::string(nearest(name, names))});
  if (!problems.empty()) throw InputError(problems);
}

bool draw_sweep(const std::vector<SweptGroup>& groups, const std::vector<std::string>& quantities,
                const std::filesystem::path& path) {
  const std::vector<const QuantitySpread*> shown = chosen(groups, quantities);
  if (shown.empty()) return false;
  const Across across = across_of(groups);
  Figure figure{.letters = false};
  for (const QuantitySpread* quantity : shown) {
    Chart chart{.x = across.axis, .y = {.label = quantity->name, .unit = quantity->unit == "1" ? "" : quantity->unit}};
    std::vector<std::string> lines;
    for (const std::string& line : across.lines)
      if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
    for (const std::string& name : lines) {
      std::vector<std::size_t> order;
      for (std::size_t n = 0; n < groups.size(); ++n)
        if (across.lines[n] == name) order.push_back(n);
      std::stable_sort(order.begin(), order.end(),
                       [&](std::size_t a, std::size_t b) { return across.values[a] < across.values[b]; });
      figure::Line line{.label = figure.panels.empty() ? name : std::string(), .marked = true};
      bool spread = false;
      for (const std::size_t n : order) {
        const QuantitySpread* of_group = find_quantity(groups[n], quantity->name);
        line.x.push_back(across.values[n]);
        line.y.push_back(of_group ? of_group->mean : NAN);
        line.spread.push_back(of_group && of_group->values.size() > 1 ? of_group->deviation : 0);
        spread = spread || line.spread.back() > 0;
      }
      if (!spread) line.spread.clear();
      chart.series.emplace_back(std::move(line));
    }
    figure.panels.emplace_back(std::move(chart));
  }
  write_png(figure, path);
  return true;
}

}  // namespace talus::app
