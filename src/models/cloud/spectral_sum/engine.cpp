// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/engine.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/cloud/spectral_sum/spline.hpp"
#include "models/cloud/spectral_sum/split.hpp"
#include "physics/hydrodynamics/mobility.hpp"

namespace talus::cloud {

namespace {

using hydrodynamics::Mobility;

constexpr std::size_t strip = 4;  // cells that are spread together in a direction: more nodes than a spline has
constexpr std::size_t targets_wanted = 4;  // of a block of cells: gathering their neighbours is shared

template <class T, int dimensions>
SumNear<T, dimensions> choose(InstructionSet set, Mobility mobility, int degree) {
  return TALUS_COMPILED_FOR(set, sum_near, <T, dimensions>)(mobility, degree);
}

/// Lengths in units of the cut-off. A cell is half of it.
template <class T, int points, int dimensions>
class EngineOf final : public SpectralSum::Engine {
 public:
  EngineOf(const SpectralSum::Options& options_, const SpectralAccuracy& accuracy_, std::span<const double> radius_)
      : Engine(options_, accuracy_, radius_),
        convolution_(accuracy_, deviations),
        sum_near_(choose<T, dimensions>(resolve(options_.instruction_set), options_.mobility, accuracy_.degree)) {
    for (const double c : Split(accuracy_.beta, accuracy_.order).polynomials(accuracy_.degree))
      polynomial_.push_back(static_cast<T>(c));
  }

  void velocities(ThreadTeam& team, const Lattice& lattice, std::span<const Vector3> position,
                  std::span<const Vector3> force, std::span<Vector3> velocity) override {
    cells_.sort(team, lattice, position, order);
    std::array<std::size_t, 3> nodes = {1, 1, 1};
    for (std::size_t k = 0; k < dimensions; ++k) nodes[k] = nodes_along(lattice.count[k], accuracy);
    convolution_.prepare(team, nodes, mean_size / (cutoff * cutoff));
    pack(team, position, force);
    // What a strip of rows and layers is spread over reaches into the next ones by less than a strip: every other one
    // at a time.
    const std::size_t strips = (lattice.rows() + strip - 1) / strip, slabs = (lattice.layers() + strip - 1) / strip;
    for (const std::size_t odd_slab : {0, 1})
      for (const std::size_t odd_strip : {0, 1}) {
        const std::size_t across = (strips + 1 - odd_strip) / 2;
        team.run(across * ((slabs + 1 - odd_slab) / 2),
                 [&](std::size_t n) { spread(2 * (n % across) + odd_strip, 2 * (n / across) + odd_slab); });
      }
    convolution_.apply(team);
    const std::size_t rows = lattice.all_rows();
    const std::size_t tasks = std::min<std::size_t>(rows, 16 * static_cast<std::size_t>(team.size()));
    space_.resize(std::max(space_.size(), tasks));
    team.run(tasks, [&](std::size_t task) {
      for (std::size_t row = rows * task / tasks; row < rows * (task + 1) / tasks; ++row) {
        add_near(row, space_[task]);
        interpolate(row, velocity);
      }
    });
  }

 private:
  struct Place {  // of a sphere on the grid: the node at or below it along each axis, and how far it is beyond
    std::uint32_t node[dimensions];
    T beyond[dimensions];
  };

  /// What a sphere is spread over: weights along each axis. In a plane the third weight is 1.
  struct Weights {
    static constexpr int layers = dimensions == 2 ? 1 : points;
    const SplineWeights<T, points> x, y, z;
    explicit Weights(const Place& place) : x(place.beyond[0]), y(place.beyond[1]), z(place.beyond[dimensions - 1]) {}
    T layer(int l) const { return dimensions == 2 ? T(1) : z.value[l]; }
  };

  void pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force);
  void spread(std::size_t strip_of_rows, std::size_t slab_of_layers);
  void interpolate(std::size_t row, std::span<Vector3> velocity) const;
  void add_near(std::size_t row, AlignedArray<T>& space);
  T* column(std::size_t k) { return columns_.data() + k * padded_; }
  const T* column(std::size_t k) const { return columns_.data() + k * padded_; }
  std::size_t first_node(const Place& place) const {
    std::size_t at = place.node[1] * convolution_.pitch() + place.node[0];
    if constexpr (dimensions == 3) at += place.node[2] * convolution_.layer_pitch();
    return at;
  }

  // Columns of numbers; vectors have one for each dimension.
  static constexpr std::size_t position_of = 0, force_of = dimensions, near_of = 2 * dimensions,
                               cell_of = 3 * dimensions, size_of = cell_of + 1, radius_of = cell_of + 2,
                               all_columns = cell_of + 3;

