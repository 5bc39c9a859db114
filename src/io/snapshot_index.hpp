// SPDX-License-Identifier: Apache-2.0
/// snapshots/particles.hdf.series: the snapshots and their times, in ParaView's form for series of files.
///
///     {"file-series-version": "1.0", "files": [{"name": "particles_0000.vtkhdf", "time": 0.0}, ...]}
///
/// Debian's ParaView 5.11.0 knows its VTKHDF reader by the endings .hdf and .hdf.series alone (later ones by .vtkhdf
/// too), and counts frames where it is given single files; through this file it opens the series with its times.
#pragma once

#include <string_view>

#include "io/run_folder.hpp"

namespace talus {

/// From where the times of the snapshots before the latest are known: from the index as it was, and from the snapshots
/// where it has none; or from the snapshots alone, which takes opening them all.
enum class KnownTimes { of_index, of_snapshots };

/// Lists the snapshots 0 to `latest` that are there. To be called after each snapshot, `latest`, is written.
/// \throws FileError if the index cannot be written or a snapshot not be read
void index_snapshots(const RunFolder& folder, int latest, std::string_view kind = "particles",
                     KnownTimes known = KnownTimes::of_index);

}  // namespace talus
