// SPDX-License-Identifier: Apache-2.0
/// The law `critical-state` on an endless slope: a column of layers between a rough base and a free surface, which move
/// along and across the slope by Newton's law. One dimension, so no scheme of the model stands between law and answer.
#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "base/unit.hpp"
#include "physics/granular/critical_state.hpp"

namespace talus::granular {
namespace {

constexpr double grain_density = 2500, gravity = 9.81;

class Slope {
 public:
  /// \param height m, of layers at the packing at which the grains just touch
  Slope(const CriticalState::Parameters& parameters, double diameter, double height, int layers)
      : law_(parameters, grain_density, diameter),
        mass_(parameters.reference_packing * grain_density * height / layers),
        points_(static_cast<std::size_t>(layers)),
        place_(points_.size() + 1),
        along_(points_.size() + 1, 0.0),
        across_(points_.size() + 1, 0.0) {
    for (std::size_t k = 0; k < place_.size(); ++k) place_[k] = height * static_cast<double>(k) / layers;
    step_ = 0.2 * (height / layers) / law_.sound_speed(parameters.reference_packing * grain_density);
  }

  /// \param damping 1/s, of the motion across the slope; \param held whether the grains may not move along it
  void advance(double time, double angle, double damping, bool held = false) {
    const double down = gravity * std::sin(angle), press = gravity * std::cos(angle);
    for (double passed = 0; passed < time; passed += step_) {
      for (std::size_t k = 0; k < points_.size(); ++k) {
        const double thickness = place_[k + 1] - place_[k];
        const Tensor3<> gradient{.xz = (along_[k + 1] - along_[k]) / thickness,
                                 .zz = (across_[k + 1] - across_[k]) / thickness};
        points_[k] = law_.update(points_[k], gradient, mass_ / thickness, step_);
      }
      for (std::size_t k = 1; k < place_.size(); ++k) {
        const bool top = k == points_.size();
        const SymmetricTensor3<> below = points_[k - 1].stress;
        const SymmetricTensor3<> above = top ? SymmetricTensor3<>{} : points_[k].stress;
        const double mass = (top ? 0.5 : 1.0) * mass_;
        if (!held) along_[k] += step_ * (down - (above.zx - below.zx) / mass);
        across_[k] += step_ * (-press - (above.zz - below.zz) / mass);
        across_[k] /= 1 + damping * step_;
        place_[k] += step_ * across_[k];
      }
    }
  }

  double height() const { return place_.back(); }
  double place(std::size_t k) const { return place_[k]; }
  double speed(std::size_t k) const { return along_[k]; }
  double surface_speed() const { return along_.back(); }
  std::size_t layers() const { return points_.size(); }
  const MaterialPoint<CriticalState>& point(std::size_t k) const { return points_[k]; }

 private:
  CriticalState law_;
  double mass_;  // of a layer over its area, kg/m^2
  std::vector<MaterialPoint<CriticalState>> points_;
  std::vector<double> place_, along_, across_;  // of the layers' ends: m, m/s, m/s
  double step_ = 0;
};

TEST(CriticalStateOnASlope, FlowsAsBagnoldFound) {
  const double diameter = 5e-3, angle = 24 * M_PI / 180;
  const CriticalState::Parameters p{
      .bulk_modulus = 1e6, .shear_modulus = 0.6e6, .reference_packing = 0.58, .ageing_strength = 0};
  Slope slope(p, diameter, 0.1, 40);
  slope.advance(0.1, angle, 200, true);
  slope.advance(8, angle, 20);
  // mu(I) = tan(angle) at every depth.
  const double ratio = std::tan(angle);
  const double inertial = p.inertial_number * (ratio - p.static_friction) / (p.dynamic_friction - ratio);
  const double packing = p.critical_packing - p.packing_slope * inertial;
  const double height = slope.height();
  const double factor = 2.0 / 3.0 * inertial / diameter * std::sqrt(packing * gravity * std::cos(angle));
  const double most = factor * std::pow(height, 1.5);
  EXPECT_GT(most, 0.4);
  for (std::size_t k = 1; k <= slope.layers(); ++k) {
    const double bagnold = factor * (std::pow(height, 1.5) - std::pow(std::max(height - slope.place(k), 0.0), 1.5));
    EXPECT_NEAR(slope.speed(k), bagnold, 0.01 * most) << k;
  }
  for (std::size_t k = 0; k + 2 < slope.layers(); ++k)
    EXPECT_NEAR(p.reference_packing / (1 + slope.point(k).history.expansion), packing, 1e-3) << k;
}

TEST(CriticalStateOnASlope, StartsAtASteeperAngleThanItStops) {
  // Grains of 0.2 mm at the critical packing, at rest for ten ageing times; then the slope is tilted by 0.1 degrees
  // every 50 ms, and back once they flow.
  const CriticalState::Parameters p{.bulk_modulus = 1e6, .shear_modulus = 0.6e6, .reference_packing = 0.585};
  Slope slope(p, 200e-6, 0.02, 10);
  double angle = 20 * degree;
  slope.advance(0.1, angle, 200);
  EXPECT_LT(slope.surface_speed(), 1e-4);
  while (slope.surface_speed() < 5e-3 && angle < 45 * degree) {
    angle += 0.1 * degree;
    slope.advance(0.05, angle, 20);
  }
  const double starts = angle / degree;
  EXPECT_NEAR(starts, std::atan(p.static_friction + p.ageing_strength) / degree, 0.35);
  while (slope.surface_speed() > 1e-3 && angle > 0) {
    angle -= 0.1 * degree;
    slope.advance(0.05, angle, 20);
  }
  const double stops = angle / degree;
  EXPECT_NEAR(stops, std::atan(p.static_friction) / degree, 0.8);
  EXPECT_GT(starts - stops, 3);
}

}  // namespace
}  // namespace talus::granular
