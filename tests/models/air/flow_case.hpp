// SPDX-License-Identifier: Apache-2.0
/// A flow of air on a small grid, for the tests of the air.
#pragma once

#include "models/air/flow.hpp"

namespace talus::air {

inline FlowBoundaries all(FlowBoundary kind) {
  FlowBoundaries boundaries;
  boundaries.kind.fill(kind);
  return boundaries;
}

/// The pressure drop of a bed of packing 0.6, Pa/m, at a superficial velocity of 0.01 m/s. In model B the drag is the
/// whole resistance; in model A it is what the air's share of the pressure balances.
struct FixedBed {
  coupling::DragLaw law;
  Formulation formulation;
  double drop;
};
inline constexpr FixedBed fixed_beds[] = {
    {coupling::DragLaw::schiller_naumann_umekage_yuu, Formulation::model_a, 2152},
    {coupling::DragLaw::schiller_naumann_umekage_yuu, Formulation::model_b, 0.4 * 2152},
    {coupling::DragLaw::ergun_wen_yu, Formulation::model_a, 3849},
    {coupling::DragLaw::ergun_wen_yu, Formulation::model_b, 3849}};

template <class Body>
void for_each_cell(const Grid& grid, Body&& body) {
  for (int k = 0; k < grid.count[2]; ++k)
    for (int j = 0; j < grid.count[1]; ++j)
      for (int i = 0; i < grid.count[0]; ++i) body(i, j, k, grid.index(i, j, k));
}

/// Place of a face: its low corner's axis, the others' centres.
inline Vector3 face_centre(const Grid& grid, int axis, int i, int j, int k) {
  Vector3 x = grid.centre(i, j, k);
  x[axis] -= 0.5 * grid.spacing[axis];
  return x;
}

/// A flow on a grid with its state, and steps.
struct Case {
  ThreadTeam team;
  Grid grid;
  Parameters parameters;
  AirFlow flow;
  Solids solids;
  AirState state;
  FaceField impulse;

  Case(const Grid& cells, const Parameters& p, const std::vector<Wall>& walls = {}, int threads = 1)
      : team(threads),
        grid(cells),
        parameters(p),
        flow(cells, p, walls),
        solids(cells),
        state(cells),
        impulse(cells.face_field()) {}

  template <class Velocity>
  void set_velocity(Velocity&& velocity) {
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < flow.apertures().faces(axis, 2); ++k)
        for (int j = 0; j < flow.apertures().faces(axis, 1); ++j)
          for (int i = 0; i < flow.apertures().faces(axis, 0); ++i)
            state.velocity[static_cast<std::size_t>(axis)][grid.index(i, j, k)] =
                velocity(face_centre(grid, axis, i, j, k))[axis];
  }
  void set_solids(int k_from, int k_to, double fraction, const Vector3& velocity) {
    for_each_cell(grid, [&](int, int, int k, std::size_t c) {
      if (k < k_from || k >= k_to) return;
      solids.fraction[c] = fraction;
      for (int a = 0; a < 3; ++a) solids.flux[static_cast<std::size_t>(a)][c] = fraction * velocity[a];
    });
  }
  /// Momentum of all the air, N s.
  Vector3 momentum() const {
    Vector3 total;
    for (int axis = 0; axis < 3; ++axis)
      for (int k = 0; k < flow.apertures().faces(axis, 2); ++k)
        for (int j = 0; j < flow.apertures().faces(axis, 1); ++j)
          for (int i = 0; i < flow.apertures().faces(axis, 0); ++i) {
            const bool is_end = flow.apertures().is_end(axis, axis == 0 ? i : axis == 1 ? j : k);
            total[axis] += state.momentum[static_cast<std::size_t>(axis)][grid.index(i, j, k)] * grid.volume() *
                           (is_end ? 0.5 : 1);
          }
    return total;
  }
  void begin() { flow.begin(team, solids, state); }
  void advance(double dt, int steps = 1) {
    for (int n = 0; n < steps; ++n) flow.advance(team, dt, solids, state, impulse);
  }
};

}  // namespace talus::air
