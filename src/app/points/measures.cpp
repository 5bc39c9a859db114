// SPDX-License-Identifier: Apache-2.0
#include "app/points/measures.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "analysis/fronts.hpp"
#include "analysis/head_tail.hpp"
#include "analysis/heads.hpp"
#include "analysis/statistics.hpp"
#include "base/error.hpp"
#include "base/text.hpp"

namespace talus::app {

namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();
constexpr double reach_of_neighbours = 4;     // mean radii, Eq. 11
constexpr double layer_on_slope = 2;          // mean radii: the first layer of grains
constexpr double farthest_over_radius = 1e6;  // of two points, so that a grid of cells can hold them

std::vector<Vector3> seen_from_the_side(std::span<const Vector3> position) {
  std::vector<Vector3> projected(position.begin(), position.end());
  for (Vector3& x : projected) x.y = 0;
  return projected;
}

std::vector<double> as_numbers(const std::vector<std::uint32_t>& counts) {
  return {counts.begin(), counts.end()};
}

}  // namespace

std::vector<double> numbers_of(const PointsToMeasure& set, const std::string& name, std::string& unit) {
  std::vector<std::string> names;
  std::vector<double> numbers;
  for (const ColumnView& column : set.points().columns) {
    const std::string own(column.name);
    auto is_asked = [&](const std::string& candidate) {
      names.push_back(candidate);
      if (candidate == name) unit = column.unit;
      return candidate == name;
    };
    if (const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values)) {
      const bool length = is_asked(own), x = is_asked(own + "_x"), y = is_asked(own + "_y"), z = is_asked(own + "_z");
      if (length || x || y || z)
        for (const Vector3& v : *vectors) numbers.push_back(length ? norm(v) : x ? v.x : y ? v.y : v.z);
    } else if (is_asked(own)) {
      std::visit(
          [&](const auto& values) {
            if constexpr (!std::is_same_v<std::decay_t<decltype(values)>, std::span<const Vector3>>)
              for (const auto value : values) numbers.push_back(static_cast<double>(value));
          },
          column.values);
    }
  }
  if (!numbers.empty()) return numbers;
  const std::vector<std::string_view> candidates(names.begin(), names.end());
  throw InputError({{.where = "--column " + name,
                     .what = name.empty() ? "missing" : set.name() + " has no such column",
                     .allowed = fmt::format("{}", fmt::join(names, ", ")),
                     .nearest = std::string(nearest(name, candidates))}});
}

PointsToMeasure::PointsToMeasure(std::string name, Snapshot points, std::optional<double> mean_radius)
    : name_(std::move(name)), points_(std::move(points)) {
  std::vector<Problem> problems;
  auto add = [&](const char* what, const char* allowed) {
    problems.push_back({.where = name_, .what = what, .allowed = allowed});
  };
  const auto places = points_.positions();
  if (places.empty()) add("holds no points", "at least one");
  if (points_.has("radius")) {
    const auto radii = points_.scalars("radius");
    radius_.assign(radii.begin(), radii.end());
    if (!std::all_of(radii.begin(), radii.end(), [](double a) { return std::isfinite(a) && a > 0; }))
      add("has radii that are not above 0", "radii above 0");
    mean_radius_ = mean_radius.value_or(mean(radii));
  } else if (mean_radius) {
    mean_radius_ = *mean_radius;
    radius_.assign(places.size(), mean_radius_);
  } else {
    add("has no column 'radius'", "--radius, such as \"5 mm\"");
  }
  for (const Vector3& x : places)
    if (!(norm(x - places.front()) < farthest_over_radius * mean_radius_)) {
      if (problems.empty())
        add("has places that are not finite, or a million radii apart", "see --radius, and the units");
      break;
    }
  if (!problems.empty()) throw InputError(problems);
}

std::optional<std::span<const Vector3>> PointsToMeasure::velocity() const {
  if (!points_.has("velocity")) return std::nullopt;
  return points_.vectors("velocity");
}

Measured measure_heads(const PointsToMeasure& set, const std::string&, std::size_t) {
  Measured m;
  m.columns = {{"particles", "1"}, {"width", "m"}, {"thickness", "m"}, {"aspect_ratio", "1"}, {"concavity", "1"}};
  const std::vector<GrainSet> heads = find_heads(set.position(), set.mean_radius());
  for (const GrainSet& head : heads) {
    const HeadSize size = head_size(set.position(), set.radius(), head, set.mean_radius());
    m.rows.push_back(
        {static_cast<double>(head.size()), size.width, size.thickness, size.aspect_ratio(), size.concavity});
  }
  const std::vector<double> largest = heads.empty() ? std::vector<double>{0, none, none, none, none} : m.rows.front();
  m.quantities = {{"head_count", "1", static_cast<double>(heads.size())},
                  {"head_particles", "1", largest[0]},
                  {"head_width", "m", largest[1]},
                  {"head_thickness", "m", largest[2]},
                  {"head_aspect_ratio", "1", largest[3]},
                  {"head_concavity", "1", largest[4]}};
  return m;
}

