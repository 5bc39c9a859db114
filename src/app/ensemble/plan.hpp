// SPDX-License-Identifier: Apache-2.0
/// Which runs an ensemble consists of: every combination of the varied keys is a group, every seed of a group a member.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace talus::app {

struct EnsembleRequest {
  std::string case_path;
  std::vector<std::string> settings;  ///< as --set
  std::vector<std::string> vary;      ///< "particles.radius=1 mm,5 mm"
  int members = 20;
  int jobs = 1;
  std::filesystem::path folder;
  bool resume = false;
};

struct EnsembleMember {
  std::int64_t seed = 0;
  std::vector<std::string> settings;  ///< all of them, the seed's too
  std::filesystem::path folder;
  std::string fingerprint;
  double end = 0;  ///< run.end, s
};

struct EnsembleGroup {
  std::string name;                   ///< "radius=1mm_size=0.065m"; "all" without varied keys
  std::vector<std::string> settings;  ///< of the varied keys
  std::vector<EnsembleMember> members;
};

struct EnsemblePlan {
  std::vector<EnsembleGroup> groups;
  bool pictures = true;  ///< output.pictures of the case
};

/// Reads and checks the case of every group. Member k has the case's seed + k. Folders: FOLDER/GROUP/seed_0001; of a
/// model in which nothing is random each group has one member, in FOLDER/GROUP.
/// \throws InputError with every problem of the case and of --vary
EnsemblePlan plan_ensemble(const EnsembleRequest& request);

}  // namespace talus::app
