// SPDX-License-Identifier: Apache-2.0
/// The direct sum over all pairs of spheres that interact through a viscous fluid: Eqs 3b, 3c and the sum of Eq. 4a of
/// Niiya, Awazu & Nishimori 2020.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <vector>

#include "base/instruction_set.hpp"
#include "base/parallel.hpp"
#include "base/vector.hpp"
#include "models/cloud/pair_sum/kernel.hpp"
#include "models/cloud/pair_sum/shared_tasks.hpp"
#include "physics/hydrodynamics/mobility.hpp"
#include "ranks/ranks.hpp"

namespace talus::cloud {

/// The plane in which the spheres move, or all space. In a plane the third component of forces and positions is not
/// read.
enum class Motion { xy, xz, xyz };

/// Arithmetic of the sum over pairs. `single_precision` computes the pairs in single precision, with positions relative
/// to a near one, and adds blocks of them up in double precision.
enum class Precision { double_precision, single_precision };

/// Velocities of spheres due to the forces on the others. The cost is N^2/2 pairs, the memory about 1 kB per sphere.
///
/// Bitwise identical for any number of threads, and of processes that share the pairs; each then has all spheres, and
/// its constructor and `velocities` are calls together. Instruction sets agree within 1e-14 of the largest sum over
/// pairs of |M_ij F_j| in double precision and 1e-6 in single precision; the reciprocal square root starts from an
/// estimate of the processor, which depends on its make.
class PairSum {
 public:
  struct Options {
    hydrodynamics::Mobility mobility = hydrodynamics::Mobility::rotne_prager_1969;
    Motion motion = Motion::xyz;
    Precision precision = Precision::double_precision;
    InstructionSet instruction_set = InstructionSet::automatic;
    double viscosity = 0;  ///< Pa s, > 0
  };

  /// \param radius one per sphere, m, > 0
  /// \param order as `reorder`
  /// \param ranks outlive it
  /// \throws InputError if the processor does not have the instruction set
  PairSum(const Options& options, std::span<const double> radius, std::span<const std::uint32_t> order = {},
          const Ranks& ranks = one_process());

  /// Sets the order in which the spheres are stored: a permutation, preferably one that keeps neighbours in space near
  /// in memory; empty: unchanged. It changes the last bits, and in single precision it matters for the accuracy: pairs
  /// lose digits in proportion to the extent of a tile of 128 spheres over their distance.
  /// \throws std::invalid_argument if it is neither empty nor a permutation
  void reorder(std::span<const std::uint32_t> order);

  /// velocity[i] = sum over j != i of M_ij F_j; the sphere's own Stokes drag is not in it. Overwrites; components
  /// outside the plane of motion become 0. With the printed tensor two spheres at one position get a velocity that is
  /// not finite; with zuk-2014 every configuration has a finite one. \param position m; \param force N; \param velocity
  /// m/s; one per sphere, in the order of the radii \throws std::invalid_argument if a length is not the number of
  /// spheres
  void velocities(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force,
                  std::span<Vector3> velocity);

  std::size_t size() const { return radius_.size(); }
  InstructionSet instruction_set() const { return instruction_set_; }  ///< the one in use, never `automatic`
  /// Tasks of the sum that processors share, at most; with a few spheres some of them are one.
  static std::size_t max_tasks(std::size_t spheres);
  double seconds_of_messages() const { return shared_ ? shared_->seconds() : 0; }  ///< since the start

 private:
  struct Task {
    std::size_t begin, end;  // rows
    std::size_t offset;      // of its velocities in sums_: a column for each dimension, from row `begin` on
    bool is_here;            // this process computes it
  };

  void divide_into_tasks(const Ranks& ranks);
  void pack(ThreadTeam& team, std::span<const Vector3> position, std::span<const Vector3> force);
  std::vector<TaskSums> computed() const;
  template <class Take>
  void add_tasks(ThreadTeam& team, std::span<const TaskSums> tasks, std::size_t first, std::size_t end,
                 Take&& take) const;
  double* column(std::size_t k) { return packed_.data() + k * padded_; }

  Options options_;
  InstructionSet instruction_set_;
  std::size_t dimensions_;
  std::array<double Vector3::*, 3> axis_;  // those of the motion first
  std::vector<double> radius_;
  std::size_t padded_;
  SumRows sum_rows_ = nullptr;        // none without interaction
  double length_ = 1;                 // m, unit of the packed lengths: the power of two at or below the largest radius
  std::vector<std::uint32_t> order_;  // sphere at each packed position
  std::vector<double> packed_;        // columns of padded_ numbers: positions, forces, radius, size
  std::vector<Task> tasks_;
  std::vector<double> sums_;
  std::unique_ptr<SharedTasks> shared_;  // none for one process
};

}  // namespace talus::cloud

namespace talus {
template <>
inline constexpr auto choices<hydrodynamics::Mobility> = std::to_array<std::string_view>({"rotne-prager-1969",
                                                                                          "zuk-2014", "none"});
template <>
inline constexpr auto choices<cloud::Motion> = std::to_array<std::string_view>({"xy", "xz", "xyz"});
template <>
inline constexpr auto choices<cloud::Precision> = std::to_array<std::string_view>({"double", "single"});
}  // namespace talus
