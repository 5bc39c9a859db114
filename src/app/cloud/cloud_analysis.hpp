// SPDX-License-Identifier: Apache-2.0
/// What is measured on a cloud's run, from its folder alone: curves and tables under analysis/, and the quantities of
/// its summary. The definitions are those of docs/quantities.md.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "analysis/curve.hpp"
#include "models/cloud/pair_sum.hpp"
#include "numerics/named_value.hpp"
#include "numerics/snapshot.hpp"

namespace talus::app {

/// What turns a run's SI numbers into the paper's: lengths over a, speeds over v_s.
struct CloudFrame {
  double radius = 0;        ///< mean radius a, m
  double stokes_speed = 0;  ///< v_s, m/s
  cloud::Motion motion = cloud::Motion::xy;
  double slope_angle = 0;  ///< rad
  bool has_slope = true;

  double stokes_time() const { return radius / stokes_speed; }
};

/// The snapshots of a run in the order of their numbers.
std::vector<std::filesystem::path> snapshot_paths(const std::filesystem::path& run_folder);

/// Front speed over v_s against time in a/v_s, from a run's series.csv.
Curve front_speed_of_run(const std::filesystem::path& run_folder, const CloudFrame& frame);

/// What is measured on one snapshot, by the names of docs/quantities.md; lengths over a, speeds over v_s, angles in
/// degrees. Which quantities there are depends on the plane of motion alone.
/// \param front_speed over v_s; nan where it is not known
std::vector<NamedValue> measure_snapshot(const Snapshot& snapshot, const CloudFrame& frame, double front_speed);

/// Writes analysis/front_speed.csv, analysis/snapshots.csv and, for motion in the plane of the slope,
/// analysis/head_widths.csv (every head of the last snapshot); returns the summary's quantities.
/// \throws FileError
std::vector<NamedValue> analyze_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame);

}  // namespace talus::app
