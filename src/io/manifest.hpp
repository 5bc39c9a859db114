// SPDX-License-Identifier: Apache-2.0
/// manifest.json: what was run, by which program, where. The first file of a run's folder, and what marks it as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace talus {

struct Manifest {
  // What is run.
  std::string case_text;    ///< the case as resolved, every default shown
  std::string fingerprint;  ///< of the case
  std::int64_t seed = 0;
  std::string instruction_set;  ///< of the pair sums; the bits depend on it
  int threads = 1;              ///< the bits do not

  // By what, where and when; `manifest_of_this_program` fills these in.
  std::string version, revision, compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  std::string processor;                                       ///< "AMD EPYC 7763 64-Core Processor"
  int cores = 1;                                               ///< that the program may use
  std::string system;                                          ///< "Linux 6.1.0-13-amd64 x86_64"
  std::string started;                                         ///< UTC, "2026-01-31T12:34:56Z"
};

/// The second half of a manifest. The libraries are those of io and base; others are the caller's to add.
Manifest manifest_of_this_program();

/// \throws FileError with the system's reason
void write_manifest(const std::filesystem::path& path, const Manifest& manifest);

/// \throws FileError if the file cannot be read or is no manifest
Manifest read_manifest(const std::filesystem::path& path);

}  // namespace talus
