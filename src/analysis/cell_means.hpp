// SPDX-License-Identifier: Apache-2.0
/// Fields of grains on a grid: means of the particles in cells, and their means and deviations over snapshots.
#pragma once

#include <array>
#include <vector>

#include "base/vector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

/// A grid of cubes over a box.
struct CellBox {
  Vector3 low;
  double cell = 0;             ///< edge, m
  std::array<int, 3> count{};  ///< at least one along each axis
};
/// \param low, high corners of the box, m \param cell > 0, m
CellBox cells_over(const Vector3& low, const Vector3& high, double cell);

class CellMeans {
 public:
  /// \param diameter of the grains, m; grain_density kg/m^3: for inertial numbers
  CellMeans(const CellBox& box, double diameter, double grain_density);

  /// \param snapshot with the columns position, velocity, packing, shear_rate, stress_xx to stress_zx
  void take(const Snapshot& snapshot);

  int snapshots() const { return taken_; }

  /// For every column of the cells NAME its mean over the snapshots that have particles there, and NAME_deviation, the
  /// standard deviation of the snapshots' values (0 of one): velocity (m/s, its deviation of the size of the
  /// difference), packing, pressure (Pa, a third of the trace), shear_stress (Pa, the root of half of the deviator
  /// squared), inertial_number (of the cell's mean shear rate and pressure; 0 without pressure). "filled": share of the
  /// snapshots with particles there. 0 where there are none. \param time that the file names, s
  GridSnapshot result(double time) const;

 private:
  static constexpr std::size_t numbers = 4;
  struct Sum {
    double count = 0;  // of snapshots
    Vector3 velocity;
    double velocity_squared = 0;
    std::array<double, numbers> value{}, squared{};
  };
  CellBox box_;
  double diameter_, grain_density_;
  int taken_ = 0;
  std::vector<Sum> sums_;
};

}  // namespace talus
