// SPDX-License-Identifier: Apache-2.0
/// What the walls of a vessel bear, by field of their surface and by band of their height: sums of what the steps gave
/// them, means over windows of time, and the largest of these.
#pragma once

#include <string>
#include <vector>

#include "base/exact_sum.hpp"
#include "base/vector.hpp"
#include "models/continuum/setup/parameters.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"
#include "numerics/surface/surface_fields.hpp"

namespace talus::continuum {

/// The kept columns, one entry per field.
struct WallLoads {
  // What the field received from the start to the present window, N s: pressing on it, whichever side, and altogether
  // with friction.
  std::vector<double> push;
  std::vector<Vector3> received;
  // The same until the opening of the gate.
  std::vector<double> gate_push;
  std::vector<Vector3> gate_received;
  // The same in the present window, in fixed point: sums of no order; of window_received x, y, z, one after another. In
  // a sector what its copies received is noted at the fields of the sector itself (SurfaceFields::original).
  FixedSums window_push, window_received;
  FixedPoint point{1};  ///< of the window, N s; from the case, not a field
  // Means over the last whole window, and over the last one before the gate opened, Pa.
  std::vector<double> pressure, rest_pressure;
  std::vector<Vector3> traction, rest_traction;
  // The largest mean of a window since the gate opened (until then: since the start), Pa, and the window's middle, s.
  std::vector<double> max_pressure, max_time;
  double window_start = 0;  ///< s

  /// Since the start, N s.
  double push_of(const SurfaceFields& fields, std::size_t n) const { return push[n] + push_in_window(fields, n); }
  Vector3 received_of(const SurfaceFields& fields, std::size_t n) const { return received[n] + in_window(fields, n); }
  /// In the present window, N s.
  double push_in_window(const SurfaceFields& fields, std::size_t n) const {
    return point.value(window_push[fields.original(n)]);
  }
  Vector3 in_window(const SurfaceFields& fields, std::size_t n) const {
    const std::size_t from = 3 * fields.original(n);
    return fields.from_original(n, {point.value(window_received[from]), point.value(window_received[from + 1]),
                                    point.value(window_received[from + 2])});
  }
};

/// A force that the fields under a particle received.
struct LoadOfFields {
  FieldShare fields;
  double push;       ///< N s; below 0 where grains that stick pull
  Vector3 received;  ///< N s
};

constexpr double size_of_load_field = 2;   ///< in spacings
constexpr double edge_of_drawn_field = 3;  ///< the longest of its triangles in snapshots, in spacings

/// The fields of a vessel's walls.
SurfaceFields load_fields(const Layout& layout);

/// Their number, without their areas, which take long to find.
std::size_t count_load_fields(const Layout& layout);

/// Without load. \param fields their number \param unit State::impulse_unit, N s
WallLoads no_loads(std::size_t fields, double unit);

/// To the fields, and in a sector to all copies of them: the loads are those of the whole vessel.
void add_load(const LoadOfFields& load, const SurfaceFields& fields, WallLoads& loads);

/// Whether close_window() would close the window.
inline bool is_window_over(double time, double length, const WallLoads& loads) {
  return !(time - loads.window_start < length);
}

/// Closes the window if it is over. \param time at the end of a step, s \param length of a window, s: peak_time()
void close_window(const SurfaceFields& fields, double time, double length, WallLoads& loads);

/// Takes the last window for that at rest, and resets the largest loads. \param time of the opening, s
void begin_flow(const SurfaceFields& fields, double time, WallLoads& loads);

/// A part of a patch between two heights.
struct LoadBand {
  std::string name;  ///< "cylinder.3": patch, and number from below, from 1; no name of a patch has a point
  std::uint32_t patch = 0;
  double low = 0, high = 0;  ///< heights, m
  double area = 0;           ///< inside the box, m^2
  double sine = 0;           ///< of the wall's angle with the vertical, a mean: 0 upright, 1 level
  bool is_level() const;     ///< a floor or a lid: it has no line down
  std::vector<std::uint32_t> fields;
};

/// The bands of all patches, each four spacings of the coarsest level high at least, twelve of a patch at most; a level
/// patch is one.
std::vector<LoadBand> load_bands(const Parameters& parameters, const SurfaceFields& fields);

/// Which fields are the far face of a body that is drawn with both: its near face, of the same patch, sees grains of
/// the bed at the start, or where they come in, and they do not. Of a sector none.
std::vector<char> far_faces(const Layout& layout, const SurfaceFields& fields);

/// What each band received since the start: "normal_impulse_NAME", pressing on it, and but for level ones
/// "shear_impulse_NAME", along the wall downwards, N s.
std::vector<NamedValue> totals_of(const std::vector<LoadBand>& bands, const SurfaceFields& fields,
                                  const WallLoads& loads);

/// The columns on the mesh: pressure and shear, means over the last whole window; pressure_at_rest, shear_at_rest;
/// pressure_in_flow, shear_in_flow, means since the gate opened; pressure_largest and its time_of_largest.
/// \param time, gate_time of the state, s
SurfaceSnapshot loads_on(const FieldMesh& mesh, const SurfaceFields& fields, const WallLoads& loads, double time,
                         double gate_time);

}  // namespace talus::continuum
