// SPDX-License-Identifier: Apache-2.0
/// Heaps of any points, z up: free surface, slopes, packing, layers.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "analysis/free_surface.hpp"
#include "analysis/statistics.hpp"
#include "app/points/measures.hpp"

namespace talus::app {

namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double least_slope = 20;  // mean radii: ten spacings, as in the hopper
constexpr double room = 6;          // mean radii above the highest point, so that the surface has an end

/// The points' own box: walls that touch the outermost spheres, an open top.
Domain box_around(const PointsToMeasure& set) {
  const double a = set.mean_radius();
  Vector3 low = set.position()[0], high = low;
  for (const Vector3& x : set.position())
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], x[axis] - a);
      high[axis] = std::max(high[axis], x[axis] + a);
    }
  high.z += room * a;
  return Domain(
      {low,
       high,
       {FaceKind::wall, FaceKind::wall, FaceKind::symmetry, FaceKind::symmetry, FaceKind::wall, FaceKind::open}});
}

struct Heap {
  Section packing;
  std::vector<double> at_points;
  FreeSurface surface;
  double middle = 0;
};

Heap heap_of(const PointsToMeasure& set) {
  const double a = set.mean_radius();
  const Domain domain = box_around(set);
  const ParticleField field(particles_of_spheres(set.position(), a), domain);
  Heap heap{
      packing_section(field.particles(), domain, 2 * a, a), {}, {}, 0.5 * (domain.box().low.x + domain.box().high.x)};
  for (const Vector3& x : set.position()) heap.at_points.push_back(field.packing(x));
  heap.surface = free_surface(heap.packing, {domain.box().low.z, domain.box().high.z}, 0.5 * median(heap.at_points));
  return heap;
}

std::vector<double> finite(const std::vector<double>& values) {
  std::vector<double> chosen;
  std::copy_if(values.begin(), values.end(), std::back_inserter(chosen), [](double z) { return std::isfinite(z); });
  return chosen;
}

}  // namespace

Measured measure_surface(const PointsToMeasure& set, const std::string&, std::size_t) {
  const Heap heap = heap_of(set);
  const std::vector<double> heights = finite(heap.surface.z);
  Measured m;
  m.quantities = {{"surface_z_max", "m", quantile(heights, 1)},
                  {"surface_z_mean", "m", mean(heights)},
                  {"surface_angle", "deg", surface_angle(heap.surface, heap.middle) / degree}};
  m.columns = {{"x", "m"}, {"surface_z", "m"}};
  for (std::size_t n = 0; n < heap.surface.x.size(); ++n) m.rows.push_back({heap.surface.x[n], heap.surface.z[n]});
  return m;
}

Measured measure_repose(const PointsToMeasure& set, const std::string&, std::size_t) {
  const Heap heap = heap_of(set);
  const std::vector<HeapSlope> slopes = heap_slopes(heap.surface, least_slope * set.mean_radius());
  const ReposeAngle angle = repose_angle(slopes, heap.middle);
  Measured m;
  m.quantities = {{"repose_angle", "deg", angle.mean / degree},
                  {"repose_angle_left", "deg", angle.left / degree},
                  {"repose_angle_right", "deg", angle.right / degree},
                  {"repose_angle_steepest", "deg", angle.steepest / degree}};
  m.columns = {{"from", "m"}, {"to", "m"}, {"angle", "deg"}};
  for (const HeapSlope& slope : slopes) m.rows.push_back({slope.from, slope.to, slope.angle() / degree});
  return m;
}

Measured measure_packing(const PointsToMeasure& set, const std::string&, std::size_t) {
  const Heap heap = heap_of(set);
  Measured m;
  m.quantities = {{"packing_median", "1", median(heap.at_points)},
                  {"packing_percentile_99_9", "1", quantile(heap.at_points, 0.999)},
                  {"packing_max", "1", quantile(heap.at_points, 1)}};
  m.columns = {{"z", "m"}, {"packing", "1"}};
  for (std::size_t row = 0; row < heap.packing.rows; ++row) {
    const auto first = heap.packing.value.begin() + static_cast<std::ptrdiff_t>(row * heap.packing.columns);
    m.rows.push_back({heap.packing.z(row),
                      mean(std::vector<double>(first, first + static_cast<std::ptrdiff_t>(heap.packing.columns)))});
  }
  return m;
}

Measured measure_layers(const PointsToMeasure& set, const std::string& column, std::size_t bins) {
  Measured m;
  std::string unit;
  const std::vector<double> values = numbers_of(set, column, unit);
  const auto [lowest, highest] = std::minmax_element(set.position().begin(), set.position().end(),
                                                     [](const Vector3& a, const Vector3& b) { return a.z < b.z; });
  struct Layer {
    double height = 0, value = 0, points = 0;
  };
  std::vector<Layer> layers(bins);
  const double thickness = (highest->z - lowest->z) / static_cast<double>(bins);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double above = set.position()[i].z - lowest->z;
    Layer& layer = layers[thickness > 0 ? std::min(bins - 1, static_cast<std::size_t>(above / thickness)) : 0];
    layer.height += set.position()[i].z;
    layer.value += values[i];
    ++layer.points;
  }
  m.columns = {{"z", "m"}, {column, unit}, {"points", "1"}};
  for (const Layer& layer : layers)
    if (layer.points > 0) m.rows.push_back({layer.height / layer.points, layer.value / layer.points, layer.points});
  m.quantities = {{"mean", unit, mean(values)}};
  return m;
}

}  // namespace talus::app
