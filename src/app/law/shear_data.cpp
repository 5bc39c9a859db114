// SPDX-License-Identifier: Apache-2.0
#include "app/law/shear_data.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "base/error.hpp"
#include "io/csv_table.hpp"

namespace talus::app {

namespace {

using granular::YieldPoint;

constexpr double least_stress = 1, least_consolidation = 20, most_stress = 1e6;  // Pa: of shear testers for powders
constexpr std::size_t least_points = 2, least_loci = 2, least_points_in_all = 4;
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

void check_columns(const CsvTable& table, Faults& faults) {
  const auto has = [&](std::string_view name) { return table.find(name) != nullptr; };
  const bool points = has("consolidation") && has("normal_stress") && has("shear_stress") && !has("friction_angle");
  const bool evaluated = has("friction_angle") && has("cohesion") != has("unconfined_strength") &&
                         (has("consolidation") || has("major_stress")) && !has("normal_stress") && !has("shear_stress");
  if (!points && !evaluated)
    faults.add(1, "", "these columns are neither points of failure nor evaluated loci", std::string(headers));
}

/// What makes a locus one, and its evaluation. \param line of its first row
void evaluate(MeasuredLocus& locus, std::optional<YieldPoint> pre_shear, int line, Faults& faults) {
  const std::string of = fmt::format("consolidation {:.4g} Pa", locus.consolidation);
  const auto [low, high] = std::minmax_element(locus.points.begin(), locus.points.end(),
                                               [](const auto& a, const auto& b) { return a.normal < b.normal; });
  if (locus.points.size() < least_points || !(high->normal > low->normal))
    return faults.add(line, of, fmt::format("has {} point(s) of failure under different loads", locus.points.size()),
                      "at least two loads below the consolidation");
  try {
    const double share = (locus.consolidation - low->normal) / (high->normal - low->normal);
    locus.locus = granular::evaluated(
        pre_shear.value_or(YieldPoint{locus.consolidation, low->shear + share * (high->shear - low->shear)}),
        locus.points);
  } catch (const std::invalid_argument&) {
    return faults.add(line, of, "its shear stress does not grow with the load", "a friction above 0");
  }
  locus.locus.major = locus.major.value_or(locus.locus.major);
  if (!(locus.locus.flow_factor() >= 1))
    faults.add(line, of,
               fmt::format("f_c = {:.4g} Pa is more than sigma_1 = {:.4g} Pa: ff_c = {:.2g}", locus.locus.strength,
                           locus.locus.major, locus.locus.flow_factor()),
               "ff_c of 1 and more: what consolidated a sample does not break it");
}

}  // namespace

std::vector<MeasuredLocus> read_shear_data(const std::filesystem::path& path) {
  const CsvTable table = read_csv_table(path, {.known = known, .known_only = true, .header = headers});
  Faults faults{path};
  check_columns(table, faults);
  faults.finish();
  for (const std::string_view name : {"consolidation", "major_stress"})
    faults.check_stresses(table, name, least_consolidation);
  for (const std::string_view name : {"normal_stress", "shear_stress"})
    faults.check_stresses(table, name, least_stress);
  faults.finish();
  std::vector<MeasuredLocus> loci;
  std::vector<std::optional<YieldPoint>> pre_shear;
  std::vector<int> lines;
  if (table.find("friction_angle")) {
    add_evaluated(table, loci);
    pre_shear.resize(loci.size()), lines = table.lines;
  } else {
    const auto& consolidation = table.find("consolidation")->values;
    const auto& normal = table.find("normal_stress")->values;
    const auto& shear = table.find("shear_stress")->values;
    const CsvColumn* density = table.find("bulk_density");
    for (std::size_t row = 0; row < table.lines.size(); ++row) {
      auto found = std::find_if(loci.begin(), loci.end(), [&](const MeasuredLocus& locus) {
        return std::abs(locus.consolidation / consolidation[row] - 1) < 1e-6;
      });
      if (found == loci.end()) {
        loci.push_back({.consolidation = consolidation[row]});
        pre_shear.emplace_back(), lines.push_back(table.lines[row]);
        found = loci.end() - 1;
      }
      if (density) found->bulk_density = density->values[row];
      const YieldPoint point{normal[row], shear[row]};
      const double load = normal[row] / consolidation[row];
      if (load > 1 + 1e-3)
        faults.add(table.lines[row], "normal_stress", fmt::format("{:.4g} Pa is above the consolidation", point.normal),
                   fmt::format("at most {:.4g} Pa", consolidation[row]));
      else if (load > 1 - 1e-3)
        pre_shear[static_cast<std::size_t>(found - loci.begin())] = point;
      else
        found->points.push_back(point);
    }
  }
  std::size_t points = 0;
  for (std::size_t n = 0; n < loci.size(); ++n) {
    evaluate(loci[n], pre_shear[n], lines[n], faults);
    points += loci[n].points.size();
  }
  if (loci.size() < least_loci || points < least_points_in_all)
    faults.add(0, "",
               fmt::format("holds {} yield {} with {} points of failure", loci.size(),
                           loci.size() == 1 ? "locus" : "loci", points),
               "two loci of different consolidation and four points at least");
  faults.finish();
  return loci;
}

std::vector<YieldPoint> read_wall_data(const std::filesystem::path& path) {
  static constexpr std::string_view required[] = {"normal_stress", "shear_stress"};
  const CsvTable table = read_csv_table(path, {.known = std::span(known).subspan(1, 2),
                                               .required = required,
                                               .known_only = true,
                                               .header = "normal_stress [kPa], shear_stress [kPa]"});
  Faults faults{path};
  for (const std::string_view name : required) faults.check_stresses(table, name, least_stress);
  if (table.lines.size() < 3) faults.add(0, "", fmt::format("holds {} points", table.lines.size()), "three at least");
  faults.finish();
  std::vector<YieldPoint> points;
  for (std::size_t row = 0; row < table.lines.size(); ++row)
    points.push_back({table.find("normal_stress")->values[row], table.find("shear_stress")->values[row]});
  return points;
}

}  // namespace talus::app
