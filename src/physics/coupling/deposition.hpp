// SPDX-License-Identifier: Apache-2.0
/// From SPH particles to the cells of the air and back: deposition of the solid volume and its flux on a grid with the
/// SPH kernel, and interpolation from cells with the same weights ("averaged in an air cell", Yuu & Umekage 2011).
///
/// The weights of a particle are its kernel at the cells' centres (of long cells: summed over that of parts as long as
/// they are wide), over their sum: volume and momentum are conserved to
/// round-off. The kernel is rounded to single precision, the sum is not. Contributions beyond a face of the box or a
/// wall are folded back, as those of the image of the particle, so that the packing next to a wall is not
/// underestimated; those beyond a periodic face enter at the opposite one. Contributions beyond an open face are lost,
/// so that the weights of a leaving particle vanish continuously and a stream is as dense at the face as inside. Behind
/// a wall that is not aligned with the cells there are no cells for the images: their contributions go to the visible
/// cells. So do those behind a surface.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/grid/grid.hpp"
#include "numerics/mass_ratios.hpp"
#include "numerics/surface/surface.hpp"

namespace talus::coupling {

class Deposition {
 public:
  /// \throws std::invalid_argument if the grid does not fill the domain's box
  /// \param domain, surface outlive it
  Deposition(const Grid& grid, const Domain& domain, const Surface& surface = Surface::none());

  /// Finds the weights. \param smoothing_length of each particle, m; the kernel reaches twice as far
  /// \param is_left_out of each particle: it has no weights; empty: none is
  void find_weights(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length,
                    std::span<const char> is_left_out = {});

  /// \param solid_volume of a particle of mass ratio 1, without pores, m^3
  /// Sums in fixed point, which do not depend on the order of the particles: multiples of 2^-50 (fraction) and 2^-44
  /// m/s, exact up to 2^53 of these.
  /// \param fraction out: solid volume over volume of every cell
  /// \param flux out: by component, that times the solid's velocity, m/s
  void deposit(ThreadTeam& team, double solid_volume, MassRatios ratios, std::span<const Vector3> velocity,
               CellField& fraction, FaceField& flux) const;

  /// The first cells of the first and of the last row in which particles have weights, in the grid's order; of none the
  /// first is the larger one.
  std::array<std::size_t, 2> rows() const;

  /// received[j] = solid_volume * ratios[j] * sum over cells of weight * (per solid volume). Summed over particles this
  /// is the cells' volume times `deposit`'s fraction times `per_solid_volume`.
  void distribute(ThreadTeam& team, double solid_volume, MassRatios ratios, const FaceField& per_solid_volume,
                  std::span<Vector3> received) const;

  /// Largest size of a vector field's mean over the cells of a particle, by its weights; `at_least` if that is larger.
  /// Particles whose cells all have smaller ones are left out.
  /// \param square of the size of the vector of every cell
  double max_mean(ThreadTeam& team, const FaceField& vector, const CellField& square, double at_least);

 private:
  static constexpr std::size_t block_size = 64;
  struct Particle {
    std::size_t rows = 0;     // of cells along x, those before it in the block included
    std::size_t columns = 0;  // of each row: a whole number of vectors
    double per_total = 0;     // of its weights, those of cells beyond open faces included
  };
  struct Block {
    std::vector<Particle> particle;
    std::vector<std::uint32_t> first;  // cell of each row
    std::vector<float> weight;         // of its cells, not normalised; 0 beyond reach
    std::size_t rows = 0, weights = 0;
  };
  struct Scratch;
  void find_weights(const Vector3& position, double smoothing_length, Scratch& scratch, Block& block) const;
  void find_seen(const Vector3& position, Scratch& scratch) const;
  static void weigh_seen(std::size_t columns, Scratch& scratch);
  void keep(std::size_t columns, Scratch& scratch, Block& block) const;
  void leave_out_hidden(const Vector3& position, double reach, std::size_t columns, Scratch& scratch) const;
  template <class Body>
  void for_each_particle(const Block& block, std::size_t first, Body&& body) const;

  Grid grid_;
  const Domain& domain_;
  const Surface& surface_;
  std::array<bool, 3> is_mirrored_{};  // along each axis: neither end of the box is open or periodic
  double min_reach_ = 0;               // with which a particle reaches the centre of the nearest part of a cell, m
  double beyond_reach_ = 0;            // that the centre of a cell may be, of which a part is within reach, m
  std::size_t count_ = 0;
  std::vector<Block> blocks_;
  std::vector<double> row_max_;  // of each row_lanes cells, one after another
};

}  // namespace talus::coupling
