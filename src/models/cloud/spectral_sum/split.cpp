// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/spectral_sum/split.hpp"

#include <array>
#include <cmath>
#include <numbers>
#include <span>

namespace talus::cloud {

namespace {

using hydrodynamics::PairMobility;

constexpr int quadrature_points = 48;

/// Nodes and weights of Gauss and Legendre on [0, 1], by Newton's iteration.
void gauss_legendre(std::vector<double>& node, std::vector<double>& weight) {
  constexpr int n = quadrature_points;
  for (int k = 0; k < n; ++k) {
    double x = std::cos(std::numbers::pi * (k + 0.75) / (n + 0.5)), slope = 1;
    for (int iteration = 0; iteration < 8; ++iteration) {
      double before = 1, value = x;
      for (int j = 2; j <= n; ++j) {
        const double next = ((2 * j - 1) * x * value - (j - 1) * before) / j;
        before = value, value = next;
      }
      slope = n * (x * value - before) / (x * x - 1);
      x -= value / slope;
    }
    node.push_back(0.5 * (1 + x));
    weight.push_back(1 / ((1 - x * x) * slope * slope));
  }
}

/// Powers of v from Chebyshev's polynomials.
std::vector<double> to_powers(const std::vector<double>& chebyshev) {
  const std::size_t count = chebyshev.size();
  std::vector<double> powers(count, 0.0), before(count, 0.0), latest(count, 0.0);
  before[0] = 1;
  if (count > 1) latest[1] = 1;
  for (std::size_t k = 0; k < count; ++k) {
    const std::vector<double>& t = k == 0 ? before : latest;
    for (std::size_t n = 0; n < count; ++n) powers[n] += chebyshev[k] * t[n];
    if (k == 0) continue;
    std::vector<double> next(count, 0.0);
    for (std::size_t n = 0; n < count; ++n) next[n] = (n > 0 ? 2 * latest[n - 1] : 0.0) - before[n];
    before = latest, latest = next;
  }
  return powers;
}

}  // namespace

Split::Split(double beta, int order) : order_(order) {
  gauss_legendre(node_, weight_);
  const double half = std::log(0.5 * beta);
  for (int k = 0; k < 200; ++k) {
    const double term = std::exp((2 * k + order) * half - std::lgamma(k + 1.0) - std::lgamma(k + order + 1.0) - beta);
    if (k > beta && term < 1e-18) break;
    series_.push_back(term);
  }
  double mass = 0;
  for (std::size_t k = 0; k < node_.size(); ++k) mass += 2 * weight_[k] * window(node_[k] * node_[k], 0);
  for (double& term : series_) term /= mass;
}

double Split::window(double square, int derivative) const {
  const double y = 1 - square;
  if (!(y > 0)) return 0;
  double sum = 0;
  for (std::size_t k = series_.size(); k-- > 0;) {
    double factor = 1;
    for (int d = 0; d < derivative; ++d) factor *= -(static_cast<double>(k) + order_ - d);
    sum = sum * y + factor * series_[k];
  }
  return sum * std::pow(y, order_ - derivative);
}

double Split::mean(double square, int derivative) const {
  double sum = 0;
  for (std::size_t k = 0; k < node_.size(); ++k) {
    const double x = node_[k] * node_[k];
    sum += weight_[k] * std::pow(x, derivative) * window(square * x, derivative);
  }
  return sum;
}

// With (1/t) d/dt = 2 d/d(t^2) and F'/t = 2 Q, F'' = 2 phi:
//   stokeslet: isotropic F'' + F'/t, radial (F'/t - F'')/t^2 = -4 Q';
//   dipole, h = F''/2 + F'/t = phi + 2 Q: isotropic -h'/t = -2 (phi' + 2 Q'), radial -4 (phi'' + 2 Q'').
PairMobility<double> Split::stokeslet(double r) const {
  if (r >= 1) return hydrodynamics::oseen_with_size(1 / r, 0.0);
  const double u = r * r;
  return {2 * (window(u, 0) + mean(u, 0)), -4 * mean(u, 1)};
}

PairMobility<double> Split::dipole(double r) const {
  if (r >= 1) return {1 / (r * r * r), -3 / (r * r * r * r * r)};
  const double u = r * r;
  return {-2 * (window(u, 1) + 2 * mean(u, 1)), -4 * (window(u, 2) + 2 * mean(u, 2))};
}

std::vector<double> Split::polynomials(int degree) const {
  const int count = degree + 1;
  std::array<std::vector<double>, 4> value;
  for (int k = 0; k < count; ++k) {
    const double v = std::cos(std::numbers::pi * (k + 0.5) / count), r = std::sqrt(0.5 * (1 + v));
    const PairMobility<double> s = stokeslet(r), d = dipole(r);
    value[0].push_back(s.isotropic), value[1].push_back(s.radial);
    value[2].push_back(d.isotropic), value[3].push_back(d.radial);
  }
  std::vector<double> powers;
  for (const std::vector<double>& f : value) {
    std::vector<double> chebyshev;
    for (int n = 0; n < count; ++n) {
      double sum = 0;
      for (int k = 0; k < count; ++k) sum += f[k] * std::cos(std::numbers::pi * n * (k + 0.5) / count);
      chebyshev.push_back((n == 0 ? 1.0 : 2.0) / count * sum);
    }
    const std::vector<double> p = to_powers(chebyshev);
    powers.insert(powers.end(), p.begin(), p.end());
  }
  return powers;
}

}  // namespace talus::cloud