  Convolution<T, dimensions> convolution_;
  SumNear<T, dimensions> sum_near_;
  std::vector<T> polynomial_;
  Cells cells_;
  std::size_t padded_ = 0;
  std::vector<T> columns_;
  std::vector<Place> place_;
  std::vector<AlignedArray<T>> space_;
};

template <class T, int points, int dimensions>
void EngineOf<T, points, dimensions>::pack(ThreadTeam& team, std::span<const Vector3> position,
                                           std::span<const Vector3> force) {
  const Lattice& lattice = cells_.lattice();
  padded_ = position.size() + near_padding;  // neighbours are read a register at a time
  columns_.resize(all_columns * padded_), place_.resize(position.size());
  const double per_force = 1 / (8 * std::numbers::pi * options.viscosity * cutoff);
  const double per_area = 1 / (cutoff * cutoff), per_cutoff = 1 / cutoff;
  const double nodes = 0.5 * accuracy.nodes;  // of the grid in a cell
  for_each(team, position.size(), [&](std::size_t n) {
    const std::uint32_t i = cells_.sphere()[n];
    Place& place = place_[n];
    for (std::size_t k = 0; k < dimensions; ++k) {
      const double x = lattice.cells_along(k, position[i]);
      const auto number = static_cast<std::uint32_t>(x);
      const double inside = x - number, along = x * nodes;
      place.node[k] = static_cast<std::uint32_t>(along);
      place.beyond[k] = static_cast<T>(along - place.node[k]);
      column(position_of + k)[n] = static_cast<T>(0.5 * inside);
      if (k == 0) column(cell_of)[n] = static_cast<T>(number);
      column(force_of + k)[n] = static_cast<T>(force[i].*lattice.axis[k] * per_force);
    }
    column(size_of)[n] = static_cast<T>(size[i] * per_area);
    column(radius_of)[n] = static_cast<T>(radius[i] * per_cutoff);
  });
}

template <class T, int points, int dimensions>
void EngineOf<T, points, dimensions>::spread(std::size_t strip_of_rows, std::size_t slab_of_layers) {
  const Lattice& lattice = cells_.lattice();
  const T mean = static_cast<T>(size_offset / (cutoff * cutoff)), per_spacing = static_cast<T>(accuracy.nodes);
  const T* const s = column(size_of);
  const std::size_t pitch = convolution_.pitch(), layer_pitch = convolution_.layer_pitch();
  const std::size_t field_pitch = convolution_.field_pitch();
  T* const fields = convolution_.fields();
  const std::size_t begin_row = strip_of_rows * strip, end_row = std::min(begin_row + strip, lattice.rows());
  const std::size_t begin_layer = slab_of_layers * strip, end_layer = std::min(begin_layer + strip, lattice.layers());
  for (std::size_t layer = begin_layer; layer < end_layer; ++layer) {
    const std::size_t rows_before = layer * lattice.rows();
    const std::size_t end = cells_.first(rows_before + end_row - 1, lattice.columns());
    for (std::size_t n = cells_.first(rows_before + begin_row, 0); n < end; ++n) {
      const Weights w(place_[n]);
      const std::size_t at = first_node(place_[n]);
      const T deviation = deviations.sources ? (s[n] - mean) * per_spacing : T(0);
      T f[dimensions];
      for (int k = 0; k < dimensions; ++k) f[k] = column(force_of + static_cast<std::size_t>(k))[n];
      for (int l = 0; l < w.layers; ++l)
        for (int j = 0; j < points; ++j) {
          T* row = fields + at + static_cast<std::size_t>(l) * layer_pitch + static_cast<std::size_t>(j) * pitch;
          const T across = w.y.value[j] * w.layer(l);
          for (int k = 0; k < dimensions; ++k, row += field_pitch) {
            const T to = f[k] * across;
            for (int i = 0; i < points; ++i) row[i] += to * w.x.value[i];
          }
          if (!deviations.sources) continue;
          const T by_slope = deviation * f[0] * across;
          T by_value = deviation * f[1] * w.y.slope[j] * w.layer(l);
          if constexpr (dimensions == 3) by_value += deviation * f[2] * w.y.value[j] * w.z.slope[l];
          for (int i = 0; i < points; ++i) row[i] += by_slope * w.x.slope[i] + by_value * w.x.value[i];
        }
    }
  }
}

template <class T, int points, int dimensions>
void EngineOf<T, points, dimensions>::interpolate(std::size_t row, std::span<Vector3> velocity) const {
  const Lattice& lattice = cells_.lattice();
  const std::size_t pitch = convolution_.pitch(), layer_pitch = convolution_.layer_pitch();
  const std::size_t field_pitch = convolution_.field_pitch();
  const T mean = static_cast<T>(size_offset / (cutoff * cutoff)), per_spacing = static_cast<T>(accuracy.nodes);
  const T *const s = column(size_of), *const fields = convolution_.fields();
  for (std::size_t n = cells_.first(row, 0); n < cells_.first(row, lattice.columns()); ++n) {
    const Weights w(place_[n]);
    const std::size_t at = first_node(place_[n]);
    T sum[dimensions][points] = {}, value[points] = {}, slope_y[points] = {}, slope_z[points] = {};
    for (int l = 0; l < w.layers; ++l)
      for (int j = 0; j < points; ++j) {
        const T* from = fields + at + static_cast<std::size_t>(l) * layer_pitch + static_cast<std::size_t>(j) * pitch;
        const T across = w.y.value[j] * w.layer(l);
        for (int k = 0; k < dimensions; ++k, from += field_pitch)
          for (int i = 0; i < points; ++i) sum[k][i] += across * from[i];
        if (!deviations.targets) continue;
        const T by_y = w.y.slope[j] * w.layer(l), by_z = dimensions == 3 ? w.y.value[j] * w.z.slope[l] : T(0);
        for (int i = 0; i < points; ++i) value[i] += across * from[i];
        for (int i = 0; i < points; ++i) slope_y[i] += by_y * from[i];
        if constexpr (dimensions == 3)
          for (int i = 0; i < points; ++i) slope_z[i] += by_z * from[i];
      }
    T v[dimensions];
    for (int k = 0; k < dimensions; ++k) {
      v[k] = column(near_of + static_cast<std::size_t>(k))[n];
      for (int i = 0; i < points; ++i) v[k] += w.x.value[i] * sum[k][i];
    }
    if (deviations.targets) {
      const T deviation = (s[n] - mean) * per_spacing;
      for (int i = 0; i < points; ++i) {
        v[0] -= deviation * w.x.slope[i] * value[i], v[1] -= deviation * w.x.value[i] * slope_y[i];
        if constexpr (dimensions == 3) v[2] -= deviation * w.x.value[i] * slope_z[i];
      }
    }
    Vector3& result = velocity[cells_.sphere()[n]];
    result = Vector3{};
    for (std::size_t k = 0; k < dimensions; ++k) result.*lattice.axis[k] = v[k];
  }
}

template <class T, int points, int dimensions>
void EngineOf<T, points, dimensions>::add_near(std::size_t row, AlignedArray<T>& space) {
  const Lattice& lattice = cells_.lattice();
  SortedSpheres<T, dimensions> spheres{.cell = column(cell_of), .size = column(size_of), .radius = column(radius_of)};
  T* sums[dimensions];
  for (std::size_t k = 0; k < dimensions; ++k)
    spheres.position[k] = column(position_of + k), spheres.force[k] = column(force_of + k),
    sums[k] = column(near_of + k);
  constexpr std::size_t reach = near_reach, rows = near_rows(dimensions);
  const std::size_t in_layer = row % lattice.rows(), layer = row / lattice.rows();
  for (std::size_t begin = 0, end; begin < lattice.columns(); begin = end) {
    NearBlock<T, dimensions> block;
    block.first = cells_.first(row, begin);
    for (end = begin + 1; end < lattice.columns() && end < begin + 8; ++end)
      if (cells_.first(row, end) - block.first >= targets_wanted) break;
    block.last = cells_.first(row, end);
    if (block.first == block.last) continue;
    block.first_cell = static_cast<T>(begin);
    std::size_t count = 0;
    for (std::size_t k = 0; k < rows; ++k) {
      // Moved up by the reach, so as not to be negative.
      const std::size_t of_layer = in_layer + k % 5, of_layers = layer + (dimensions == 2 ? reach : k / 5);
      if (of_layer < reach || of_layer - reach >= lattice.rows()) continue;
      if (of_layers < reach || of_layers - reach >= lattice.layers()) continue;
      const std::size_t other = (of_layers - reach) * lattice.rows() + (of_layer - reach);
      block.begin[k] = cells_.first(other, begin < reach ? 0 : begin - reach);
      block.end[k] = cells_.first(other, std::min(end + reach, lattice.columns()));
      count += block.end[k] - block.begin[k];
    }
    // Grown by half: the task's room settles after a few blocks.
    const std::size_t needed = near_columns(dimensions) * (count + 2 * near_padding);
    if (space.size() < needed) space = AlignedArray<T>(needed + needed / 2);
    sum_near_(spheres, block, polynomial_.data(), space.data(), sums);
  }
}

template <int dimensions>
std::unique_ptr<SpectralSum::Engine> make(const SpectralSum::Options& options, const SpectralAccuracy& accuracy,
                                          std::span<const double> radius) {
  if (accuracy.points == 4) return std::make_unique<EngineOf<float, 4, dimensions>>(options, accuracy, radius);
  if (accuracy.points == 6) return std::make_unique<EngineOf<float, 6, dimensions>>(options, accuracy, radius);
  return std::make_unique<EngineOf<double, 8, dimensions>>(options, accuracy, radius);
}

}  // namespace

SpectralSum::Engine::Engine(const Options& options_, const SpectralAccuracy& accuracy_, std::span<const double> radius_)
    : options(options_),
      accuracy(accuracy_),
      directions(options_.motion == Motion::xyz ? 3 : 2),
      axis({&Vector3::x, &Vector3::y, &Vector3::z}),
      radius(radius_.begin(), radius_.end()),
      order(radius_.size()) {
  if (options.motion == Motion::xz) std::swap(axis[1], axis[2]);
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
  return options.motion == Motion::xyz ? make<3>(options, accuracy, radius) : make<2>(options, accuracy, radius);
}

}  // namespace talus::cloud
