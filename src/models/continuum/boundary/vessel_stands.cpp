// SPDX-License-Identifier: Apache-2.0
/// Who stands at which part of a vessel's walls, and with whom: found with the lists of neighbours.
#include <algorithm>
#include <cmath>
#include <limits>

#include "base/instruction_set.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/setup/levels.hpp"
#include "numerics/near_points/kernel.hpp"

namespace talus::continuum {

namespace {

constexpr double widest_group = 4;  // of particles that look for points together, in spacings

/// The coarsest set that a particle may take while the lists hold, of those of its level. \param distance, margin in
/// spacings of that level
std::size_t set_for(double distance, double margin) {
  std::size_t set = 0;
  while (set + 1 < sets_of_points && distance - margin > points_of_walls[set + 1].from) ++set;
  return set;
}

/// Around some particles and all that they reach.
struct Surroundings {
  static constexpr double infinity = std::numeric_limits<double>::infinity();
  Vector3 low{infinity, infinity, infinity}, high{-infinity, -infinity, -infinity};

  Surroundings with(const Vector3& x, double reach) const {
    Surroundings box = *this;
    for (int axis = 0; axis < 3; ++axis) {
      box.low[axis] = std::min(low[axis], x[axis] - reach);
      box.high[axis] = std::max(high[axis], x[axis] + reach);
    }
    return box;
  }
  bool is_empty() const { return !(low.x <= high.x); }
  bool is_wider_than(double width) const {
    return high.x - low.x > width || high.y - low.y > width || high.z - low.z > width;
  }
};

}  // namespace

/// What some particles, one after the other, have found.
struct VesselWalls::Found {
  std::vector<std::uint32_t> near;
  std::vector<Stand> stands;
  std::vector<std::uint32_t> particles, stands_of;  // that have found some, and how many
};

/// Points of a set around a few particles, in columns; the first block is a particle that looks for those near it.
class VesselWalls::PointsAround {
 public:
  void gather(const VesselWalls& walls, std::size_t set, const Vector3& low, const Vector3& high) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const std::uint32_t first = walls.first_record_[set];
    std::size_t n = PointBlock::size;
    const auto place_of = [&](std::size_t place) -> PointBlock& {
      if (place / PointBlock::size >= blocks_.size()) blocks_.resize(2 * (place / PointBlock::size) + 1);
      return blocks_[place / PointBlock::size];
    };
    walls.grids_[set]->for_each_row_between(low, high, [&](std::span<const std::uint32_t> points) {
      for (const std::uint32_t p : points) {
        const Vector3& x = walls.places_[first + p];
        if (x.x < low.x || x.y < low.y || x.z < low.z || x.x > high.x || x.y > high.y || x.z > high.z) continue;
        if (walls.surface_.is_open(walls.patches_[walls.parts_[first + p]])) continue;
        PointBlock& block = place_of(n);
        const std::size_t lane = n++ % PointBlock::size;
        block.x[lane] = x.x, block.y[lane] = x.y, block.z[lane] = x.z;
        block.radius[lane] = 0;
        block.number[lane] = first + p;
      }
    });
    for (; n % PointBlock::size != 0; ++n) blocks_[n / PointBlock::size].x[n % PointBlock::size] = infinity;
    const auto blocks = static_cast<std::uint32_t>(n / PointBlock::size);
    boxes_.resize((blocks - 1 + BlockBoxes::size - 1) / BlockBoxes::size);
    for (std::uint32_t k = 0; k < boxes_.size() * BlockBoxes::size; ++k) {
      BlockBoxes& to = boxes_[k / BlockBoxes::size];
      const std::size_t lane = k % BlockBoxes::size;
      // Around all space: the points are few.
      for (std::size_t axis = 0; axis < 3; ++axis)
        to.low[axis][lane] = 1 + k < blocks ? -infinity : infinity, to.high[axis][lane] = infinity;
      to.radius[lane] = 0;
      to.block[lane] = 1 + k;
    }
    for (std::size_t lane = 1; lane < PointBlock::size; ++lane) place_of(0).x[lane] = infinity;
    near_.resize(PointBlock::size * BlockBoxes::size * boxes_.size());
  }

