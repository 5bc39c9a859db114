// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/vessel_walls.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/compiled_for.hpp"
#include "numerics/surface/surface_points.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {

namespace {

/// Distance of the points of the walls, in spacings. Of the fine ones: the push of a plane is right to 1 % from 0.4
/// spacings on, to 7 % from 0.25 on (WallIntegrals.AreThoseOfAPlane). The coarse ones, right to 1 % from a spacing on,
/// are for particles farther away than `coarse_from` when the lists are built. A particle takes one set only: sums over
/// evenly spread points are exact far beyond their distance, and a border between two sets would spoil that.
constexpr std::array<double, 2> pieces{0.4, 0.8};
constexpr double coarse_from = 1.15;
constexpr int steps_of_h = 64;

}  // namespace

VesselWalls::VesselWalls(const Surface& surface, double spacing, InstructionSet set)
    : surface_(surface), sweep_(TALUS_COMPILED_FOR(set, wall_sweep)()), spacing_(spacing) {
  if (surface.is_empty()) return;
  patches_.resize(surface.parts());
  for (std::size_t n = 0; n < levels_.size(); ++n) {
    levels_[n].first = static_cast<std::uint32_t>(records_.size());
    std::vector<SurfacePoint> points = spread_points(surface, pieces[n] * spacing);
    std::stable_sort(points.begin(), points.end(),
                     [](const SurfacePoint& a, const SurfacePoint& b) { return a.part < b.part; });
    for (const SurfacePoint& point : points) {
      const Vector3 &x = point.place, &normal = point.normal;
      records_.push_back({{x.x, x.y, x.z}, {normal.x, normal.y, normal.z}, point.area, 0});
      parts_.push_back(point.part);
      patches_[point.part] = point.patch;
      levels_[n].places.push_back(x);
    }
  }
  records_.push_back({{1e3, 1e3, 1e3}, {1, 0, 0}, 0, 0});
  for (int n = 0; n <= 2 * steps_of_h; ++n) plane_.push_back(sph::weight_of_plane(static_cast<double>(n) / steps_of_h));
}

/// What some particles, one after the other, have found.
struct VesselWalls::Found {
  std::vector<std::uint32_t> near;
  std::vector<Stand> stands;
  std::vector<std::uint32_t> particles, stands_of;  // that have found some, and how many
};

/// Adds the records within reach of a particle, by part.
void VesselWalls::find_points(const Level& level, const Vector3& position, double reach, Found& found) const {
  const auto begin = static_cast<std::uint32_t>(found.near.size());
  level.grid->for_each_candidate(position, [&](std::uint32_t n) {
    const Vector3 d = level.places[n] - position;
    if (dot(d, d) <= reach * reach && !surface_.is_open(patches_[parts_[level.first + n]]))
      found.near.push_back(level.first + n);
  });
  // In an order of their own, whatever the cells are.
  std::sort(found.near.begin() + begin, found.near.end());
  const auto end = static_cast<std::uint32_t>(found.near.size());
  std::uint32_t stands = 0;
  for (std::uint32_t n = begin; n < end; ++stands) {
    const std::uint32_t first = n, part = parts_[found.near[n]];
    double distance = std::numeric_limits<double>::infinity();
    for (; n < end && parts_[found.near[n]] == part; ++n) {
      const double* normal = records_[found.near[n]].normal;
      const Vector3 d = level.places[found.near[n] - level.first] - position;
      distance = std::min(distance, std::abs(d.x * normal[0] + d.y * normal[1] + d.z * normal[2]));
    }
    found.stands.push_back({first, n - first, patches_[part], part, distance});
  }
  found.stands_of.push_back(stands);
}

