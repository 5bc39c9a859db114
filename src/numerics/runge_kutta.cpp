// SPDX-License-Identifier: Apache-2.0
#include "numerics/runge_kutta.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace talus {

ChebyshevStages chebyshev_stages(int stages, double damping) {
  if (stages < 1 || !(damping > 0)) throw std::invalid_argument("Chebyshev stages: at least one stage, damping > 0");
  const double s = stages;
  const double w0 = 1 + damping / (s * s);

  // T_j(w0) and its first two derivatives by the three-term recurrence.
  std::vector<double> t(stages + 1), dt(stages + 1), ddt(stages + 1);
  t[0] = 1, t[1] = w0, dt[0] = 0, dt[1] = 1, ddt[0] = 0, ddt[1] = 0;
  for (int j = 2; j <= stages; ++j) {
    t[j] = 2 * w0 * t[j - 1] - t[j - 2];
    dt[j] = 2 * t[j - 1] + 2 * w0 * dt[j - 1] - dt[j - 2];
    ddt[j] = 4 * dt[j - 1] + 2 * w0 * ddt[j - 1] - ddt[j - 2];
  }
  const double w1 = t[stages] / dt[stages];

  ChebyshevStages result;
  result.stages.resize(stages);
  result.stages[0] = {1, 0, w1 / w0, w1 / w0};
  for (int j = 2; j <= stages; ++j) {
    const double ratio = t[j - 1] / t[j];
    result.stages[j - 1] = {2 * w0 * ratio, -t[j - 2] / t[j], 2 * w1 * ratio, w1 * dt[j] / t[j]};
  }
  // Until its argument w0 + w1 z has fallen to -1 the polynomial T_s(w0 + w1 z)/T_s(w0) stays within 1/T_s(w0), which
  // is about 1 - damping: stiff modes die out.
  result.stability = (w0 + 1) / w1;
  result.second_order = 0.5 * w1 * w1 * ddt[stages] / t[stages];
  return result;
}

int stages_for(double stiffness, double damping) {
  int stages = 1;
  if (stiffness > 0) {
    const double estimate = std::sqrt(stiffness / (2 - 4.0 / 3.0 * damping));
    if (!(estimate < 1e6)) throw std::invalid_argument("Chebyshev stages: stiffness is not finite or absurd");
    stages = std::max(1, static_cast<int>(estimate) - 1);
  }
  while (chebyshev_stages(stages, damping).stability < stiffness) ++stages;
  return stages;
}

}  // namespace talus
