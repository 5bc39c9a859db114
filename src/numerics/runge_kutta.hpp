// SPDX-License-Identifier: Apache-2.0
/// Runge-Kutta methods. Coefficients of the first-order damped Runge-Kutta-Chebyshev method for stiff systems y' = f(y)
/// whose Jacobian has a real, negative spectrum. With s stages the stable interval on the negative axis grows like s^2,
/// so the cost of a stiff spring is the square root of the cost of explicit Euler.
///
///     Y_0 = y,  Y_1 = Y_0 + (w1/w0) h f(Y_0),
///     Y_j = mu_j Y_{j-1} + nu_j Y_{j-2} + step_j h f(Y_{j-1}),  j = 2..s,   y(t+h) = Y_s
///     mu_j = 2 w0 b_j/b_{j-1}, nu_j = -b_j/b_{j-2}, step_j = 2 w1 b_j/b_{j-1},
///     b_j = 1/T_j(w0), w0 = 1 + damping/s^2, w1 = T_s(w0)/T_s'(w0)
///
/// Source: P. J. van der Houwen & B. P. Sommeijer, Z. Angew. Math. Mech. 60, 479-485 (1980); J. G. Verwer, Appl. Numer.
/// Math. 22, 359-379 (1996).
#pragma once

#include <array>
#include <vector>

namespace talus {

struct ChebyshevStages {
  struct Stage {
    double previous;         ///< mu_j, weight of Y_{j-1}
    double before_previous;  ///< nu_j, weight of Y_{j-2}
    double rate;             ///< step_j, weight of h f(Y_{j-1})
    double time;             ///< c_j: Y_j approximates y(t + c_j h)
  };
  std::vector<Stage> stages;  ///< stages[j-1] makes Y_j; stages[0] uses Y_0 alone
  double stability;           ///< beta: stable for h |lambda| <= beta
  double second_order;        ///< coefficient of (h lambda)^2 in the stability polynomial; exact would be 1/2
};

/// \param stages >= 1 (one stage is explicit Euler with a slightly damped interval)
/// \param damping > 0; larger damps stiff modes more and shortens the interval: beta = (2 - 4/3 damping) s^2
ChebyshevStages chebyshev_stages(int stages, double damping);

/// Least number of stages that is stable for h |lambda| <= stiffness.
int stages_for(double stiffness, double damping);

// Coefficients of the Runge-Kutta pair of orders 5 and 4 of Dormand and Prince, for systems y' = f(y) that are not
// stiff. Its last stage is the rate at the new position, which the next step opens with: six evaluations a step.
//
//     Y_s = y + h sum_{r<s} weight[s][r] k_r,  k_s = f(Y_s),  s = 0..6,   y(t+h) = Y_6
//     error of the embedded solution of order 4: h sum_s error[s] k_s
//
// Source: J. R. Dormand & P. J. Prince, J. Comput. Appl. Math. 6, 19-26 (1980), table 2 (RK5(4)7M).

}  // namespace talus

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

namespace talus {}  // namespace talus