void VesselWalls::find(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                       std::span<const double> smoothing_length, double skin) {
  is_met_ = false;
  if (is_empty()) return;
  const double largest = position.empty() ? 0 : *std::max_element(smoothing_length.begin(), smoothing_length.end());
  if (const double reach = 2 * largest + skin; !(cell_ >= reach)) {
    cell_ = 1.1 * reach;
    for (Level& level : levels_) level.grid.emplace(level.places, cell_);
  }
  std::vector<Found> found((position.size() + chunk_size - 1) / chunk_size);
  team.run(found.size(), [&](std::size_t chunk) {
    for (std::size_t i = chunk * chunk_size; i < std::min(position.size(), (chunk + 1) * chunk_size); ++i) {
      const double distance = neighbourhood.distance_from_vessel(i);
      if (!std::isfinite(distance)) continue;
      find_points(levels_[distance > coarse_from * spacing_], position[i], 2 * smoothing_length[i] + skin,
                  found[chunk]);
      if (found[chunk].stands_of.back() == 0)
        found[chunk].stands_of.pop_back();
      else
        found[chunk].particles.push_back(static_cast<std::uint32_t>(i));
    }
  });
  near_.clear();
  slot_.assign(position.size(), -1);
  particles_.clear();
  stands_.clear();
  first_stand_.assign(1, 0);
  for (const Found& some : found) {
    const auto before = static_cast<std::uint32_t>(near_.size());
    near_.insert(near_.end(), some.near.begin(), some.near.end());
    for (Stand stand : some.stands) {
      stand.first += before;
      stands_.push_back(stand);
    }
    for (std::size_t n = 0; n < some.particles.size(); ++n) {
      slot_[some.particles[n]] = static_cast<std::int32_t>(particles_.size());
      particles_.push_back(some.particles[n]);
      first_stand_.push_back(first_stand_.back() + some.stands_of[n]);
    }
  }
  met_.resize(particles_.size());
  find_pairs(team, neighbourhood, position, smoothing_length, skin);
}

/// Who stands with a particle at the same part of a wall, as near to the particle's image there as the kernel reaches.
void VesselWalls::find_pairs(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                             std::span<const double> smoothing_length, double skin) {
  const std::size_t count = neighbourhood.particles();
  const auto ghosts = neighbourhood.ghosts();
  images_.clear();
  std::vector<std::uint32_t> seat_of_ghost(ghosts.size());  // the first of them
  for (std::size_t g = 0; g < ghosts.size(); ++g) {
    seat_of_ghost[g] = static_cast<std::uint32_t>(stands_.size() + images_.size());
    if (const std::int32_t slot = slot_[ghosts[g].source]; slot >= 0)
      for (std::uint32_t s = first_stand_[static_cast<std::size_t>(slot)];
           s < first_stand_[static_cast<std::size_t>(slot) + 1]; ++s)
        images_.push_back({s, neighbourhood.image(ghosts[g])});
  }
  seats_.assign(stands_.size() + images_.size() + 1, {});
  const auto nobody = static_cast<std::uint32_t>(seats_.size() - 1),
             no_record = static_cast<std::uint32_t>(count + ghosts.size());

  struct Pairs {
    std::vector<std::uint32_t> record, seat, size;
  };
  std::vector<Pairs> found((particles_.size() + chunk_size - 1) / chunk_size);
  team.run(found.size(), [&](std::size_t chunk) {
    Pairs& pairs = found[chunk];
    for (std::size_t slot = chunk * chunk_size; slot < std::min(particles_.size(), (chunk + 1) * chunk_size); ++slot) {
      const std::uint32_t i = particles_[slot];
      for (std::uint32_t s = first_stand_[slot]; s < first_stand_[slot + 1]; ++s) {
        const std::size_t begin = pairs.record.size();
        for (const std::uint32_t record : neighbourhood.of(i)) {
          const bool ghost = record >= count;
          const std::uint32_t source = ghost ? ghosts[record - count].source : record;
          if (slot_[source] < 0) continue;
          const std::uint32_t first = first_stand_[static_cast<std::size_t>(slot_[source])],
                              last = first_stand_[static_cast<std::size_t>(slot_[source]) + 1];
          for (std::uint32_t t = first; t < last; ++t) {
            if (stands_[t].part != stands_[s].part) continue;
            const double reach = smoothing_length[i] + smoothing_length[source] + skin;
            const Vector3 x =
                ghost ? neighbourhood.image(ghosts[record - count]).position(position[source]) : position[source];
            // Each may come nearer to the wall by half the skin.
            const double a = std::max(0.0, stands_[s].distance - 0.5 * skin),
                         b = std::max(0.0, stands_[t].distance - 0.5 * skin);
            if (dot(x - position[i], x - position[i]) + 4 * a * b > reach * reach) continue;
            pairs.record.push_back(record);
            pairs.seat.push_back(ghost ? seat_of_ghost[record - count] + (t - first) : t);
          }
        }
        while ((pairs.record.size() - begin) % Neighbours::padded_to != 0)
          pairs.record.push_back(no_record), pairs.seat.push_back(nobody);
        pairs.size.push_back(static_cast<std::uint32_t>(pairs.record.size() - begin));
      }
    }
  });
  first_pair_.assign(1, 0);
  pair_record_.clear();
  pair_seat_.clear();
  for (const Pairs& pairs : found) {
    pair_record_.insert(pair_record_.end(), pairs.record.begin(), pairs.record.end());
    pair_seat_.insert(pair_seat_.end(), pairs.seat.begin(), pairs.seat.end());
    for (const std::uint32_t size : pairs.size) first_pair_.push_back(first_pair_.back() + size);
  }
}

