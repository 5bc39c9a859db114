// SPDX-License-Identifier: Apache-2.0
/// A run's snapshots as the viewer of a report reads them: the same particles in every frame, thinned, rounded, packed.
#pragma once

#include <cstddef>
#include <filesystem>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

namespace talus::app {

/// What a report carries at most of one run.
struct ReportLimits {
  std::size_t particles = 20000, frames = 100;
  std::size_t arrows = 2000;  ///< of the air, a frame
};

/// Appends the blocks of the particles and of the air, and describes them:
///
///     {"time": [s...], "of_frames", "count", "of_particles", "levels_of_fields",
///      "position": [{"low", "high", "levels", "block"} x 3],
///      "fields": [{"name", "unit", "low", "high", "levels", "block"}...],
///      "identity": block or absent where the n-th particle is number n,
///      "air": {"count": [3], "low": [3], "spacing": [3], "velocity": [{...} x 3]} or absent}
///
/// Vectors are also given by their size, a stress by its pressure, a third of the trace; columns that never change are
/// left out, the radius apart. Particles are chosen by their numbers, evenly; frames evenly over the time, the first
/// and the last among them. Air in a box that is thin along an axis is that of its middle layer.
/// \param origin time from which the frames count, s \returns null where there are no snapshots
/// \throws FileError
nlohmann::ordered_json pack_run(const std::filesystem::path& folder, double origin, const ReportLimits& limits,
                                std::vector<std::string>& blocks);

/// Frames of `count`, at most `most` of them, evenly, the first and the last among them.
std::vector<std::size_t> evenly(std::size_t count, std::size_t most);

}  // namespace talus::app
