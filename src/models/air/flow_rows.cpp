// SPDX-License-Identifier: Apache-2.0
#include "models/air/flow_rows.hpp"

#include <algorithm>
#include <cmath>

#include "base/clones.hpp"
#include "base/registers.hpp"
#include "physics/air/momentum.hpp"
#include "physics/coupling/drag.hpp"

namespace talus::air {

TALUS_CLONES void extrapolate_row(std::ptrdiff_t count, double share, double rho, const double* void_fraction,
                                  const double* momentum, const double* before, double* __restrict mass,
                                  double* __restrict velocity) {
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double middle = momentum[f] + share * (momentum[f] - before[f]);
    mass[f] = middle;
    velocity[f] = middle / (rho * void_fraction[f]);
  }
}

TALUS_CLONES void lead_on_row(std::ptrdiff_t count, double ratio, double* __restrict pressure,
                              double* __restrict before) {
  for (std::ptrdiff_t c = 0; c < count; ++c) {
    const double last = pressure[c];
    pressure[c] = last + ratio * (last - before[c]);
    before[c] = last;
  }
}

TALUS_CLONES void predict_row(std::ptrdiff_t count, double dt, double rho, double viscosity, double grains_share,
                              double per_pressure, const StageRow& given, double* __restrict after_drag,
                              double* __restrict velocity, double* __restrict conductance) {
  const StageRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double phi = row.void_fraction[f], per_mass = 1 / (rho * phi);
    const double force = row.convection[f] + viscous_force(phi, viscosity, row.viscous[f]);
    after_drag[f] =
        row.open[f] * coupling::velocity_after_drag(row.decay[f], row.momentum[f], per_mass, row.grain_velocity[f]);
    velocity[f] = row.open[f] * (after_drag[f] + row.mean[f] * dt * force * per_mass);
    conductance[f] = row.open[f] * pressure_share(phi, grains_share) * row.mean[f] * per_pressure;
  }
}

TALUS_CLONES void add_pressure_row(std::ptrdiff_t count, double factor, double grains_share, const PressureRow& given,
                                   double* __restrict velocity) {
  const PressureRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double phi = row.void_fraction[f];
    velocity[f] -=
        factor * row.open[f] * row.mean[f] * (pressure_share(phi, grains_share) / phi) * (row.high[f] - row.low[f]);
  }
}

namespace {

template <bool with_grains>
TALUS_INLINE double find_source(int count, const VolumeFlowRow& given, double* __restrict source) {
  const VolumeFlowRow row = given;
  constexpr int lanes = 8;
  double most[lanes] = {};
  const auto at = [&](int c, double& largest) {
    const auto flow = [&](const VolumeFlowRow::Axis& axis, double open, std::ptrdiff_t f) {
      const double of_air = axis.void_fraction[f] * axis.velocity[f];
      return open * (with_grains ? of_air + axis.solid_fraction[f] * axis.grain_velocity[f] : of_air);
    };
    const auto low = [&](const VolumeFlowRow::Axis& axis) { return flow(axis, axis.open[c], c); };
    const auto high = [&](const VolumeFlowRow::Axis& axis) { return flow(axis, axis.open_after[c], c + axis.next); };
    const auto& [x, y, z] = row.axis;
    const double low_x = low(x), low_y = low(y), low_z = low(z);
    source[c] = -((high(x) - low_x) * x.area + (high(y) - low_y) * y.area + (high(z) - low_z) * z.area);
    const double sum = std::abs(low_x) * x.area + std::abs(low_y) * y.area + std::abs(low_z) * z.area;
    largest = sum > largest ? sum : largest;
  };
  int c = 0;
  for (; c + lanes <= count; c += lanes)
    for (int l = 0; l < lanes; ++l) at(c + l, most[l]);
  for (; c < count; ++c) at(c, most[0]);
  double largest = 0;
  for (const double x : most) largest = x > largest ? x : largest;
  return largest;
}

}  // namespace

TALUS_CLONES double find_source_of_row(int count, bool with_grains, const VolumeFlowRow& row,
                                       double* __restrict source) {
  return with_grains ? find_source<true>(count, row, source) : find_source<false>(count, row, source);
}

