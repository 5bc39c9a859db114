// SPDX-License-Identifier: Apache-2.0
/// The stiffest point of a loading curve, from which the speed of sound follows.
#pragma once

#include <algorithm>
#include <vector>

namespace talus::granular {

/// Largest slope of a curve that is smooth between its joints, from 0 to the last; jumps at joints do not count.
/// \param curve strain -> stress, Pa; \param joints any order, > 0
template <class Curve>
double steepest_slope(Curve&& curve, std::vector<double> joints) {
  std::sort(joints.begin(), joints.end());
  constexpr int samples = 256;
  double begin = 0, steepest = 0;
  for (const double end : joints) {
    const double step = (end - begin) / samples;
    for (int k = 0; k < samples; ++k) {
      const double e = begin + (k + 0.5) * step, d = 1e-3 * step;
      steepest = std::max(steepest, (curve(e + d) - curve(e - d)) / (2 * d));
    }
    begin = end;
  }
  return steepest;
}

}  // namespace talus::granular
