// SPDX-License-Identifier: Apache-2.0
/// How fast the spectral sum over pairs is on one thread, beside the direct sum of the same run, and the memory that
/// the program has taken by then. Radii within 5 %, the printed tensor; in a plane spheres at a packing of 0.4, in
/// space at 0.2. usage: benchmark_spectral_sum [plane | space] [largest number of spheres for the direct sum, 20000 if
/// left out]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
#include <string_view>
#include <vector>

#include "base/random.hpp"
#include "models/cloud/spectral_sum.hpp"
#include "numerics/cell_grid.hpp"

namespace talus::cloud {
namespace {

double processor_time() {
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

double megabytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024;
}

template <class Body>
double min_time(Body&& body, int repetitions) {
  double least = 1e30;
  for (int k = 0; k < repetitions; ++k) {
    const double begin = processor_time();
    body();
    least = std::min(least, processor_time() - begin);
  }
  return least;
}

struct Setup {
  std::vector<Vector3> position, force, velocity;
  std::vector<double> radius;
  std::vector<std::uint32_t> order;

  Setup(std::size_t count, bool space) : velocity(count) {
    constexpr double a = 5e-3;
    Random random(1);
    const auto side =
        static_cast<std::size_t>(std::ceil(std::pow(static_cast<double>(count), space ? 1.0 / 3 : 0.5) - 1e-9));
    const double spacing = a * (space ? std::cbrt(4 * std::numbers::pi / 3 / 0.2) : std::sqrt(std::numbers::pi / 0.4));
    const double play = 0.5 * spacing - 1.05 * a, flat = space ? 1 : 0;
    const auto place = [&](std::size_t n) { return spacing * static_cast<double>(n) + random.uniform(-play, play); };
    const auto component = [&] { return random.uniform(-1e-4, 1e-4); };
    for (std::size_t i = 0; i < count; ++i) {
      const double x = place(i % side), y = place(space ? i / side % side : i / side);
      position.push_back({x, y, space ? place(i / side / side) : 0});
      const double f = component(), g = component();
      force.push_back({f, g, flat * component()});
      radius.push_back(a * random.uniform(0.95, 1.05));
    }
    order = spatial_order(position, 4 * a);
  }
};

void measure(std::size_t count, bool space, std::size_t max_direct) {
  Setup s(count, space);
  ThreadTeam team(1);
  const PairSum::Options options{.motion = space ? Motion::xyz : Motion::xy, .viscosity = 1.82e-5};
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    SpectralSum sum(options, accuracy, s.radius);
    sum.reorder(s.order);
    const auto plan = sum.plan(s.position);
    if (!plan) continue;
    sum.set_cutoff(plan->cutoff);
    const auto run = [&] { sum.velocities(team, s.position, s.force, s.velocity); };
    run();  // makes the tensor's spectrum
    const double time = min_time(run, 7);
    fmt::print("{:9} spheres, spectral {:.0e}, r_c {:5.1f} a: {:9.3g} ms, {:9.3g} spheres/s, {:6.0f} MB\n", count,
               accuracy.error, plan->cutoff / 5e-3, 1e3 * time, static_cast<double>(count) / time, megabytes());
  }
  if (count > max_direct) return;
  PairSum direct(options, s.radius, s.order);
  std::vector<Vector3> exact(count);
  const double time = min_time([&] { direct.velocities(team, s.position, s.force, exact); }, count > 50000 ? 1 : 2);
  double error = 0, size = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const Vector3 d = s.velocity[i] - exact[i];
    error += dot(d, d), size += dot(exact[i], exact[i]);
  }
  fmt::print("{:9} spheres, direct: {:9.3g} ms, {:9.3g} spheres/s; error of the last {:.2g}\n", count, 1e3 * time,
             static_cast<double>(count) / time, std::sqrt(error / size));
}

}  // namespace
}  // namespace talus::cloud

int main(int count, char** argument) {
  const bool space = count > 1 && std::string_view(argument[1]) == "space";
  const auto max_direct = static_cast<std::size_t>(count > 2 ? std::strtod(argument[2], nullptr) : 20000);
  for (const std::size_t spheres : {500, 1000, 2000, 10000, 100000, 1000000})
    talus::cloud::measure(spheres, space, max_direct);
}
