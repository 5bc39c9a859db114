// SPDX-License-Identifier: Apache-2.0
/// JSON files, read and written whole. For the .cpp files of io only: the library's header is long to compile.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "base/error.hpp"
#include "io/file.hpp"

namespace talus {

/// Keys in the order in which they were given; bytes that are no UTF-8 become U+FFFD.
using Json = nlohmann::ordered_json;

inline void write_json(const std::filesystem::path& path, const Json& json, Flush flush = Flush::now) {
  write_atomically(path, json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n', flush);
}

/// \param what_it_is for messages: "a summary"; \param read Json -> result
/// \throws FileError if the file cannot be read, is not JSON or lacks a required value
template <class Read>
auto read_json(const std::filesystem::path& path, const char* what_it_is, Read&& read) {
  const std::string text = read_whole_file(path);
  try {
    return read(Json::parse(text));
  } catch (const Json::exception& error) {
    throw FileError(path.string(), std::string("is not ") + what_it_is + " of Talus: " + error.what());
  }
}

}  // namespace talus
