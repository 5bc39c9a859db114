// SPDX-License-Identifier: Apache-2.0
#include "app/law/shear_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string_view>

#include "base/error.hpp"
#include "io/csv_table.hpp"

namespace talus::app {

namespace {

using granular::YieldPoint;

constexpr double least_stress = 1, least_consolidation = 20, most_stress = 1e6;  // Pa: of shear testers for powders
constexpr double most_angle = 80 * std::numbers::pi / 180;
constexpr double least_ratio = 1.05;  // of the largest load, or consolidation, over the smallest
constexpr std::size_t least_points = 2, least_points_in_all = 4;
constexpr KnownColumn known[] = {{"consolidation", dimension::pressure}, {"normal_stress", dimension::pressure},
                                 {"shear_stress", dimension::pressure},  {"bulk_density", dimension::density},
                                 {"friction_angle", dimension::angle},   {"cohesion", dimension::pressure},
                                 {"major_stress", dimension::pressure},  {"unconfined_strength", dimension::pressure}};
constexpr std::string_view headers =
    "consolidation [kPa], normal_stress [kPa], shear_stress [kPa], or consolidation [kPa], friction_angle [deg], "
    "cohesion [kPa]";

/// The faults of a file, by line.
struct Faults {
  const std::filesystem::path& path;
  std::vector<Problem> problems = {};

  void add(int line, std::string key, std::string what, std::string allowed) {
    problems.push_back({.where = path.string(),
                        .line = line,
                        .key = std::move(key),
                        .what = std::move(what),
                        .allowed = std::move(allowed)});
  }
  void check_stresses(const CsvTable& table, std::string_view name, double least) {
    const CsvColumn* column = table.find(name);
    if (!column) return;
    for (std::size_t row = 0; row < column->values.size(); ++row)
      if (const double value = column->values[row]; !(value >= least && value <= most_stress))
        add(table.lines[row], std::string(name), fmt::format("{:.4g} Pa is no stress of a shear tester", value),
            fmt::format("{:g} Pa to 1 MPa; the header has the unit, such as {} [kPa]", least, name));
  }
  void check_above_0(const CsvTable& table, std::string_view name, double below, const char* allowed) {
    const CsvColumn* column = table.find(name);
    for (std::size_t row = 0; column && row < column->values.size(); ++row)
      if (const double value = column->values[row]; !(value > 0 && value < below))
        add(table.lines[row], std::string(name),
            column->unit == "rad" ? fmt::format("{:.4g} deg is out of range", value * 180 / std::numbers::pi)
                                  : fmt::format("{:.4g} {} is out of range", value, column->unit),
            allowed);
  }
  void finish() const {
    if (!problems.empty()) throw InputError(problems);
  }
};

/// The points of evaluated loci: two on each line, which give it back.
void add_evaluated(const CsvTable& table, std::vector<MeasuredLocus>& loci) {
  const auto value = [&](std::string_view name, std::size_t row) {
    const CsvColumn* column = table.find(name);
    return column ? std::optional(column->values[row]) : std::nullopt;
  };
  for (std::size_t row = 0; row < table.lines.size(); ++row) {
    const double angle = *value("friction_angle", row), sine = std::sin(angle), slope = std::tan(angle);
    const double cohesion =
        value("cohesion", row)
            .value_or(value("unconfined_strength", row).value_or(0) * (1 - sine) / (2 * std::cos(angle)));
    const double apex = cohesion / slope;
    const double load =
        value("consolidation", row)
            .value_or((value("major_stress", row).value_or(0) + apex) / ((1 + slope * slope) * (1 + sine)) - apex);
    MeasuredLocus& locus = loci.emplace_back();
    locus.consolidation = load;
    locus.bulk_density = value("bulk_density", row);
    locus.major = value("major_stress", row);
    for (const double share : {0.25, 0.75}) locus.points.push_back({share * load, cohesion + slope * share * load});
  }
}

struct Mean {
  double sum = 0;
  int count = 0;