  /// The records of those within reach, rising; until the next call.
  std::span<std::uint32_t> near(const Vector3& x, double reach) {
    static PickNear* const pick_near = TALUS_COMPILED_FOR(resolve(InstructionSet::automatic), pick_near);
    PointBlock& own = blocks_[0];
    own.x[0] = x.x, own.y[0] = x.y, own.z[0] = x.z, own.radius[0] = reach;
    return std::span(near_).first(pick_near(blocks_.data(), boxes_.data(), boxes_.size(), 0, 0, near_.data()));
  }

 private:
  std::vector<PointBlock> blocks_;
  std::vector<BlockBoxes> boxes_;  // of all but the first
  std::vector<std::uint32_t> near_;
};

/// The points of a part as a particle meets them. \param points of one part, at least one
PointsOfPart VesselWalls::points_of_part(const Vector3& position, std::span<std::uint32_t> points) const {
  PointsOfPart result;
  result.part = parts_[points.front()];
  result.points = points;
  double distance = std::numeric_limits<double>::infinity();
  for (const std::uint32_t n : points) {
    const Vector3 normal = normal_of(n);
    const double below = dot(places_[n] - position, normal);
    result.side = result.side | (below < 0 ? Side::above : Side::below);
    if (!(std::abs(below) < distance)) continue;
    distance = std::abs(below);
    result.foot = position + below * normal;
    result.above_nearest = below < 0;
    result.normal = below < 0 ? normal : -1.0 * normal;
  }
  return result;
}

/// Adds a particle's stands at the parts of the walls that it sees. \param near records within reach, rising
/// \returns whether there are any
bool VesselWalls::add_stands(const Vector3& position, std::span<std::uint32_t> near, Found& found) const {
  const auto of_other_part = [&](std::uint32_t n) { return parts_[n] != parts_[near.front()]; };
  if (std::any_of(near.begin(), near.end(), of_other_part))
    std::sort(near.begin(), near.end(),
              [&](std::uint32_t a, std::uint32_t b) { return std::pair(parts_[a], a) < std::pair(parts_[b], b); });
  const auto padding = static_cast<std::uint32_t>(records_.size() - 1);
  thread_local std::vector<PointsOfPart> of_thread;
  std::vector<PointsOfPart>& parts = of_thread;
  parts.clear();
  for (std::size_t begin = 0, end = 0; begin < near.size(); begin = end) {
    while (end < near.size() && parts_[near[end]] == parts_[near[begin]]) ++end;
    parts.push_back(points_of_part(position, near.subspan(begin, end - begin)));
  }
  std::uint32_t stands = 0;
  for (std::size_t n = 0; n < parts.size(); ++n) {
    const std::size_t seen = visibility_.keep_visible(position, parts, n);
    if (seen == 0) continue;
    const PointsOfPart part =
        seen == parts[n].points.size() ? parts[n] : points_of_part(position, parts[n].points.first(seen));
    const auto first = static_cast<std::uint32_t>(found.near.size());
    found.near.insert(found.near.end(), part.points.begin(), part.points.end());
    while ((found.near.size() - first) % WallPoints::padded_to != 0) found.near.push_back(padding);
    found.stands.push_back({first, static_cast<std::uint32_t>(found.near.size()) - first, patches_[part.part],
                            part.part, fields_ ? fields_->under(part.part, part.foot) : FieldShare{},
                            norm(part.foot - position)});
    ++stands;
  }
  if (stands > 0) found.stands_of.push_back(stands);
  return stands > 0;
}

