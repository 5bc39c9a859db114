// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/accuracy.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <utility>

#include "base/error.hpp"
#include "io/parameter_value.hpp"
#include "models/continuum/regime.hpp"
#include "models/continuum/setup/choices.hpp"
#include "models/continuum/setup/forecast.hpp"

namespace talus::app {

namespace {

using continuum::Accuracy;

constexpr int copies[] = {18, 15, 12, 10, 9, 8, 6, 5, 4};  // narrower sectors cost more: all their copies meet
constexpr double across_outlet[] = {8, 12, 20};            // particles, by Accuracy
constexpr double trial_spacings[] = {25, 50, 100, 200};    // on the width of the box, while the outlet is not known
constexpr int max_levels[] = {2, 1, 0};                    // by Accuracy: coarser particles bear walls too roughly
constexpr std::int64_t across_vessel = 16;                 // of the coarsest particles, at least
constexpr const char* option = "accuracy";

CaseFile with(CaseFile file, const std::string& setting) {
  file.set(setting, option);
  return file;
}

std::set<std::string> warnings_of(const continuum::Setup& setup) {
  std::set<std::string> names;
  for (const RegimeLine& line : continuum::regime_of_case(setup))
    if (line.warning) names.insert(line.quantity);
  return names;
}

std::optional<double> width_of_box(const CaseFile& file) {
  const CaseEntry* const entry = file.find("box.width");
  if (!entry) return std::nullopt;
  ValueFault fault;
  const auto value = convert_value(*entry, {"box.width", dimension::length, above(0), ""}, value_type<double>(), fault);
  return value ? std::optional(std::get<double>(*value)) : std::nullopt;
}

/// The width of the narrowest outlet, m; nothing without one. The case is read with spacings of a trial, the first that
/// its bed bears. \throws InputError if no spacing makes it valid
std::optional<double> outlet_width(const CaseFile& file, double box, const ReadSetup& read) {
  for (const double spacings : trial_spacings) try {
      const auto setup = read(with(file, "bed.spacing=" + millimetres(box / spacings)));
      if (!setup->outlet_width) return std::nullopt;
      double narrowest = *setup->outlet_width;
      for (const continuum::VesselOutlet& outlet : setup->vessel_outlets)
        narrowest = std::min(narrowest, outlet.narrow);
      return narrowest;
    } catch (const InputError&) {
      if (spacings == std::end(trial_spacings)[-1]) throw;
    }
  return std::nullopt;
}

/// With the narrowest sector that brings no warning; without any where none does.
CaseFile with_sector(const CaseFile& file, const ReadSetup& read) {
  std::optional<std::set<std::string>> known;
  for (const std::string& setting : sector_settings()) try {
      CaseFile changed = with(file, setting);
      const std::set<std::string> warnings = warnings_of(*read(changed));
      if (!known) known = warnings_of(*read(file));
      if (std::includes(known->begin(), known->end(), warnings.begin(), warnings.end())) return changed;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): a vessel that no sector stands for
    }
  return file;
}

/// Particles of one size across the bed where it is narrowest, with the half beyond a plane of symmetry that it
/// reaches.
double across_bed(const continuum::Setup& setup) {
  constexpr double tried = 1e4;  // particles
  const continuum::Layout bed(continuum::coarser(setup, tried));
  const double spacing = bed.given.bed.spacing;
  const std::vector<Vector3> positions = continuum::bed_positions(bed);
  const auto along = [&](int axis, FaceKind low_face, FaceKind high_face, double extent) {
    double low = extent, high = 0;
    for (const Vector3& x : positions) low = std::min(low, x[axis]), high = std::max(high, x[axis]);
    const bool at_low = low_face == FaceKind::symmetry && low < spacing;
    const bool at_high = high_face == FaceKind::symmetry && high > extent - spacing;
    return (at_low != at_high ? 2 : 1) * (high - low + spacing);
  };
  const auto& box = setup.given.box;
  double across = std::min(along(0, box.left, box.right, box.width), along(1, box.front, box.rear, box.depth));
  if (const std::optional<Sector> sector = bed.sector()) {
    double radius = 0;
    for (const Vector3& x : positions) radius = std::max(radius, sector->radius(x));
    across = 2 * radius + spacing;
  }
  return across / setup.given.bed.spacing;
}

/// With as many levels, up to some, as leave enough particles across the bed; without any where particles of several
/// sizes cannot be; with air only a case that says so has levels.
CaseFile with_levels(const CaseFile& file, int max, const ReadSetup& read) {
  for (int levels = max; levels > 0; --levels) try {
      CaseFile changed = with(file, fmt::format("levels.count={}", levels));
      const auto setup = read(changed);
      if (!setup->given.air.enabled && across_bed(*setup) >= static_cast<double>(across_vessel << levels))
        return changed;
    } catch (const InputError&) {  // NOLINT(bugprone-empty-catch): a case without an outlet
    }
  return file;
}

}  // namespace

std::vector<std::string> sector_settings() {
  std::vector<std::string> settings;
  for (const int n : copies) settings.push_back(fmt::format("box.sector={:g} deg", 360.0 / n));
  return settings;
}

std::string millimetres(double length) {
  const double value = 1e3 * length, unit = std::pow(10, std::floor(std::log10(value)) - 3);
  return fmt::format("{:.4g} mm", unit * std::floor(value / unit * (1 + 1e-12)));
}

CaseFile with_accuracy(const CaseFile& file, const ReadSetup& read) {
  const std::optional<Accuracy> accuracy = choice_in<Accuracy>(file, "accuracy");
  if (!accuracy) return file;
  CaseFile changed = file;
  const auto set = [&](const char* key, const std::string& value) {
    if (!file.contains(key)) changed.set(fmt::format("{}={}", key, value), option);
  };
  if (*accuracy != Accuracy::reference) set("integration.pair_precision", "single");
  if (!file.contains("bed.spacing")) {
    const std::optional<double> box = width_of_box(file);
    const std::optional<double> outlet = box ? outlet_width(changed, *box, read) : std::nullopt;
    if (!outlet) return changed;  // bed.spacing is missing, which reading it says
    set("bed.spacing", millimetres(*outlet / across_outlet[static_cast<std::size_t>(*accuracy)]));
  }
  if (*accuracy != Accuracy::reference && !file.contains("box.sector") && file.tables("vessel") > 0)
    changed = with_sector(changed, read);
  if (!file.contains("levels.count"))
    changed = with_levels(changed, max_levels[static_cast<std::size_t>(*accuracy)], read);
  return changed;
}

}  // namespace talus::app
