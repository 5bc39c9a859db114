// SPDX-License-Identifier: Apache-2.0
/// The sums over the points of a wall, and over neighbours at a wall, a register at a time. Compiled once for each
/// instruction set.
#include "base/simd.hpp"
#include "base/simd_columns.hpp"
#include "models/continuum/boundary/kernels/kernel.hpp"
#include "numerics/sph/cubic_spline.hpp"
#include "physics/sph/wall_integrals.hpp"

namespace talus::continuum {
inline namespace TALUS_INSTRUCTION_SET {

using WallNumber = SimdVector<double>;

struct WallVector {
  WallNumber x, y, z;
};
TALUS_INLINE WallNumber inner(const WallVector& a, const WallVector& b) {
  return multiply_add(a.x, b.x, multiply_add(a.y, b.y, a.z * b.z));
}
/// A symmetric tensor, xx yy zz xy yz zx, times a vector.
TALUS_INLINE WallVector product(const WallNumber (&t)[6], const WallVector& v) {
  return {inner({t[0], t[3], t[5]}, v), inner({t[3], t[1], t[4]}, v), inner({t[5], t[4], t[2]}, v)};
}

inline void sum_points(const WallPoints& points, const std::uint32_t* place, double h, WallTotals& totals) {
  using Number = SimdVector<float>;
  static_assert(WallPoints::padded_to % Number::lanes == 0);
  const double per_h = 1 / h;
  const Number scale = points.quantum * per_h, per_square = per_h * per_h;
  sph::WallSums<Number> sums;  // of lengths in smoothing lengths
  for (std::uint32_t first = 0; first < points.count; first += Number::lanes) {
    const std::uint32_t* const number = points.number + first;
    Number column[8];
    load_columns([&](int lane) { return reinterpret_cast<const float*>(points.all + number[lane]); }, column);
    const auto along = [&](int axis) {
      Number quanta;
      quanta.row[0] = registers::differences_of_bits(column[axis].row[0], place[axis]);
      return scale * quanta;
    };
    const Number d[3] = {along(0), along(1), along(2)}, n[3] = {column[3], column[4], column[5]};
    const Number square = multiply_add(d[0], d[0], multiply_add(d[1], d[1], d[2] * d[2]));
    if (lane_bits(square < Number(sph::support * sph::support)) == 0) continue;
    sums.add(d, n, per_square * column[6], 1);
  }
  const Number zero = 0.0;
  const Number all[20] = {sums.density,    sums.slope[0],   sums.slope[1],   sums.slope[2],  sums.moment[0],
                          sums.moment[1],  sums.moment[2],  sums.moment[3],  sums.moment[4], sums.moment[5],
                          sums.closing[0], sums.closing[1], sums.closing[2], sums.normal[0], sums.normal[1],
                          sums.normal[2],  sums.nearness,   sums.weight,     sums.distance,  zero};
  store_sums(all, &totals.density);
  for (int axis = 0; axis < 3; ++axis) {
    totals.slope[axis] *= per_h;
    totals.closing[axis] *= per_h;
    totals.normal[axis] *= per_h;
  }
  totals.nearness *= per_h * per_h;
  totals.weight *= per_h;
}

inline void sum_images(const Records& records, std::uint32_t self, const WallSeat& own, const WallSeat* seats,
                       const WallPairs& others, double mass, double* acceleration) {
  using Number = WallNumber;
  constexpr double min_sum = 1.7 * 1.7;  // of two normals, squared: on one side, and not around a corner
  const MotionRecord& place = records.motion[self];
  const StressRecord& loaded = records.stress[self];
  const Number zero = 0.0;
  WallVector sum{zero, zero, zero};
  for (std::uint32_t first = 0; first < others.count; first += Number::lanes) {
    const std::uint32_t *const record = others.record + first, *const sits = others.seat + first;
    Number motion[8], stress[8], seat[8];
    load_columns([&](int lane) { return records.motion[record[lane]].position; }, motion);
    load_columns([&](int lane) { return seats[sits[lane]].normal; }, seat);
    const WallVector both{seat[0] + Number(own.normal[0]), seat[1] + Number(own.normal[1]),
                          seat[2] + Number(own.normal[2])};
    const WallVector d{motion[0] - Number(place.position[0]), motion[1] - Number(place.position[1]),
                       motion[2] - Number(place.position[2])};
    const Number h = Number(place.half_length) + motion[3];
    const Number size = inner(both, both);
    // From the image: farther than from the particle itself.
    const Number square = inner(d, d) + 4.0 * own.distance * seat[3] + 1e-30;
    const auto acts = square < 4.0 * h * h && size > Number(min_sum) && seat[4] > zero;
    if (lane_bits(acts) == 0) continue;
    load_columns([&](int lane) { return records.stress[record[lane]].specific_stress; }, stress);
    const Number turned = reciprocal_sqrt(size + 1e-30);
    const WallVector n{turned * both.x, turned * both.y, turned * both.z};
    const Number inverse_h = 1.0 / h, inverse_distance = reciprocal_sqrt(square);
    const Number slope =
        sph::cubic_spline_slope_of(square * inverse_distance * inverse_h, h * inverse_distance, inverse_h);
    Number together[6], apart[6];
    for (int c = 0; c < 6; ++c) {
      together[c] = Number(loaded.specific_stress[c]) + stress[c];
      apart[c] = Number(loaded.specific_stress[c]) - stress[c];
    }
    const Number height = inner(d, n), farther = Number(own.distance) + seat[3];
    const WallVector push = product(together, {d.x - height * n.x, d.y - height * n.y, d.z - height * n.z});
    const WallVector turn = product(apart, n);
    const WallVector f{push.x - farther * turn.x, push.y - farther * turn.y, push.z - farther * turn.z};
    const Number through = inner(f, n);
    const Number half_mass = mass > 0 ? Number(0.5 * mass) : motion[7] * stress[6];
    const Number factor = select(acts, half_mass * (Number(own.share) + seat[4]) * slope, zero);
    sum = {multiply_add(factor, f.x - through * n.x, sum.x), multiply_add(factor, f.y - through * n.y, sum.y),
           multiply_add(factor, f.z - through * n.z, sum.z)};
  }
  acceleration[0] = sum_lanes(sum.x, 0), acceleration[1] = sum_lanes(sum.y, 0), acceleration[2] = sum_lanes(sum.z, 0);
}

}  // namespace TALUS_INSTRUCTION_SET

WallKernels TALUS_FOR_SET(wall_kernels)() {
  return {sum_points, sum_images};
}

}  // namespace talus::continuum
