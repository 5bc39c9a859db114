// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/convolution.hpp"

#include <algorithm>
#include <utility>

namespace talus::cloud {

namespace {

/// The least even number from `least` on without prime factors above 7.
std::size_t good_size(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

}  // namespace

template <class T, int dimensions>
Convolution<T, dimensions>::Convolution(const SpectralAccuracy& accuracy, Deviations deviations)
    : seam_(static_cast<std::size_t>(accuracy.seam)),
      sources_(dimensions + (deviations.sources ? 1 : 0)),
      results_(dimensions + (deviations.targets ? 1 : 0)),
      spectrum_(accuracy, deviations) {}

/// The correction for the spline is felt a few nodes away: so far its sources, where the sampled tensor has its seam,
/// are kept.
template <class T, int dimensions>
std::size_t Convolution<T, dimensions>::doubled(std::size_t nodes) const {
  return good_size(2 * nodes + seam_);
}

template <class T, int dimensions>
void Convolution<T, dimensions>::prepare(ThreadTeam& team, const NodeCount& count, double mean_size) {
  // A few sizes serve many grids: the room is the transform's.
  NodeCount room = {1, 1, 1};
  for (std::size_t k = 0; k <= last; ++k) room[k] = (doubled(count[k]) - seam_) / 2;
  if (room != count_ || mean_size != mean_size_) {
    count_ = room, mean_size_ = mean_size;
    all_ = {1, 1, 1};
    for (std::size_t k = 0; k <= last; ++k) all_[k] = doubled(count_[k]);
    blocks_ = (all_[0] / 2 + width) / width;
    pitch_ = 2 * width * blocks_;
    fields_ = AlignedArray<T>(std::max(sources_, results_) * field_pitch());
    space_.clear();
    row_forward_ = Transform<T>::to_spectrum(all_[0], fields_.data());
    row_backward_ = Transform<T>::from_spectrum(all_[0], fields_.data());
    for (std::size_t k = 1; k <= last; ++k) {
      const AlignedArray<Complex> from(all_[k] * width), to(all_[k] * width);
      forward_[k] = Transform<T>::of_columns(all_[k], width, from.data(), to.data(), false);
      backward_[k] = Transform<T>::of_columns(all_[k], width, from.data(), to.data(), true);
    }
    spectrum_.sample(team, all_, mean_size);
  }
  team.run(count_[1] * count_[2], [&](std::size_t n) {
    for (std::size_t k = 0; k < std::max(sources_, results_); ++k) std::fill_n(row(k, n), pitch_, T(0));
  });
}

template <class T, int dimensions>
typename Convolution<T, dimensions>::Space Convolution<T, dimensions>::make_space() const {
  const std::size_t fields = std::max(sources_, results_);
  Space made{.slab = AlignedArray<Complex>(fields * slab()),
             .line = AlignedArray<Complex>(fields * all_[2] * width),
             .across = AlignedArray<Complex>(std::max(all_[1], all_[2]) * width),
             .input = {}};
  for (std::size_t k = 1; k <= last; ++k) made.input[k] = AlignedArray<Complex>(all_[k] * width);
  return made;
}

/// Along the last direction. \param at wave numbers along the others
template <class T, int dimensions>
void Convolution<T, dimensions>::multiply_line(std::size_t block, NodeCount at, Complex* line,
                                               std::size_t field) const {
  for (std::size_t n = 0; n < all_[last]; ++n) {
    at[last] = n;
    spectrum_.multiply(block, at, reinterpret_cast<T*>(line + n * width), 2 * field);
  }
}

/// Across the layers, for one row after the other.
template <class T, int dimensions>
void Convolution<T, dimensions>::transform_layers(std::size_t block, const Space& work) const {
  const std::size_t field = all_[2] * width, layer = all_[1] * width;
  Complex *const line = work.line.data(), *const input = work.input[2].data(), *const output = work.across.data();
  for (std::size_t j = 0; j < all_[1]; ++j) {
    for (std::size_t k = 0; k < sources_; ++k) {
      const Complex* const from = work.slab.data() + k * slab() + j * width;
      for (std::size_t l = 0; l < count_[2]; ++l) std::copy_n(from + l * layer, width, input + l * width);
      forward_[2].of_complex(input, line + k * field);
    }
    multiply_line(block, {0, j, 0}, line, field);
    for (std::size_t k = 0; k < results_; ++k) {
      backward_[2].of_complex(line + k * field, output);
      Complex* const to = work.slab.data() + k * slab() + j * width;
      for (std::size_t l = 0; l < count_[2]; ++l) std::copy_n(output + l * width, width, to + l * layer);
    }
  }
}

/// The sources' spectra along the rows, of some columns, become the results' spectra.
template <class T, int dimensions>
void Convolution<T, dimensions>::transform_block(std::size_t block, const Space& work) {
  Complex *const input = work.input[1].data(), *const output = work.across.data();
  const auto columns = [&](std::size_t k, std::size_t l) {
    return work.slab.data() + k * slab() + l * all_[1] * width;
  };
  const auto part_of_row = [&](std::size_t k, std::size_t l, std::size_t j) {
    return reinterpret_cast<Complex*>(row(k, l * count_[1] + j)) + block * width;
  };
  for (std::size_t k = 0; k < sources_; ++k)
    for (std::size_t l = 0; l < count_[2]; ++l) {
      for (std::size_t j = 0; j < count_[1]; ++j) std::copy_n(part_of_row(k, l, j), width, input + j * width);
      forward_[1].of_complex(input, columns(k, l));
    }
  if constexpr (dimensions == 2)
    multiply_line(block, {}, work.slab.data(), slab());
  else
    transform_layers(block, work);
  for (std::size_t k = 0; k < results_; ++k)
    for (std::size_t l = 0; l < count_[2]; ++l) {
      backward_[1].of_complex(columns(k, l), output);
      for (std::size_t j = 0; j < count_[1]; ++j) std::copy_n(output + j * width, width, part_of_row(k, l, j));
    }
}

template <class T, int dimensions>
void Convolution<T, dimensions>::apply(ThreadTeam& team) {
  const std::size_t rows = count_[1] * count_[2];
  team.run(rows, [&](std::size_t n) {
    for (std::size_t k = 0; k < sources_; ++k) row_forward_.to_complex(row(k, n));
  });
  // Blocks of columns do not know of each other: what a task takes does not change a bit.
  const std::size_t tasks = std::min<std::size_t>(blocks_, 4 * static_cast<std::size_t>(team.size()));
  while (space_.size() < tasks) space_.push_back(make_space());
  team.run(tasks, [&](std::size_t task) {
    for (std::size_t block = task; block < blocks_; block += tasks) transform_block(block, space_[task]);
  });
  team.run(rows, [&](std::size_t n) {
    for (std::size_t k = 0; k < results_; ++k) row_backward_.to_real(row(k, n));
  });
}

template class Convolution<float, 2>;
template class Convolution<float, 3>;
template class Convolution<double, 2>;
template class Convolution<double, 3>;

}  // namespace talus::cloud
