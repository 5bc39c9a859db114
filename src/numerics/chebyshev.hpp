// SPDX-License-Identifier: Apache-2.0
/// Coefficients of the first-order damped Runge-Kutta-Chebyshev method for stiff systems y' = f(y) whose Jacobian has a
/// real, negative spectrum. With s stages the stable interval on the negative axis grows like s^2, so the cost of a
/// stiff spring is the square root of that of explicit Euler.
///
///     Y_0 = y,  Y_1 = Y_0 + (w1/w0) h f(Y_0),
///     Y_j = mu_j Y_{j-1} + nu_j Y_{j-2} + step_j h f(Y_{j-1}),  j = 2..s,   y(t+h) = Y_s
///     mu_j = 2 w0 b_j/b_{j-1}, nu_j = -b_j/b_{j-2}, step_j = 2 w1 b_j/b_{j-1},
///     b_j = 1/T_j(w0), w0 = 1 + damping/s^2, w1 = T_s(w0)/T_s'(w0)
///
/// Source: P. J. van der Houwen & B. P. Sommeijer, Z. Angew. Math. Mech. 60, 479-485 (1980); J. G. Verwer, Appl. Numer.
/// Math. 22, 359-379 (1996).
#pragma once

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

}  // namespace talus
