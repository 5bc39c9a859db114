// SPDX-License-Identifier: Apache-2.0
/// The share of a process in the particles.
///
/// Every particle has one owner, a process, and one place in the order of all particles. A process holds those that it
/// owns and copies of those around them, its halo, in one array in the order of their places: its neighbour lists then
/// have the same sequence as those of one process by itself, and so do the sums over them. Who owns what changes no
/// bit. Copies have no lists and therefore no rates; stages pass over them or compute what is not read, and what sums
/// and lists read of them is sent by their owners beforehand.
///
/// One process by itself owns all, has no halo, and the place of a particle is its number.
#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "base/error.hpp"
#include "base/system.hpp"
#include "models/continuum/state.hpp"
#include "numerics/geometry/domain.hpp"
#include "numerics/neighbourhood.hpp"
#include "ranks/halo.hpp"
#include "ranks/ranks.hpp"

namespace talus::continuum {

/// Where the time of the steps goes on this process: processor time of its main thread, s. A process that waits for a
/// message takes it as if it computed, unless the processor has other programs to run.
struct TimeOfSteps {
  double steps = 0;     ///< all of it
  double messages = 0;  ///< to the halo and votes
  double sharing = 0;   ///< owners, migration, halo, places
  double air = 0;       ///< the air's step, with its messages
};

/// What splitting adds to the particles of all processes.
struct Parts {
  std::uint64_t added = 0;  ///< by all
  std::vector<std::int64_t>
      numbers;  ///< of each particle here, among those that are added in their order; -1: it is not
};

class Share {
 public:
  /// \param ranks outlive it
  explicit Share(const Ranks& ranks) : ranks_(ranks) {}

  const Ranks& ranks() const { return ranks_; }
  bool is_all() const { return ranks_.is_alone(); }
  bool owns(std::size_t i) const { return is_halo_.empty() || !is_halo_[i]; }
  /// How many particles all processes own. \param here how many this one has, with its halo
  std::size_t of_all(std::size_t here) const { return is_all() ? here : count_; }

  TimeOfSteps& time() const { return time_; }

  // The calls below do nothing for one process; with several they are calls together.

  /// Takes the particles of the states for all there are, those of the first process first, and its numbers for those
  /// of all processes.
  void begin(State& state);

  /// Moves particles to their owners and finds the halo, for neighbour lists that are built from list_position,
  /// list_smoothing_length and list_margin. Cuts space again where the work has become uneven.
  /// \pre no halo \param carried more columns of the particles
  void distribute(State& state, const Domain& domain, std::span<std::vector<double>* const> carried);
  /// Moves particles to the processes whose parts of space hold these places. \pre no halo
  /// \param where of a particle, m; nothing: it stays
  void bring(State& state, const std::function<std::optional<Vector3>(std::size_t)>& where);

  /// What a particle here costs among those of others, when space is cut again. \param pairs in the lists of this
  /// process
  void weigh(std::size_t pairs);
  /// What the neighbour lists need to know besides. \pre distribute
  PartOfPoints part() const { return {is_halo_, reach_, margin_}; }

  /// Gives columns the halo's values, in one message.
  void refresh(std::span<const Halo::Column> columns) {
    if (is_all()) return;
    const Stopwatch watch(time_.messages);
    halo_.refresh(columns);
  }
  void vote(Votes& votes) const {
    if (is_all()) return;
    const Stopwatch watch(time_.messages);
    ranks_.join(votes);
  }

  /// Removes the halo from one more column.
  void keep_owned(std::vector<double>& column) const;
  /// Removes the halo from the state. \returns whether there was one
  bool drop_halo(State& state);

  /// Gives the particles their places along a space-filling curve, ties by the places before (spatial_order). They
  /// are in that order once they have been distributed. \pre no halo \param cell_size m
  void sort(const State& state, double cell_size);

  /// Particles that the first process has added behind its own come last in the order of all.
  void add(std::size_t count);
  /// Closes the gaps that particles leave which this and other processes take away. \param kept numbers of those that
  /// stay here, rising \returns how many all processes have taken away \pre no halo
  std::size_t remove(std::span<const std::uint32_t> kept);
  /// Gives the parts of particles that split the places behind the first of them, of one process too. \pre no halo
  /// \param source of each particle that there will be here which one it comes from, rising
  Parts split(std::span<const std::uint32_t> source);

  /// Reads the particles of all, in their order. \param to memory of the first process
  void read(const State& state, const ColumnPiece& piece, std::byte* to) const;
  /// Gives the first process what the walls received since the window began, all of it.
  void collect_window(WallLoads& loads) const;

  /// Has a sum of all processes added with the next votes, to what no step reads before: sums travel with what has to
  /// be known at once. For one process at once. \param add receives the sums over all processes
  void add_later(std::vector<FixedVector> sums, std::function<void(std::span<const FixedVector>)> add);
  /// The votes of all, and the sums that wait. \param here where the first particle is that has a fault, if any has
  /// \param report of it \throws NumericalError of the first one in the order of all, the same at every process
  void join(const State& state, Votes& votes, std::optional<std::size_t> here,
            const std::function<NumericalError::Report(std::size_t)>& report);

  /// What the process says whose particle comes first in the order of all. \param here none: it has no such particle
  NumericalError::Report report_of_first(std::optional<std::size_t> here,
                                         const std::function<NumericalError::Report(std::size_t)>& report) const;

  /// Joins what the walls received since the window began, so that each process has all of it.
  void join_window(WallLoads& loads) const;

  /// What the work of this process is among that of all since it began or resumed, and what sharing it takes, in words.
  /// \param pairs in the lists of this process
  std::string account(std::size_t pairs) const;

 private:
  double place_of(std::optional<std::size_t> here) const;
  NumericalError::Report told_by(double first, std::optional<std::size_t> here,
                                 const std::function<NumericalError::Report(std::size_t)>& report) const;
  void cut(std::span<const Vector3> points);
  std::vector<int> owners(const State& state);
  std::unique_ptr<Plan> send(State& state, std::span<std::vector<double>* const> carried, const ByRank& to,
                             const std::vector<std::uint32_t>* stay);
  ByRank halo_of_others(const State& state, const Domain& domain) const;
  std::vector<std::uint32_t> by_place(std::size_t own) const;

  const Ranks& ranks_;
  std::unique_ptr<Partition> partition_;
  std::size_t count_ = 0;            // of all processes
  std::size_t own_ = 0;              // of the particles of the lists here how many this process owns
  std::uint64_t work_ = 1;           // of each of them, as that of others
  std::vector<std::int64_t> place_;  // of the particles here, rising but between sort and distribute
  std::vector<char> is_halo_;        // of the particles here; empty: none is
  Halo halo_;
  double reach_ = 0, margin_ = 0;
  mutable TimeOfSteps time_;
  std::uint64_t least_owned_ = UINT64_MAX, most_owned_ = 0, moved_ = 0;  // of any process; from this one to others
  struct Waiting {
    std::vector<FixedVector> sums;
    std::function<void(std::span<const FixedVector>)> add;
  };
  std::vector<Waiting> waiting_;
};

}  // namespace talus::continuum
