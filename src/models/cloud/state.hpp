// SPDX-License-Identifier: Apache-2.0
/// The state of a cloud: its fields and counters, each defined once.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vector.hpp"
#include "numerics/field.hpp"

namespace talus::cloud {

struct State {
  double time = 0;         ///< s
  std::uint64_t step = 0;  ///< steps taken

  std::vector<Vector3> position;  ///< m
  std::vector<double> radius;     ///< m

  // Derived from position and radius at the end of every step.
  std::vector<Vector3> velocity;       ///< m/s, Eq. 4a
  std::vector<Vector3> contact_force;  ///< N, on the grain, from grains and slope
  std::vector<double> overlap;         ///< m, the grain's largest, with a grain or the slope; 0 if it touches none

  // Warm starts and memory of the step control: kept, so that a resumed run takes the same steps.
  std::vector<Vector3> increment;           ///< m, the last step's displacement
  std::vector<Vector3> stiff_mode;          ///< unit vector of the stiffest motion found so far
  std::vector<std::int64_t> spatial_order;  ///< order in which the pair sum stores the grains
  double sum_cutoff = 0;                    ///< m, of the spectral sum; 0: the sum is direct
  double last_step = 0;                     ///< s, length of the last step; 0 before the first
  double next_step = 0;                     ///< s, proposed by the error control
  double spectral_radius = 0;               ///< 1/s, estimate of the stiffest rate
  std::uint64_t stages = 0;                 ///< stages of the last step
  std::uint64_t evaluations = 0;            ///< of all velocities, since the start
  std::uint64_t rejected_steps = 0;         ///< since the start
};

template <class Visit, class S>
void for_each_field(Visit&& visit, S& s) {
  visit(FieldInfo{"time", "s"}, s.time);
  visit(FieldInfo{"step", "1"}, s.step);
  visit(FieldInfo{"position", "m"}, s.position);
  visit(FieldInfo{"radius", "m"}, s.radius);
  visit(FieldInfo{"velocity", "m/s", FieldRole::derived}, s.velocity);
  visit(FieldInfo{"contact_force", "N", FieldRole::derived}, s.contact_force);
  visit(FieldInfo{"overlap", "m", FieldRole::derived}, s.overlap);
  visit(FieldInfo{"increment", "m", FieldRole::kept, false}, s.increment);
  visit(FieldInfo{"stiff_mode", "1", FieldRole::kept, false}, s.stiff_mode);
  visit(FieldInfo{"spatial_order", "1", FieldRole::kept, false}, s.spatial_order);
  visit(FieldInfo{"sum_cutoff", "m"}, s.sum_cutoff);
  visit(FieldInfo{"last_step", "s"}, s.last_step);
  visit(FieldInfo{"next_step", "s"}, s.next_step);
  visit(FieldInfo{"spectral_radius", "1/s"}, s.spectral_radius);
  visit(FieldInfo{"stages", "1"}, s.stages);
  visit(FieldInfo{"evaluations", "1"}, s.evaluations);
  visit(FieldInfo{"rejected_steps", "1"}, s.rejected_steps);
}

}  // namespace talus::cloud
