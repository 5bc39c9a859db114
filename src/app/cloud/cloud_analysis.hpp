// SPDX-License-Identifier: Apache-2.0
/// What is measured on a cloud's run, from its folder alone. Estimators: analysis/avalanche.hpp.
#pragma once

#include <filesystem>
#include <vector>

#include "analysis/avalanche.hpp"
#include "base/vector.hpp"
#include "models/cloud/pair_sum.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

/// Converts a run's SI numbers to the paper's.
struct CloudFrame {
  AvalancheScales scales;
  cloud::Motion motion = cloud::Motion::xy;
  bool has_slope = true;
  Vector3 gravity = {0, 0, -1};  ///< unit vector

  CloudMotion cloud_motion() const {
    if (has_slope) return CloudMotion::on_slope;
    return motion == cloud::Motion::xyz ? CloudMotion::falling : CloudMotion::other;
  }
};

/// Reads series.csv, and of a fall the snapshots when a measure asks for them. Without a slope the run has no front.
/// The run's end is the time of its last row: that of its last snapshot, at most a step after run.end, and no more than
/// there is of a run cut short. \throws FileError
AvalancheRun read_avalanche(const std::filesystem::path& run_folder, const CloudFrame& frame);

/// Writes analysis/front_speed.csv, or analysis/snapshots.csv of a fall (a column per measure); returns the summary's
/// quantities. \throws FileError
std::vector<NamedValue> analyze_cloud(const std::filesystem::path& run_folder, const CloudFrame& frame,
                                      const AvalancheRun& run);

}  // namespace talus::app
