// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/pairs/pair_records.hpp"

#include <algorithm>
#include <cmath>

#include "models/continuum/material.hpp"
#include "models/continuum/pairs/quanta.hpp"
#include "models/continuum/pairs/rates.hpp"

namespace talus::continuum {

namespace {

SingleMotionRecord single(const Vector3& x, const Vector3& u, float half_length, float volume, double per_quantum) {
  const auto place = in_quanta(x, per_quantum);
  return {{place[0], place[1], place[2]},
          half_length,
          {static_cast<float>(u.x), static_cast<float>(u.y), static_cast<float>(u.z)},
          volume};
}

SingleStressRecord single(const SymmetricTensor3<>& s, float half_density, float tension) {
  return {{static_cast<float>(s.xx), static_cast<float>(s.yy), static_cast<float>(s.zz), static_cast<float>(s.xy),
           static_cast<float>(s.yz), static_cast<float>(s.zx)},
          half_density,
          tension};
}

/// Of the artificial stress: the largest tension, or a little more where none of the others is its equal.
double tension_of(const SymmetricTensor3<>& stress) {
  constexpr double sqrt_2_3 = 0.81649658092772603;
  return std::max(sqrt_2_3 * norm(deviator(stress)) - trace(stress) / 3, 0.0);
}

/// What an image does to the numbers of a record, where it only turns signs and shifts places, as most do: then a
/// record is a short loop without branches, for which the compiler takes registers.
struct Signs {
  bool suffice;
  double motion[8], shift[8], stress[8];       // factors, what is added to the motion, factors
  float single_velocity[4], single_stress[8];  // factors of the later half of the motion, and of the stress
  int moves[3], moved = 0;                     // the axes along which it moves places, and how many they are

  explicit Signs(const Image& image) : suffice(is_diagonal(image.map) && is_diagonal(image.vector_map)) {
    const Tensor3<>&m = image.map, &v = image.vector_map;
    const SymmetricTensor3<> t = image.tensor({1, 1, 1, 1, 1, 1});
    const double of_motion[] = {m.xx, m.yy, m.zz, 1, v.xx, v.yy, v.zz, 1};
    const double of_stress[] = {t.xx, t.yy, t.zz, t.xy, t.yz, t.zx, 1, 1};
    for (int k = 0; k < 8; ++k) {
      motion[k] = of_motion[k], stress[k] = of_stress[k];
      shift[k] = k < 3 ? image.offset[k] : 0;
      single_stress[k] = static_cast<float>(stress[k]);
    }
    for (int k = 0; k < 4; ++k) single_velocity[k] = static_cast<float>(motion[4 + k]);
    for (int axis = 0; axis < 3; ++axis)
      if (motion[axis] != 1 || shift[axis] != 0) moves[moved++] = axis;
  }

