// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

#include "models/cloud/spectral_sum/spline.hpp"

namespace talus::cloud {

template <class T, int dimensions>
TensorSpectrum<T, dimensions>::TensorSpectrum(const SpectralAccuracy& accuracy, Deviations deviations)
    : accuracy_(accuracy), deviations_(deviations), split_(accuracy.beta, accuracy.order) {}

/// Where the component kl is among the parts.
template <class T, int dimensions>
constexpr std::size_t TensorSpectrum<T, dimensions>::part(std::size_t k, std::size_t l) {
  const std::size_t low = k < l ? k : l, high = k < l ? l : k;
  return low * dimensions - low * (low + 1) / 2 + high;
}

template <class T, int dimensions>
std::size_t TensorSpectrum<T, dimensions>::offset(std::size_t block, std::size_t j, std::size_t l) const {
  return ((block * (all_[1] / 2 + 1) + j) * (all_[2] / 2 + 1) + l) * all_parts * width;
}

/// Samples a kernel where no coordinate on the doubled grid is negative, transforms it and stores it, corrected for the
/// spline and scaled. \param odd whether it changes its sign with a coordinate; it is even otherwise
template <class T, int dimensions>
void TensorSpectrum<T, dimensions>::fill(ThreadTeam& team, std::size_t number, const std::array<bool, 3>& odd,
                                         const std::function<double(const Place&)>& kernel) {
  NodeCount half{}, first{}, count{};
  std::array<std::vector<double>, 3> correction;
  double nodes = 1;
  for (std::size_t k = 0; k < 3; ++k) {
    half[k] = all_[k] / 2, first[k] = odd[k] ? 1 : 0;
    count[k] = half[k] + 1 - 2 * first[k];
    correction[k].assign(half[k] + 1, 1.0);
    const auto size = static_cast<double>(all_[k]);
    nodes *= size;
    for (std::size_t n = 0; n <= half[k] && k < dimensions; ++n)
      correction[k][n] = spline_correction(2 * std::numbers::pi * static_cast<double>(n) / size, accuracy_.points);
  }
  AlignedArray<double> samples(count[0] * count[1] * count[2]);
  const double spacing = 1.0 / accuracy_.nodes;
  team.run(count[1] * count[2], [&](std::size_t row) {
    const std::size_t j = row % count[1] + first[1], l = row / count[1] + first[2];
    for (std::size_t i = 0; i < count[0]; ++i)
      samples[row * count[0] + i] = kernel({static_cast<double>(i + first[0]) * spacing,
                                            static_cast<double>(j) * spacing, static_cast<double>(l) * spacing});
  });
  transform_part(samples.data(), count, odd);
  const double sign = odd[0] + odd[1] + odd[2] == 2 ? -1 : 1;  // two odd directions: (-i)^2
  team.run((half[1] + 1) * (half[2] + 1), [&](std::size_t row) {
    const std::size_t j = row % (half[1] + 1), l = row / (half[1] + 1);
    const double across = sign * correction[1][j] * correction[2][l];
    const bool in = j >= first[1] && j - first[1] < count[1] && l >= first[2] && l - first[2] < count[2];
    for (std::size_t i = 0; i < blocks_ * width; ++i) {
      double value = 0;
      if (in && i >= first[0] && i - first[0] < count[0])
        value = samples[((l - first[2]) * count[1] + j - first[1]) * count[0] + i - first[0]] *
                (correction[0][i] / nodes) * across;
      table_[offset(i / width, j, l) + number * width + i % width] = static_cast<T>(value);
    }
  });
}

template <class T, int dimensions>
void TensorSpectrum<T, dimensions>::sample(ThreadTeam& team, const NodeCount& all, double mean_size) {
  all_ = all;
  blocks_ = (all[0] / 2 + width) / width;
  table_ = AlignedArray<T>(blocks_ * (all[1] / 2 + 1) * (all[2] / 2 + 1) * all_parts * width);
  const auto distance = [](const Place& x) { return std::hypot(std::hypot(x[0], x[1]), x[2]); };
  for (std::size_t k = 0; k < dimensions; ++k) {
    for (std::size_t l = k; l < dimensions; ++l) {
      std::array<bool, 3> odd{};
      odd[k] = odd[l] = k != l;
      fill(team, part(k, l), odd, [&](const Place& x) {
        const double r = distance(x);
        const auto s = split_.stokeslet(r), d = split_.dipole(r);
        const double radial = x[k] * x[l] * (s.radial + mean_size * d.radial);
        return k == l ? s.isotropic + mean_size * d.isotropic + radial : radial;
      });
    }
    if (!deviations_.sources && !deviations_.targets) continue;
    std::array<bool, 3> odd{};
    odd[k] = true;
    fill(team, parts + k, odd, [&](const Place& x) { return -x[k] * split_.dipole(distance(x)).isotropic; });
  }
}

template <class T, int dimensions>
void TensorSpectrum<T, dimensions>::multiply(std::size_t block, const NodeCount& at, T* spectra,
                                             std::size_t field) const {
  NodeCount folded{};
  T sign[dimensions] = {1};
  for (std::size_t k = 1; k < dimensions; ++k) {
    const bool negative = at[k] > all_[k] / 2;
    folded[k] = negative ? all_[k] - at[k] : at[k];
    sign[k] = negative ? T(-1) : T(1);
  }
  const T* const g = table_.data() + offset(block, folded[1], folded[2]);
  for (std::size_t b = 0; b < width; ++b) {
    T re[dimensions], im[dimensions], out_re[dimensions], out_im[dimensions];
    for (std::size_t k = 0; k < dimensions; ++k)
      re[k] = spectra[k * field + 2 * b], im[k] = spectra[k * field + 2 * b + 1];
    for (std::size_t k = 0; k < dimensions; ++k) {
      const T first = sign[k] * g[part(k, 0) * width + b];
      out_re[k] = first * re[0], out_im[k] = first * im[0];
      for (std::size_t l = 1; l < dimensions; ++l) {
        const T factor = sign[k] * sign[l] * g[part(k, l) * width + b];
        out_re[k] += factor * re[l], out_im[k] += factor * im[l];
      }
    }
    if (deviations_.sources || deviations_.targets) {
      T* const scalar = spectra + dimensions * field + 2 * b;
      const T scalar_re = scalar[0], scalar_im = scalar[1];
      T sum_re = 0, sum_im = 0;
      for (std::size_t k = 0; k < dimensions; ++k) {
        const T gradient = sign[k] * g[(parts + k) * width + b];  // times -i
        if (deviations_.sources) out_re[k] += gradient * scalar_im, out_im[k] -= gradient * scalar_re;
        sum_re += gradient * im[k], sum_im += gradient * re[k];
      }
      if (deviations_.targets) scalar[0] = sum_re, scalar[1] = -sum_im;
    }
    for (std::size_t k = 0; k < dimensions; ++k)
      spectra[k * field + 2 * b] = out_re[k], spectra[k * field + 2 * b + 1] = out_im[k];
  }
}

template class TensorSpectrum<float, 2>;
template class TensorSpectrum<float, 3>;
template class TensorSpectrum<double, 2>;
template class TensorSpectrum<double, 3>;

}  // namespace talus::cloud
