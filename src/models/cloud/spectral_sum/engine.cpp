// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/engine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/cloud/spectral_sum/spline.hpp"
#include "models/cloud/spectral_sum/split.hpp"
#include "physics/hydrodynamics/rotne_prager.hpp"
#include "physics/hydrodynamics/zuk.hpp"

namespace talus::cloud {

namespace {

using hydrodynamics::Mobility;

constexpr std::size_t strip = 4;           // rows of cells that are spread together: more nodes than a spline has
constexpr std::size_t targets_wanted = 4;  // of a block of cells: gathering their neighbours is shared

template <class T>
SumNear<T> choose(InstructionSet set, Mobility mobility, int degree) {
  constexpr bool single = sizeof(T) == sizeof(float);
  if constexpr (single) {
    switch (set) {
#if defined(__x86_64__)
      case InstructionSet::avx512:
        return sum_near_avx512(mobility, degree);
      case InstructionSet::avx2:
        return sum_near_avx2(mobility, degree);
#endif
      default:
        return sum_near_portable(mobility, degree);
    }
  } else {
    switch (set) {
#if defined(__x86_64__)
      case InstructionSet::avx512:
        return sum_near_double_avx512(mobility, degree);
      case InstructionSet::avx2:
        return sum_near_double_avx2(mobility, degree);
#endif
      default:
        return sum_near_double_portable(mobility, degree);
    }
  }
}

/// Lengths in units of the cut-off. A cell is half of it.
template <class T, int points>
class EngineOf final : public SpectralSum::Engine {
 public:
  EngineOf(const SpectralSum::Options& options_, const SpectralAccuracy& accuracy_, std::span<const double> radius_)
      : Engine(options_, accuracy_, radius_),
        convolution_(accuracy_, deviations),
        sum_near_(choose<T>(resolve(options_.instruction_set), options_.mobility, accuracy_.degree)) {
    for (const double c : Split(accuracy_.beta, accuracy_.order).polynomials(accuracy_.degree))
      polynomial_.push_back(static_cast<T>(c));
  }

  void velocities(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
                  std::span<const Vector3> force, std::span<Vector3> velocity) override {
    cells_.sort(team, lattice, position, order);
    convolution_.prepare(team, nodes_along(lattice.columns, accuracy), nodes_along(lattice.rows, accuracy),
                         mean_size / (cutoff * cutoff));
    pack(team, position, force);
    // What a strip of cells is spread over reaches into the next ones by less than a strip: every other one at a time.
    const std::size_t strips = (lattice.rows + strip - 1) / strip;
    for (const std::size_t parity : {0, 1})
      team.run((strips + 1 - parity) / 2, [&](std::size_t n) { spread(2 * n + parity); });
    convolution_.apply(team);
    const std::size_t tasks = std::min<std::size_t>(lattice.rows, 16 * static_cast<std::size_t>(team.size()));
    space_.resize(std::max(space_.size(), tasks));
    team.run(tasks, [&](std::size_t task) {
      for (std::size_t row = lattice.rows * task / tasks; row < lattice.rows * (task + 1) / tasks; ++row) {
        add_near(row, space_[task]);
        interpolate(row, velocity);
      }
    });
  }

 private:
  struct Place {  // of a sphere on the grid: the node at or below it along both axes, and how far it is beyond
    std::uint32_t node[2];
    T beyond[2];
  };

  void pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force);
  void spread(std::size_t number);
  void interpolate(std::size_t row, std::span<Vector3> velocity) const;
  void add_near(std::size_t row, AlignedArray<T>& space);
  T* column(std::size_t k) { return columns_.data() + k * padded_; }
  const T* column(std::size_t k) const { return columns_.data() + k * padded_; }

  enum Column : std::size_t { position_x, position_y, cell, force_x, force_y, size_of, radius_of, near_x, near_y, all };