 private:
  static bool is_diagonal(const Tensor3<>& q) {
    return q.xy == 0 && q.xz == 0 && q.yx == 0 && q.yz == 0 && q.zx == 0 && q.zy == 0;
  }
};

std::vector<Signs> signs_of(std::span<const Image> images) {
  return {images.begin(), images.end()};
}

/// Room for as many records, some of it spare. A vector that grows by itself keeps what it held, which is not needed,
/// and takes three times its memory meanwhile.
template <class Record>
void reserve_records(std::vector<Record>& records, std::size_t count) {
  if (records.capacity() < count) {
    std::vector<Record>().swap(records);
    records.reserve(count + count / 16);
  }
  records.resize(count);
}

template <class Number, class Record>
Number* numbers(Record& record) {
  return reinterpret_cast<Number*>(&record);
}
template <int count, class Number>
void multiply(const Number* record, const Number* factor, Number* product) {
  Number all[count];
  for (int k = 0; k < count; ++k) all[k] = factor[k] * record[k];
  std::copy_n(all, count, product);
}
template <int count, class Number>
void multiply_and_shift(const Number* record, const Number* factor, const Number* shift, Number* result) {
  Number all[count];
  for (int k = 0; k < count; ++k) all[k] = factor[k] * record[k] + shift[k];
  std::copy_n(all, count, result);
}

/// Particles near each other are within the reach, at the middle of a step a little beyond: a quarter of the range.
double quantum_for(double reach) {
  return std::exp2(std::ceil(std::log2(reach)) + 2 - 32);
}

}  // namespace

/// Walls of a vessel read the records in double precision whatever that of the pairs.
void PairRecords::pack(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses) {
  const bool in_single = options_.precision == PairPrecision::in_single;
  if (in_single) pack_single(team, lists, particles, stresses);
  if (!in_single || options_.always_double) pack_double(team, lists, particles, stresses);
}

void PairRecords::find_read_by_walls(const PairLists& lists, std::span<const std::uint32_t> at_walls) {
  if (options_.precision != PairPrecision::in_single) return;
  const Neighbourhood& neighbourhood = lists.neighbourhood();
  const auto ghosts = neighbourhood.ghosts();
  const std::size_t count = neighbourhood.particles();
  std::vector<char> is_read(count + ghosts.size(), 0);
  for (const std::uint32_t i : at_walls) {
    is_read[i] = 1;
    for (const std::uint32_t n : neighbourhood.of(i)) {
      if (n == is_read.size()) continue;  // padding
      is_read[n] = 1;
      if (n >= count) is_read[ghosts[n - count].source] = 1;
    }
  }
  wall_particles_.clear(), wall_ghosts_.clear();
  for (std::uint32_t n = 0; n < is_read.size(); ++n)
    if (is_read[n])
      n < count ? wall_particles_.push_back(n) : wall_ghosts_.push_back(n - static_cast<std::uint32_t>(count));
}

/// Records of images are made from those of their sources. What only forces read is packed for them only.
void PairRecords::pack_double(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses) {
  const std::size_t count = particles.position.size();
  const Neighbourhood& neighbourhood = lists.neighbourhood();
  const auto ghosts = neighbourhood.ghosts();
  const bool are_all = options_.precision != PairPrecision::in_single;
  const std::span<const std::uint32_t> packed_ghosts = are_all ? lists.packed_ghosts() : wall_ghosts_;
  reserve_records(motion_, count + ghosts.size() + 1);
  reserve_records(stress_, motion_.size());
  for_each(team, are_all ? count : wall_particles_.size(), [&](std::size_t n) {
    const std::size_t i = are_all ? n : wall_particles_[n];
    const double density = particles.density[i];
    const Vector3 &x = particles.position[i], &u = particles.velocity[i];
    motion_[i] = {{x.x, x.y, x.z},
                  0.5 * particles.smoothing_length[i],
                  {u.x, u.y, u.z},
                  particles.mass_ratio[i] * options_.mass / density};
    if (!stresses) return;
    const SymmetricTensor3<> s = specific_stress(particles, i, options_.stress_form, options_.grain_density);
    stress_[i] = {{s.xx, s.yy, s.zz, s.xy, s.yz, s.zx}, 0.5 * density, options_.tension ? tension_of(s) : 0};
  });
  const std::vector<Signs> signs = signs_of(neighbourhood.images());
  for_each(team, packed_ghosts.size(), [&](std::size_t n) {
    const std::size_t g = packed_ghosts[n];
    MotionRecord& source = motion_[ghosts[g].source];
    if (const Signs& image = signs[ghosts[g].image]; image.suffice) {
      multiply_and_shift<8>(numbers<double>(source), image.motion, image.shift, numbers<double>(motion_[count + g]));
      if (stresses)
        multiply<8>(numbers<double>(stress_[ghosts[g].source]), image.stress, numbers<double>(stress_[count + g]));
      return;
    }
    const Image& image = neighbourhood.image(ghosts[g]);
    const Vector3 x = image.position({source.position[0], source.position[1], source.position[2]});
    const Vector3 u = image.vector({source.velocity[0], source.velocity[1], source.velocity[2]});
    motion_[count + g] = {{x.x, x.y, x.z}, source.half_length, {u.x, u.y, u.z}, source.volume};
    if (!stresses) return;
    const double* s = stress_[ghosts[g].source].specific_stress;
    const SymmetricTensor3<> t = image.tensor({s[0], s[1], s[2], s[3], s[4], s[5]});
    const StressRecord& of_source = stress_[ghosts[g].source];
    stress_[count + g] = {{t.xx, t.yy, t.zz, t.xy, t.yz, t.zx}, of_source.half_density, of_source.tension};
  });
  constexpr double far_away = 1e3;  // m
  motion_.back() = {{far_away, far_away, far_away}, count > 0 ? 0.5 * particles.smoothing_length.front() : 1, {}, 0};
  stress_.back() = {{}, count > 0 ? 0.5 * particles.density.front() : 1, 0};
}

void PairRecords::pack_single(ThreadTeam& team, const PairLists& lists, const ParticleView& particles, bool stresses) {
  const std::size_t count = particles.position.size();
  const Neighbourhood& neighbourhood = lists.neighbourhood();
  const auto ghosts = neighbourhood.ghosts();
  const auto packed_ghosts = lists.packed_ghosts();
  quantum_ = quantum_for(neighbourhood.reach());
  const double per_quantum = 1 / quantum_;
  reserve_records(single_motion_, count + ghosts.size() + 1);
  reserve_records(single_stress_, single_motion_.size());
  for_each(team, count, [&](std::size_t i) {
    const double density = particles.density[i];
    single_motion_[i] =
        single(particles.position[i], particles.velocity[i], static_cast<float>(0.5 * particles.smoothing_length[i]),
               static_cast<float>(particles.mass_ratio[i] * options_.mass / density), per_quantum);
    if (!stresses) return;
    const SymmetricTensor3<> s = specific_stress(particles, i, options_.stress_form, options_.grain_density);
    single_stress_[i] =
        single(s, static_cast<float>(0.5 * density), options_.tension ? static_cast<float>(tension_of(s)) : 0.0F);
  });
  const std::vector<Signs> signs = signs_of(neighbourhood.images());
  const auto mirror = [&](const Signs& of_image, std::span<const std::uint32_t> alike) {
    const Signs image = of_image;  // a copy: what is stored below could change what is referred to
    SingleMotionRecord* const motion = single_motion_.data();
    SingleStressRecord* const stress = single_stress_.data();
    for (const std::uint32_t g : alike) {
      const std::size_t source = ghosts[g].source;
      SingleMotionRecord& to = motion[count + g];
      to = motion[source];
      for (int n = 0; n < image.moved; ++n) {
        const int axis = image.moves[n];
        const double place = image.motion[axis] * particles.position[source][axis] + image.shift[axis];
        to.position[axis] = whole_quanta(per_quantum * place);
      }
      multiply<4>(numbers<float>(motion[source]) + 4, image.single_velocity, numbers<float>(to) + 4);
      if (stresses) multiply<8>(numbers<float>(stress[source]), image.single_stress, numbers<float>(stress[count + g]));
    }
  };
  const auto turn = [&](const Image& image, std::span<const std::uint32_t> alike) {
    for (const std::uint32_t g : alike) {
      const std::size_t source = ghosts[g].source;
      single_motion_[count + g] =
          single(image.position(particles.position[source]), image.vector(particles.velocity[source]),
                 single_motion_[source].half_length, single_motion_[source].volume, per_quantum);
      if (!stresses) continue;
      const float* s = single_stress_[source].specific_stress;
      single_stress_[count + g] = single(image.tensor({s[0], s[1], s[2], s[3], s[4], s[5]}),
                                         single_stress_[source].half_density, single_stress_[source].tension);
    }
  };
  for_each_chunk(team, packed_ghosts.size(), [&](std::size_t first, std::size_t end) {
    // Those of an image follow each other.
    for (std::size_t next = first; first < end; first = next) {
      const std::uint32_t in = ghosts[packed_ghosts[first]].image;
      while (next < end && ghosts[packed_ghosts[next]].image == in) ++next;
      const std::span alike = packed_ghosts.subspan(first, next - first);
      if (signs[in].suffice)
        mirror(signs[in], alike);
      else
        turn(neighbourhood.images()[in], alike);
    }
  });
  // Its square is in the range of a float; one over its cube is zero, and not one of the numbers just above it, which
  // cost a processor a hundred cycles each.
  constexpr float vast = 1e16F;  // m
  single_motion_.back() = {{}, vast, {}, 0};
  single_stress_.back() = {{}, count > 0 ? single_stress_.front().half_density : 1, 0};
}

Records PairRecords::view() const {
  return {motion_.data(), stress_.data(), {single_motion_.data(), single_stress_.data(), quantum_}};
}

}  // namespace talus::continuum