void VesselWalls::meet(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length) {
  is_met_ = true;
  for_each(team, particles_.size(), [&](std::size_t slot) {
    const std::size_t i = particles_[slot];
    meet(slot, position[i], smoothing_length[i], met_[slot]);
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

void VesselWalls::meet(std::size_t slot, const Vector3& position, double smoothing_length, NearWalls& met) {
  met.count = 0;
  NearWall one_more;
  const double place[3] = {position.x, position.y, position.z};
  for (std::uint32_t s = first_stand_[slot]; s < first_stand_[slot + 1]; ++s) {
    const Stand& stand = stands_[s];
    seats_[s].share = 0;
    if (surface_.is_open(stand.patch)) continue;
    const auto least = [&] {
      return std::min_element(met.of.begin(), met.of.end(),
                              [](const NearWall& a, const NearWall& b) { return a.sums.weight < b.sums.weight; });
    };
    NearWall& wall = met.count < most_near_walls ? met.of[met.count] : one_more;
    sweep_.points(records_.data(), near_.data() + stand.first, stand.count,
                  static_cast<std::uint32_t>(records_.size() - 1), place, smoothing_length, wall.sums);
    const Vector3 normal{wall.sums.normal[0], wall.sums.normal[1], wall.sums.normal[2]};
    const double size = norm(normal);
    if (!(size > 0)) continue;
    wall.patch = stand.patch, wall.part = stand.part, wall.stand = s;
    wall.normal = (1 / size) * normal;
    wall.distance = wall.sums.distance / wall.sums.weight;
    wall.share = share_of_plane(wall.sums.weight * smoothing_length, wall.distance / smoothing_length);
    if (&wall != &one_more)
      ++met.count;
    else if (least()->sums.weight < wall.sums.weight)
      *least() = wall;
  }
  for (const NearWall& wall : met.all())
    seats_[wall.stand] = {{wall.normal.x, wall.normal.y, wall.normal.z}, wall.distance, wall.share, {}};
}

Vector3 VesselWalls::force_of_images(const NearWall& wall, const Records& records, std::size_t particle,
                                     const std::span<const std::uint32_t>* seen, double mass) const {
  const std::uint32_t first = first_pair_[wall.stand], size = first_pair_[wall.stand + 1] - first;
  WallPairs pairs{pair_record_.data() + first, pair_seat_.data() + first, size};
  thread_local std::vector<std::uint32_t> record, seat;
  if (seen) {
    record.clear(), seat.clear();
    for (std::uint32_t n = 0; n < size; ++n)
      if (std::binary_search(seen->begin(), seen->end(), pairs.record[n]))
        record.push_back(pairs.record[n]), seat.push_back(pairs.seat[n]);
    while (record.size() % Neighbours::padded_to != 0)
      record.push_back(pair_record_[first + size - 1]), seat.push_back(static_cast<std::uint32_t>(seats_.size() - 1));
    pairs = {record.data(), seat.data(), static_cast<std::uint32_t>(record.size())};
  }
  alignas(64) double acceleration[4];
  sweep_.images(records, static_cast<std::uint32_t>(particle), seats_[wall.stand], seats_.data(), pairs, mass,
                acceleration);
  return {acceleration[0], acceleration[1], acceleration[2]};
}

}  // namespace talus::continuum