  void add(double value) { sum += value, ++count; }
  std::optional<double> value() const { return count > 0 ? std::optional(sum / count) : std::nullopt; }
};

/// Points of failure by their consolidation. Of several rows of pre-shear the mean counts, as in ASTM D6128; the bulk
/// density is theirs, or without any that of all rows.
void add_points(const CsvTable& table, std::vector<MeasuredLocus>& loci,
                std::vector<std::optional<YieldPoint>>& pre_shear, std::vector<int>& lines, Faults& faults) {
  const auto& consolidation = table.find("consolidation")->values;
  const auto& normal = table.find("normal_stress")->values;
  const auto& shear = table.find("shear_stress")->values;
  const CsvColumn* density = table.find("bulk_density");
  struct Rows {
    Mean shear = {}, density = {}, density_of_all = {};
  };
  std::vector<Rows> rows;
  for (std::size_t row = 0; row < table.lines.size(); ++row) {
    const auto found = std::find_if(loci.begin(), loci.end(), [&](const MeasuredLocus& locus) {
      return std::abs(locus.consolidation / consolidation[row] - 1) < 1e-6;
    });
    const auto n = static_cast<std::size_t>(found - loci.begin());
    if (found == loci.end()) {
      loci.push_back({.consolidation = consolidation[row]});
      rows.emplace_back(), lines.push_back(table.lines[row]);
    }
    if (density) rows[n].density_of_all.add(density->values[row]);
    const double load = normal[row] / consolidation[row];
    if (load > 1 + 1e-3) {
      faults.add(table.lines[row], "normal_stress", fmt::format("{:.4g} Pa is above the consolidation", normal[row]),
                 fmt::format("at most {:.4g} Pa", consolidation[row]));
    } else if (load > 1 - 1e-3) {
      rows[n].shear.add(shear[row]);
      if (density) rows[n].density.add(density->values[row]);
    } else {
      loci[n].points.push_back({normal[row], shear[row]});
    }
  }
  for (std::size_t n = 0; n < loci.size(); ++n) {
    const auto pre = rows[n].shear.value(), its_density = rows[n].density.value();
    pre_shear.push_back(pre ? std::optional(YieldPoint{loci[n].consolidation, *pre}) : std::nullopt);
    loci[n].bulk_density = its_density ? its_density : rows[n].density_of_all.value();
  }
}

void check_columns(const CsvTable& table, Faults& faults) {
  const auto has = [&](std::string_view name) { return table.find(name) != nullptr; };
  const bool points = has("consolidation") && has("normal_stress") && has("shear_stress") && !has("friction_angle");
  const bool evaluated = has("friction_angle") && has("cohesion") != has("unconfined_strength") &&
                         (has("consolidation") || has("major_stress")) && !has("normal_stress") && !has("shear_stress");
  if (!points && !evaluated)
    faults.add(1, "", "these columns are neither points of failure nor evaluated loci", std::string(headers));
}

bool is_spread(double low, double high) {
  return high >= least_ratio * low;
}

/// Where points span loads. \returns the least and the largest
std::optional<std::pair<YieldPoint, YieldPoint>> ends_of(const std::vector<YieldPoint>& points) {
  const auto [low, high] = std::minmax_element(points.begin(), points.end(),
                                               [](const auto& a, const auto& b) { return a.normal < b.normal; });
  if (points.size() < least_points || !is_spread(low->normal, high->normal)) return std::nullopt;
  return std::pair{*low, *high};
}

/// What makes a locus one, and its evaluation. \param line of its first row
void evaluate(MeasuredLocus& locus, std::optional<YieldPoint> pre_shear, int line, Faults& faults) {
  const std::string of = fmt::format("consolidation {:.4g} Pa", locus.consolidation);
  const auto ends = ends_of(locus.points);
  if (!ends)
    return faults.add(line, of, fmt::format("has {} point(s) of failure under different loads", locus.points.size()),
                      "at least two loads below the consolidation");
  const auto& [low, high] = *ends;
  try {
    const double share = (locus.consolidation - low.normal) / (high.normal - low.normal);
    locus.locus = granular::evaluated(
        pre_shear.value_or(YieldPoint{locus.consolidation, low.shear + share * (high.shear - low.shear)}),
        locus.points);
  } catch (const std::invalid_argument&) {
    return faults.add(line, of, "its shear stress does not grow with the load", "a friction above 0");
  }
  if (locus.locus.angle >= most_angle)
    return faults.add(line, of, fmt::format("its angle is {:.3g} deg", locus.locus.angle * 180 / std::numbers::pi),
                      "below 80 deg");
  locus.locus.major = locus.major.value_or(locus.locus.major);
  if (!(locus.locus.flow_factor() >= 1))
    faults.add(line, of,
               fmt::format("f_c = {:.4g} Pa is more than sigma_1 = {:.4g} Pa: ff_c = {:.2g}", locus.locus.strength,
                           locus.locus.major, locus.locus.flow_factor()),
               "ff_c of 1 and more: what consolidated a sample does not break it");
}

}  // namespace

std::vector<MeasuredLocus> read_shear_data(const std::filesystem::path& path) {
  const CsvTable table =
      read_csv_table(path, {.known = known, .known_only = true, .needs_units = true, .header = headers});
  Faults faults{path};
  check_columns(table, faults);
  faults.finish();
  for (const std::string_view name : {"consolidation", "major_stress"})
    faults.check_stresses(table, name, least_consolidation);
  for (const std::string_view name : {"normal_stress", "shear_stress"})
    faults.check_stresses(table, name, least_stress);
  faults.check_above_0(table, "friction_angle", most_angle, "above 0 and below 80 deg");
  faults.check_above_0(table, "bulk_density", 1e5, "above 0; the header has the unit, such as bulk_density [kg/m3]");
  faults.finish();
  std::vector<MeasuredLocus> loci;
  std::vector<std::optional<YieldPoint>> pre_shear;
  std::vector<int> lines;
  if (table.find("friction_angle")) {
    add_evaluated(table, loci);
    pre_shear.resize(loci.size()), lines = table.lines;
  } else {
    add_points(table, loci, pre_shear, lines, faults);
  }
  std::size_t points = 0;
  double least = most_stress, most = 0;
  for (std::size_t n = 0; n < loci.size(); ++n) {
    evaluate(loci[n], pre_shear[n], lines[n], faults);
    points += loci[n].points.size();
    least = std::min(least, loci[n].consolidation), most = std::max(most, loci[n].consolidation);
  }
  if (!is_spread(least, most) || points < least_points_in_all)
    faults.add(
        0, "",
        fmt::format("holds {} yield {}{}, with {} points of failure", loci.size(), loci.size() == 1 ? "locus" : "loci",
                    loci.empty() ? "" : fmt::format(" of {:.4g} to {:.4g} Pa", least, most), points),
        "two loci of different consolidation, by 5 % at least, and four points at least");
  faults.finish();
  return loci;
}

std::vector<YieldPoint> read_wall_data(const std::filesystem::path& path) {
  static constexpr std::string_view required[] = {"normal_stress", "shear_stress"};
  const CsvTable table = read_csv_table(path, {.known = std::span(known).subspan(1, 2),
                                               .required = required,
                                               .known_only = true,
                                               .needs_units = true,
                                               .header = "normal_stress [kPa], shear_stress [kPa]"});
  Faults faults{path};
  for (const std::string_view name : required) faults.check_stresses(table, name, least_stress);
  if (table.lines.size() < 3) faults.add(0, "", fmt::format("holds {} points", table.lines.size()), "three at least");
  faults.finish();
  std::vector<YieldPoint> points;
  for (std::size_t row = 0; row < table.lines.size(); ++row)
    points.push_back({table.find("normal_stress")->values[row], table.find("shear_stress")->values[row]});
  const auto ends = ends_of(points);
  if (!ends)
    faults.add(0, "", "its points are under one load", "loads that differ by 5 % at least");
  else if (!(ends->second.shear > ends->first.shear))
    faults.add(0, "", "its shear stress does not grow with the load", "a friction above 0");
  faults.finish();
  return points;
}

}  // namespace talus::app
