// SPDX-License-Identifier: Apache-2.0
/// What walls of a vessel cost: a step in a cone under a cylinder beside one of as many particles in a box of mirrors,
/// a rebuild of the neighbour lists of both, and the same vessel in 10^5 triangles beside itself. The beds bear their
/// weight; a step is one without a rebuild. Both sides of a ratio are measured in turn; the least times are compared.
/// Arguments: particles, about so many; by how many hundredths of a spacing they are moved at most, at random, from the
/// lattice on which they are laid. On it all lists of a box are equally long, which no bed that has moved has.
#include <benchmark/benchmark.h>

#include <algorithm>
#include <cmath>
#include <ctime>
#include <limits>
#include <memory>
#include <numbers>

#include "models/continuum/model.hpp"
#include "models/continuum/setup/initial.hpp"
#include "models/continuum/setup/vessel.hpp"
#include "models/continuum/workspace.hpp"

namespace talus::continuum {
namespace {

constexpr double spacing = 2.5e-3;

/// As cases/silo-cone.toml.
Parameters grains(double disorder) {
  Parameters p;
  p.bed.spacing = spacing;
  p.bed.disorder = disorder;
  p.gate = {.opens = GateOpens::at_time, .time = 1e3};
  p.grains.density = 2500;
  p.law = granular::CriticalState::Parameters{.bulk_modulus = 0.30625e6, .shear_modulus = 0.18375e6};
  p.collisions.form = granular::Collisions::none;
  p.sph.viscosity_alpha = 0.01;
  p.walls.coefficient = 0.3;
  p.walls.friction_from = FrictionFrom::start;
  p.integration.method = Method::leapfrog;
  p.integration.courant = 1.2;
  return p;
}

/// Twice as high as wide.
Parameters box(double particles, double disorder) {
  Parameters p = grains(disorder);
  const double side = std::round(std::cbrt(0.5 * particles)), height = std::round(particles / (side * side));
  p.box.width = p.box.depth = side * spacing;
  p.box.height = (height + 10) * spacing;
  p.box.front = p.box.rear = FaceKind::wall;
  p.bed.height = height * spacing;
  return p;
}

/// A cylinder as high as wide on a cone of 30 degrees.
Parameters silo(double particles, double disorder) {
  Parameters p = grains(disorder);
  // Of the radius R: the cylinder 2 pi R^3, the cone without its tip 0.52 pi R^3.
  const double radius = std::cbrt(particles / (2.52 * std::numbers::pi)) * spacing;
  const double outlet = 0.46 * radius, cone = (radius - outlet) * std::numbers::sqrt3, bottom = 4 * spacing;
  p.box.width = p.box.depth = 2 * radius + 10 * spacing;
  p.box.height = bottom + cone + 2.5 * radius + 10 * spacing;
  p.box.front = p.box.rear = FaceKind::wall;
  VesselPart upper, lower, gate;
  upper.shape = VesselShape::cylinder, lower.shape = VesselShape::cone, gate.shape = VesselShape::disc;
  upper.radius = lower.upper_radius = radius, lower.lower_radius = gate.radius = outlet;
  lower.bottom = gate.height = bottom;
  lower.top = upper.bottom = bottom + cone, upper.top = bottom + cone + 2.5 * radius;
  gate.gate = true;
  p.vessel = {upper, lower, gate};
  p.bed.height = cone + 2 * radius;
  return p;
}

/// The same walls as drawings of so many triangles together: each is cut into four until there are enough.
Parameters triangulated(const Parameters& p, std::size_t least) {
  Parameters drawn = p;
  std::vector<std::vector<Triangle>> parts;
  for (std::size_t n = 0; n < p.vessel.size(); ++n) parts.push_back(triangles_of(p, n));
  const auto count = [&] {
    std::size_t sum = 0;
    for (const auto& part : parts) sum += part.size();
    return sum;
  };
  const auto longest = [](const Triangle& t) {
    std::size_t side = 0;
    for (std::size_t c = 1; c < 3; ++c)
      if (norm(t.corner[(c + 1) % 3] - t.corner[c]) > norm(t.corner[(side + 1) % 3] - t.corner[side])) side = c;
    return side;
  };
  while (count() < least)
    for (auto& part : parts) {
      std::vector<Triangle> finer;
      for (const Triangle& t : part) {
        const std::size_t a = longest(t), b = (a + 1) % 3, c = (a + 2) % 3;
        const Vector3 middle = 0.5 * (t.corner[a] + t.corner[b]);
        finer.push_back({{t.corner[a], middle, t.corner[c]}, 0});
        finer.push_back({{middle, t.corner[b], t.corner[c]}, 0});
      }
      part = std::move(finer);
    }
  for (std::size_t n = 0; n < parts.size(); ++n) {
    VesselPart& part = drawn.vessel[n];
    part.shape = VesselShape::stl, part.unit = FileUnit::m;
    part.drawn = std::make_shared<DrawnSurface>(std::move(parts[n]));
  }
  return drawn;
}

double processor_time() {
  std::timespec time{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
  return static_cast<double>(time.tv_sec) + 1e-9 * static_cast<double>(time.tv_nsec);
}

/// With a speed of sound of 100 m/s.
Setup setup_of(const Parameters& p) {
  Setup setup(p);
  setup.sound_speed = 100;
  return setup;
}

/// A bed that bears the weight above each of its particles.
struct Bed {
  Parameters parameters;
  ThreadTeam team{1};
  Continuum model;
  Domain domain;
  Surface surface;
  PairSums pairs;
  std::vector<double> h;
  double min_step = std::numeric_limits<double>::infinity(), min_lists = min_step;  // s, of a particle

  explicit Bed(const Parameters& p)
      : parameters(p),
        model(p),
        domain(Boundary(p).domain()),
        surface(Boundary(p).vessel()),
        pairs(setup_of(p), domain, surface) {
    State& s = model.mutable_state();
    double top = 0;
    for (const Vector3& x : s.position) top = std::max(top, x.z);
    for (std::size_t i = 0; i < s.position.size(); ++i)
      for (std::size_t c = 0; c < 3; ++c)
        s.material.stress[c][i] = p.bed.packing * p.grains.density * 9.81 * (top + spacing - s.position[i].z);
    model.begin(team);
    for (int n = 0; n < 50; ++n) model.advance(team);
    for (const double density : s.density) h.push_back(pairs.smoothing_length(density));
  }
  double count() const { return static_cast<double>(model.state().position.size()); }

  void measure() {
    for (int n = 0; n < 5; ++n) {
      const std::uint64_t builds = model.state().list_builds;
      const double begin = processor_time();
      model.advance(team);
      if (model.state().list_builds == builds) min_step = std::min(min_step, (processor_time() - begin) / count());
    }
    const double begin = processor_time();
    pairs.find_neighbours(team, model.state().position, h);
    min_lists = std::min(min_lists, (processor_time() - begin) / count());
  }
};

void compare(benchmark::State& run, const Parameters& first, const Parameters& second) {
  Bed beds[2]{Bed(first), Bed(second)};
  for (auto _ : run)
    for (Bed& bed : beds) bed.measure();
  constexpr double nanosecond = 1e-9;
  const auto number = [&](const char* name, double value) { run.counters[name] = benchmark::Counter(value); };
  number("particles", beds[1].count());
  number("triangles", static_cast<double>(beds[1].surface.triangles().size()));
  number("step_ns_first", beds[0].min_step / nanosecond);
  number("step_ns", beds[1].min_step / nanosecond);
  number("step_ratio", beds[1].min_step / beds[0].min_step);
  number("lists_ns_first", beds[0].min_lists / nanosecond);
  number("lists_ns", beds[1].min_lists / nanosecond);
  number("lists_ratio", beds[1].min_lists / beds[0].min_lists);
}

double disorder_of(const benchmark::State& run) {
  return 0.01 * static_cast<double>(run.range(1));
}
void vessel_over_box(benchmark::State& run) {
  const auto particles = static_cast<double>(run.range(0));
  compare(run, box(particles, disorder_of(run)), silo(particles, disorder_of(run)));
}
void triangulated_over_primitive(benchmark::State& run) {
  const Parameters p = silo(static_cast<double>(run.range(0)), disorder_of(run));
  compare(run, p, triangulated(p, 100'000));
}

void sizes(benchmark::internal::Benchmark* stage) {
  // The least of some fifty steps: of the five of one round it is up to a tenth more.
  stage->ArgNames({"particles", "disorder"})->ArgsProduct({{10'000, 100'000}, {0, 10}})->MinTime(6);
  stage->Unit(benchmark::kMillisecond);
}
BENCHMARK(vessel_over_box)->Apply(sizes);
BENCHMARK(triangulated_over_primitive)->Apply(sizes);

}  // namespace
}  // namespace talus::continuum

BENCHMARK_MAIN();
