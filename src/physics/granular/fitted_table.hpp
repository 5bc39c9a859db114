// SPDX-License-Identifier: Apache-2.0
/// Fitted functions, ready to be evaluated in the inner loop: one look-up finds the polynomials of all functions of one
/// argument, by the leading bits of the argument, and the same numbers come out for a number alone and for lanes.
#pragma once

#include <array>
#include <string_view>

#include "base/parameter.hpp"
#include "base/simd.hpp"
#include "physics/granular/fitted_functions.hpp"

namespace talus::granular {

/// Polynomials of `degree` in pieces, `columns` functions side by side, on 0 to max_fitted_strain.
template <int columns, int degree>
class PieceTable {
 public:
  static constexpr int max_pieces = 64;

  /// The functions at `a` >= 0; beyond the range at its end (see beyond_range).
  template <class Number>
  void evaluate(const Number& a, Number (&value)[columns]) const {
    const Number inside = minimum(a, Number(max_fitted_strain));
    Number c[columns * (degree + 1)];
    gather_rows(
        inside, [this](double x) { return row_of(x); }, c);
    for (int k = 0; k < columns; ++k) {
      value[k] = c[k * (degree + 1) + degree];
      for (int power = degree - 1; power >= 0; --power)
        value[k] = multiply_add(value[k], inside, c[k * (degree + 1) + power]);
    }
  }
  /// Of a table of one function.
  template <class Number>
  Number operator()(const Number& a) const requires(columns == 1) {
    Number value[1];
    evaluate(a, value);
    return value[0];
  }

  /// Adds the piece that follows. \param coefficients of one function after another, lowest power first
  void append(double end, const double (&coefficients)[columns * (degree + 1)]);
  /// Completes the look-up; the last piece ends at max_fitted_strain.
  /// \throws std::logic_error if three joints lie within 1/64 of an octave, too close for the look-up to separate them
  /// apart
  void finish();

  int pieces() const { return pieces_; }
  double end(int piece) const { return end_[piece]; }

 private:
  // A bucket is 1/64 of an octave, from 2^-15 = 3.05e-5, below all joints; two joints a bucket at most.
  static constexpr int shift = 52 - 6;
  static constexpr long long min_key = (1023LL - 15) << 6;
  static constexpr int buckets = 64 * 11;

  static int bucket_of(double a) {
    const long long key = (__builtin_bit_cast(long long, a) >> shift) - min_key;
    return key < 0 ? 0 : key < buckets ? static_cast<int>(key) : buckets - 1;
  }
  const double* row_of(double a) const {
    const int piece = first_[bucket_of(a)];
    return coefficient_[piece + (a >= end_[piece] ? 1 : 0) + (a >= end_[piece + 1] ? 1 : 0)];
  }

  int pieces_ = 0;
  double end_[max_pieces + 2] = {};
  double coefficient_[max_pieces + 2][columns * (degree + 1)] = {};
  unsigned char first_[buckets] = {};  // the piece in which the bucket begins
};

/// Factor that carries A_n beyond the range of the fits: A_n(a) = A_n(0.035) 0.035/a.
template <class Number>
Number beyond_range(const Number& a) {
  return max_fitted_strain / maximum(a, Number(max_fitted_strain));
}

/// A1, A2, A3 (Pa) and A4 at one argument: what the printed component formulas need.
using ComponentTable = PieceTable<4, 3>;
ComponentTable component_table(const FittedFunctions& functions);

/// A4 alone.
using ShearTable = PieceTable<1, 3>;
ShearTable shear_table(const FittedFunctions& functions);

/// P(a) = (A1 + 2 A2) a, Pa: sqrt(3) times the pressure at the volumetric strain a/sqrt(3) and alpha = f = 1. Where the
/// print lets P fall with the compression (by a fifth between 0.0027 and 0.007) it stays at its largest value before:
/// a pressure that falls with the density would let the grains collapse without bound.
using PressureTable = PieceTable<1, 4>;
PressureTable pressure_table(const FittedFunctions& functions);

enum class Tables { repaired, printed };

/// The fits as a law takes them: the keys that the fitted laws have in common.
struct Fits {
  Tables tables = Tables::repaired;
  double scale = 9.80;          ///< alpha, stress of the real field over that of the fits' (130 Pa at the bottom)
  double max_deviator = 0.014;  ///< |e_dev| beyond which A4 |e_dev| no longer changes

  const FittedFunctions& functions() const { return tables == Tables::printed ? printed_2011 : repaired_2011; }
};

template <class Visit, class F>
void for_each_fit_parameter(Visit&& visit, F& fits) {
  visit(
      Parameter{"tables",
                {},
                {},
                "fitted functions A1 to A4: with coefficients that round to the printed ones and join, or as printed"},
      fits.tables);
  visit(Parameter{"scale", dimension::none, above(0),
                  "alpha: rho_b g h_m over 130 Pa, the stress at the bottom of the bed over that of the fits"},
        fits.scale);
}

/// \param largest range of the key
template <class Visit, class F>
void visit_max_deviator(Visit&& visit, F& fits, const Range& largest) {
  visit(Parameter{"max_deviator", dimension::none, largest,
                  "|e_dev| beyond which shear no longer hardens or softens the grains; the fits end at 0.035"},
        fits.max_deviator);
}

/// Up to where the fits go.
constexpr Range within_fits() {
  return {.min = 0, .max = max_fitted_strain, .min_excluded = true};
}

/// Where the loading curve of the pressure ends with the fits, at f = 1, Pa.
double max_fitted_pressure(const Fits& fits);

/// Diameter of the grains that were fitted, m.
inline constexpr double fitted_diameter = 200e-6;

}  // namespace talus::granular

namespace talus {
template <>
inline constexpr auto choices<granular::Tables> = std::to_array<std::string_view>({"repaired", "printed"});
}  // namespace talus
