// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <string_view>
#include <type_traits>

#include "numerics/cell_grid.hpp"
#include "numerics/snapshot_of.hpp"

namespace talus::continuum {

namespace {

constexpr double degree = std::numbers::pi / 180;

/// Of the triangle the one it turns into by one angle of the sector, to a millionth of the vessel.
bool has_copy(const Surface& surface, const CellGrid& middles, const Sector& sector, std::size_t triangle,
              double slack) {
  const Triangle& t = surface.triangles()[triangle];
  bool found = false;
  middles.for_each_candidate(sector.turned(t.middle(), 1), [&](std::uint32_t u) {
    if (found || surface.part(u) != surface.part(triangle)) return;
    const auto& corners = surface.triangles()[u].corner;
    found = std::all_of(t.corner.begin(), t.corner.end(), [&](const Vector3& corner) {
      const Vector3 x = sector.turned(corner, 1);
      return std::any_of(corners.begin(), corners.end(), [&](const Vector3& c) { return norm(c - x) <= slack; });
    });
  });
  return found;
}

/// The components of a tensor follow each other in the order of SymmetricTensor3.
bool begins_tensor(const std::vector<ColumnView>& columns, std::size_t first) {
  constexpr std::array<std::string_view, 6> endings = {"_xx", "_yy", "_zz", "_xy", "_yz", "_zx"};
  if (first + endings.size() > columns.size()) return false;
  for (std::size_t c = 0; c < endings.size(); ++c)
    if (!columns[first + c].name.ends_with(endings[c])) return false;
  return true;
}

}  // namespace

std::vector<Problem> check_sector(const Parameters& p) {
  std::vector<Problem> problems;
  if (!p.box.sector) return problems;
  const auto refuse = [&](bool given, std::string key, std::string what, std::string allowed) {
    if (given) problems.push_back({.key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)});
  };
  const double copies = 2 * std::numbers::pi / *p.box.sector, nearest = std::round(copies);
  refuse(std::abs(copies - nearest) > 1e-6 * nearest, "box.sector",
         fmt::format("{:.4g} deg is no whole part of 360 deg", *p.box.sector / degree),
         fmt::format("{:.6g} deg, a part of {:g}", 360 / nearest, nearest));
  refuse(p.vessel.empty(), "box.sector", "given, but there is no [[vessel]]", "an axisymmetric vessel");
  refuse(!p.plates.empty(), "plates", "plates through the depth of the box beside box.sector", "one of them");
  refuse(p.air.enabled, "air.enabled", "the air's cells are no sector", "false with box.sector");
  refuse(!p.inlets.empty(), "inlet", "grains do not come into a sector yet", "none with box.sector");
  const auto refuse_ends = [&](const BedRegion& bed, const auto& key) {
    const std::pair<const char*, const std::optional<double>&> ends[] = {
        {"left", bed.left}, {"right", bed.right}, {"front", bed.front}, {"rear", bed.rear}};
    for (const auto& [name, end] : ends)
      refuse(end.has_value(), key(name), "cuts the bed of a sector", "left out with box.sector");
    refuse(bed.velocity && ((*bed.velocity)[0] != 0 || (*bed.velocity)[1] != 0), key("velocity"),
           "is not along the axis of the sector", "0 along x and y with box.sector");
  };
  refuse_ends(p.bed, [](const char* name) { return std::string("bed.") + name; });
  for (std::size_t n = 0; n < p.beds.size(); ++n)
    refuse_ends(p.beds[n], [n](const char* name) { return beds_key(n, name); });
  refuse(p.bed.given != nullptr, "bed.file", "particles of a file in a sector", "left out with box.sector");
  return problems;
}

std::vector<Problem> check_symmetry(const Parameters& p) {
  const std::optional<Sector> sector = sector_of(p);
  if (!sector || p.vessel.empty()) return {};
  const Surface surface = surface_of(p);
  std::vector<Vector3> middles;
  for (const Triangle& t : surface.triangles()) middles.push_back(t.middle());
  const double slack = 1e-6 * norm(surface.high() - surface.low());
  const CellGrid grid(middles, 1e4 * slack);
  std::set<std::uint32_t> bent;
  for (std::size_t t = 0; t < surface.triangles().size(); ++t)
    if (const std::uint32_t patch = surface.triangles()[t].patch; !bent.contains(patch))
      if (!has_copy(surface, grid, *sector, t, slack)) bent.insert(patch);
  std::vector<Problem> problems;
  for (const std::uint32_t patch : bent)
    problems.push_back({.key = vessel_key(patch, "shape"),
                        .what = fmt::format("{} does not turn into itself by {:.4g} deg about the axis of the sector",
                                            name_of(p, patch), *p.box.sector / degree),
                        .allowed = fmt::format("round walls with their axis at ({:.4g}, {:.4g}) mm, as without "
                                               "`centre`, or no box.sector",
                                               1e3 * sector->axis().x, 1e3 * sector->axis().y)});
  return problems;
}

