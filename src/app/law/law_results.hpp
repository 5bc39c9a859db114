// SPDX-License-Identifier: Apache-2.0
/// What `talus law` leaves: the path, and the fitted functions that the law is made of, as tables.
#pragma once

#include <filesystem>
#include <span>
#include <vector>

#include "app/law/law_case.hpp"
#include "numerics/named_value.hpp"
#include "physics/granular/law.hpp"

namespace talus::app {

/// A path that was followed.
struct FollowedPath {
  LawCase parameters;
  granular::AnyLaw law;
  std::vector<granular::PathStretch> stretches;
  granular::PathOptions options;
  std::vector<granular::PathPoint> points;  ///< as follow_path
};

/// Largest and last values of the path, for the screen.
std::vector<NamedValue> quantities_of(const FollowedPath& path);

/// A row per point: time, stretch, packing, pressure, shear stress (|tau_dev|/2^(1/2)), friction (their ratio), strain
/// and stress, the stress by collisions unless there are none, and what the law remembers. Strain since the start.
/// \throws FileError
void write_path_table(const FollowedPath& path, const std::filesystem::path& file);

/// A1 to A4 of a fitted law (the paper's Figure 1), the friction and the pressure that follow, against strain: as
/// printed and, where they are, as repaired. \throws FileError
void write_functions(const granular::Fits& fits, const std::filesystem::path& file);

}  // namespace talus::app
