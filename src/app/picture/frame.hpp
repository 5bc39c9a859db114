// SPDX-License-Identifier: Apache-2.0
/// What one picture of a run shows, read from its snapshots.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/case/scene.hpp"
#include "base/vector.hpp"

namespace talus::app {

/// Which numbers are colours, which vectors arrows.
struct Shown {
  std::string color = {};   ///< a number of the particles (scene.hpp), or "air.NAME" of the cells; empty: one colour
  std::string arrows = {};  ///< "air", or a vector of the particles; empty: none
};

/// One snapshot as it is drawn: particles, or the cells of the air.
struct Frame {
  double time = 0;  ///< from the gate's opening, s
  std::vector<Vector3> positions = {};
  std::vector<double> radii = {}, values = {};  ///< values: one each, or none
  std::string unit = {};                        ///< of the values
  std::vector<Vector3> arrow_positions = {}, arrow_values = {};
  std::string arrow_unit = {};
};

/// The snapshots of a run, or of the air alone where it has no particles.
class RunFrames {
 public:
  /// \throws FileError if there is no run, or no snapshot in it
  explicit RunFrames(const std::filesystem::path& folder);

  const std::filesystem::path& folder() const { return folder_; }
  const std::vector<double>& times() const { return times_; }  ///< rising, from the gate's opening, s
  const Scene& scene() const { return scene_; }
  bool has_particles() const { return has_particles_; }

  /// The snapshot nearest to a time. \param option named if there is none near
  /// \throws InputError if the time is before the first or after the last by more than half of what lies between two
  std::size_t at(double time, const std::string& option) const;

  /// \throws FileError; InputError with the nearest name if there is no such field
  Frame read(std::size_t snapshot, const Shown& shown) const;

 private:
  std::filesystem::path folder_;
  std::vector<int> numbers_;
  std::vector<double> times_;
  bool has_particles_ = true;
  double origin_ = 0;
  Scene scene_;
};

}  // namespace talus::app
