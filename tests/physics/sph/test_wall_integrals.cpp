// SPDX-License-Identifier: Apache-2.0
#include "physics/sph/wall_integrals.hpp"

#include <gtest/gtest.h>

#include "numerics/sph/cubic_spline.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::sph {
namespace {

using std::numbers::pi;

TEST(WallIntegrals, OverTheWholeSphereAreThoseOfTheKernel) {
  for (const double h : {1.0, 0.3}) {
    const auto all = radial_integrals(0.0, 1 / h);
    EXPECT_NEAR(4 * pi * all.density, 1, 1e-13);
    EXPECT_NEAR(4 * pi / 3 * all.moment, 1, 1e-13) << "by parts, that of W s^2";
    const auto none = radial_integrals(2.5, 1 / h);
    EXPECT_NEAR(none.density, 0, 1e-15);
    EXPECT_NEAR(none.slope, 0, 1e-15);
    EXPECT_NEAR(none.moment, 0, 1e-15);
  }
}

TEST(WallIntegrals, AreThoseOfTheKernelFromAnyRadius) {
  const double h = 0.7;
  for (const double begin : {0.1, 0.6, 1.0, 1.3, 1.9}) {
    double density = 0, slope = 0, moment = 0;
    constexpr int steps = 20000;
    const double step = (2 - begin) * h / steps;
    for (int n = 0; n < steps; ++n) {
      const double s = begin * h + (n + 0.5) * step, derivative = s * cubic_spline_slope(s, h);
      density += cubic_spline(s, h) * s * s * step;
      slope -= derivative * s * s * step;
      moment -= derivative * s * s * s * step;
    }
    const auto closed = radial_integrals(begin, 1 / h);
    EXPECT_NEAR(closed.density, density, 1e-9);
    EXPECT_NEAR(closed.slope, slope, 1e-9);
    EXPECT_NEAR(closed.moment, moment, 1e-9);
  }
}

TEST(WallIntegrals, VanishAsPowersAtTheEndOfTheSupport) {
  for (const double u : {1e-2, 1e-4, 1e-6}) {
    const auto all = radial_integrals(2 - u, 1.0);
    EXPECT_NEAR(all.density / (std::pow(u, 4) / (4 * pi)), 1, u);
    EXPECT_NEAR(all.slope / (std::pow(u, 3) / pi), 1, u);
    EXPECT_NEAR(all.moment / (2 * std::pow(u, 3) / pi), 1, 2 * u);
  }
}

/// Of a particle at a distance from a plane of points.
WallSums<double> sums_over(const std::vector<SurfacePoint>& points, const Vector3& x, double h) {
  WallSums<double> sums;
  for (const SurfacePoint& p : points) {
    const double d[3] = {p.place.x - x.x, p.place.y - x.y, p.place.z - x.z};
    const double n[3] = {p.normal.x, p.normal.y, p.normal.z};
    sums.add(d, n, p.area, h);
  }
  return sums;
}

TEST(WallIntegrals, AreThoseOfAPlane) {
  const Vector3 a{-4, -4, 0}, b{4, -4, 0}, c{4, 4, 0}, d{-4, 4, 0};
  const Surface plane({{{a, b, c}, 0}, {{a, c, d}, 0}}, 1);
  const auto points = spread_points(plane, 0.4);
  for (const double distance : {0.25, 0.4, 0.5, 1.0})
    for (int n = 0; n < 40; ++n) {
      const Vector3 x{0.037 * n, 0.021 * n, distance};
      const WallSums<double> s = sums_over(points, x, 1), other = sums_over(points, {x.x, x.y, -distance}, 1);
      const double slack = distance < 0.3 ? 0.17 : distance < 0.45 ? 0.025 : 8e-3;
      EXPECT_NEAR(s.weight / weight_of_plane(distance), 1, slack) << distance;
      EXPECT_NEAR(s.normal[2], s.weight, 1e-12);
      EXPECT_NEAR(other.normal[2], -other.weight, 1e-12) << "of either side";
      // The field of a pressure that is the same everywhere pushes nothing: what is beyond the plane balances what is
      // before it, whose integral of the kernel's gradient is that over the plane of the kernel itself.
      double expected = 0;
      constexpr int steps = 2000;
      const double height = std::sqrt(distance * distance + 0.0225), step = (2 - height) / steps;
      for (int k = 0; k < steps && step > 0; ++k) {
        const double r = height + (k + 0.5) * step;
        expected += 2 * pi * r * cubic_spline(r, 1.0) * step;
      }
      EXPECT_NEAR(-s.slope[2] / expected, 1, slack) << distance;
      EXPECT_NEAR(s.distance / s.weight, distance, 1e-9);
    }
}

TEST(WallIntegrals, CoarserPointsAreAsGoodFromAfar) {
  const Vector3 a{-4, -4, 0}, b{4, -4, 0}, c{4, 4, 0}, d{-4, 4, 0};
  const auto points = spread_points(Surface({{{a, b, c}, 0}, {{a, c, d}, 0}}, 1), 0.8);
  const double touching = weight_of_plane(0.5);  // what errors are shares of
  for (const double distance : {1.0, 1.1, 1.3, 1.6})
    for (int n = 0; n < 40; ++n) {
      const WallSums<double> s = sums_over(points, {0.037 * n, 0.021 * n, distance}, 1);
      EXPECT_NEAR(s.weight, weight_of_plane(distance), 5e-3 * touching) << distance;
      EXPECT_LT(std::hypot(s.slope[0], s.slope[1]), 5e-3 * touching) << distance;
    }
}

TEST(WallIntegrals, InACornerAllIsCountedOnce) {
  const auto face = [](int axis) {
    const auto at = [&](double u, double v) {
      Vector3 x;
      x[(axis + 1) % 3] = u, x[(axis + 2) % 3] = v;
      return x;
    };
    return std::vector<Triangle>{{{at(0, 0), at(4, 0), at(4, 4)}, 0}, {{at(0, 0), at(4, 4), at(0, 4)}, 0}};
  };
  std::vector<Triangle> all;
  for (int axis = 0; axis < 3; ++axis)
    for (const Triangle& t : face(axis)) all.push_back(t);
  const auto points = spread_points(Surface(all, 1), 0.2);
  for (const double away : {0.5, 0.8, 1.2}) {
    const double as_blurred = std::sqrt(away * away + 0.0225);
    double before = 0;  // of the kernel, within the corner
    constexpr int cells = 80;
    const double cell = 4.0 / cells;
    for (int i = 0; i < cells; ++i)
      for (int j = 0; j < cells; ++j)
        for (int k = 0; k < cells; ++k) {
          const Vector3 x = cell * Vector3{i + 0.5, j + 0.5, k + 0.5};
          before += cell * cell * cell * cubic_spline(norm(x - Vector3{as_blurred, as_blurred, as_blurred}), 1.0);
        }
    EXPECT_NEAR(sums_over(points, {away, away, away}, 1).density, 1 - before, 0.012) << away;
  }
}

}  // namespace
}  // namespace talus::sph
