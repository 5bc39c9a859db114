// SPDX-License-Identifier: Apache-2.0
/// The air in the hopper of Yuu & Umekage 2011 as their Figures 10 and 11 show it: its velocity as arrows, its pressure
/// along lines.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "app/continuum/hopper_ensembles.hpp"
#include "io/figure/chart.hpp"
#include "numerics/grid_snapshot.hpp"

namespace talus::app {

/// The snapshot of the air nearest to a time from the gate's opening, its time counted from there; nothing for a run
/// without air, or one that ends before. \throws FileError
std::optional<GridSnapshot> air_at(const HopperEnsemble& ensemble, double time);

/// Figure 10: velocities in the middle of the depth 0.17 s and 1.0 s after the opening, over the cells that hold
/// grains; for all variants with air. \returns false, drawing nothing, if there is none
bool draw_air_vectors(const std::vector<HopperEnsemble>& ensembles, const std::filesystem::path& path);

/// Points of a line through the cells in the middle of the depth.
struct AirProfile {
  std::vector<double> place;     ///< x or z, mm
  std::vector<double> pressure;  ///< Pa
  std::vector<double> velocity;  ///< upwards, m/s
};
AirProfile air_along_x(const GridSnapshot& air, double z);
AirProfile air_along_z(const GridSnapshot& air, double x);

}  // namespace talus::app
