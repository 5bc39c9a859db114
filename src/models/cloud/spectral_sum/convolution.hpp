// SPDX-License-Identifier: Apache-2.0
/// The smooth part of the tensor on a grid in the plane: sources on its nodes in, velocities at its nodes out, by
/// transforms of twice its size that leave no images (Hockney & Eastwood 1981, section 6-5).
///
/// Two sources are forces. Where the spheres' sizes differ, the tensor has the mean size s, and what the deviation ds
/// of a sphere adds, -ds grad grad h . f, goes by a scalar: as a source f ds . grad of a point, of which the velocity
/// is the field of grad h; as a target the velocity -ds grad of the scalar grad h . f. Exact for the source, for the
/// target or for both.
#pragma once

#include <cstddef>
#include <memory>

#include "base/parallel.hpp"
#include "models/cloud/spectral_sum/accuracy.hpp"

namespace talus::cloud {

/// Which spheres' deviations of size are to be carried.
struct Deviations {
  bool sources = false, targets = false;
};

template <class T>
class Convolution {
 public:
  Convolution(const SpectralAccuracy& accuracy, Deviations deviations);
  ~Convolution();
  Convolution(Convolution&&) noexcept;
  Convolution& operator=(Convolution&&) noexcept;

  /// Makes room for a grid and sets its sources to 0. Transforms and the tensor's spectrum are kept while they fit.
  /// \param mean_size s, in units of the square of the cut-off
  void prepare(ThreadTeam& team, std::size_t columns, std::size_t rows, double mean_size);

  /// The grid's rows, `pitch()` numbers apart: before `apply` of the sources (0 and 1 forces over 8 pi mu times the
  /// cut-off, 2 the deviations' scalar), after it of the results (0 and 1 velocities, 2 the scalar for targets).
  T* field(int number);
  const T* field(int number) const;
  std::size_t pitch() const;

  void apply(ThreadTeam& team);

  /// Memory of a grid, bytes.
  static double bytes(const SpectralAccuracy& accuracy, double columns, double rows);

 private:
  struct Grid;
  std::unique_ptr<Grid> grid_;
};

}  // namespace talus::cloud
