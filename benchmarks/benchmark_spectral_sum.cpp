// SPDX-License-Identifier: Apache-2.0
/// How fast the spectral sum over pairs in a plane is on one thread, beside the direct sum of the same run, and the
/// memory that the program has taken by then. Spheres at a packing of 0.4, radii within 5 %, the printed tensor.
/// usage: benchmark_spectral_sum [largest number of spheres for the direct sum, 20000 if left out]
#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <optional>
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
double least_time(Body&& body, int repetitions) {
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

  explicit Setup(std::size_t count) : velocity(count) {
    constexpr double a = 5e-3;
    Random random(1);
    const auto side = static_cast<std::size_t>(std::ceil(std::sqrt(static_cast<double>(count))));
    const double spacing = a * std::sqrt(std::numbers::pi / 0.4), play = 0.5 * spacing - 1.05 * a;
    for (std::size_t i = 0; i < count; ++i) {
      position.push_back({spacing * static_cast<double>(i % side) + random.uniform(-play, play),
                          spacing * static_cast<double>(i / side) + random.uniform(-play, play), 0});
      force.push_back({random.uniform(-1e-4, 1e-4), random.uniform(-1e-4, 1e-4), 0});
      radius.push_back(a * random.uniform(0.95, 1.05));
    }
    order = spatial_order(position, 4 * a);
  }
};

void measure(std::size_t count, std::size_t most_direct) {
  Setup s(count);
  ThreadTeam team(1);
  const PairSum::Options options{.motion = Motion::xy, .viscosity = 1.82e-5};
  for (const SpectralAccuracy& accuracy : spectral_accuracies) {
    SpectralSum sum(options, accuracy, s.radius);
    sum.reorder(s.order);
    const auto plan = sum.plan(s.position);
    if (!plan) continue;
    sum.set_cutoff(plan->cutoff);
    const auto run = [&] { sum.velocities(team, s.position, s.force, s.velocity); };
    run();  // makes the tensor's spectrum
    const double time = least_time(run, 7);
    fmt::print("{:9} spheres, spectral {:.0e}, r_c {:5.1f} a: {:9.3g} ms, {:9.3g} spheres/s, {:6.0f} MB\n", count,
               accuracy.error, plan->cutoff / 5e-3, 1e3 * time, static_cast<double>(count) / time, megabytes());
  }
  if (count > most_direct) return;
  PairSum direct(options, s.radius, s.order);
  std::vector<Vector3> exact(count);
  const double time = least_time([&] { direct.velocities(team, s.position, s.force, exact); }, 2);
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
  const auto most_direct = static_cast<std::size_t>(count > 1 ? std::strtod(argument[1], nullptr) : 20000);
  for (const std::size_t spheres : {500, 1000, 2000, 10000, 100000, 1000000})
    talus::cloud::measure(spheres, most_direct);
}
