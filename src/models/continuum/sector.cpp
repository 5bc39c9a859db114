// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/sector.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>
#include <type_traits>

#include "base/unit.hpp"
#include "numerics/cell_grid.hpp"
#include "numerics/field.hpp"

namespace talus::continuum {

namespace {

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

std::vector<Problem> check_symmetry(const Layout& layout) {
  const Parameters& p = layout.given;
  const std::optional<Sector>& sector = layout.sector();
  if (!sector || p.vessel.empty()) return {};
  const Surface& surface = layout.boundary->vessel();
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
    if (!s.lasting_rate[0].empty()) set_tensor(s.lasting_rate, i, image->tensor(tensor_at(s.lasting_rate, i)));
    s.sector_turns[i] = (s.sector_turns[i] + copies - image->turns) % copies;
  }
}

SectorCopies copies_of(const State& s, const Sector& sector) {
  // Where particles split, one number in all snapshots, above all identities.
  constexpr std::int64_t far_above = std::int64_t{1} << 32;
  return {sector.axis(), sector.copies(),
          s.has.mass_ratio ? far_above : static_cast<std::int64_t>(s.population.next_identity)};
}

PointSet part_of(const State& s, const Sector& sector) {
  const Snapshot state = snapshot_of(s);
  const SectorCopies copies = copies_of(s, sector);
  PointSet part{.time = state.time, .step = state.step, .columns = {}, .copies = copies};
  for (const ColumnView& column : state.columns)
    std::visit(
        [&](const auto& values) {
          if (values.empty() && !s.position.empty()) return;  // not yet derived
          std::vector<std::decay_t<decltype(values[0])>> own(values.begin(), values.end());
          if constexpr (std::is_same_v<decltype(own), std::vector<std::int64_t>>)
            for (std::size_t i = 0; i < own.size() && column.name == "identity"; ++i)
              own[i] = identity_in_whole(copies, own[i], s.sector_turns[i]);
          part.columns.push_back({std::string(column.name), std::string(column.unit), std::move(own)});
        },
        column.values);
  return part;
}

}  // namespace talus::continuum
