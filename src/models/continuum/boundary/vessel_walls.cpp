// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_walls.hpp"

#include <algorithm>
#include <cmath>

#include "base/instruction_set.hpp"
#include "models/continuum/pairs/quanta.hpp"
#include "numerics/surface/surface.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {

namespace {

constexpr double edge_of_cell = 2;  // of the grids of points, in spacings
constexpr int steps_of_h = 64;

std::array<float, 3> single(const Vector3& x) {
  return {static_cast<float>(x.x), static_cast<float>(x.y), static_cast<float>(x.z)};
}

}  // namespace

VesselWalls::VesselWalls(const Surface& surface, double spacing, InstructionSet set, const SurfaceFields* fields,
                         const std::optional<Sector>& sector, int levels)
    : surface_(surface),
      fields_(fields),
      kernels_(TALUS_COMPILED_FOR(set, wall_kernels)()),
      spacing_(spacing),
      sets_(sets_for(levels)) {
  if (surface.is_empty()) return;
  patches_.resize(surface.parts());
  quantum_ = quantum_of_walls(spacing);
  // Those of the finest level last.
  for (std::size_t k = 0; k < sets_; ++k) {
    const std::size_t n = (k + sets_of_points) % sets_;
    first_record_[n] = static_cast<std::uint32_t>(records_.size());
    const double apart = apart_in(n) * spacing;
    const std::vector<SurfacePoint> points = spread_points(surface, apart, sector);
    // Numbered cell by cell: points that are near each other stand together.
    std::vector<Vector3> places;
    for (const SurfacePoint& point : points) places.push_back(point.place);
    const CellGrid as_spread(places, edge_of_cell * spacing);
    for (const std::uint32_t p : as_spread.order()) {
      const SurfacePoint& point = points[p];
      const auto place = in_quanta(point.place, 1 / quantum_);
      const auto normal = single(point.normal);
      records_.push_back(
          {{place[0], place[1], place[2]}, {normal[0], normal[1], normal[2]}, static_cast<float>(point.area), 0});
      places_.push_back(point.place);
      parts_.push_back(point.part);
      patches_[point.part] = point.patch;
    }
    grids_[n].emplace(std::span(places_).subspan(first_record_[n]), edge_of_cell * spacing);
  }
  const double reach = 2.6 * (1 << levels);  // of a particle of the bed, with its margin, in spacings
  std::vector<Vector3> normals;
  for (std::uint32_t n = 0; n < records_.size(); ++n) normals.push_back(normal_of(n));
  visibility_ = WallVisibility(surface, places_, normals, parts_, records_.size() - first_record_[sets_of_points - 1],
                               spacing, reach * spacing);
  records_.push_back({{}, {1, 0, 0}, 0, 0});
  for (int n = 0; n <= 2 * steps_of_h; ++n) plane_.push_back(sph::weight_of_plane(static_cast<double>(n) / steps_of_h));
}

void VesselWalls::meet(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
  is_met_ = true;
  for_each(team, particles_.size(), [&](std::size_t slot) {
    const std::size_t i = particles_[slot];
    meet(slot, position[i], smoothing_length[i]);
  });
  for_each(team, images_.size(), [&](std::size_t n) {
    WallSeat& seat = seats_[stands_.size() + n];
    seat = seats_[images_[n].stand];
    const Image& image = images_[n].image;
    const Vector3 normal = image.position({seat.normal[0], seat.normal[1], seat.normal[2]}) - image.position({});
    seat.normal[0] = normal.x, seat.normal[1] = normal.y, seat.normal[2] = normal.z;
  });
}

double VesselWalls::share_of_plane(double weight, double distance_over_h) const {
  const double place = distance_over_h * steps_of_h;
  if (!(place < 2 * steps_of_h)) return 0;
  const auto n = static_cast<std::size_t>(place);
  const double part = place - static_cast<double>(n), whole = (1 - part) * plane_[n] + part * plane_[n + 1];
  return whole > 0 ? std::min(1.0, weight / whole) : 0;
}

void VesselWalls::meet(std::size_t slot, const Vector3& position, double smoothing_length) {
  NearWall* const met = met_.data() + first_stand_[slot];
  std::size_t count = 0;
  NearWall one_more;
  const auto place = in_quanta(position, 1 / quantum_);
  for (std::uint32_t s = first_stand_[slot]; s < first_stand_[slot + 1]; ++s) {
    const Stand& stand = stands_[s];
    seats_[s].share = 0;
    if (surface_.is_open(stand.patch)) continue;
    NearWall& wall = count < max_near_walls ? met[count] : one_more;
    kernels_.points({records_.data(), near_.data() + stand.first, stand.count, quantum_}, place.data(),
                    smoothing_length, wall.sums);
    const Vector3 normal{wall.sums.normal[0], wall.sums.normal[1], wall.sums.normal[2]};
    const double size = norm(normal);
    if (!(size > 0)) continue;
    wall.patch = stand.patch, wall.part = stand.part, wall.stand = s, wall.fields = stand.fields;
    wall.normal = (1 / size) * normal;
    wall.distance = wall.sums.distance / wall.sums.weight;
    wall.share = share_of_plane(wall.sums.weight * smoothing_length, wall.distance / smoothing_length);
    if (&wall != &one_more) {
      ++count;
    } else {
      NearWall& least = *std::min_element(
          met, met + count, [](const NearWall& a, const NearWall& b) { return a.sums.weight < b.sums.weight; });
      if (least.sums.weight < wall.sums.weight) least = wall;
    }
  }
  met_count_[slot] = static_cast<std::uint8_t>(count);
  for (const NearWall& wall : std::span(met, count))
    seats_[wall.stand] = {{wall.normal.x, wall.normal.y, wall.normal.z}, wall.distance, wall.share, {}};
}

