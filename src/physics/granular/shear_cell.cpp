// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/shear_cell.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <utility>

namespace talus::granular {

namespace {

/// One sample in its apparatus.
class Sample {
 public:
  Sample(const AnyLaw& law, const ShearCellOptions& options) : law_(law), options_(options) {
    point_.density = options.density;
  }

  const PathPoint& point() const { return point_; }

  /// Loads it, its sides held.
  void load(double normal) { follow({load_time_, {}, Stress{std::nullopt, std::nullopt, normal, std::nullopt}}, 200); }
  /// Takes the shear stress off, and brings it under another stress, the same all around.
  void release(double stress) {
    follow({load_time_, {}, Stress{std::nullopt, std::nullopt, point_.stress.zz, 0.0}}, 100);
    follow({load_time_, {}, Stress{stress, stress, stress, 0.0}}, 200);
  }
  /// Shears it under its load. \returns the largest shear stress
  double shear(double strain) {
    const Tensor3<> gradient{.xz = options_.rate};
    double most = 0;
    for (const PathPoint& p :
         follow({strain / options_.rate, gradient, Stress{std::nullopt, std::nullopt, point_.stress.zz, std::nullopt}},
                1000))
      most = std::max(most, std::abs(p.stress.zx));
    return most;
  }
  /// Compresses it along z under its lateral stress. \returns the largest axial stress, and whether it was a peak or
  /// plateau: within the last tenth of the strain it grew by less than 1 %
  std::pair<double, bool> compress(double strain, bool in_plane_strain) {
    const Tensor3<> gradient{.zz = -options_.rate};
    Stress stress{point_.stress.xx, point_.stress.yy, std::nullopt, std::nullopt};
    if (in_plane_strain) stress[1].reset();
    double most = point_.stress.zz, before = most;
    const std::vector<PathPoint> path = follow({strain / options_.rate, gradient, stress}, 1000);
    for (std::size_t n = 0; n < path.size(); ++n) {
      most = std::max(most, path[n].stress.zz);
      if (n == 9 * path.size() / 10) before = most;
    }
    return {most, most <= 1.01 * before};
  }

 private:
  using Stress = std::array<std::optional<double>, 4>;

  std::vector<PathPoint> follow(const PathStretch& stretch, int points) {
    std::vector<PathPoint> path =
        follow_path(law_, point_, std::span(&stretch, 1),
                    {.density = point_.density, .max_increment = options_.max_increment, .points = points});
    point_ = path.back();
    return path;
  }

  static constexpr double load_time_ = 1;  // s
  const AnyLaw& law_;
  const ShearCellOptions& options_;
  PathPoint point_ = {};
};

}  // namespace

YieldLocus evaluated(const YieldPoint& pre_shear, std::span<const YieldPoint> points) {
  double normal = 0, shear = 0, square = 0, product = 0;
  const auto n = static_cast<double>(points.size());
  for (const YieldPoint& p : points) normal += p.normal / n, shear += p.shear / n;
  for (const YieldPoint& p : points) {
    square += (p.normal - normal) * (p.normal - normal);
    product += (p.normal - normal) * (p.shear - shear);
  }
  if (!(square > 0) || !(product > 0)) throw std::invalid_argument("a yield locus needs two loads and a friction");
  const double slope = product / square;
  YieldLocus locus{.cohesion = shear - slope * normal, .angle = std::atan(slope)};
  const double sine = std::sin(locus.angle), cosine = std::cos(locus.angle), apex = locus.cohesion / slope;
  locus.strength = std::max(2 * locus.cohesion * cosine / (1 - sine), 0.0);
  const double a = pre_shear.normal + apex;
  // A point of pre-shear above the line has no such circle: that which touches the line below it.
  const double root =
      std::sqrt(std::max(a * a * sine * sine - pre_shear.shear * pre_shear.shear * cosine * cosine, 0.0));
  const double centre = (a - root) / (cosine * cosine);
  const double radius = centre * sine, middle = centre - apex;
  locus.major = middle + radius;
  locus.effective_angle = std::asin(std::min(radius / middle, 1.0));
  return locus;
}

ShearTest shear_test(const AnyLaw& law, double load, std::span<const double> fractions,
                     const ShearCellOptions& options) {
  Sample sample(law, options);
  sample.load(load);
  const PathPoint loaded = sample.point();
  sample.shear(options.steady_strain);
  ShearTest test{.pre_shear = {load, std::abs(sample.point().stress.zx)}, .density = sample.point().density};
  test.oedometer = {loaded.stress.xx, loaded.stress.zz}, test.density_in_oedometer = loaded.density;
  for (const double fraction : fractions) {
    Sample failing = sample;
    failing.release(fraction * load);
    test.points.push_back({fraction * load, failing.shear(options.failure_strain)});
    Sample cylinder = sample;
    cylinder.release(fraction * load);
    test.triaxial.push_back({fraction * load, cylinder.compress(options.failure_strain, false).first});
  }
  test.locus = evaluated(test.pre_shear, test.points);
  if (options.wall) {
    test.on_wall = test.points;
    test.on_wall.push_back(test.pre_shear);
    for (YieldPoint& point : test.on_wall)
      point.shear = std::min(point.shear, options.wall->coefficient * point.normal + options.wall->adhesion);
  }
  for (const bool in_plane_strain : {true, false}) {
    Sample unconfined = sample;
    unconfined.release(0);
    const auto [strength, is_peak] = unconfined.compress(options.failure_strain, in_plane_strain);
    (in_plane_strain ? test.strength_in_plane_strain : test.strength_of_cylinder) = is_peak ? strength : std::nan("");
  }
  return test;
}

}  // namespace talus::granular
