// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/convolution.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "models/cloud/spectral_sum/fourier.hpp"
#include "models/cloud/spectral_sum/spline.hpp"
#include "models/cloud/spectral_sum/split.hpp"

namespace talus::cloud {

namespace {

using Count = std::array<std::size_t, 3>;

constexpr std::size_t width = 8;  // columns transformed together

/// The least even number from `least` on without prime factors above 7.
std::size_t good_size(std::size_t least) {
  for (std::size_t n = least + least % 2;; n += 2) {
    std::size_t rest = n;
    for (const std::size_t prime : {2, 3, 5, 7})
      while (rest % prime == 0) rest /= prime;
    if (rest == 1) return n;
  }
}

/// Of the spectrum of a symmetric tensor, xx, xy, (xz,) yy ..., and after it of grad h: one at some place, `width`
/// numbers each.
constexpr std::size_t tensor_parts(std::size_t dimensions) {
  return dimensions * (dimensions + 1) / 2;
}
constexpr std::size_t tables(std::size_t dimensions) {
  return tensor_parts(dimensions) + dimensions;
}
constexpr std::size_t part(std::size_t dimensions, std::size_t k, std::size_t l) {
  const std::size_t low = k < l ? k : l, high = k < l ? l : k;
  return low * dimensions - low * (low + 1) / 2 + high;
}

/// At `width` wave numbers the sources' spectra become those of the results.
/// \param g parts of the table there; \param sign -1 along directions in which it is of the mirrored wave number
/// \param field numbers between the spectra of one source and the next
template <class T, std::size_t dimensions>
void multiply(const T* g, const std::array<T, dimensions>& sign, const Deviations& deviations, T* spectra,
              std::size_t field) {
  for (std::size_t b = 0; b < width; ++b) {
    T re[dimensions], im[dimensions], out[2][dimensions];
    for (std::size_t k = 0; k < dimensions; ++k)
      re[k] = spectra[k * field + 2 * b], im[k] = spectra[k * field + 2 * b + 1];
    for (std::size_t k = 0; k < dimensions; ++k) {
      const T first = sign[0] * sign[k] * g[part(dimensions, k, 0) * width + b];
      out[0][k] = first * re[0], out[1][k] = first * im[0];
      for (std::size_t l = 1; l < dimensions; ++l) {
        const T factor = sign[k] * sign[l] * g[part(dimensions, k, l) * width + b];
        out[0][k] += factor * re[l], out[1][k] += factor * im[l];
      }
    }
    if (deviations.sources || deviations.targets) {
      T* const scalar = spectra + dimensions * field + 2 * b;
      const T scalar_re = scalar[0], scalar_im = scalar[1];
      T sum_re = 0, sum_im = 0;
      for (std::size_t k = 0; k < dimensions; ++k) {
        const T gradient = sign[k] * g[(tensor_parts(dimensions) + k) * width + b];  // times -i
        if (deviations.sources) out[0][k] += gradient * scalar_im, out[1][k] -= gradient * scalar_re;
        sum_re += gradient * im[k], sum_im += gradient * re[k];
      }
      if (deviations.targets) scalar[0] = sum_re, scalar[1] = -sum_im;
    }
    for (std::size_t k = 0; k < dimensions; ++k)
      spectra[k * field + 2 * b] = out[0][k], spectra[k * field + 2 * b + 1] = out[1][k];
  }
}

}  // namespace

template <class T, int dimensions>
struct Convolution<T, dimensions>::Grid {
  using Complex = std::complex<T>;
  static constexpr std::size_t last = dimensions - 1;  // the direction that is transformed last

  /// What a block of columns is transformed in. Inputs of transforms along a direction are 0 beyond the nodes in use.
  struct Space {
    AlignedArray<Complex> slab, line, across;  ///< of all fields; of all fields in a line of layers; output of one line
    std::array<AlignedArray<Complex>, 3> input;
  };

  SpectralAccuracy accuracy;
  Deviations deviations;
  Split split;
  double mean_size = -1;
  Count count = {}, all = {};  // of the nodes that are in use, and of the doubled grid
  std::size_t pitch = 0, blocks = 0;
  AlignedArray<T> fields, table;
  std::vector<Space> space;
  Transform<T> row_forward, row_backward;
  std::array<Transform<T>, 3> forward, backward;  // across rows and layers

