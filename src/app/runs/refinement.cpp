// SPDX-License-Identifier: Apache-2.0
#include "app/runs/refinement.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>
#include <variant>

#include "base/error.hpp"
#include "base/unit.hpp"
#include "io/file.hpp"

namespace talus::app {

namespace {

constexpr std::array<std::string_view, 5> of_the_machine{"wall_seconds", "cpu_seconds", "peak_memory", "threads",
                                                         "steps"};
constexpr double min_depth = 3;  // of a bed, in spacings

std::optional<double> length_in(const CaseFile& file, std::string_view key) {
  const CaseEntry* entry = file.find(key);
  const auto* text = entry ? std::get_if<std::string>(&entry->value.value) : nullptr;
  const auto quantity = text ? parse_quantity(*text) : std::nullopt;
  return quantity ? std::optional(quantity->value) : std::nullopt;
}

}  // namespace

CaseFile refined_case(const CaseFile& file) {
  const auto refuse = [](std::string key, std::string what, std::string allowed) {
    throw InputError(
        {{.where = "--refine", .key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)}});
  };
  const std::optional<double> spacing = length_in(file, "bed.spacing");
  if (!spacing)
    refuse("bed.spacing", "the case has no spacing of particles to divide", "a case of the model continuum");
  if (file.contains("integration.step"))
    refuse("integration.step", "is fixed, and the finer run would need a shorter one", "integration.courant");
  for (const char* key : {"box.width", "box.depth"})
    if (const auto depth = length_in(file, key); depth && *depth < (min_depth - 1e-9) * *spacing)
      refuse(key,
             fmt::format("{:.4g} mm are {:.2g} particles: a section, whose depth would no longer be a whole number of "
                         "them",
                         1e3 * *depth, *depth / *spacing),
             fmt::format("at least {:.4g} mm, or two runs with both divided", 1e3 * min_depth * *spacing));
  CaseFile finer = file;
  finer.set("bed.spacing=" + format_quantity(*spacing / refinement, "m"), "--refine");
  for (const char* key : {"air.cell", "air.cell_depth"})
    if (const auto cell = length_in(file, key))
      finer.set(fmt::format("{}={}", key, format_quantity(*cell / refinement, "m")), "--refine");
  return finer;
}

std::vector<RefinedQuantity> extrapolated(const Summary& coarse, const Summary& fine, double ratio) {
  std::vector<RefinedQuantity> found;
  for (const NamedValue& value : coarse.quantities) {
    const NamedValue* other = fine.find(value.name);
    if (!other || !std::isfinite(value.value) || !std::isfinite(other->value)) continue;
    if (std::find(of_the_machine.begin(), of_the_machine.end(), value.name) != of_the_machine.end()) continue;
    const double to_none = other->value + (other->value - value.value) / (ratio - 1);
    found.push_back({value.name, value.unit, value.value, other->value, to_none, std::abs(to_none - other->value)});
  }
  return found;
}

std::string table_of(const std::vector<RefinedQuantity>& quantities) {
  std::string text = fmt::format("{:<32} {:>12} {:>12} {:>12} {:>12}  {}\n", "", "spacing", "divided", "extrapolated",
                                 "error", "unit");
  for (const RefinedQuantity& q : quantities)
    text += fmt::format("{:<32} {:>12.5g} {:>12.5g} {:>12.5g} {:>12.2g}  {}\n", q.name, q.coarse, q.fine,
                        q.extrapolated, q.error, q.unit);
  return text;
}

void write_refinement(const std::filesystem::path& path, const std::vector<RefinedQuantity>& quantities) {
  nlohmann::ordered_json all = nlohmann::ordered_json::object();
  for (const RefinedQuantity& q : quantities)
    all[q.name] = {
        {"unit", q.unit}, {"coarse", q.coarse}, {"fine", q.fine}, {"extrapolated", q.extrapolated}, {"error", q.error}};
  const nlohmann::ordered_json json = {{"ratio", refinement}, {"quantities", all}};
  write_atomically(path, json.dump(2) + "\n");
}

}  // namespace talus::app
