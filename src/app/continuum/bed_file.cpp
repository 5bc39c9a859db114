// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/bed_file.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <string_view>

#include "base/error.hpp"
#include "io/csv_table.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

constexpr std::string_view hdf5_signature = "\x89HDF\r\n\x1a\n";
constexpr std::array<const char*, 3> velocity_names = {"velocity_x", "velocity_y", "velocity_z"};

bool is_hdf5(const std::filesystem::path& path) {
  std::array<char, hdf5_signature.size()> first{};
  std::ifstream(path, std::ios::binary).read(first.data(), first.size());
  return std::string_view(first.data(), first.size()) == hdf5_signature;
}

std::vector<Vector3> vectors(const CsvColumn& x, const CsvColumn& y, const CsvColumn& z) {
  std::vector<Vector3> values(x.values.size());
  for (std::size_t n = 0; n < values.size(); ++n) values[n] = {x.values[n], y.values[n], z.values[n]};
  return values;
}

continuum::GivenBed read_csv(const std::filesystem::path& path) {
  static constexpr KnownColumn known[] = {{"x", dimension::length},
                                          {"y", dimension::length},
                                          {"z", dimension::length},
                                          {"velocity_x", dimension::velocity},
                                          {"velocity_y", dimension::velocity},
                                          {"velocity_z", dimension::velocity},
                                          {"density", dimension::density}};
  static constexpr std::string_view required[] = {"x", "y", "z"};
  const CsvTable table = read_csv_table(
      path, {.known = known, .required = required, .known_only = true, .header = "x [mm], y [mm], z [mm]"});
  continuum::GivenBed bed;
  bed.lines = table.lines;
  bed.position = vectors(*table.find("x"), *table.find("y"), *table.find("z"));
  std::array<const CsvColumn*, 3> velocity{};
  for (std::size_t axis = 0; axis < 3; ++axis) velocity[axis] = table.find(velocity_names[axis]);
  const auto there = std::count_if(velocity.begin(), velocity.end(), [](const CsvColumn* c) { return c != nullptr; });
  if (there == 3) {
    bed.velocity = vectors(*velocity[0], *velocity[1], *velocity[2]);
  } else if (there > 0) {
    const auto missing =
        static_cast<std::size_t>(std::find(velocity.begin(), velocity.end(), nullptr) - velocity.begin());
    throw InputError({{.where = path.string(),
                       .what = fmt::format("has no column {}", velocity_names[missing]),
                       .allowed = "velocity_x, velocity_y and velocity_z, or none of them"}});
  }
  if (const CsvColumn* density = table.find("density")) bed.density = density->values;
  return bed;
}

continuum::GivenBed read_vtkhdf(const std::filesystem::path& path) {
  PointSet points = read_points(path);
  continuum::GivenBed bed;
  std::vector<Problem> problems;
  const auto take = [&]<class Values>(PointSet::Column& column, std::string_view unit, Values& values) {
    auto* const own = std::get_if<Values>(&column.values);
    const bool fits = column.unit == unit || column.unit == "1" || column.unit.empty();
    if (own && fits)
      values = std::move(*own);
    else
      problems.push_back({.where = path.string(),
                          .what = fmt::format("column {}: {}", column.name,
                                              own ? fmt::format("its unit is {}", column.unit) : "is of another kind"),
                          .allowed = fmt::format(
                              "{} in {}", std::is_same_v<Values, std::vector<Vector3>> ? "vectors" : "numbers", unit)});
  };
  for (PointSet::Column& column : points.columns) {
    if (column.name == "position")
      take(column, "m", bed.position);
    else if (column.name == "velocity")
      take(column, "m/s", bed.velocity);
    else if (column.name == "density")
      take(column, "kg/m3", bed.density);
    else if (const auto* ratio = std::get_if<std::vector<double>>(&column.values);
             ratio && column.name == "mass_ratio" &&
             std::any_of(ratio->begin(), ratio->end(), [](double r) { return r != 1; }))
      problems.push_back({.where = path.string(),
                          .what = "column mass_ratio: particles of several sizes, whose masses a bed does not keep",
                          .allowed = "a snapshot of a run without levels and sector"});
    else
      bed.unread.push_back(column.name);
  }
  if (!problems.empty()) throw InputError(std::move(problems));
  return bed;
}

}  // namespace

continuum::GivenBed read_bed(const std::filesystem::path& path) {
  continuum::GivenBed bed = is_hdf5(path) ? read_vtkhdf(path) : read_csv(path);
  if (!bed.position.empty()) bed.low = bed.high = bed.position.front();
  for (const Vector3& x : bed.position)
    for (int axis = 0; axis < 3; ++axis)
      bed.low[axis] = std::min(bed.low[axis], x[axis]), bed.high[axis] = std::max(bed.high[axis], x[axis]);
  return bed;
}

}  // namespace talus::app