  Grid(const SpectralAccuracy& accuracy_, Deviations deviations_)
      : accuracy(accuracy_), deviations(deviations_), split(accuracy_.beta, accuracy_.order) {}

  std::size_t sources() const { return dimensions + (deviations.sources ? 1 : 0); }
  std::size_t results() const { return dimensions + (deviations.targets ? 1 : 0); }
  std::size_t field_count() const { return std::max(sources(), results()); }
  std::size_t rows() const { return count[1] * count[2]; }
  T* row(std::size_t field, std::size_t n) { return fields.data() + (field * rows() + n) * pitch; }
  const T* parts_at(std::size_t block, const Count& k) const {
    return table.data() + ((block * (all[1] / 2 + 1) + k[1]) * (all[2] / 2 + 1) + k[2]) * tables(dimensions) * width;
  }
  // The correction for the spline is felt a few nodes away: so far its sources, where the sampled kernel has its seam,
  // are kept.
  std::size_t seam() const { return static_cast<std::size_t>(accuracy.seam); }
  std::size_t doubled(std::size_t nodes) const { return good_size(2 * nodes + seam()); }
  std::size_t slab() const { return count[2] * all[1] * width; }  // numbers of a field in a block of columns

  void set_size();
  void sample(ThreadTeam& team);
  void fill_table(ThreadTeam& team, std::size_t number, const std::array<bool, 3>& odd,
                  const std::function<double(const std::array<double, 3>&)>& kernel);
  void make_space();
  void transform_block(std::size_t block, const Space& work);
  void transform_layers(std::size_t block, const Space& work) const;
  void multiply_line(std::size_t block, Count at, T sign, Complex* line, std::size_t field) const;
};

template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::set_size() {
  all = {1, 1, 1};
  for (std::size_t k = 0; k <= last; ++k) all[k] = doubled(count[k]);
  blocks = (all[0] / 2 + width) / width;
  pitch = 2 * width * blocks;
  fields = AlignedArray<T>(field_count() * rows() * pitch);
  table = AlignedArray<T>(blocks * (all[1] / 2 + 1) * (all[2] / 2 + 1) * tables(dimensions) * width);
  space.clear();
  row_forward = Transform<T>::to_spectrum(all[0], fields.data());
  row_backward = Transform<T>::from_spectrum(all[0], fields.data());
  for (std::size_t k = 1; k <= last; ++k) {
    const AlignedArray<Complex> from(all[k] * width), to(all[k] * width);
    forward[k] = Transform<T>::of_columns(all[k], width, from.data(), to.data(), false);
    backward[k] = Transform<T>::of_columns(all[k], width, from.data(), to.data(), true);
  }
}

/// Samples a kernel where no coordinate on the doubled grid is negative, transforms it and stores it, corrected for the
/// spline and scaled. \param odd whether it changes its sign with a coordinate; it is even otherwise
template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::fill_table(ThreadTeam& team, std::size_t number, const std::array<bool, 3>& odd,
                                                  const std::function<double(const std::array<double, 3>&)>& kernel) {
  Count half{}, first{}, some{};
  std::array<std::vector<double>, 3> correction;
  for (std::size_t k = 0; k < 3; ++k) {
    half[k] = all[k] / 2, first[k] = odd[k] ? 1 : 0;
    some[k] = half[k] + 1 - 2 * first[k];
    correction[k].assign(half[k] + 1, 1.0);
    const auto size = static_cast<double>(all[k]);
    for (std::size_t n = 0; n <= half[k] && k <= last; ++n)
      correction[k][n] = spline_correction(2 * std::numbers::pi * static_cast<double>(n) / size, accuracy.points);
  }
  AlignedArray<double> samples(some[0] * some[1] * some[2]);
  const double spacing = 1.0 / accuracy.nodes;
  team.run(some[1] * some[2], [&](std::size_t row) {
    const std::size_t j = row % some[1], l = row / some[1];
    for (std::size_t i = 0; i < some[0]; ++i)
      samples[row * some[0] + i] =
          kernel({static_cast<double>(i + first[0]) * spacing, static_cast<double>(j + first[1]) * spacing,
                  static_cast<double>(l + first[2]) * spacing});
  });
  transform_part(samples.data(), some, odd);
  const double nodes = static_cast<double>(all[0]) * static_cast<double>(all[1]) * static_cast<double>(all[2]);
  // Each odd direction gives -i; a single one is left to `multiply`.
  const double sign = odd[0] + odd[1] + odd[2] == 2 ? -1 : 1;
  team.run((half[1] + 1) * (half[2] + 1), [&](std::size_t row) {
    const std::size_t j = row % (half[1] + 1), l = row / (half[1] + 1);
    const double along = sign * correction[1][j] * correction[2][l];
    const bool in = j >= first[1] && j - first[1] < some[1] && l >= first[2] && l - first[2] < some[2];
    for (std::size_t i = 0; i < blocks * width; ++i) {
      const bool inside = in && i >= first[0] && i - first[0] < some[0];
      const double value =
          inside ? samples[((l - first[2]) * some[1] + j - first[1]) * some[0] + (i - first[0])] *
                       (correction[0][i] / nodes) * along
                 : 0.0;
      const_cast<T*>(parts_at(i / width, {0, j, l}))[number * width + i % width] = static_cast<T>(value);
    }
  });
}

template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::sample(ThreadTeam& team) {
  using Place = std::array<double, 3>;
  const auto distance = [](const Place& x) { return std::hypot(std::hypot(x[0], x[1]), x[2]); };
  for (std::size_t k = 0; k <= last; ++k) {
    for (std::size_t l = k; l <= last; ++l) {
      std::array<bool, 3> odd{};
      if (k != l) odd[k] = odd[l] = true;
      fill_table(team, part(dimensions, k, l), odd, [&](const Place& x) {
        const double r = distance(x);
        const auto s = split.stokeslet(r), d = split.dipole(r);
        const double radial = x[k] * x[l] * (s.radial + mean_size * d.radial);
        return k == l ? s.isotropic + mean_size * d.isotropic + radial : radial;
      });
    }
    if (field_count() == dimensions) continue;
    std::array<bool, 3> odd{};
    odd[k] = true;
    fill_table(team, tensor_parts(dimensions) + k, odd,
               [&](const Place& x) { return -x[k] * split.dipole(distance(x)).isotropic; });
  }
}

/// Along the last direction. \param at wave numbers along the others; \param sign of what is odd along the rows
template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::multiply_line(std::size_t block, Count at, T sign, Complex* line,
                                                     std::size_t field) const {
  std::array<T, dimensions> signs{};
  signs[0] = 1, signs[1] = sign;
  for (std::size_t n = 0; n < all[last]; ++n) {
    const bool mirrored = n > all[last] / 2;
    at[last] = mirrored ? all[last] - n : n;
    signs[last] = mirrored ? T(-1) : T(1);
    multiply<T, dimensions>(parts_at(block, at), signs, deviations, reinterpret_cast<T*>(line + n * width), 2 * field);
  }
}

template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::make_space() {
  Space& made = space.emplace_back();
  made.slab = AlignedArray<Complex>(field_count() * slab());
  made.line = AlignedArray<Complex>(field_count() * all[2] * width);
  made.across = AlignedArray<Complex>(std::max(all[1], all[2]) * width);
  for (std::size_t k = 1; k <= last; ++k) made.input[k] = AlignedArray<Complex>(all[k] * width);
}

/// Across the layers, for one row after the other.
template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::transform_layers(std::size_t block, const Space& work) const {
  const std::size_t field = all[2] * width, layer = all[1] * width;
  Complex *const line = work.line.data(), *const input = work.input[2].data(), *const output = work.across.data();
  for (std::size_t j = 0; j < all[1]; ++j) {
    for (std::size_t k = 0; k < sources(); ++k) {
      const Complex* const from = work.slab.data() + k * slab() + j * width;
      for (std::size_t l = 0; l < count[2]; ++l) std::copy_n(from + l * layer, width, input + l * width);
      forward[2].of_complex(input, line + k * field);
    }
    const bool mirrored = j > all[1] / 2;
    multiply_line(block, {0, mirrored ? all[1] - j : j, 0}, mirrored ? T(-1) : T(1), line, field);
    for (std::size_t k = 0; k < results(); ++k) {
      backward[2].of_complex(line + k * field, output);
      Complex* const to = work.slab.data() + k * slab() + j * width;
      for (std::size_t l = 0; l < count[2]; ++l) std::copy_n(output + l * width, width, to + l * layer);
    }
  }
}

/// The sources' spectra along the rows, of some columns, become those of the results.
template <class T, int dimensions>
void Convolution<T, dimensions>::Grid::transform_block(std::size_t block, const Space& work) {
  Complex *const input = work.input[1].data(), *const output = work.across.data();
  const auto columns = [&](std::size_t k, std::size_t l) { return work.slab.data() + k * slab() + l * all[1] * width; };
  const auto part_of_row = [&](std::size_t k, std::size_t l, std::size_t j) {
    return reinterpret_cast<Complex*>(row(k, l * count[1] + j)) + block * width;
  };
  for (std::size_t k = 0; k < sources(); ++k)
    for (std::size_t l = 0; l < count[2]; ++l) {
      for (std::size_t j = 0; j < count[1]; ++j) std::copy_n(part_of_row(k, l, j), width, input + j * width);
      forward[1].of_complex(input, columns(k, l));
    }
  if constexpr (dimensions == 2)
    multiply_line(block, {}, 1, work.slab.data(), slab());
  else
    transform_layers(block, work);
  for (std::size_t k = 0; k < results(); ++k)
    for (std::size_t l = 0; l < count[2]; ++l) {
      backward[1].of_complex(columns(k, l), output);
      for (std::size_t j = 0; j < count[1]; ++j) std::copy_n(output + j * width, width, part_of_row(k, l, j));
    }
}

template <class T, int dimensions>
Convolution<T, dimensions>::Convolution(const SpectralAccuracy& accuracy, Deviations deviations)
    : grid_(std::make_unique<Grid>(accuracy, deviations)) {}
template <class T, int dimensions>
Convolution<T, dimensions>::~Convolution() = default;
template <class T, int dimensions>
Convolution<T, dimensions>::Convolution(Convolution&&) noexcept = default;
template <class T, int dimensions>
Convolution<T, dimensions>& Convolution<T, dimensions>::operator=(Convolution&&) noexcept = default;

template <class T, int dimensions>
T* Convolution<T, dimensions>::fields() {
  return grid_->fields.data();
}

template <class T, int dimensions>
const T* Convolution<T, dimensions>::fields() const {
  return grid_->fields.data();
}

template <class T, int dimensions>
std::size_t Convolution<T, dimensions>::field_pitch() const {
  return grid_->rows() * grid_->pitch;
}

template <class T, int dimensions>
std::size_t Convolution<T, dimensions>::pitch() const {
  return grid_->pitch;
}

template <class T, int dimensions>
std::size_t Convolution<T, dimensions>::layer_pitch() const {
  return grid_->count[1] * grid_->pitch;
}

template <class T, int dimensions>
void Convolution<T, dimensions>::prepare(ThreadTeam& team, const Count& count, double mean_size) {
  Grid& g = *grid_;
  // A few sizes serve many grids: the room is that of the transform.
  Count room = {1, 1, 1};
  for (std::size_t k = 0; k <= Grid::last; ++k)
    room[k] = (g.doubled(count[k]) - g.seam()) / 2;
  if (room != g.count || mean_size != g.mean_size) {
    g.count = room, g.mean_size = mean_size;
    g.set_size();
    g.sample(team);
  }
  team.run(g.rows(), [&](std::size_t n) {
    for (std::size_t k = 0; k < g.field_count(); ++k) std::fill_n(g.row(k, n), g.pitch, T(0));
  });
}

template <class T, int dimensions>
void Convolution<T, dimensions>::apply(ThreadTeam& team) {
  Grid& g = *grid_;
  team.run(g.rows(), [&](std::size_t n) {
    for (std::size_t k = 0; k < g.sources(); ++k) g.row_forward.to_complex(g.row(k, n));
  });
  // Blocks of columns do not know of each other: what a task takes does not change a bit.
  const std::size_t tasks = std::min<std::size_t>(g.blocks, 4 * static_cast<std::size_t>(team.size()));
  while (g.space.size() < tasks) g.make_space();
  team.run(tasks, [&](std::size_t task) {
    for (std::size_t block = task; block < g.blocks; block += tasks) g.transform_block(block, g.space[task]);
  });
  team.run(g.rows(), [&](std::size_t n) {
    for (std::size_t k = 0; k < g.results(); ++k) g.row_backward.to_real(g.row(k, n));
  });
}

template class Convolution<float, 2>;
template class Convolution<float, 3>;
template class Convolution<double, 2>;
template class Convolution<double, 3>;

}  // namespace talus::cloud