/// The place of the surface nearest to y, if it is nearer than `within`. \param clear what is known, and is known then
std::optional<Surface::Foot> VesselWalls::foot_near(Clearance& clear, const Vector3& y, double within) const {
  const double looked_beyond = 0.3 * spacing_, moved = norm(y - clear.around);
  if (moved + within < clear.distance) return std::nullopt;
  std::optional<Surface::Foot> foot;
  const bool searched = clear.triangles == 0 || !(moved < looked_beyond);
  if (searched) {
    // The tree finds triangles whose boxes are within that distance, several times as many as are themselves.
    constexpr std::size_t max_found = 64;
    thread_local std::vector<std::uint32_t> near;
    clear = {y, within + looked_beyond, 0, {}};
    bool all = surface_.near(y, clear.distance, max_found, near);
    if (all) {
      const double slack = 1e-9 * clear.distance;
      std::erase_if(near, [&](std::uint32_t t) {
        return norm(nearest_place(surface_.triangles()[t], y) - y) > clear.distance + slack;
      });
      if (near.empty()) return std::nullopt;
      all = near.size() <= Clearance::max_triangles;
    }
    if (all) {
      clear.triangles = static_cast<std::uint32_t>(near.size());
      std::copy(near.begin(), near.end(), clear.triangle.begin());
    } else {
      foot = surface_.nearest(y, clear.distance);
    }
  }
  for (std::uint32_t n = 0; n < clear.triangles; ++n) {
    const std::uint32_t t = clear.triangle[n];
    const Vector3 place = nearest_place(surface_.triangles()[t], y);
    const double distance = norm(place - y);
    if (!foot || distance < foot->distance || (distance == foot->distance && t < foot->triangle))
      foot = Surface::Foot{t, place, distance};
  }
  if (searched && foot) clear.distance = std::min(clear.distance, foot->distance);
  return foot && foot->distance < within ? foot : std::nullopt;
}

std::optional<VesselWalls::Touch> VesselWalls::touched(std::size_t place, const Vector3& x, const Vector3& y,
                                                       double within) {
  const auto foot = foot_near(clearance_[place], y, within);
  if (!foot) return std::nullopt;
  const Vector3 out = y - foot->place;
  Touch touch{foot->triangle, foot->place, (1 / foot->distance) * out};
  if (dot(out, x - foot->place) > 0) return touch;
  // On the surface or beyond it.
  if (const auto crossing = surface_.first_crossing(x, y))
    touch.triangle = crossing->triangle, touch.place = x + crossing->at * (y - x);
  const Vector3& normal = surface_.normal(touch.triangle);
  touch.normal = dot(normal, x - touch.place) < 0 ? -1.0 * normal : normal;
  return touch;
}

Vector3 VesselWalls::force_of_images(const NearWall& wall, const Records& records, std::size_t particle,
                                     const std::span<const std::uint32_t>* seen, double mass) const {
  const std::uint32_t first = first_pair_[wall.stand], size = first_pair_[wall.stand + 1] - first;
  WallPairs pairs{pair_record_.data() + first, pair_seat_.data() + first, size};
  if (seen) {
    thread_local std::vector<std::uint32_t> of_thread[2];
    auto& [record, seat] = of_thread;
    record.clear(), seat.clear();
    for (std::uint32_t n = 0; n < size; ++n)
      if (std::binary_search(seen->begin(), seen->end(), pairs.record[n]))
        record.push_back(pairs.record[n]), seat.push_back(pairs.seat[n]);
    while (record.size() % WallPairs::padded_to != 0)
      record.push_back(pair_record_[first + size - 1]), seat.push_back(static_cast<std::uint32_t>(seats_.size() - 1));
    pairs = {record.data(), seat.data(), static_cast<std::uint32_t>(record.size())};
  }
  alignas(64) double acceleration[4];
  kernels_.images(records, static_cast<std::uint32_t>(particle), seats_[wall.stand], seats_.data(), pairs, mass,
                  acceleration);
  return {acceleration[0], acceleration[1], acceleration[2]};
}

}  // namespace talus::continuum
