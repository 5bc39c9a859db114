// SPDX-License-Identifier: Apache-2.0
/// The spectrum of the smooth part of the tensor on the doubled grid of a convolution.
#pragma once

#include <array>
#include <cstddef>
#include <functional>

#include "base/parallel.hpp"
#include "models/cloud/spectral_sum.hpp"
#include "models/cloud/spectral_sum/fourier.hpp"
#include "models/cloud/spectral_sum/split.hpp"

namespace talus::cloud {

/// Of a grid, along each direction.
using NodeCount = std::array<std::size_t, 3>;

/// Which spheres' deviations of size are to be carried (convolution.hpp).
struct Deviations {
  bool sources = false, targets = false;
};

/// The tensor is symmetric, and each part of it even or odd along each direction: the wave numbers without a negative
/// component, a quarter or an octant of all, hold it. Stored are real numbers: what is odd along a single direction,
/// the gradient of h, lacks its factor -i.
template <class T, int dimensions>
class TensorSpectrum {
 public:
  static constexpr std::size_t width = 8;  ///< wave numbers along the first direction that are handled together

  TensorSpectrum(const SpectralAccuracy& accuracy, Deviations deviations);

  /// \param all nodes of the doubled grid, even; 1 along the third direction in a plane
  /// \param mean_size s, in units of the square of the cut-off
  void sample(ThreadTeam& team, const NodeCount& all, double mean_size);

  /// At the wave numbers `block` times the width and on along the first direction, and `at` along the others, the
  /// sources' spectra become the results' spectra, both in the order of Convolution::fields.
  /// \param at of the doubled grid; those beyond the middle are negative
  /// \param spectra complex numbers, real and imaginary parts alternating; \param field numbers from one source to the
  /// next
  void multiply(std::size_t block, const NodeCount& at, T* spectra, std::size_t field) const;

 private:
  using Place = std::array<double, 3>;
  static constexpr std::size_t parts = dimensions * (dimensions + 1) / 2, all_parts = parts + dimensions;
  static constexpr std::size_t part(std::size_t k, std::size_t l);

  std::size_t offset(std::size_t block, std::size_t j, std::size_t l) const;
  void fill(ThreadTeam& team, std::size_t number, const std::array<bool, 3>& odd,
            const std::function<double(const Place&)>& kernel);

  SpectralAccuracy accuracy_;
  Deviations deviations_;
  Split split_;
  NodeCount all_ = {};
  std::size_t blocks_ = 0;
  AlignedArray<T> table_;  // for each block and wave number across: xx, xy, (xz,) yy ... and grad h
};

}  // namespace talus::cloud
