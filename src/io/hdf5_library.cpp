// SPDX-License-Identifier: Apache-2.0
#include "io/hdf5_library.hpp"

#include <atomic>

#include "base/error.hpp"

namespace talus::hdf5 {

namespace {

/// Where the memory grows in small steps; columns larger than this make it grow at once.
constexpr std::size_t memory_increment = 1 << 16;

}  // namespace

void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

void fail(const std::filesystem::path& path, const std::string& what) {
  std::string reason = "HDF5 gives no reason";
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
        if (depth == 0) *static_cast<std::string*>(text) = error->desc;
        return 0;
      },
      &reason);
  throw FileError(path.string(), what + ": " + reason);
}

Handle file_access_in_memory() {
  Handle access(H5Pcreate(H5P_FILE_ACCESS), H5Pclose);
  H5Pset_fapl_core(access.id(), memory_increment, false);
  return access;
}

std::string unique_name() {
  static std::atomic<unsigned long> count{0};
  return "talus-memory-" + std::to_string(count++);
}

}  // namespace talus::hdf5