TALUS_CLONES void finish_row(std::ptrdiff_t count, double dt, double rho, double factor, double grains_share,
                             double grains_pressure, const ExchangeRow& given, double* __restrict velocity,
                             double* __restrict momentum, double* __restrict received, double* __restrict drag) {
  const ExchangeRow row = given;
  const double per_time = 1 / dt;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double phi = row.void_fraction[f], solid = row.solid_fraction[f], difference = row.high[f] - row.low[f];
    const double u =
        row.velocity[f] - factor * row.open[f] * row.mean[f] * (pressure_share(phi, grains_share) / phi) * difference;
    const double mass = rho * phi;
    velocity[f] = u, momentum[f] = mass * u;
    // All but drag, as an acceleration times dt: what makes the slip's decay end at the velocity found.
    const double gained = (u - row.after_drag[f]) / row.mean[f];
    const double slip = row.momentum[f] / mass - row.grain_velocity[f];
    const double lost = coupling::drag_impulse(row.decay[f], row.mean[f], mass, slip, gained);
    const double is_solid = solid > 0 ? 1.0 : 0.0;
    received[f] = row.open[f] * (is_solid * lost / (solid + (1 - is_solid)) - grains_pressure * dt * difference);
    drag[f] = row.open[f] * is_solid * lost * per_time;
  }
}

TALUS_CLONES void find_solids_of_row(std::ptrdiff_t count, const SolidsRow& given, double* __restrict solid,
                                     double* __restrict gap, double* __restrict velocity) {
  const SolidsRow row = given;
  for (std::ptrdiff_t f = 0; f < count; ++f) {
    const double s = 0.5 * (row.fraction_before[f] + row.fraction_here[f]), is_solid = s > 0 ? 1.0 : 0.0;
    solid[f] = s, gap[f] = 1 - s;
    velocity[f] = is_solid * (0.5 * (row.flux_before[f] + row.flux_here[f])) / (s + (1 - is_solid));
  }
}

TALUS_CLONES bool are_fractions(std::ptrdiff_t count, const double* fraction) {
  std::ptrdiff_t good = 0;
  for (std::ptrdiff_t c = 0; c < count; ++c)
    good += static_cast<std::ptrdiff_t>(fraction[c] >= 0) & static_cast<std::ptrdiff_t>(fraction[c] < 1);
  return good == count;
}

namespace {

/// From the first to the last number of one or two rows that are above 0; empty at the end of the row if none is. Most
/// rows have no grains, or only in part.
struct RowPart {
  std::ptrdiff_t begin, end;
};
TALUS_INLINE RowPart positive_part(std::ptrdiff_t count, const double* one, const double* other) {
  RowPart part{0, count};
  while (part.begin < count && !(one[part.begin] > 0 || other[part.begin] > 0)) ++part.begin;
  while (part.begin < part.end && !(one[part.end - 1] > 0 || other[part.end - 1] > 0)) --part.end;
  return part;
}

/// Velocity of the air against the grains' in the centre of cell c, along one axis.
TALUS_INLINE double slip_of(const CellRow& row, int axis, std::ptrdiff_t c, double per_solid) {
  return 0.5 * (row.velocity[axis][c] + row.velocity[axis][c + row.next[axis]]) - per_solid * row.flux[axis][c];
}

template <coupling::DragLaw law>
TALUS_INLINE void find_drag(RowPart part, const coupling::DragMedium& given_medium, const CellRow& given,
                            double* __restrict drag) {
  const CellRow row = given;
  const coupling::DragMedium medium = given_medium;
  for (std::ptrdiff_t c = part.begin; c < part.end; ++c) {
    const double s = row.fraction[c], is_solid = s > 0 ? 1.0 : 0.0, per_solid = is_solid / (s + (1 - is_solid));
    const double x = slip_of(row, 0, c, per_solid), y = slip_of(row, 1, c, per_solid),
                 z = slip_of(row, 2, c, per_solid);
    drag[c] = coupling::drag_coefficient(law, medium, s, std::sqrt((x * x + y * y) + z * z));
  }
}

}  // namespace

