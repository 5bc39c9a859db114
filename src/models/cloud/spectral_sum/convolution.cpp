// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/convolution.hpp"

#include <algorithm>
#include <complex>
#include <functional>
#include <numbers>
#include <vector>

#include "models/cloud/spectral_sum/fourier.hpp"
#include "models/cloud/spectral_sum/spline.hpp"
#include "models/cloud/spectral_sum/split.hpp"

namespace talus::cloud {

namespace {

// The correction for the spline is felt a few nodes away; beyond this many its sources are where the kernel, sampled on
// the doubled grid, has its seam.
constexpr std::size_t seam = 40;
constexpr std::size_t width = 8;  // columns transformed together
constexpr int tables = 5;         // of the tensor: xx, xy, yy, and grad h along x and y
constexpr std::size_t aligned_to = 64;

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

template <class T>
struct Convolution<T>::Grid {
  using Complex = std::complex<T>;

  SpectralAccuracy accuracy;
  Deviations deviations;
  Split split;
  double mean_size = -1;
  std::size_t columns = 0, rows = 0;          // of the nodes that are in use
  std::size_t all_columns = 0, all_rows = 0;  // of the doubled grid
  std::size_t pitch = 0, blocks = 0;
  AlignedArray<T> fields, table;
  std::vector<AlignedArray<Complex>> space;
  Transform<T> row_forward, row_backward, column_forward, column_backward;

  Grid(const SpectralAccuracy& accuracy_, Deviations deviations_)
      : accuracy(accuracy_), deviations(deviations_), split(accuracy_.beta, accuracy_.order) {}

  int sources() const { return deviations.sources ? 3 : 2; }
  int results() const { return deviations.targets ? 3 : 2; }
  int field_count() const { return std::max(sources(), results()); }
  T* row(int field, std::size_t n) { return fields.data() + (static_cast<std::size_t>(field) * rows + n) * pitch; }

