// SPDX-License-Identifier: Apache-2.0
#include "physics/granular/fitted_table.hpp"

#include <algorithm>
#include <cmath>
#include <span>
#include <stdexcept>
#include <vector>

namespace talus::granular {

template <int columns, int degree>
void PieceTable<columns, degree>::append(double end, const double (&coefficients)[columns * (degree + 1)]) {
  if (pieces_ == max_pieces) throw std::logic_error("fitted functions: too many pieces");
  end_[pieces_] = end;
  std::copy(std::begin(coefficients), std::end(coefficients), coefficient_[pieces_++]);
}

template <int columns, int degree>
void PieceTable<columns, degree>::finish() {
  if (pieces_ == 0 || end_[pieces_ - 1] != max_fitted_strain)
    throw std::logic_error("fitted functions: the pieces do not end with the range");
  for (int piece = 0; piece + 1 < pieces_; ++piece) {
    const int bucket = bucket_of(end_[piece]);
    if (bucket == 0 || (piece > 1 && bucket == bucket_of(end_[piece - 2])))
      throw std::logic_error("fitted functions: three joints too close to be told apart");
    std::fill(first_ + bucket + 1, first_ + buckets, static_cast<unsigned char>(piece + 1));
  }
  // The range includes its end, and a look-up asks for two joints.
  for (int past = pieces_; past < max_pieces + 2; ++past) {
    end_[past] = 2 * max_fitted_strain;
    std::copy(std::begin(coefficient_[pieces_ - 1]), std::end(coefficient_[pieces_ - 1]), coefficient_[past]);
  }
}

template class PieceTable<4, 3>;
template class PieceTable<1, 3>;
template class PieceTable<1, 4>;

namespace {

std::vector<double> joints_of(std::initializer_list<const FittedFunction*> functions) {
  std::vector<double> joints;
  for (const FittedFunction* function : functions)
    for (int k = 0; k < function->pieces; ++k) joints.push_back(function->piece[k].end);
  std::sort(joints.begin(), joints.end());
  joints.erase(std::unique(joints.begin(), joints.end()), joints.end());
  return joints;
}

/// The piece that holds all up to `end`.
const Piece& piece_before(const FittedFunction& function, double end) {
  return *std::find_if(function.piece, function.piece + function.pieces,
                       [&](const Piece& piece) { return end <= piece.end; });
}

/// A polynomial without constant term, a (c0 + c1 a + c2 a^2 + c3 a^3), and its slope.
struct Curve {
  double c0, c1, c2, c3;
  double operator()(double a) const { return a * (c0 + a * (c1 + a * (c2 + a * c3))); }
  double slope(double a) const { return c0 + a * (2 * c1 + a * (3 * c2 + a * 4 * c3)); }
};

/// The first position in (begin, end] at which `holds` is true, or `end`.
template <class Predicate>
double first_place(double begin, double end, Predicate&& holds) {
  constexpr int samples = 512;
  double before = begin;
  for (int k = 1; k <= samples; ++k) {
    const double a = k == samples ? end : begin + (end - begin) * k / samples;
    if (holds(a)) {
      double after = a;
      while (true) {
        const double middle = 0.5 * (before + after);
        if (middle <= before || middle >= after) return after;
        (holds(middle) ? after : before) = middle;
      }
    }
    before = a;
  }
  return end;
}

}  // namespace

ComponentTable component_table(const FittedFunctions& functions) {
  ComponentTable table;
  for (const double end : joints_of({&functions.a1, &functions.a2, &functions.a3, &functions.a4})) {
    double c[16];
    double* next = c;
    for (const FittedFunction* function : {&functions.a1, &functions.a2, &functions.a3, &functions.a4}) {
      const Piece& piece = piece_before(*function, end);
      for (const double coefficient : {piece.c0, piece.c1, piece.c2, piece.c3}) *next++ = coefficient;
    }
    table.append(end, c);
  }
  table.finish();
  return table;
}

ShearTable shear_table(const FittedFunctions& functions) {
  ShearTable table;
  for (const Piece& piece : std::span(functions.a4.piece, static_cast<std::size_t>(functions.a4.pieces)))
    table.append(piece.end, {piece.c0, piece.c1, piece.c2, piece.c3});
  table.finish();
  return table;
}

PressureTable pressure_table(const FittedFunctions& functions) {
  constexpr double joined = 1e-6;  // a fall by less, at a joint, is none
  PressureTable table;
  double begin = 0, largest = 0;
  for (const double end : joints_of({&functions.a1, &functions.a2})) {
    const Piece& one = piece_before(functions.a1, end);
    const Piece& two = piece_before(functions.a2, end);
    const Curve curve{one.c0 + 2 * two.c0, one.c1 + 2 * two.c1, one.c2 + 2 * two.c2, one.c3 + 2 * two.c3};
    while (begin < end) {
      double next = end;
      if (curve(begin) >= largest * (1 - joined) && curve.slope(begin) > 0) {
        next = first_place(begin, end, [&](double a) { return curve.slope(a) <= 0; });
        table.append(next, {0, curve.c0, curve.c1, curve.c2, curve.c3});
        largest = curve(next);
      } else {
        next = first_place(begin, end, [&](double a) { return curve(a) > largest && curve.slope(a) > 0; });
        table.append(next, {largest, 0, 0, 0, 0});
      }
      begin = next;
    }
  }
  table.finish();
  return table;
}

double max_fitted_pressure(const Fits& fits) {
  return fits.scale * pressure_table(fits.functions())(max_fitted_strain) / std::sqrt(3.0);
}

}  // namespace talus::granular