  Convolution<T> convolution_;
  SumNear<T> sum_near_;
  std::vector<T> polynomial_;
  Cells cells_;
  std::size_t padded_ = 0;
  std::vector<T> columns_;
  std::vector<Place> place_;
  std::vector<AlignedArray<T>> space_;
};

template <class T, int points>
void EngineOf<T, points>::pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force) {
  const Lattice& lattice = cells_.lattice();
  padded_ = position.size();
  columns_.resize(all * padded_), place_.resize(padded_);
  const double per_force = 1 / (8 * std::numbers::pi * options.viscosity * cutoff);
  const double per_area = 1 / (cutoff * cutoff), per_cutoff = 1 / cutoff;
  const double nodes = 0.5 * accuracy.nodes;  // of the grid in a cell
  for_each(team, padded_, [&](std::size_t n) {
    const std::uint32_t i = cells_.sphere()[n];
    Place& place = place_[n];
    for (std::size_t k = 0; k < 2; ++k) {
      const double x = lattice.cells_along(k, position[i]);
      const auto number = static_cast<std::uint32_t>(x);
      const double inside = x - number, along = x * nodes;
      place.node[k] = static_cast<std::uint32_t>(along);
      place.beyond[k] = static_cast<T>(along - place.node[k]);
      column(position_x + k)[n] = static_cast<T>(0.5 * inside);
      if (k == 0) column(cell)[n] = static_cast<T>(number);
      column(force_x + k)[n] = static_cast<T>(force[i].*lattice.axis[k] * per_force);
    }
    column(size_of)[n] = static_cast<T>(size[i] * per_area);
    column(radius_of)[n] = static_cast<T>(radius[i] * per_cutoff);
  });
}

template <class T, int points>
void EngineOf<T, points>::spread(std::size_t number) {
  const Lattice& lattice = cells_.lattice();
  const std::size_t end = cells_.first(std::min((number + 1) * strip, lattice.rows) - 1, lattice.columns);
  const T mean = static_cast<T>(size_offset / (cutoff * cutoff)), per_spacing = static_cast<T>(accuracy.nodes);
  const T *const f_x = column(force_x), *const f_y = column(force_y), *const s = column(size_of);
  T *const field_x = convolution_.field(0), *const field_y = convolution_.field(1);
  T* const field_s = deviations.sources ? convolution_.field(2) : nullptr;
  const std::size_t pitch = convolution_.pitch();
  for (std::size_t n = cells_.first(number * strip, 0); n < end; ++n) {
    const Place& place = place_[n];
    const SplineWeights<T, points> x(place.beyond[0]), y(place.beyond[1]);
    T along[points], gradient_x[points], gradient_y[points];
    const T deviation = deviations.sources ? (s[n] - mean) * per_spacing : T(0);
    for (int k = 0; k < points; ++k) along[k] = x.value[k];
    for (int k = 0; k < points; ++k) gradient_x[k] = deviation * f_x[n] * x.slope[k];
    for (int k = 0; k < points; ++k) gradient_y[k] = deviation * f_y[n] * x.value[k];
    for (int j = 0; j < points; ++j) {
      const std::size_t at = (place.node[1] + static_cast<std::size_t>(j)) * pitch + place.node[0];
      T *const row_x = field_x + at, *const row_y = field_y + at;
      const T to_x = f_x[n] * y.value[j], to_y = f_y[n] * y.value[j];
      for (int k = 0; k < points; ++k) row_x[k] += to_x * along[k];
      for (int k = 0; k < points; ++k) row_y[k] += to_y * along[k];
      if (!deviations.sources) continue;
      T* const row_s = field_s + at;
      for (int k = 0; k < points; ++k) row_s[k] += gradient_x[k] * y.value[j] + gradient_y[k] * y.slope[j];
    }
  }
}

template <class T, int points>
void EngineOf<T, points>::interpolate(std::size_t row, std::span<Vector3> velocity) const {
  const Lattice& lattice = cells_.lattice();
  const T *const field_x = convolution_.field(0), *const field_y = convolution_.field(1);
  const T* const field_s = deviations.targets ? convolution_.field(2) : nullptr;
  const std::size_t pitch = convolution_.pitch();
  const T mean = static_cast<T>(size_offset / (cutoff * cutoff)), per_spacing = static_cast<T>(accuracy.nodes);
  const T* const s = column(size_of);
  for (std::size_t n = cells_.first(row, 0); n < cells_.first(row, lattice.columns); ++n) {
    const Place& place = place_[n];
    const SplineWeights<T, points> x(place.beyond[0]), y(place.beyond[1]);
    T sum_x[points] = {}, sum_y[points] = {}, value[points] = {}, slope[points] = {};
    for (int j = 0; j < points; ++j) {
      const std::size_t at = (place.node[1] + static_cast<std::size_t>(j)) * pitch + place.node[0];
      const T *const row_x = field_x + at, *const row_y = field_y + at;
      for (int k = 0; k < points; ++k) sum_x[k] += y.value[j] * row_x[k];
      for (int k = 0; k < points; ++k) sum_y[k] += y.value[j] * row_y[k];
      if (!deviations.targets) continue;
      const T* const row_s = field_s + at;
      for (int k = 0; k < points; ++k) value[k] += y.value[j] * row_s[k];
      for (int k = 0; k < points; ++k) slope[k] += y.slope[j] * row_s[k];
    }
    T v_x = column(near_x)[n], v_y = column(near_y)[n];
    for (int k = 0; k < points; ++k) v_x += x.value[k] * sum_x[k], v_y += x.value[k] * sum_y[k];
    if (deviations.targets) {
      const T deviation = (s[n] - mean) * per_spacing;
      for (int k = 0; k < points; ++k)
        v_x -= deviation * x.slope[k] * value[k], v_y -= deviation * x.value[k] * slope[k];
    }
    Vector3& v = velocity[cells_.sphere()[n]];
    v = Vector3{};
    v.*lattice.axis[0] = v_x, v.*lattice.axis[1] = v_y;
  }
}