TALUS_CLONES void find_drag_of_row(std::ptrdiff_t count, coupling::DragLaw law, const coupling::DragMedium& medium,
                                   const CellRow& row, double* __restrict drag) {
  using coupling::DragLaw;
  const RowPart part = positive_part(count, row.fraction, row.fraction);
  std::fill(drag, drag + part.begin, 0.0), std::fill(drag + part.end, drag + count, 0.0);
  if (law == DragLaw::ergun_wen_yu)
    find_drag<DragLaw::ergun_wen_yu>(part, medium, row, drag);
  else
    find_drag<DragLaw::schiller_naumann_umekage_yuu>(part, medium, row, drag);
}

TALUS_CLONES void find_slip_of_row(std::ptrdiff_t count, const CellRow& given, double* __restrict x,
                                   double* __restrict y, double* __restrict z, double* __restrict square) {
  const CellRow row = given;
  const RowPart part = positive_part(count, row.fraction, row.fraction);
  for (double* out : {x, y, z, square})
    std::fill(out, out + part.begin, 0.0), std::fill(out + part.end, out + count, 0.0);
  for (std::ptrdiff_t c = part.begin; c < part.end; ++c) {
    const double s = row.fraction[c], is_solid = s > 0 ? 1.0 : 0.0, per_solid = is_solid / (s + (1 - is_solid));
    x[c] = is_solid * slip_of(row, 0, c, per_solid), y[c] = is_solid * slip_of(row, 1, c, per_solid),
    z[c] = is_solid * slip_of(row, 2, c, per_solid);
    square[c] = (x[c] * x[c] + y[c] * y[c]) + z[c] * z[c];
  }
}

TALUS_CLONES Rates max_rates_of_row(std::ptrdiff_t count, const Vector3& per_width, double grain_density,
                                    const CellRow& given, const double* drag) {
  constexpr int lanes = 8;
  const CellRow row = given;
  const Vector3 per = per_width;
  double crossing[lanes] = {}, response[lanes] = {};
  const auto largest = [](double a, double b) { return a > b ? a : b; };
  const auto at = [&](std::ptrdiff_t c, double& max_crossing, double& max_response) {
    const auto fastest = [&](int a) {
      return largest(std::abs(row.velocity[a][c]), std::abs(row.velocity[a][c + row.next[a]]));
    };
    max_crossing = largest(fastest(0) * per.x + fastest(1) * per.y + fastest(2) * per.z, max_crossing);
    const double s = row.fraction[c], phi = 1 - s, is_solid = s > 0 ? 1.0 : 0.0;
    max_response = largest(is_solid * drag[c] / (phi * phi * (s + (1 - is_solid)) * grain_density), max_response);
  };
  std::ptrdiff_t c = 0;
  for (; c + lanes <= count; c += lanes)
    for (int l = 0; l < lanes; ++l) at(c + l, crossing[l], response[l]);
  for (; c < count; ++c) at(c, crossing[0], response[0]);
  Rates most{0, 0};
  for (int l = 0; l < lanes; ++l)
    most.crossing = largest(crossing[l], most.crossing), most.response = largest(response[l], most.response);
  return most;
}

TALUS_CLONES void find_decay_of_row(std::ptrdiff_t count, double per_density, const double* drag_before,
                                    const double* drag_here, const double* void_fraction, double* __restrict decay,
                                    double* __restrict mean) {
  const RowPart part = positive_part(count, drag_before, drag_here);
  for (std::ptrdiff_t f = 0; f < part.begin; ++f) decay[f] = mean[f] = 1;
  for (std::ptrdiff_t f = part.end; f < count; ++f) decay[f] = mean[f] = 1;
  for (std::ptrdiff_t f = part.begin; f < part.end; ++f) {
    const double between = 0.5 * (drag_before[f] + drag_here[f]);
    const coupling::SlipDecay slip = coupling::slip_decay(between * per_density / void_fraction[f]);
    decay[f] = slip.decay, mean[f] = slip.mean;
  }
}

TALUS_CLONES void average_row(std::ptrdiff_t count, const double* first, const double* second,
                              double* __restrict mean) {
  for (std::ptrdiff_t c = 0; c < count; ++c) mean[c] = 0.5 * (first[c] + second[c]);
}

}  // namespace talus::air
