// SPDX-License-Identifier: Apache-2.0
/// The smooth part of the tensor on a grid in the plane or in space: sources on its nodes in, velocities at its nodes
/// out, by transforms of twice its size that leave no images (Hockney & Eastwood 1981, section 6-5).
///
/// Sources are the components of the forces. Where the spheres' sizes differ, the tensor has the mean size s, and what
/// the deviation ds of a sphere adds, -ds grad grad h . f, goes by a scalar: as a source f ds . grad of a point, of
/// which the velocity is the field of grad h; as a target the velocity -ds grad of the scalar grad h . f. Exact for the
/// source, for the target or for both.
#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "base/parallel.hpp"
#include "models/cloud/spectral_sum/accuracy.hpp"

namespace talus::cloud {

/// Which spheres' deviations of size are to be carried.
struct Deviations {
  bool sources = false, targets = false;
};

template <class T, int dimensions>
class Convolution {
 public:
  Convolution(const SpectralAccuracy& accuracy, Deviations deviations);
  ~Convolution();
  Convolution(Convolution&&) noexcept;
  Convolution& operator=(Convolution&&) noexcept;

  /// Makes room for a grid and sets its sources to 0. Transforms and the tensor's spectrum are kept while they fit.
  /// \param count of nodes along each direction, 1 along the third in a plane
  /// \param mean_size s, in units of the square of the cut-off
  void prepare(ThreadTeam& team, const std::array<std::size_t, 3>& count, double mean_size);

  /// The fields, `field_pitch()` numbers apart, their layers, `layer_pitch()` apart, and rows, `pitch()` apart: before
  /// `apply` of the sources (first forces over 8 pi mu times the cut-off, then the deviations' scalar), after it of the
  /// results (velocities, then the scalar for targets).
  T* fields();
  const T* fields() const;
  std::size_t field_pitch() const;
  std::size_t layer_pitch() const;
  std::size_t pitch() const;

  void apply(ThreadTeam& team);

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace talus::cloud
