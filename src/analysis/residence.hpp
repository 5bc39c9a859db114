// SPDX-License-Identifier: Apache-2.0
/// How long layers of a bed stay in a vessel: particles are tagged by their height when the gate opens, and the times
/// at which they pass the outlet are read off the snapshots.
#pragma once

#include <cstdint>
#include <unordered_map>
#include <vector>

#include "numerics/snapshot.hpp"

namespace talus {

struct LayerResidence {
  double low = 0, high = 0;              ///< heights at the start, m
  double particles = 0;                  ///< of the layer
  double share_out = 0;                  ///< of them, that have left by the end
  double first = 0, mean = 0, last = 0;  ///< times of those, s; nan if none has
};

class Residence {
 public:
  /// \param start with the columns position and identity \param outlet its height, m; what is below does not count
  /// \param layers of equal height from the outlet to the highest particle
  Residence(const Snapshot& start, double outlet, std::size_t layers);

  /// The next snapshot. A particle that it shows below the outlet, and the one before above, has passed in between,
  /// where a straight way between both positions meets the height; one that it no longer shows, half-way in time.
  /// \param time from the opening of the gate, s
  void take(const Snapshot& next, double time);

  std::vector<LayerResidence> layers() const;

 private:
  struct Tagged {
    std::size_t layer;
    double height, passed;  // m; s, nan until it has
    std::size_t seen;       // in which snapshot last
  };
  double outlet_, low_, step_ = 0, time_ = 0;
  std::size_t count_, taken_ = 0;
  std::unordered_map<std::int64_t, Tagged> tagged_;
};

}  // namespace talus
