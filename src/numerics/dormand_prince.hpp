// SPDX-License-Identifier: Apache-2.0
/// Coefficients of the Runge-Kutta pair of orders 5 and 4 of Dormand and Prince, for systems y' = f(y) that are not
/// stiff. Its last stage is the rate of the new place, which the next step opens with: six evaluations a step.
///
///     Y_s = y + h sum_{r<s} weight[s][r] k_r,  k_s = f(Y_s),  s = 0..6,   y(t+h) = Y_6
///     error of the embedded solution of order 4: h sum_s error[s] k_s
///
/// Source: J. R. Dormand & P. J. Prince, J. Comput. Appl. Math. 6, 19-26 (1980), table 2 (RK5(4)7M).
#pragma once

#include <array>

namespace talus::dormand_prince {

inline constexpr std::size_t stages = 7;
inline constexpr int order = 5;
inline constexpr int evaluations = 6;  ///< a step, the first rate being the last of the step before

inline constexpr std::array<std::array<double, stages - 1>, stages> weight{{
    {},
    {1.0 / 5},
    {3.0 / 40, 9.0 / 40},
    {44.0 / 45, -56.0 / 15, 32.0 / 9},
    {19372.0 / 6561, -25360.0 / 2187, 64448.0 / 6561, -212.0 / 729},
    {9017.0 / 3168, -355.0 / 33, 46732.0 / 5247, 49.0 / 176, -5103.0 / 18656},
    {35.0 / 384, 0, 500.0 / 1113, 125.0 / 192, -2187.0 / 6784, 11.0 / 84},
}};

inline constexpr std::array<double, stages> error{71.0 / 57600,      0,          -71.0 / 16695, 71.0 / 1920,
                                                  -17253.0 / 339200, 22.0 / 525, -1.0 / 40};

/// Stable for h |lambda| up to this on the negative axis, where the stability polynomial has size 1 (3.306).
inline constexpr double stability = 3.3;

}  // namespace talus::dormand_prince
