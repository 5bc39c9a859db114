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
#include <complex>
#include <cstddef>
#include <vector>

#include "base/parallel.hpp"
#include "models/cloud/spectral_sum/fourier.hpp"
#include "models/cloud/spectral_sum/spectrum.hpp"

namespace talus::cloud {

template <class T, int dimensions>
class Convolution {
 public:
  Convolution(const SpectralAccuracy& accuracy, Deviations deviations);

  /// Makes room for a grid and sets its sources to 0. Transforms and the tensor's spectrum are kept while they fit.
  /// \param count of nodes along each direction, 1 along the third in a plane
  /// \param mean_size s, in units of the square of the cut-off
  void prepare(ThreadTeam& team, const NodeCount& count, double mean_size);

  /// The fields, `field_pitch()` numbers apart, their layers, `layer_pitch()` apart, and rows, `pitch()` apart: before
  /// `apply` of the sources (first forces over 8 pi mu times the cut-off, then the deviations' scalar), after it of the
  /// results (velocities, then the scalar for targets).
  T* fields() { return fields_.data(); }
  const T* fields() const { return fields_.data(); }
  std::size_t field_pitch() const { return count_[2] * layer_pitch(); }
  std::size_t layer_pitch() const { return count_[1] * pitch_; }
  std::size_t pitch() const { return pitch_; }

  void apply(ThreadTeam& team);

 private:
  using Complex = std::complex<T>;
  static constexpr std::size_t width = TensorSpectrum<T, dimensions>::width;
  static constexpr std::size_t last = dimensions - 1;  // the direction that is transformed last

  /// What a block of columns is transformed in. Inputs of transforms along a direction are 0 beyond the nodes in use.
  struct Space {
    AlignedArray<Complex> slab, line, across;  // of all fields; of all fields along the layers; output of one transform
    std::array<AlignedArray<Complex>, 3> input;
  };

  std::size_t doubled(std::size_t nodes) const;
  std::size_t slab() const { return count_[2] * all_[1] * width; }  // numbers of a field in a block of columns
  T* row(std::size_t field, std::size_t n) { return fields() + field * field_pitch() + n * pitch_; }
  Space make_space() const;
  void transform_block(std::size_t block, const Space& work);
  void transform_layers(std::size_t block, const Space& work) const;
  void multiply_line(std::size_t block, NodeCount at, Complex* line, std::size_t field) const;

  std::size_t seam_, sources_, results_;  // sources and results: numbers of fields
  TensorSpectrum<T, dimensions> spectrum_;
  double mean_size_ = -1;
  NodeCount count_ = {}, all_ = {};  // of the nodes that are in use, and of the doubled grid
  std::size_t pitch_ = 0, blocks_ = 0;
  AlignedArray<T> fields_;
  std::vector<Space> space_;
  Transform<T> row_forward_, row_backward_;
  std::array<Transform<T>, 3> forward_, backward_;  // across rows and layers
};

}  // namespace talus::cloud