  void set_size();
  void sample(ThreadTeam& team);
  void fill_table(ThreadTeam& team, int number, bool odd_x, bool odd_y,
                  const std::function<double(double, double)>& kernel);
  void transform_columns(std::size_t block, Complex* work);
  void multiply(std::size_t block, Complex* work) const;
};

template <class T>
void Convolution<T>::Grid::set_size() {
  all_columns = good_size(2 * columns + seam), all_rows = good_size(2 * rows + seam);
  pitch = (all_columns + 2 + aligned_to - 1) / aligned_to * aligned_to;
  blocks = (all_columns / 2 + width) / width;
  fields = AlignedArray<T>(static_cast<std::size_t>(field_count()) * rows * pitch + 2 * width);
  table = AlignedArray<T>(blocks * (all_rows / 2 + 1) * tables * width);
  space.clear();
  AlignedArray<Complex> columns_of_a_block(all_rows * width);
  row_forward = Transform<T>::to_spectrum(all_columns, fields.data());
  row_backward = Transform<T>::from_spectrum(all_columns, fields.data());
  column_forward = Transform<T>::of_columns(all_rows, width, columns_of_a_block.data(), false);
  column_backward = Transform<T>::of_columns(all_rows, width, columns_of_a_block.data(), true);
}

/// Samples a kernel on a quarter of the doubled grid, transforms it and stores it, corrected for the spline and scaled.
/// \param odd_x, odd_y whether it changes its sign with a coordinate; it is even otherwise
template <class T>
void Convolution<T>::Grid::fill_table(ThreadTeam& team, int number, bool odd_x, bool odd_y,
                                      const std::function<double(double, double)>& kernel) {
  const std::size_t half_x = all_columns / 2, half_y = all_rows / 2;
  const std::size_t first_x = odd_x ? 1 : 0, first_y = odd_y ? 1 : 0;
  const std::size_t count_x = half_x + 1 - 2 * first_x, count_y = half_y + 1 - 2 * first_y;
  AlignedArray<double> quarter(count_x * count_y);
  const double spacing = 1.0 / accuracy.nodes;
  team.run(count_y, [&](std::size_t j) {
    for (std::size_t i = 0; i < count_x; ++i)
      quarter[j * count_x + i] =
          kernel(static_cast<double>(i + first_x) * spacing, static_cast<double>(j + first_y) * spacing);
  });
  transform_quarter(quarter.data(), count_x, count_y, odd_x, odd_y);
  const auto correction = [&](std::size_t k, std::size_t all) {
    return spline_correction(2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(all), accuracy.points);
  };
  std::vector<double> across(half_x + 1);
  for (std::size_t k = 0; k <= half_x; ++k)
    across[k] = correction(k, all_columns) / (static_cast<double>(all_columns) * static_cast<double>(all_rows));
  const double sign = odd_x && odd_y ? -1 : 1;  // each odd direction gives -i; a single one is left to `multiply`
  team.run(half_y + 1, [&](std::size_t j) {
    const double along = sign * correction(j, all_rows);
    for (std::size_t block = 0; block < blocks; ++block)
      for (std::size_t b = 0; b < width; ++b) {
        const std::size_t i = block * width + b;
        const bool inside = i >= first_x && i - first_x < count_x && j >= first_y && j - first_y < count_y;
        const double value = inside ? quarter[(j - first_y) * count_x + (i - first_x)] * across[i] * along : 0.0;
        table[((block * (half_y + 1) + j) * tables + static_cast<std::size_t>(number)) * width + b] =
            static_cast<T>(value);
      }
  });
}

template <class T>
void Convolution<T>::Grid::sample(ThreadTeam& team) {
  const auto mobility = [&](double x, double y) {
    const double r = std::hypot(x, y);
    const auto s = split.stokeslet(r), d = split.dipole(r);
    return hydrodynamics::PairMobility<double>{s.isotropic + mean_size * d.isotropic, s.radial + mean_size * d.radial};
  };
  fill_table(team, 0, false, false, [&](double x, double y) {
    const auto m = mobility(x, y);
    return m.isotropic + x * x * m.radial;
  });
  fill_table(team, 1, true, true, [&](double x, double y) { return x * y * mobility(x, y).radial; });
  fill_table(team, 2, false, false, [&](double x, double y) {
    const auto m = mobility(x, y);
    return m.isotropic + y * y * m.radial;
  });
  if (field_count() == 2) return;
  fill_table(team, 3, true, false, [&](double x, double y) { return -x * split.dipole(std::hypot(x, y)).isotropic; });
  fill_table(team, 4, false, true, [&](double x, double y) { return -y * split.dipole(std::hypot(x, y)).isotropic; });
}

/// The sources' spectra of some columns, one after the other in `work`, become those of the results.
template <class T>
void Convolution<T>::Grid::multiply(std::size_t block, Complex* work) const {
  const std::size_t half = all_rows / 2, field = all_rows * width;
  const bool from_scalar = deviations.sources, to_scalar = deviations.targets;
  for (std::size_t j = 0; j < all_rows; ++j) {
    const std::size_t row = j <= half ? j : all_rows - j;
    const T sign = j <= half ? T(1) : T(-1);  // of what is odd along the columns
    const T* const g = table.data() + (block * (half + 1) + row) * tables * width;
    T* const x = reinterpret_cast<T*>(work + j * width);
    T* const y = reinterpret_cast<T*>(work + field + j * width);
    T* const scalar = reinterpret_cast<T*>(work + 2 * field + j * width);
    for (std::size_t b = 0; b < width; ++b) {
      const T xx = g[b], xy = sign * g[width + b], yy = g[2 * width + b];
      const T re_x = x[2 * b], im_x = x[2 * b + 1], re_y = y[2 * b], im_y = y[2 * b + 1];
      T out_x[2] = {xx * re_x + xy * re_y, xx * im_x + xy * im_y};
      T out_y[2] = {xy * re_x + yy * re_y, xy * im_x + yy * im_y};
      if (from_scalar || to_scalar) {
        const T grad_x = g[3 * width + b], grad_y = sign * g[4 * width + b];  // times -i
        if (from_scalar) {
          const T re = scalar[2 * b], im = scalar[2 * b + 1];
          out_x[0] += grad_x * im, out_x[1] -= grad_x * re;
          out_y[0] += grad_y * im, out_y[1] -= grad_y * re;
        }
        if (to_scalar) {
          scalar[2 * b] = grad_x * im_x + grad_y * im_y;
          scalar[2 * b + 1] = -(grad_x * re_x + grad_y * re_y);
        }
      }
      x[2 * b] = out_x[0], x[2 * b + 1] = out_x[1];
      y[2 * b] = out_y[0], y[2 * b + 1] = out_y[1];
    }
  }
}

template <class T>
void Convolution<T>::Grid::transform_columns(std::size_t block, Complex* work) {
  const std::size_t field = all_rows * width;
  for (int k = 0; k < sources(); ++k) {
    Complex* const column = work + static_cast<std::size_t>(k) * field;
    for (std::size_t j = 0; j < rows; ++j) {
      const Complex* const from = reinterpret_cast<const Complex*>(row(k, j)) + block * width;
      std::copy(from, from + width, column + j * width);
    }
    std::fill(column + rows * width, column + field, Complex{});
    column_forward.of_complex(column);
  }
  multiply(block, work);
  for (int k = 0; k < results(); ++k) {
    Complex* const column = work + static_cast<std::size_t>(k) * field;
    column_backward.of_complex(column);
    for (std::size_t j = 0; j < rows; ++j)
      std::copy(column + j * width, column + (j + 1) * width, reinterpret_cast<Complex*>(row(k, j)) + block * width);
  }
}

template <class T>
Convolution<T>::Convolution(const SpectralAccuracy& accuracy, Deviations deviations)
    : grid_(std::make_unique<Grid>(accuracy, deviations)) {}
template <class T>
Convolution<T>::~Convolution() = default;
template <class T>
Convolution<T>::Convolution(Convolution&&) noexcept = default;
template <class T>
Convolution<T>& Convolution<T>::operator=(Convolution&&) noexcept = default;

template <class T>
T* Convolution<T>::field(int number) {
  return grid_->row(number, 0);
}

template <class T>
const T* Convolution<T>::field(int number) const {
  return grid_->row(number, 0);
}

template <class T>
std::size_t Convolution<T>::pitch() const {
  return grid_->pitch;
}

template <class T>
void Convolution<T>::prepare(ThreadTeam& team, std::size_t columns, std::size_t rows, double mean_size) {
  Grid& g = *grid_;
  // A few sizes serve many grids: the room is that of the transform.
  const std::size_t room_x = (good_size(2 * columns + seam) - seam) / 2;
  const std::size_t room_y = (good_size(2 * rows + seam) - seam) / 2;
  if (room_x != g.columns || room_y != g.rows || mean_size != g.mean_size) {
    g.columns = room_x, g.rows = room_y, g.mean_size = mean_size;
    g.set_size();
    g.sample(team);
  }
  team.run(g.rows, [&](std::size_t j) {
    for (int k = 0; k < g.field_count(); ++k) std::fill(g.row(k, j), g.row(k, j) + g.pitch, T(0));
  });
}

template <class T>
void Convolution<T>::apply(ThreadTeam& team) {
  Grid& g = *grid_;
  team.run(g.rows, [&](std::size_t j) {
    for (int k = 0; k < g.sources(); ++k) g.row_forward.to_complex(g.row(k, j));
  });
  // Columns do not know of each other: what a task takes does not change a bit.
  const std::size_t tasks = std::min<std::size_t>(g.blocks, 4 * static_cast<std::size_t>(team.size()));
  const std::size_t field = g.all_rows * width * static_cast<std::size_t>(g.field_count());
  while (g.space.size() < tasks) g.space.emplace_back(field);
  team.run(tasks, [&](std::size_t task) {
    for (std::size_t block = task; block < g.blocks; block += tasks) g.transform_columns(block, g.space[task].data());
  });
  team.run(g.rows, [&](std::size_t j) {
    for (int k = 0; k < g.results(); ++k) g.row_backward.to_real(g.row(k, j));
  });
}

template <class T>
double Convolution<T>::bytes(const SpectralAccuracy&, double columns, double rows) {
  // Fields twice as wide as the grid, the tables of a quarter of the doubled grid, and one such quarter in double.
  const double nodes = 1.1 * (columns + seam) * (rows + seam);
  return nodes * (sizeof(T) * (3 * 2 + tables) + sizeof(double)) + 4e6;
}

template class Convolution<float>;
template class Convolution<double>;

}  // namespace talus::cloud