/// Particles whose numbers follow each other are mostly near each other too: they look among the same points.
void VesselWalls::find_stands(const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                              std::span<const double> smoothing_length, std::span<const double> margin,
                              std::span<const double> mass_ratio, std::size_t chunk, Found& found) const {
  thread_local std::array<PointsAround, max_sets_of_points> of_thread;
  std::array<PointsAround, max_sets_of_points>& around = of_thread;  // its address is looked up once
  const auto reach = [&](std::size_t i) { return 2 * (smoothing_length[i] + margin[i]); };
  const auto set_of = [&](std::size_t i) {
    const int level = mass_ratio.empty() ? 0 : std::clamp(level_of(mass_ratio[i]), 0, static_cast<int>(sets_ - 3) / 2);
    const double spacing = spacing_ * (1 << level);
    return 2 * static_cast<std::size_t>(level) +
           set_for(neighbourhood.distance_from_vessel(i) / spacing, margin[i] / spacing);
  };
  const auto look = [&](std::span<const std::uint32_t> group,
                        const std::array<Surroundings, max_sets_of_points>& boxes) {
    for (std::size_t set = 0; set < sets_; ++set)
      if (!boxes[set].is_empty()) around[set].gather(*this, set, boxes[set].low, boxes[set].high);
    for (const std::uint32_t i : group)
      if (const auto near = around[set_of(i)].near(position[i], reach(i)); !near.empty()) {
        if (add_stands(position[i], near, found)) found.particles.push_back(i);
      }
  };
  thread_local std::vector<std::uint32_t> group;
  std::array<Surroundings, max_sets_of_points> boxes;
  group.clear();
  for (std::size_t i = chunk * chunk_size; i < std::min(position.size(), (chunk + 1) * chunk_size); ++i) {
    if (!(neighbourhood.distance_from_vessel(i) <= reach(i))) continue;
    const std::size_t set = set_of(i);
    Surroundings box = boxes[set].with(position[i], reach(i));
    if (box.is_wider_than(widest_group * spacing_ + 2 * reach(i))) {
      look(group, boxes);
      group.clear();
      boxes = {};
      box = Surroundings{}.with(position[i], reach(i));
    }
    boxes[set] = box;
    group.push_back(static_cast<std::uint32_t>(i));
  }
  look(group, boxes);
}

void VesselWalls::find(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                       std::span<const double> smoothing_length, std::span<const double> margin,
                       std::span<const double> mass_ratio) {
  is_met_ = false;
  if (is_empty()) return;
  std::vector<Found> found((position.size() + chunk_size - 1) / chunk_size);
  team.run(found.size(), [&](std::size_t chunk) {
    find_stands(neighbourhood, position, smoothing_length, margin, mass_ratio, chunk, found[chunk]);
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
  clearance_.resize(particles_.size());
  for (std::size_t n = 0; n < particles_.size(); ++n)
    clearance_[n] = {position[particles_[n]], neighbourhood.distance_from_vessel(particles_[n]), 0, {}};
  met_.resize(stands_.size());
  met_count_.assign(particles_.size(), 0);
  find_pairs(team, neighbourhood, position, smoothing_length, margin);
}

/// Who stands with a particle at the same part of a wall, as near to the particle's image there as the kernel reaches.
void VesselWalls::find_pairs(ThreadTeam& team, const Neighbourhood& neighbourhood, std::span<const Vector3> position,
                             std::span<const double> smoothing_length, std::span<const double> margin) {
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
            const double reach = smoothing_length[i] + margin[i] + smoothing_length[source] + margin[source];
            const Vector3 x =
                ghost ? neighbourhood.image(ghosts[record - count]).position(position[source]) : position[source];
            // Each may come nearer to the wall by its margin.
            const double a = std::max(0.0, stands_[s].distance - margin[i]),
                         b = std::max(0.0, stands_[t].distance - margin[source]);
            if (dot(x - position[i], x - position[i]) + 4 * a * b > reach * reach) continue;
            pairs.record.push_back(record);
            pairs.seat.push_back(ghost ? seat_of_ghost[record - count] + (t - first) : t);
          }
        }
        while ((pairs.record.size() - begin) % WallPairs::padded_to != 0)
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

}  // namespace talus::continuum
