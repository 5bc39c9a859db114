// SPDX-License-Identifier: Apache-2.0
/// The loops of the pressure solver over a run of cells of one colour (Checkerboard). They are separate functions so
/// that the compiler vectorises them. Sums are interleaved, so that vectors of any width add in the same order.
#pragma once

#include <cstddef>

#include "numerics/grid/runs.hpp"

namespace talus::run_loops {

/// run[m] := row[2 m]: one colour of a row along x. \returns whether a number is positive in one of `run` (before) and
/// `row`, and not in the other
bool take(int length, const double* row, double* __restrict run);
void take(int length, const float* row, float* __restrict run);

/// run[m] += row[2 m].
void add_strided(int length, const double* row, double* __restrict run);

/// row[2 m] := run[m].
void put(int length, const double* run, double* __restrict row);
void put(int length, const float* run, float* __restrict row);

/// to[m] += from[m].
void add(int length, const float* from, float* __restrict to);
/// to[m] += factor from[m].
void add(std::size_t length, double factor, const float* from, double* __restrict to);
/// to[m] := factor from[m].
void scale(std::size_t length, double factor, const double* from, float* __restrict to);
/// to[m] := 1/from[m], 0 for 0.
void invert(std::size_t length, const float* from, float* __restrict to);

/// diagonal := conductances around + outside; \returns the largest
double find_diagonal(int length, const Runs<double>& around, const double* outside, double* __restrict diagonal);
void find_diagonal(int length, const Runs<float>& around, const float* outside, float* __restrict diagonal);

/// residual := source - (diagonal value - inflow); \returns its square
double find_residual(int length, const Runs<double>& around, const double* diagonal, const double* value,
                     const double* source, double* __restrict residual);

/// applied := diagonal x - inflow; \returns its product with x
double apply(int length, const Runs<float>& around, const float* diagonal, const float* x, float* __restrict applied);

/// x := inverse source.
void relax_from_zero(int length, const float* source, const float* inverse, float* __restrict x);
/// x := inverse (source + inflow).
void relax(int length, const Runs<float>& around, const float* source, const float* inverse, float* __restrict x);
/// to[m] += inflow.
void add_inflow(int length, const Runs<float>& around, float* __restrict to);

double product(int length, const float* a, const float* b);
double square(int length, const double* a);
/// direction := correction + beta direction.
void update_direction(std::size_t length, float beta, const float* correction, float* __restrict direction);
/// x += step direction, residual -= step applied; \returns the square of the residual
double advance(int length, float step, const float* direction, const float* applied, float* __restrict x,
               float* __restrict residual);

}  // namespace talus::run_loops
