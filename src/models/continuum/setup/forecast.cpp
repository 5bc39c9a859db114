// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/forecast.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "models/continuum/boundary/vessel_loads.hpp"
#include "models/continuum/boundary/vessel_walls.hpp"
#include "models/continuum/gas/atmosphere.hpp"
#include "models/continuum/population.hpp"

namespace talus::continuum {

namespace {

constexpr double max_steps = 1e12;  // at a microsecond each, twelve days
constexpr double hopeless_courant =
    50;  // of a fixed step, with the bound on the speed of waves; 5 may yet hold in a loose bed

struct SettlingTime {
  double min = 0, max = 0;  ///< s; of an undamped bed far apart
};

/// A bed whose weight comes on at once swings about its rest with its slowest wave, omega = pi c/(2 H) for the height
/// H, whose speed is at most 4/pi g/omega; one whose weight comes on as half a cosine over n periods of it has 1/(4
/// n^2) of that left. Damping of time tau makes it die out with the slower root of s^2 - s/tau + omega^2, until hardly
/// a particle is faster than settle.speed. Without damping it dies out by friction and by the scheme's own viscosity,
/// in a time that no closed form gives: settle.max_time bounds it.
SettlingTime settling_time(const Setup& setup) {
  const Parameters& p = setup.given;
  const auto known = [&](double time) { return SettlingTime{time, time}; };
  if (p.gate.opens == GateOpens::from_the_start) return known(0);
  if (p.gate.opens == GateOpens::at_time) return known(p.gate.time);
  constexpr double pi = std::numbers::pi;
  const TimeScales& scales = setup.scales;
  const double frequency = 0.5 * pi * setup.sound_speed / setup.depth, loading = setup.loading.time();
  const double periods = loading * frequency / (2 * pi);
  const double speed = 4 / pi * p.gravity.acceleration / frequency / std::max(1.0, 4 * periods * periods);
  const double excess = std::log(std::max(1.0, speed / scales.settled_speed)),
               least = loading + scales.settled_duration;
  const double most = scales.settling_limit;
  if (!(excess > 0)) return known(std::min(most, least));
  if (!p.settle.damping_time) return {std::min(most, least), most};
  const double half_rate = 0.5 / *p.settle.damping_time;
  const double rate = half_rate - std::sqrt(std::max(0.0, half_rate * half_rate - frequency * frequency));
  return known(std::min(most, least + excess / rate));
}

/// All triangles of the vessel.
struct Triangles {
  double count = 0, area = 0;  ///< m^2
  double drawn = 0;            ///< that snapshots of the walls have: parts of them in fields
};
Triangles triangles_of_vessel(const Parameters& p) {
  Triangles all;
  const double edge = edge_of_drawn_field * p.bed.spacing;
  for (std::size_t n = 0; n < p.vessel.size(); ++n)
    for (const Triangle& t : triangles_of(p, n)) {
      const auto& [a, b, c] = t.corner;
      const double area = norm(t.area()), longest = std::max({norm(b - a), norm(c - b), norm(a - c)});
      ++all.count, all.area += area;
      all.drawn += std::max(1 + longest / edge, 2 * area / (edge * edge));
    }
  return all;
}

/// Of all sets of points, on a square of a spacing.
double points_on_square(const LevelParameters& levels) {
  double points = 0;
  for (std::size_t set = 0; set < sets_for(static_cast<int>(levels.count)); ++set)
    points += 1 / (apart_in(set) * apart_in(set));
  return points;
}

}  // namespace

double room_for_inlets(const Setup& setup) {
  const Parameters& p = setup.given;
  double high = 0, low = 0, area = p.box.width * p.box.depth;
  for (const Inlet& inlet : p.inlets) high = std::max(high, inlet.centre[2]);
  if (p.box.floor == FaceKind::open && !p.vessel.empty()) {
    const auto [from, to] = bounds_of_vessel(p);
    low = std::max(low, from.z);
    area = std::min(area, (to.x - from.x) * (to.y - from.y));
  }
  const double bed = setup.lattice.mass * bed_count(setup);
  return std::max(0.0, setup.density * area * (high - low) - bed);
}

double time_step_of(const Setup& setup) {
  const auto& integration = setup.given.integration;
  return integration.step.value_or(integration.courant * setup.smoothing_length / setup.sound_speed);
}

Forecast forecast(const Setup& setup, double end) {
  const Parameters& p = setup.given;
  const Triangles triangles = triangles_of_vessel(p);
  const double squares = triangles.area / (p.bed.spacing * p.bed.spacing),
               bed = share_of_particles(setup) * bed_count(setup);
  const double step = time_step_of(setup);
  const SettlingTime settling = settling_time(setup);
  const double come = p.inlets.empty() ? 0 : std::min(mass_to_come(p, end, settling.max), room_for_inlets(setup));
  const double particles = bed + come / setup.lattice.mass;
  return {.particles = particles,
          .written = setup.copies * particles,
          .cells = p.air.enabled ? static_cast<double>(air_grid(p).cells()) : 0,
          .wall_points = points_on_square(p.levels) * squares,
          .triangles = triangles.count,
          .drawn_triangles = triangles.drawn,
          .load_fields = squares / (size_of_load_field * size_of_load_field),
          .settling_steps = std::ceil(settling.min / step),
          .max_settling_steps = std::ceil(settling.max / step),
          .flow_steps = std::ceil(end / step)};
}

double courant_number(const Setup& setup) {
  return time_step_of(setup) * setup.sound_speed / setup.smoothing_length;
}

std::vector<Problem> check_steps(const Setup& setup, double end) {
  const Parameters& p = setup.given;
  std::vector<Problem> problems;
  const double length = setup.smoothing_length, speed = setup.sound_speed, step = time_step_of(setup);
  if (p.integration.step && step > hopeless_courant * length / speed)
    problems.push_back(
        {.key = "integration.step",
         .what = fmt::format("in {:.3g} s pressure waves pass {:.3g} smoothing lengths", step, step * speed / length),
         .allowed = fmt::format("at most {:.2g} s, better {:.2g} s (integration.courant = {:g})",
                                hopeless_courant * length / speed, p.integration.courant * length / speed,
                                p.integration.courant)});
  if (!(step > 0 && std::isfinite(step))) {
    problems.push_back({.key = "integration.courant",
                        .what = fmt::format("the time step would be {} s: pressure waves run at {} m/s over {} m "
                                            "(bed.spacing, grains.density, law.scale)",
                                            step, speed, length),
                        .allowed = "a step above 0 s"});
    return problems;
  }
  const double settling = settling_time(setup).min;
  const char* const key = p.integration.step                                                  ? "integration.step"
                          : settling <= end                                                   ? "run.end"
                          : p.gate.time > 0                                                   ? "gate.time"
                          : p.settle.loading_time.value_or(0) > setup.scales.settled_duration ? "settle.loading_time"
                                                                                              : "settle.duration";
  if (!((end + settling) / step <= max_steps))
    problems.push_back(
        {.key = key,
         .what = fmt::format("{:.3g} s take {:.2g} steps of {:.2g} s", end + settling, (end + settling) / step, step),
         .allowed = fmt::format("at most {:.0e} steps", max_steps)});
  return problems;
}

double memory_of(const Forecast& f) {
  // Libraries; columns, records and lists of particles and images, with room for sums of those beside walls; points of
  // walls, with the fields and the mesh of their loads; triangles, whose edges and faults are sought before anything
  // else is there.
  // Particles that are written are those computed, but for a sector, whose copies are made for it.
  constexpr double libraries = 22e6, sought = 1600, kept = 400, of_copy = 250;
  return std::max(libraries + sought * f.triangles, libraries + 3500 * f.particles +
                                                        of_copy * (f.written - f.particles) + 900 * f.cells +
                                                        350 * f.wall_points + kept * f.triangles);
}

Parameters coarser(const Layout& layout, double particles) {
  const Parameters& p = layout.given;
  Parameters q = p;
  q.bed.spacing *= std::cbrt(bed_count(layout) / particles);
  if (!p.bed.given) return q;
  const Extent x = bed_along_x(p), y = bed_along_y(p);  // where the file's particles lie
  q.bed.left = x.low, q.bed.right = x.high, q.bed.front = y.low, q.bed.rear = y.high, q.bed.bottom = bed_bottom(p);
  q.bed.given = nullptr, q.bed.file.clear();
  return q;
}

Parameters sample(const Layout& layout, double particles) {
  const Parameters& p = layout.given;
  const Lattice& lattice = layout.lattice;
  constexpr double max_layers = 20;
  const double layers = std::min(max_layers, static_cast<double>(lattice.count[1]));
  const double most = layout.has_no_bed() ? particles : std::min(particles, bed_count(layout));
  const double side = std::max(4.0, std::round(std::sqrt(most / layers)));
  Parameters q = p;
  q.plate = {}, q.wedge = {}, q.plates.clear(), q.vessel.clear(), q.box.sector = std::nullopt;
  q.inlets.clear(), q.removal = {}, q.beds.clear(), q.levels = {}, q.bed.mass = std::nullopt;
  q.bed.bottom = q.bed.left = q.bed.right = q.bed.front = q.bed.rear = std::nullopt;
  q.bed.inside = std::nullopt, q.bed.given = nullptr, q.bed.walls = nullptr, q.bed.file.clear();
  q.box.width = side * lattice.spacing.x, q.box.depth = layers * lattice.spacing.y;
  q.bed.height = side * lattice.spacing.z, q.box.height = 2 * q.bed.height;
  q.bed.spacing = std::cbrt(lattice.spacing.x * lattice.spacing.y * lattice.spacing.z);
  q.box.left = q.box.right = q.box.front = q.box.rear = FaceKind::symmetry;
  q.box.floor = FaceKind::wall, q.box.top = FaceKind::open;
  q.gate = {.opens = GateOpens::from_the_start, .time = 0};
  q.air.cell = p.air.enabled ? air_grid(p).spacing.x : q.bed.spacing;
  if (p.air.enabled && p.air.cell_depth) q.air.cell_depth = std::min(air_grid(p).spacing.y, q.box.depth);
  for (FlowBoundary& kind : q.air.gas.boundaries.kind) kind = FlowBoundary::no_slip;
  q.air.gas.boundaries.kind[5] = FlowBoundary::open;
  return q;
}

}  // namespace talus::continuum
