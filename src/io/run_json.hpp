// SPDX-License-Identifier: Apache-2.0
/// The JSON files of a run folder: manifest, summary, index of snapshots.
///
/// manifest.json: what was run, by which program, where. The first file of a run's folder, and what marks it as one.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/run_folder.hpp"
#include "numerics/run_record.hpp"

namespace talus {

struct Manifest {
  // What is run.
  std::string case_text;    ///< the case as resolved, every default shown
  std::string fingerprint;  ///< of the case
  std::int64_t seed = 0;
  std::string instruction_set;  ///< of the pair sums; results depend bitwise on it
  int threads = 1;              ///< results do not

  // By what, where and when; `manifest_of_this_program` fills these in.
  std::string version, revision, compiler;
  std::vector<std::pair<std::string, std::string>> libraries;  ///< name, version
  std::string processor;                                       ///< "AMD EPYC 7763 64-Core Processor"
  int cores = 1;                                               ///< that the program may use
  std::string system;                                          ///< "Linux 6.1.0-13-amd64 x86_64"
  std::string started;                                         ///< UTC, "2026-01-31T12:34:56Z"
};

/// The second half of a manifest. Its libraries are those that io and base link; the caller adds others.
Manifest manifest_of_this_program();

/// \throws FileError with the system's reason
void write_manifest(const std::filesystem::path& path, const Manifest& manifest);

/// \throws FileError if the file cannot be read or is no manifest
Manifest read_manifest(const std::filesystem::path& path);

// summary.json: the numbers in which a run ended.
//
//     {"status": "done", "wall_seconds": 12.3, "instruction_set": "avx2",
//      "warnings": ["mach-number: Mach number = 0.4: ..."],
//      "regime": [{"quantity": "Mach number", "value": "0.4", "meaning": "...", "warning": true}, ...],
//      "key_results": [{"title": "Flow", "value": "has emptied after 2.3 s, 12 g (0.8 %) left", "estimate": "..."},
//      ...], "quantities": {"front_speed_max": {"value": 51.2, "unit": "1"}, ...}}
//
// JSON has no numbers that are not finite: such a quantity has the value null and a "reason", one of "not a number",
// "infinite" and "minus infinity". It is written so that a reader knows that it was asked for.

struct Summary {
  std::string status;                       ///< "running", "done", "interrupted" or "failed"
  double wall_seconds = 0;                  ///< s
  std::string instruction_set = {};         ///< of the sum over pairs: results depend bitwise on it
  std::vector<NamedValue> quantities = {};  ///< names unique
  std::vector<std::string> warnings = {};   ///< where case or run leave what the laws assume, each after its name
  std::vector<Answer> answers = {};         ///< the key results, each with its analytical estimate
  std::vector<RegimeLine> regime = {};      ///< the validity report of a run that has ended

  /// \returns null if there is none
  const NamedValue* find(std::string_view name) const;
};

/// \throws FileError with the system's reason; \throws std::invalid_argument if a name occurs twice
void write_summary(const std::filesystem::path& path, const Summary& summary);

/// What was written, not finite values too. \throws FileError
Summary read_summary(const std::filesystem::path& path);

// snapshots/particles.hdf.series: the snapshots and their times, in ParaView's form for series of files.
//
//     {"file-series-version": "1.0", "files": [{"name": "particles_0000.vtkhdf", "time": 0.0}, ...]}
//
// Debian's ParaView 5.11.0 knows its VTKHDF reader by the endings .hdf and .hdf.series alone (later ones by .vtkhdf
// too), and counts frames where it is given single files; through this file it opens the series with its times.

/// From where the times of the snapshots before the latest are known: from the index as it was, and from the snapshots
/// where it has none; or from the snapshots alone, which takes opening them all.
enum class KnownTimes { of_index, of_snapshots };

/// Lists the snapshots 0 to `latest` that are there. To be called after each snapshot, `latest`, is written.
/// \throws FileError if the index cannot be written or a snapshot cannot be read
void index_snapshots(const RunFolder& folder, int latest, std::string_view kind = "particles",
                     KnownTimes known = KnownTimes::of_index);

}  // namespace talus
