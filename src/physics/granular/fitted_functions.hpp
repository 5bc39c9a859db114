// SPDX-License-Identifier: Apache-2.0
/// The functions A1 to A4 of Yuu & Umekage's constitutive equations, fitted to discrete-element results of 200 um glass
/// beads at a packing of 0.6, as data: as printed, and repaired so that they join. A1, A2, A3 in Pa, A4 in 1; the
/// argument a = |Ea| = (Ea_ij Ea_ij)^(1/2) is a number.
/// Source: Yuu & Umekage 2011, Appendix B. A5 and A6 are zero, "omitted in this paper".
/// Range: 0 <= a <= 0.035. Beyond, the polynomials make no sense (A1 < 0 at 0.05, a friction of 21 at 0.1).
/// deviates: A_n(a) = A_n(0.035) 0.035/a beyond 0.035, so that the stress of a proportional strain stays constant
/// (fitted_table.hpp).
#pragma once

namespace talus::granular {

/// c3 a^3 + c2 a^2 + c1 a + c0 from the end of the piece before up to `end`, which belongs to the next.
struct Piece {
  double end, c3, c2, c1, c0;
};

struct FittedFunction {
  int pieces;
  Piece piece[9];
};

struct FittedFunctions {
  FittedFunction a1, a2, a3, a4;
};

/// The end of every fit.
inline constexpr double max_fitted_strain = 0.035;

/// Appendix B to the digit. Two digits of terms that nearly cancel: most joints jump, by per cent of the left value
///     A1 at 2e-4 +17, 1e-3 +15, 3.5e-3 +52, 7e-3 -78;  A2 at 2.5e-3 +31, 7e-3 -20;  A3 at 1.65e-4 +23, 1.75e-4 -23,
///     4e-4 +115, and nothing but rounding above 3.4e-3;  A4 at 1.9e-3 -14, 1.5e-2 -13.
// clang-format off
inline constexpr FittedFunctions printed_2011 = {
    // A1
    {8, {{4.5e-5, 0, 9.4e13, 2.0e9, 9.0e5},
         {5e-5, 0, -8.0e14, 8.0e10, -8.0e5},
         {2e-4, -1.2e17, 6.7e13, -1.4e10, 1.7e6},
         {4e-4, 0, 1.2e12, -2.1e9, 1.1e6},
         {1e-3, -3.6e14, 1.2e12, -1.5e9, 9.0e5},
         {3.5e-3, -3.8e12, 4.1e10, -2.0e8, 4.4e5},
         {7e-3, -1.4e12, 2.7e10, -1.6e8, 4.1e5},
         {3.5e-2, -6.2e8, 5.5e7, -2.1e6, 4.1e4}}},
    // A2
    {9, {{4.5e-5, 0, 9.4e13, 2.0e9, 3.0e5},
         {5.5e-5, 0, -8.0e14, 8.0e10, -1.4e6},
         {1.6e-4, 7.8e16, -6.2e12, -4.8e9, 8.5e5},
         {4.5e-4, -7.0e15, 7.4e12, -2.6e9, 5.0e5},
         {1e-3, -2.3e14, 6.2e11, -5.7e8, 3.3e5},
         {2.5e-3, 1.7e13, -9.5e10, 1.2e8, 1.0e5},
         {7e-3, -2.7e11, 6.9e9, -5.8e7, 2.0e5},
         {1.2e-2, 0, 3.1e8, -8.5e6, 7.6e4},
         {3.5e-2, 0, 1.5e6, -5.7e5, 2.6e4}}},
    // A3
    {8, {{1.65e-4, 0, 7.3e12, 7.3e7, 3.0e5},
         {1.75e-4, 0, -1.8e14, 6.2e10, -4.7e6},
         {4e-4, 1.5e16, -1.1e13, 5.7e8, 6.5e5},
         {1.6e-3, -1.2e14, 5.1e11, -7.4e8, 3.9e5},
         {4e-3, -9.0e11, 1.1e10, -4.8e7, 7.4e4},
         {7e-3, -2.3e10, 1.5e9, -1.4e7, 3.2e4},
         {1.5e-2, 6.7e9, -2.8e8, 3.9e6, -1.9e4},
         {3.5e-2, 0, -2.2e5, 4.4e4, -1.9e3}}},
    // A4
    {7, {{1.1e-4, 0, 4.6e10, 1.4e6, 1.5e3},
         {1.3e-4, 0, -3.0e11, 7.2e7, -2.1e3},
         {5.5e-4, 3.1e12, -5.7e8, -3.7e6, 2.7e3},
         {1.9e-3, -3.9e11, 1.9e9, -3.2e6, 2.3e3},
         {6e-3, -2.7e9, 4.6e7, -2.8e5, 7.3e2},
         {1.5e-2, -7.4e7, 3.1e6, -4.6e4, 3.0e2},
         {3.5e-2, 0, 6.9e4, -5.0e3, 1.1e2}}}};
// clang-format on

/// The same with other digits behind the printed ones, so that the pieces join: every coefficient rounds to the printed
/// one (A1's third coefficient on [0.0035, 0.007) excepted: 2.5e10 is taken for the printed 2.7e10, which no rounding
/// of the other coefficients joins to its neighbours), neighbours meet to 1e-6, A1, A2 and A4 rise to one peak (at
/// 5e-5, 5e-5 and 1.2e-4) and fall from there, A3 does so up to 0.004. Among all such coefficients these differ least
/// from the print, in the mean of the squared relative difference over log a. Found by
/// tools/repair_fitted_functions.py. Where two printed pieces contradict each other the repair lies between them. So
/// the friction A4 a/sqrt(2), 0.61 left and 0.54 right of 0.015 in print, reads 0.55 there, at its highest: 28.9
/// degrees.
// clang-format off
inline constexpr FittedFunctions repaired_2011 = {
    // A1
    {8, {{4.5e-5, 0, 9.351e13, 1.951e9, 8.951e5},
         {5e-5, 0, -7.97218368e14, 7.97218368e10, -8.00862711e5},
         {2e-4, -1.151e17, 6.749e13, -1.39290702e10, 1.73429922e6},
         {4e-4, 0, 1.249e12, -2.051e9, 1.08752518e6},
         {1e-3, -3.551e14, 1.249e12, -1.51312105e9, 8.951e5},
         {3.5e-3, -3.751e12, 4.149e10, -1.96960049e8, 4.351e5},
         {7e-3, -1.449e12, 2.53312638e10, -1.60032544e8, 4.051e5},
         {3.5e-2, -6.17263063e8, 5.52468946e7, -2.12689395e6, 4.149e4}}},
    // A2
    {9, {{4.5e-5, 0, 9.39941217e13, 1.99908345e9, 3.00003056e5},
         {5.5e-5, 0, -8.00326502e14, 7.99725383e10, -1.39780315e6},
         {1.6e-4, 7.82537203e16, -6.18972545e12, -4.77851944e9, 8.48221815e5},
         {4.5e-4, -7.049e15, 7.351e12, -2.58953053e9, 5.0074096e5},
         {1e-3, -2.349e14, 6.15633638e11, -5.69935451e8, 3.349e5},
         {2.5e-3, 1.749e13, -9.451e10, 1.23208187e8, 9.951e4},
         {7e-3, -2.749e11, 6.851e9, -5.7914117e7, 1.96386072e5},
         {1.2e-2, 0, 3.07399038e8, -8.451e6, 7.649e4},
         {3.5e-2, 0, 1.5047003e6, -5.68674984e5, 2.59508845e4}}},
    // A3
    {8, {{1.65e-4, 0, 7.33034217e12, 7.30149684e7, 3.00084201e5},
         {1.75e-4, 0, -1.849e14, 6.18695169e10, -4.66286755e6},
         {4e-4, 1.549e16, -1.06211857e13, 5.651e8, 6.451e5},
         {1.6e-3, -1.20712234e14, 5.149e11, -7.41620337e8, 3.851e5},
         {4e-3, -9.049e11, 1.07213358e10, -4.751e7, 7.449e4},
         {7e-3, -2.349e10, 1.451e9, -1.40312168e7, 3.249e4},
         {1.5e-2, 6.651e9, -2.849e8, 3.9288885e6, -1.851e4},
         {3.5e-2, 0, -2.151e5, 4.449e4, -1.851e3}}},
    // A4
    {7, {{1.1e-4, 0, 4.60155665e10, 1.40093164e6, 1.50000721e3},
         {1.3e-4, 0, -2.96801332e11, 7.20125936e7, -2.11919114e3},
         {5.5e-4, 3.149e12, -5.651e8, -3.651e6, 2.70376536e3},
         {1.9e-3, -3.949e11, 1.87387937e9, -3.151e6, 2.28059047e3},
         {6e-3, -2.65784714e9, 4.551e7, -2.79571079e5, 7.349e2},
         {1.5e-2, -7.449e7, 3.051e6, -4.57244481e4, 3.0233907e2},
         {3.5e-2, 0, 6.86348634e4, -5.049e3, 1.11835755e2}}}};
// clang-format on

}  // namespace talus::granular
