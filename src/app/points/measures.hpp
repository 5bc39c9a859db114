// SPDX-License-Identifier: Apache-2.0
/// What can be measured on one set of points: the estimators of src/analysis by the names that `talus analyze --as`
/// takes. SI, angles in degrees.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "io/series.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"

namespace talus::app {

/// Points with a radius each, those of the file or else the mean radius.
class PointsToMeasure {
 public:
  /// \param mean_radius m; if not given, the mean of the points' radii
  /// \throws InputError if there are no points, if a place is not finite or a radius not above 0, or if neither the
  /// points nor the caller give a radius
  PointsToMeasure(std::string name, Snapshot points, std::optional<double> mean_radius);

  const std::string& name() const { return name_; }
  const Snapshot& points() const { return points_; }
  double mean_radius() const { return mean_radius_; }
  std::span<const Vector3> position() const { return points_.positions(); }
  std::span<const double> radius() const { return radius_; }
  /// Nothing if the points have none.
  std::optional<std::span<const Vector3>> velocity() const;

 private:
  std::string name_;
  Snapshot points_;
  double mean_radius_ = 0;
  std::vector<double> radius_;
};

/// The numbers of a column: of a vector its length, or a component by NAME_x; its unit too. \throws InputError
std::vector<double> numbers_of(const PointsToMeasure& set, const std::string& name, std::string& unit);

struct Measured {
  std::vector<NamedValue> quantities;
  std::vector<SeriesColumn> columns;  ///< of a table that follows, one row per head or bin; empty: none
  std::vector<std::vector<double>> rows;
};

/// \param column, bins for the histogram and the layers \throws InputError
using Measure = Measured (*)(const PointsToMeasure& points, const std::string& column, std::size_t bins);

Measured measure_heads(const PointsToMeasure& points, const std::string& column, std::size_t bins);
Measured measure_front(const PointsToMeasure& points, const std::string& column, std::size_t bins);
Measured measure_frontal_angle(const PointsToMeasure& points, const std::string& column, std::size_t bins);
Measured measure_head_tail(const PointsToMeasure& points, const std::string& column, std::size_t bins);
Measured measure_neighbours(const PointsToMeasure& points, const std::string& column, std::size_t bins);
Measured measure_histogram(const PointsToMeasure& points, const std::string& column, std::size_t bins);

// heap_measures.cpp: each point a sphere of the mean radius a, z up, on a floor under the lowest one, between walls
// beside the outermost; y is averaged over.
/// Height of the free surface in columns 2 a wide, where the packing, deposited by the kernel, is half of the median at
/// the points; its greatest and mean height, its angle as a whole.
Measured measure_surface(const PointsToMeasure& points, const std::string& column, std::size_t bins);
/// The slopes of that surface longer than 20 a, and the angles of repose left and right of the middle.
Measured measure_repose(const PointsToMeasure& points, const std::string& column, std::size_t bins);
/// Packing fraction at the points (median, 99.9th percentile, largest), and its mean in layers a high.
Measured measure_packing(const PointsToMeasure& points, const std::string& column, std::size_t bins);
/// Mean of a column over each of `bins` layers of equal height between the lowest and the highest point, with the mean
/// height of its points and their number; layers without points are left out.
Measured measure_layers(const PointsToMeasure& points, const std::string& column, std::size_t bins);

struct MeasureEntry {
  std::string_view name, text;
  Measure of;
};

inline constexpr auto measures = std::to_array<MeasureEntry>({
    {"heads", "heads seen from above: grains, width, thickness, concavity of each", measure_heads},
    {"front", "place of the foremost grain, and of the foremost below 2 a", measure_front},
    {"frontal-angle", "angle of the front against the slope, seen from the side", measure_frontal_angle},
    {"head-tail", "thickness of head and rear, seen from the side; their velocities", measure_head_tail},
    {"neighbours", "numbers of neighbours within 4 a, n and n' of Niiya et al. 2020, Eq. 11", measure_neighbours},
    {"repose", "angle of repose: slopes of a heap longer than 20 a, seen along y", measure_repose},
    {"surface", "height of the free surface, seen along y", measure_surface},
    {"packing", "packing fraction at the points, and in layers; spheres of radius a", measure_packing},
    {"layers", "means of a column in horizontal layers, from the lowest point up (--column, --bins)", measure_layers},
    {"histogram", "moments, normality and histogram of a column (--column, --bins)", measure_histogram},
});

/// For a terminal.
std::string to_text(const Measured& measured);
/// {"file", "as", "quantities": {name: {"value", "unit"}}, "table": [{column: value}]}; what is not finite is null.
std::string to_json(const Measured& measured, const std::string& file, std::string_view measure);

}  // namespace talus::app
