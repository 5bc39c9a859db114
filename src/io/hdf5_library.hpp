// SPDX-License-Identifier: Apache-2.0
/// What reading and writing share of the HDF5 library: for hdf5_reader.cpp and hdf5_writer.cpp only.
#pragma once

#include <filesystem>
#include <string>

#include "io/hdf5.hpp"

namespace talus::hdf5 {

/// Keeps the library from printing its stack of errors. The setting is each thread's own, so every member of Reader and
/// Writer begins with it.
void silence();

/// \throws FileError with the library's own account of what failed, from the call in which it began
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what);

/// Files that are opened with it are in memory only. They are distinguished by their names: see `unique_name`.
Handle file_access_in_memory();
std::string unique_name();

}  // namespace talus::hdf5
