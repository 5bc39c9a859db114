// SPDX-License-Identifier: Apache-2.0
/// From SPH particles to the cells of the air and back: the solid volume and its flow that particles spread over a grid
/// with the SPH kernel, and what cells hand back with the same weights ("averaged in an air cell", Yuu & Umekage 2011).
///
/// The weights of a particle are its kernel at the cells' centres, over their sum: volume and momentum are conserved to
/// round-off. What would fall beyond a face of the box or a wall is folded back, as the particle's image behind it
/// would spread it, so that a bed is as dense at a face as within; what would leave through a periodic face comes in at
/// the other. What would fall beyond an open face has left: no cell has it, so that the weights of a particle that
/// leaves fall to nothing without a jump, and a stream is as dense at the face as within. Behind a wall that does not
/// lie on faces of the cells, images of cells are no cells: these have no share, those that the particle sees the more.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <vector>

#include "base/parallel.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/grid/grid.hpp"

namespace talus::coupling {

class Deposition {
 public:
  /// \throws std::invalid_argument if the grid does not fill the domain's box
  /// \param domain outlives it
  Deposition(const Grid& grid, const Domain& domain);

  /// Finds the weights. \param smoothing_length of each particle, m; the kernel reaches twice as far
  void find_weights(ThreadTeam& team, std::span<const Vector3> position, std::span<const double> smoothing_length);

  /// \param solid_volume of each particle, without pores, m^3; the same for all
  /// \param fraction out: solid volume over volume of every cell
  /// \param flux out: by component, that times the solid's velocity, m/s
  void deposit(ThreadTeam& team, double solid_volume, std::span<const Vector3> velocity, CellField& fraction,
               FaceField& flux) const;

  /// received[j] = solid_volume * sum over cells of weight * (per solid volume). Summed over particles this is the
  /// cells' volume times `deposit`'s fraction times `per_solid_volume`.
  void distribute(ThreadTeam& team, double solid_volume, const FaceField& per_solid_volume,
                  std::span<Vector3> received) const;

 private:
  static constexpr std::size_t block_size = 64;
  struct Block {
    std::vector<std::size_t> end;     // of each particle's cells
    std::vector<std::uint32_t> cell;  // longer than needed
    std::vector<double> weight;
  };
  struct Scratch;
  void find_weights(const Vector3& position, double smoothing_length, Scratch& scratch, Block& block) const;
  void find_seen(const Vector3& position, Scratch& scratch) const;
  template <class Body>
  void for_each_particle(const Block& block, std::size_t first, Body&& body) const;

  Grid grid_;
  const Domain& domain_;
  std::size_t count_ = 0;
  std::vector<Block> blocks_;
};

}  // namespace talus::coupling
