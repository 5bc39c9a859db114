// SPDX-License-Identifier: Apache-2.0
/// One material point led through a path of deformations by a constitutive law: a test in a cell, no flow around it.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <vector>

#include "base/tensor.hpp"
#include "physics/granular/law.hpp"

namespace talus::granular {

/// A stretch of a path: a constant velocity gradient for a time, but for components that follow from a stress.
struct PathStretch {
  double duration;              ///< s, >= 0
  Tensor3<> velocity_gradient;  ///< 1/s, L_ij = du_i/dx_j; L_zz < 0 compresses along z
  /// Components xx, yy, zz and zx of the stress at the end of the stretch, which they approach evenly from that at its
  /// start, Pa; each in place of L_xx, L_yy, L_zz or L_xz, which are found step by step.
  std::array<std::optional<double>, 4> stress = {};

  bool is_controlled() const { return stress[0] || stress[1] || stress[2] || stress[3]; }
};

struct PathOptions {
  double density = 1500;        ///< kg/m^3, at the start, where there is no stress
  double max_increment = 1e-6;  ///< of the strain within a step; a thousand times that of the angle of rotation
  int points = 100;             ///< recorded a stretch, at equal times, the end of the stretch being the last
};

struct PathPoint {
  double time;                       ///< s
  double density;                    ///< kg/m^3
  SymmetricTensor3<> strain;         ///< Almansi strain since the start, compression positive; not the law's own memory
  SymmetricTensor3<> stress;         ///< Pa, strain-rate independent part, compression positive
  std::vector<double> history;       ///< in the order of history_of(law)
  Tensor3<> velocity_gradient = {};  ///< 1/s, mean since the last recorded point
};

/// Steps that a path takes: as many as keep each below the largest increment.
double steps_of_path(std::span<const PathStretch> path, const PathOptions& options);

/// What a law remembers, in the order of PathPoint::history.
std::vector<HistorySlot> history_of(const AnyLaw& law);

/// Leads a new point through the stretches one after the other. The density follows the velocity gradient exactly.
/// \returns the start and `points` points a stretch
/// \throws std::invalid_argument for a density, an increment or a number of points that is not positive, or a duration
/// that
///         is negative or not finite
/// \throws NumericalError if the law has no rate of deformation under which the stress of a stretch is borne
std::vector<PathPoint> follow_path(const AnyLaw& law, std::span<const PathStretch> path,
                                   const PathOptions& options = {});

/// The same from a point on, as a path left it. \pre the law's strain is not that of displacements
std::vector<PathPoint> follow_path(const AnyLaw& law, const PathPoint& from, std::span<const PathStretch> path,
                                   const PathOptions& options = {});

/// Work done on the particle over its volume at the start, J/m^3, by the trapezoidal rule over the recorded points: the
/// sum of tau : (-D) V/V_0 dt. A closed path with negative work is a source of energy. \param path, points as given to
/// and returned by follow_path
double work_of_path(std::span<const PathStretch> path, std::span<const PathPoint> points);

}  // namespace talus::granular
