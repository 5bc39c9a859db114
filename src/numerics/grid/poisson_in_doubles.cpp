// SPDX-License-Identifier: Apache-2.0
/// The pressure's equation by conjugate gradients in double precision, for what single precision does not resolve.
/// Rare, so that clarity comes before speed; the preconditioner is the same cycle of the multigrid.
#include "numerics/grid/poisson.hpp"
#include "numerics/grid/runs.hpp"

namespace talus {

struct PoissonSolver::SystemOfDoubles {
  PoissonSolver& s;
  ThreadTeam& team;

  /// Sum of term(colour, row) over all runs, as PoissonSolver::sum; pads count nothing.
  template <class Term>
  double sum(Term&& term) {
    return s.sum_over_runs(team, [&](int colour, std::size_t r, std::size_t, int) { return term(colour, r); });
  }
  double product(const std::vector<double>& a, const auto& b) {
    return sum([&](int colour, std::size_t r) {
      const std::size_t own = s.board_.run(colour, r), end = own + static_cast<std::size_t>(s.board_.length(colour, r));
      double part = 0;
      for (std::size_t c = own; c < end; ++c) part += a[c] * static_cast<double>(b[c]);
      return part;
    });
  }

  double residual_square() { return product(s.residual_, s.residual_); }
  double apply_to_direction() {
    s.neighbours_.refresh(s.board_.columns(s.direction_of_doubles_));
    const std::array<const double*, 3> low{s.matrix_.low[0].data(), s.matrix_.low[1].data(), s.matrix_.low[2].data()};
    return sum([&](int colour, std::size_t r) {
      const Runs<double> runs(s.board_, low, s.direction_of_doubles_.data(), colour, r);
      const std::size_t own = s.board_.run(colour, r);
      double part = 0;
      for (int m = 0; m < s.board_.length(colour, r); ++m) {
        const std::size_t c = own + static_cast<std::size_t>(m);
        const double out = s.matrix_.diagonal[c] * s.direction_of_doubles_[c] - runs.inflow(m);
        s.applied_of_doubles_[c] = out;
        part += out * s.direction_of_doubles_[c];
      }
      return part;
    });
  }
  void advance(double step) {
    for (std::size_t c = 0; c < s.value_.size(); ++c) {
      s.value_[c] += step * s.direction_of_doubles_[c];
      s.residual_[c] -= step * s.applied_of_doubles_[c];
    }
  }
  /// The preconditioner: z := M r with r over its norm, so that single precision holds it.
  double apply(double norm) {
    for (std::size_t c = 0; c < s.residual_.size(); ++c)
      s.multigrid_.residual()[c] = static_cast<float>(s.residual_[c] / norm);
    s.multigrid_.precondition(team);
    if (!s.closed_.empty()) s.remove_constants(s.multigrid_.correction());
    scale = norm * s.scale_;
    return scale * product(s.residual_, s.multigrid_.correction());
  }
  void update_direction(double beta) {
    for (std::size_t c = 0; c < s.direction_of_doubles_.size(); ++c)
      s.direction_of_doubles_[c] =
          scale * static_cast<double>(s.multigrid_.correction()[c]) + beta * s.direction_of_doubles_[c];
  }
  double scale = 1;
};

/// From value_ and its residual until that is `enough`.
ConjugateGradients PoissonSolver::solve_in_doubles(ThreadTeam& team, double enough, int max_iterations) {
  remove_means(residual_);
  direction_of_doubles_.assign(board_.size(), 0);
  applied_of_doubles_.assign(board_.size(), 0);
  SystemOfDoubles system{*this, team};
  return solve_by_conjugate_gradients(system, system, 0.9 * enough, max_iterations);
}

}  // namespace talus