template <class T, int points>
void EngineOf<T, points>::add_near(std::size_t row, AlignedArray<T>& space) {
  const Lattice& lattice = cells_.lattice();
  const SortedSpheres<T> spheres{.position = {column(position_x), column(position_y)},
                                 .cell = column(cell),
                                 .force = {column(force_x), column(force_y)},
                                 .size = column(size_of),
                                 .radius = column(radius_of)};
  T* const sums[2] = {column(near_x), column(near_y)};
  constexpr std::size_t reach = near_rows / 2;
  for (std::size_t begin = 0, end; begin < lattice.columns; begin = end) {
    NearBlock<T> block;
    block.first = cells_.first(row, begin);
    for (end = begin + 1; end < lattice.columns && end < begin + 8; ++end)
      if (cells_.first(row, end) - block.first >= targets_wanted) break;
    block.last = cells_.first(row, end);
    if (block.first == block.last) continue;
    block.first_cell = static_cast<T>(begin);
    std::size_t count = 0;
    for (std::size_t k = 0; k < near_rows; ++k) {
      if (row + k < reach || row + k - reach >= lattice.rows) continue;
      block.begin[k] = cells_.first(row + k - reach, begin < reach ? 0 : begin - reach);
      block.end[k] = cells_.first(row + k - reach, std::min(end + reach, lattice.columns));
      count += block.end[k] - block.begin[k];
    }
    // Grown by half: the task's room settles after a few blocks.
    const std::size_t needed = near_columns * (count + 2 * near_padding);
    if (space.size() < needed) space = AlignedArray<T>(needed + needed / 2);
    sum_near_(spheres, block, polynomial_.data(), space.data(), sums);
  }
}

}  // namespace

SpectralSum::Engine::Engine(const Options& options_, const SpectralAccuracy& accuracy_, std::span<const double> radius_)
    : options(options_),
      accuracy(accuracy_),
      axis({&Vector3::x, options_.motion == Motion::xz ? &Vector3::z : &Vector3::y}),
      radius(radius_.begin(), radius_.end()),
      order(radius_.size()) {
  const bool both = options.mobility == Mobility::zuk_2014;
  double sum = 0;
  for (const double a : radius)
    sum += size.emplace_back(both ? hydrodynamics::shared_size(a) : hydrodynamics::source_size(a));
  size_offset = radius.empty() ? 0 : sum / static_cast<double>(radius.size());
  mean_size = both ? 2 * size_offset : size_offset;
  const bool equal = std::all_of(radius.begin(), radius.end(), [&](double a) { return a == radius.front(); });
  if (equal && !radius.empty()) size_offset = size.front(), mean_size = (both ? 2 : 1) * size_offset;
  deviations = {.sources = !equal, .targets = !equal && both};
  std::iota(order.begin(), order.end(), 0u);
}

std::unique_ptr<SpectralSum::Engine> make_engine(const SpectralSum::Options& options, const SpectralAccuracy& accuracy,
                                                 std::span<const double> radius) {
  if (accuracy.points == 4) return std::make_unique<EngineOf<float, 4>>(options, accuracy, radius);
  if (accuracy.points == 6) return std::make_unique<EngineOf<float, 6>>(options, accuracy, radius);
  return std::make_unique<EngineOf<double, 8>>(options, accuracy, radius);
}

}  // namespace talus::cloud