void return_to_sector(const Domain& domain, const Material& material, State& s) {
  if (!domain.sector()) return;
  const int copies = domain.sector()->copies();
  for (std::size_t i = 0; i < s.position.size(); ++i) {
    const std::optional<Image> image = domain.back_into_sector(s.position[i]);
    if (!image) continue;
    s.position[i] = image->position(s.position[i]);
    s.velocity[i] = image->vector(s.velocity[i]);
    if (!s.reset_position.empty()) s.reset_position[i] = image->position(s.reset_position[i]);
    material.mirror(s.material, i, *image);
    for (auto* rate : {&s.lasting_rate, &s.deformation_rate})
      if (!(*rate)[0].empty()) set_tensor(*rate, i, image->tensor(tensor_at(*rate, i)));
    s.sector_turns[i] = (s.sector_turns[i] + copies - image->turns) % copies;
  }
}

PointSet whole_of(const State& s, const Sector& sector) {
  Snapshot part = snapshot_of(s);
  const int copies = sector.copies();
  const std::size_t own = s.position.size();
  std::erase_if(part.columns, [&](const ColumnView& column) {  // not yet derived
    return std::visit([&](const auto& values) { return values.size() != own; }, column.values);
  });
  PointSet whole{.time = part.time, .step = part.step, .columns = {}};
  /// Writes value(i, k) of particle i in copy k.
  const auto add = [&](const ColumnView& column, const auto& value) {
    std::vector<std::decay_t<decltype(value(std::size_t{0}, 0))>> values(own * static_cast<std::size_t>(copies));
    for (int k = 0; k < copies; ++k)
      for (std::size_t i = 0; i < own; ++i) values[static_cast<std::size_t>(k) * own + i] = value(i, k);
    whole.columns.push_back({std::string(column.name), std::string(column.unit), std::move(values)});
  };
  const auto number = static_cast<std::int64_t>(s.population.next_identity);
  for (std::size_t c = 0; c < part.columns.size(); ++c) {
    const ColumnView& column = part.columns[c];
    if (const auto* vectors = std::get_if<std::span<const Vector3>>(&column.values)) {
      const bool places = column.name == "position";
      add(column, [&](std::size_t i, int k) {
        return places ? sector.turned((*vectors)[i], k) : sector.turn(k) * (*vectors)[i];
      });
    } else if (const auto* integers = std::get_if<std::span<const std::int64_t>>(&column.values)) {
      const std::int64_t apart = column.name == "identity" ? number : 0;  // copies of a tag are alike
      add(column,
          [&](std::size_t i, int k) { return (*integers)[i] + apart * ((k + copies - s.sector_turns[i]) % copies); });
    } else if (begins_tensor(part.columns, c)) {
      std::array<std::span<const double>, 6> of{};
      for (std::size_t n = 0; n < 6; ++n) of[n] = std::get<std::span<const double>>(part.columns[c + n].values);
      std::array<std::vector<double>, 6> turned;
      for (auto& values : turned) values.reserve(own * static_cast<std::size_t>(copies));
      for (int k = 0; k < copies; ++k)
        for (std::size_t i = 0; i < own; ++i) {
          const SymmetricTensor3<> t =
              transformed({of[0][i], of[1][i], of[2][i], of[3][i], of[4][i], of[5][i]}, sector.turn(k));
          const double component[6] = {t.xx, t.yy, t.zz, t.xy, t.yz, t.zx};
          for (std::size_t n = 0; n < 6; ++n) turned[n].push_back(component[n]);
        }
      for (std::size_t n = 0; n < 6; ++n)
        whole.columns.push_back(
            {std::string(part.columns[c + n].name), std::string(part.columns[c + n].unit), std::move(turned[n])});
      c += 5;
    } else {
      const auto scalars = std::get<std::span<const double>>(column.values);
      add(column, [&](std::size_t i, int) { return scalars[i]; });
    }
  }
  return whole;
}

}  // namespace talus::continuum
