// SPDX-License-Identifier: Apache-2.0
/// The largest step of the leapfrog, against that of the lattice.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "models/continuum/cases.hpp"

namespace talus::continuum {
namespace {

using std::numbers::pi;

TEST(Advance, TheLeapfrogIsStableUpToTheStepThatTheLatticeAllows) {
  // Of waves along z on the lattice, omega = c k', with k'^2 = g^2/moment and g(k) = sum of -F z sin(k z): the
  // corrected gradient and the divergence of Eq. 17 in turn. The leapfrog amplifies none with omega dt < 2. The largest
  // k' is 1.01 along an axis and 1.08 in any direction, so that a Courant number of 1.85 is the limit.
  constexpr int layers = 12;
  int fastest = 1;
  double largest = 0;
  for (int n = 1; n < layers; ++n) {
    double g = 0;
    for (int i = -2; i <= 2; ++i)
      for (int j = -2; j <= 2; ++j)
        for (int k = -2; k <= 2; ++k)
          g -= k == 0 ? 0
                      : sph::cubic_spline_slope(std::sqrt(double(i * i + j * j + k * k)), 1.0) * k *
                            std::sin(pi * n * k / layers);
    if (const double wave_number = g / std::sqrt(lattice_moment()); wave_number > largest)
      largest = wave_number, fastest = n;
  }
  Parameters p = column(1, 1, layers);
  p.box.top = FaceKind::wall;
  p.gravity.acceleration = 0;
  p.integration.method = Method::leapfrog;
  const auto growth = [&](double courant) {
    p.integration.courant = courant;
    ThreadTeam team(1);
    Continuum model(p);
    State& start = model.mutable_state();
    for (std::size_t i = 0; i < start.position.size(); ++i)
      start.velocity[i].z = 1e-6 * std::sin(pi * fastest * start.position[i].z / (layers * spacing));
    model.begin(team);
    double max_speed = 0;
    for (int n = 0; n < 1000 && max_speed < 1; ++n) {
      model.advance(team);
      for (const Vector3& v : model.state().velocity) max_speed = std::max(max_speed, std::abs(v.z));
    }
    return max_speed / 1e-6;
  };
  EXPECT_LT(growth(0.98 * 2 / largest), 20);
  EXPECT_GT(growth(1.02 * 2 / largest), 1000);
}

}  // namespace
}  // namespace talus::continuum
