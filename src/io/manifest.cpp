// SPDX-License-Identifier: Apache-2.0
#include "io/manifest.hpp"

#include <cairo.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <sys/utsname.h>
#include <toml++/toml.h>
#include <zlib.h>

#include <chrono>
#include <ctime>
#include <fstream>
#include <thread>

#include "base/version.hpp"
#include "io/json.hpp"

namespace talus {

namespace {

std::string processor_name() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) {
      const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
      if (begin != std::string::npos) return line.substr(begin);
    }
  return "unknown";  // not every architecture names it there
}

std::string system_name() {
  utsname names{};
  ::uname(&names);
  return fmt::format("{} {} {}", names.sysname, names.release, names.machine);
}

std::string hdf5_version() {
  unsigned major = 0, minor = 0, release = 0;
  H5get_libversion(&major, &minor, &release);
  return fmt::format("{}.{}.{}", major, minor, release);
}

}  // namespace

Manifest manifest_of_this_program() {
  Manifest manifest;
  manifest.version = program_version();
  manifest.revision = program_revision();
  manifest.compiler = program_compiler();
  manifest.libraries = {
      {"HDF5", hdf5_version()},
      {"zlib", zlibVersion()},
      {"cairo", cairo_version_string()},
      {"fmt", fmt::format("{}.{}.{}", FMT_VERSION / 10000, FMT_VERSION / 100 % 100, FMT_VERSION % 100)},
      {"toml++", fmt::format("{}.{}.{}", TOML_LIB_MAJOR, TOML_LIB_MINOR, TOML_LIB_PATCH)},
      {"nlohmann-json",
       fmt::format("{}.{}.{}", NLOHMANN_JSON_VERSION_MAJOR, NLOHMANN_JSON_VERSION_MINOR, NLOHMANN_JSON_VERSION_PATCH)}};
  manifest.processor = processor_name();
  manifest.cores = static_cast<int>(std::thread::hardware_concurrency());
  manifest.system = system_name();
  manifest.started = fmt::format("{:%Y-%m-%dT%H:%M:%SZ}", fmt::gmtime(std::time(nullptr)));
  return manifest;
}

void write_manifest(const std::filesystem::path& path, const Manifest& manifest) {
  Json libraries = Json::object();
  for (const auto& [name, version] : manifest.libraries) libraries[name] = version;
  write_json(path,
             {{"program", "talus"},
              {"version", manifest.version},
              {"revision", manifest.revision},
              {"compiler", manifest.compiler},
              {"libraries", libraries},
              {"machine", {{"processor", manifest.processor}, {"cores", manifest.cores}, {"system", manifest.system}}},
              {"started", manifest.started},
              {"threads", manifest.threads},
              {"instruction_set", manifest.instruction_set},
              {"seed", manifest.seed},
              {"fingerprint", manifest.fingerprint},
              {"case", manifest.case_text}});
}

Manifest read_manifest(const std::filesystem::path& path) {
  return read_json(path, "a manifest", [&](const Json& json) {
    if (json.at("program") != "talus") throw FileError(path.string(), "is a manifest of another program");
    const Json& machine = json.at("machine");
    Manifest manifest{.case_text = json.at("case"),
                      .fingerprint = json.at("fingerprint"),
                      .seed = json.at("seed"),
                      .instruction_set = json.at("instruction_set"),
                      .threads = json.at("threads"),
                      .version = json.at("version"),
                      .revision = json.at("revision"),
                      .compiler = json.at("compiler"),
                      .libraries = {},
                      .processor = machine.at("processor"),
                      .cores = machine.at("cores"),
                      .system = machine.at("system"),
                      .started = json.at("started")};
    for (const auto& [name, version] : json.at("libraries").items()) manifest.libraries.emplace_back(name, version);
    return manifest;
  });
}

}  // namespace talus