Measured measure_front(const PointsToMeasure& set, const std::string&, std::size_t) {
  const double layer = layer_on_slope * set.mean_radius();
  Measured m;
  m.quantities = {{"front_x", "m", front_position(set.position()).value_or(none)},
                  {"front_on_slope_x", "m", front_position_on_slope(set.position(), layer).value_or(none)}};
  if (const auto velocity = set.velocity()) {
    const auto foremost = std::max_element(set.position().begin(), set.position().end(),
                                           [](const Vector3& a, const Vector3& b) { return a.x < b.x; });
    const Vector3& v = (*velocity)[static_cast<std::size_t>(foremost - set.position().begin())];
    m.quantities.push_back({"front_velocity_x", "m/s", v.x});
  }
  return m;
}

Measured measure_frontal_angle(const PointsToMeasure& set, const std::string&, std::size_t) {
  const std::vector<Vector3> position = seen_from_the_side(set.position());
  const GrainSet walk = surface_walk(position, set.mean_radius());
  const std::optional<double> angle = angle_of_line(position, walk);
  return {.quantities = {{"frontal_angle", "deg", angle ? *angle * 180 / std::numbers::pi : none},
                         {"surface_particles", "1", static_cast<double>(walk.size())}},
          .columns = {},
          .rows = {}};
}

Measured measure_head_tail(const PointsToMeasure& set, const std::string&, std::size_t) {
  const std::vector<Vector3> position = seen_from_the_side(set.position());
  const ThicknessProfile profile = thickness_profile(position, set.radius(), set.mean_radius());
  Measured m;
  m.quantities = {{"front_rear_thickness_ratio", "1", profile.head_thickness() / profile.rear_thickness()},
                  {"front_thickness", "m", profile.head_thickness()},
                  {"rear_thickness", "m", profile.rear_thickness()},
                  {"head_length", "m", profile.column * static_cast<double>(profile.head_columns)}};
  if (const auto velocity = set.velocity()) {
    const HeadTailMotion motion = head_tail_motion(position, *velocity, profile, 0);
    m.quantities.push_back({"head_upper_velocity_x", "m/s", motion.upper_head});
    m.quantities.push_back({"head_lower_velocity_x", "m/s", motion.lower_head});
    m.quantities.push_back({"tail_velocity_x", "m/s", motion.tail});
  }
  return m;
}

Measured measure_neighbours(const PointsToMeasure& set, const std::string&, std::size_t) {
  const NeighbourNumbers numbers = neighbour_numbers(Links(set.position(), reach_of_neighbours * set.mean_radius()));
  const std::vector<double> direct = as_numbers(numbers.direct), indirect = as_numbers(numbers.indirect);
  return {.quantities = {{"neighbours_mean", "1", mean(direct)},
                         {"neighbours_max", "1", *std::max_element(direct.begin(), direct.end())},
                         {"indirect_neighbours_mean", "1", mean(indirect)},
                         {"indirect_neighbours_max", "1", *std::max_element(indirect.begin(), indirect.end())}},
          .columns = {},
          .rows = {}};
}

Measured measure_histogram(const PointsToMeasure& set, const std::string& column, std::size_t bins) {
  std::string unit;
  const std::vector<double> numbers = numbers_of(set, column, unit);
  const auto [least, largest] = std::minmax_element(numbers.begin(), numbers.end());
  Measured m;
  m.quantities = {{"count", "1", static_cast<double>(numbers.size())},
                  {"mean", unit, mean(numbers)},
                  {"standard_deviation", unit, standard_deviation(numbers)},
                  {"least", unit, *least},
                  {"median", unit, median(numbers)},
                  {"largest", unit, *largest},
                  {"skewness", "1", skewness(numbers)},
                  {"normality_p_value", "1", anderson_darling(numbers).p_value}};
  if (!(*largest > *least)) return m;  // equal values fill no bins
  const Histogram h = histogram(numbers, *least, *largest, bins);
  m.columns = {{"middle", unit}, {"count", "1"}, {"density", unit == "1" ? "1" : "1/(" + unit + ")"}};
  for (std::size_t b = 0; b < bins; ++b) m.rows.push_back({h.middle(b), static_cast<double>(h.count[b]), h.density(b)});
  return m;
}

std::string to_text(const Measured& measured) {
  std::string text;
  for (const NamedValue& q : measured.quantities)
    text += fmt::format("{:32} {:.6g}{}\n", q.name, q.value, q.unit == "1" ? "" : " " + q.unit);
  if (measured.rows.empty()) return text;
  text += '\n';
  for (const SeriesColumn& column : measured.columns)
    text += fmt::format("{:>20}", column.unit == "1" ? column.name : fmt::format("{} [{}]", column.name, column.unit));
  for (const std::vector<double>& row : measured.rows) {
    text += '\n';
    for (const double value : row) text += fmt::format("{:>20.6g}", value);
  }
  return text + '\n';
}

std::string to_json(const Measured& measured, const std::string& file, std::string_view measure) {
  nlohmann::ordered_json json{{"file", file}, {"as", measure}};
  json["quantities"] = nlohmann::ordered_json::object();
  for (const NamedValue& q : measured.quantities) json["quantities"][q.name] = {{"value", q.value}, {"unit", q.unit}};
  json["table"] = nlohmann::ordered_json::array();
  for (const std::vector<double>& row : measured.rows) {
    nlohmann::ordered_json entry;
    for (std::size_t c = 0; c < row.size(); ++c) entry[measured.columns[c].name] = row[c];
    json["table"].push_back(std::move(entry));
  }
  return json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + '\n';
}

}  // namespace talus::app
