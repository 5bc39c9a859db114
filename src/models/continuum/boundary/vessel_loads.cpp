// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/boundary/vessel_loads.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>

#include "models/continuum/inlets.hpp"
#include "models/continuum/setup/forecast.hpp"
#include "models/continuum/setup/layout.hpp"
#include "models/continuum/setup/vessel.hpp"

namespace talus::continuum {

namespace {

constexpr double height_of_band = 4;  // spacings
constexpr long max_bands = 12;
constexpr double level = 0.999;

/// Unit vector down along a wall; none on a level one, whose normal may be rounded.
Vector3 downwards(const Vector3& normal) {
  constexpr double rounding = 1e-6;
  const Vector3 down = Vector3{0, 0, -1} + normal.z * normal;
  const double size = norm(down);
  return size > rounding ? (1 / size) * down : Vector3{};
}

Vector3 along(const Vector3& traction, const Vector3& normal) {
  return traction - dot(traction, normal) * normal;
}

/// What turns an impulse into a mean pressure, 1/(m^2 s); 0 outside the box.
double per_area(const SurfacePoint& field, double duration) {
  return field.area > 0 ? 1 / (duration * field.area) : 0;
}

}  // namespace

SurfaceFields load_fields(const Layout& layout) {
  const Parameters& p = layout.given;
  constexpr double infinity = std::numeric_limits<double>::infinity();
  return {layout.boundary->vessel(),
          size_of_load_field * p.bed.spacing,
          layout.sector(),
          {0, 0, -infinity},
          {p.box.width, p.box.depth, infinity}};
}

std::size_t count_load_fields(const Layout& layout) {
  const Surface& vessel = layout.boundary->vessel();
  if (vessel.is_empty()) return 0;
  return spread_points(vessel, size_of_load_field * layout.given.bed.spacing, layout.sector()).size();
}

WallLoads no_loads(std::size_t fields, double unit) {
  const std::vector<double> none(fields, 0.0);
  const std::vector<Vector3> nothing(fields);
  return {.push = none,
          .received = nothing,
          .gate_push = none,
          .gate_received = nothing,
          .window_push = FixedSums(fields),
          .window_received = FixedSums(3 * fields),
          .point = FixedPoint(unit),
          .pressure = none,
          .rest_pressure = none,
          .traction = nothing,
          .rest_traction = nothing,
          .max_pressure = none,
          .max_time = none,
          .window_start = 0};
}

void add_load(const LoadOfFields& load, const SurfaceFields& fields, WallLoads& loads) {
  const auto add = [&](std::uint32_t field, double share) {
    const std::size_t n = fields.original(field);
    const Vector3 received = share * fields.to_original(field, load.received);
    loads.window_push.add(n, loads.point.of(share * load.push));
    for (int axis = 0; axis < 3; ++axis)
      loads.window_received.add(3 * n + static_cast<std::size_t>(axis), loads.point.of(received[axis]));
  };
  const double share = load.fields.share;
  add(load.fields.field, share);
  if (share < 1) add(load.fields.other, 1 - share);
}

namespace {

/// Adds what the present window has to what came before it, and begins the next one.
void begin_window(const SurfaceFields& fields, double time, WallLoads& w) {
  for (std::size_t n = 0; n < w.push.size(); ++n)
    w.push[n] = w.push_of(fields, n), w.received[n] = w.received_of(fields, n);
  w.window_push.clear(), w.window_received.clear();
  w.window_start = time;
}

}  // namespace

void close_window(const SurfaceFields& fields, double time, double length, WallLoads& w) {
  if (!is_window_over(time, length, w)) return;
  const double duration = time - w.window_start;
  for (std::size_t n = 0; n < fields.count(); ++n) {
    const double over = per_area(fields.all()[n], duration);
    w.pressure[n] = over * w.push_in_window(fields, n);
    w.traction[n] = over * w.in_window(fields, n);
    if (w.pressure[n] > w.max_pressure[n]) {
      w.max_pressure[n] = w.pressure[n];
      w.max_time[n] = time - 0.5 * duration;
    }
  }
  begin_window(fields, time, w);
}

void begin_flow(const SurfaceFields& fields, double time, WallLoads& w) {
  w.rest_pressure = w.pressure;
  w.rest_traction = w.traction;
  begin_window(fields, time, w);
  w.gate_push = w.push;
  w.gate_received = w.received;
  std::fill(w.max_pressure.begin(), w.max_pressure.end(), 0.0);
  std::fill(w.max_time.begin(), w.max_time.end(), 0.0);
}

bool LoadBand::is_level() const {
  return sine > level;
}

std::vector<LoadBand> load_bands(const Parameters& p, const SurfaceFields& fields) {
  struct Heights {
    double low = std::numeric_limits<double>::infinity(), high = -low;
  };
  std::map<std::uint32_t, Heights> extent;
  for (std::size_t n = 0; n < p.vessel.size(); ++n)
    for (const Triangle& t : triangles_of(p, n))
      for (const Vector3& x : t.corner) {
        Heights& e = extent[static_cast<std::uint32_t>(n)];
        e.low = std::min(e.low, x.z), e.high = std::max(e.high, x.z);
      }
  const double min_height = height_of_band * std::ldexp(p.bed.spacing, static_cast<int>(p.levels.count));
  std::vector<LoadBand> bands;
  std::vector<std::size_t> first;
  for (const auto& [patch, heights] : extent) {
    const double low = heights.low, extent_up = heights.high - low;
    const long count = std::clamp(std::lround(std::floor(extent_up / min_height)), 1L, max_bands);
    first.push_back(bands.size());
    for (long k = 0; k < count; ++k) {
      const auto height = [&](long border) {
        return low + extent_up * static_cast<double>(border) / static_cast<double>(count);
      };
      const std::string name = name_of(p, patch);
      bands.push_back({.name = count == 1 ? name : fmt::format("{}.{}", name, k + 1),
                       .patch = patch,
                       .low = height(k),
                       .high = height(k + 1),
                       .fields = {}});
    }
  }
  first.push_back(bands.size());
  for (std::uint32_t n = 0; n < fields.count(); ++n) {
    const SurfacePoint& field = fields.all()[n];
    const std::size_t begin = first[field.patch], count = first[field.patch + 1] - begin;
    const Heights& e = extent[field.patch];
    const double place = e.high > e.low ? (field.place.z - e.low) / (e.high - e.low) : 0;
    const auto k = std::min(count - 1, static_cast<std::size_t>(std::max(0.0, place * static_cast<double>(count))));
    LoadBand& band = bands[begin + k];
    band.fields.push_back(n);
    band.area += field.area;
    band.sine += field.area * std::abs(field.normal.z);
  }
  for (LoadBand& band : bands) {
    if (band.area > 0) band.sine /= band.area;
  }
  return bands;
}

namespace {

/// Places of the bed at the start, some of them, and the middles of inlets.
std::vector<Vector3> places_of_grains(const Layout& layout) {
  constexpr double max_laid = 1e5;
  constexpr std::size_t max_places = 100;
  std::vector<Vector3> places;
  const Layout shown = bed_count(layout) > max_laid ? Layout(coarser(layout, max_laid)) : layout;
  const std::vector<Vector3> bed = bed_positions(shown);
  for (std::size_t n = 0; n < bed.size(); n += 1 + bed.size() / max_places) places.push_back(bed[n]);
  for (const Inlet& inlet : layout.given.inlets) places.push_back({inlet.centre[0], inlet.centre[1], inlet.centre[2]});
  return places;
}

}  // namespace

std::vector<char> far_faces(const Layout& layout, const SurfaceFields& fields) {
  std::vector<char> is_far(fields.count());
  const Surface& surface = layout.boundary->vessel();
  const bool has_drawn = std::any_of(layout.given.vessel.begin(), layout.given.vessel.end(),
                                     [](const VesselPart& v) { return v.shape == VesselShape::stl; });
  if (!has_drawn || layout.sector()) return is_far;
  const std::vector<Vector3> grains = places_of_grains(layout);
  const auto sees_grains = [&](const Vector3& x) {
    return std::any_of(grains.begin(), grains.end(), [&](const Vector3& y) { return !surface.blocks(x, y); });
  };
  const double off = 0.02 * layout.given.bed.spacing, far = norm(surface.high() - surface.low());
  for (std::size_t n = 0; n < fields.count(); ++n) {
    const SurfacePoint& field = fields.all()[n];
    if (layout.given.vessel[field.patch].shape != VesselShape::stl) continue;
    const std::array<Vector3, 2> outwards{field.normal, -1.0 * field.normal};  // a file's normals may be on either side
    if (std::any_of(outwards.begin(), outwards.end(),
                    [&](const Vector3& out) { return sees_grains(field.place + off * out); }))
      continue;
    is_far[n] = std::any_of(outwards.begin(), outwards.end(), [&](const Vector3& out) {
      const Vector3 from = field.place + off * out, to = field.place + far * out;
      const auto crossing = surface.first_crossing(from, to);
      return crossing && surface.triangles()[crossing->triangle].patch == field.patch &&
             sees_grains(from + crossing->at * (to - from) + off * out);
    });
  }
  return is_far;
}

std::vector<NamedValue> totals_of(const std::vector<LoadBand>& bands, const SurfaceFields& fields,
                                  const WallLoads& loads) {
  std::vector<NamedValue> values;
  for (const LoadBand& band : bands) {
    double push = 0, shear = 0;
    for (const std::uint32_t n : band.fields) {
      push += loads.push_of(fields, n);
      shear += dot(loads.received_of(fields, n), downwards(fields.all()[n].normal));
    }
    values.push_back({"normal_impulse_" + band.name, "N s", push});
    if (!band.is_level()) values.push_back({"shear_impulse_" + band.name, "N s", shear});
  }
  return values;
}

SurfaceSnapshot loads_on(const FieldMesh& mesh, const SurfaceFields& fields, const WallLoads& w, double time,
                         double gate_time) {
  SurfaceSnapshot snapshot{.time = time, .points = mesh.points, .triangles = mesh.corners, .columns = {}};
  const auto add = [&](const char* name, const char* unit, auto&& value_of) {
    std::vector<std::decay_t<decltype(value_of(std::size_t{0}))>> values;
    values.reserve(mesh.field.size());
    for (const std::uint32_t n : mesh.field) values.push_back(value_of(n));
    snapshot.columns.push_back({name, unit, std::move(values)});
  };
  const double flow = gate_time >= 0 ? time - gate_time : 0;
  const auto normal = [&](std::size_t n) { return fields.all()[n].normal; };
  const auto since_gate = [&](std::size_t n) { return flow > 0 ? per_area(fields.all()[n], flow) : 0.0; };
  add("pressure", "Pa", [&](std::size_t n) { return w.pressure[n]; });
  add("shear", "Pa", [&](std::size_t n) { return along(w.traction[n], normal(n)); });
  add("pressure_at_rest", "Pa", [&](std::size_t n) { return w.rest_pressure[n]; });
  add("shear_at_rest", "Pa", [&](std::size_t n) { return along(w.rest_traction[n], normal(n)); });
  add("pressure_in_flow", "Pa", [&](std::size_t n) { return since_gate(n) * (w.push_of(fields, n) - w.gate_push[n]); });
  add("shear_in_flow", "Pa",
      [&](std::size_t n) { return along(since_gate(n) * (w.received_of(fields, n) - w.gate_received[n]), normal(n)); });
  add("pressure_largest", "Pa", [&](std::size_t n) { return w.max_pressure[n]; });
  add("time_of_largest", "s", [&](std::size_t n) { return w.max_time[n]; });
  add("patch", "1", [&](std::size_t n) { return static_cast<double>(fields.all()[n].patch); });
  return snapshot;
}

}  // namespace talus::continuum
