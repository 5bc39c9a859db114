// SPDX-License-Identifier: Apache-2.0
#include "io/run_json.hpp"

#include <cairo.h>
#include <fmt/chrono.h>
#include <fmt/format.h>
#include <hdf5.h>
#include <sys/utsname.h>
#include <toml++/toml.h>
#include <zlib.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <ctime>
#include <fstream>
#include <limits>
#include <map>
#include <stdexcept>
#include <string>

#include "base/system.hpp"
#include "io/json.hpp"
#include "io/vtkhdf.hpp"

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
  manifest.cores = processors();
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

namespace {

constexpr const char* not_a_number = "not a number";
constexpr const char* infinite = "infinite";
constexpr const char* minus_infinity = "minus infinity";

double value_of(const Json& entry) {
  if (!entry.at("value").is_null()) return entry.at("value").get<double>();
  const std::string reason = entry.at("reason");
  if (reason == infinite) return std::numeric_limits<double>::infinity();
  if (reason == minus_infinity) return -std::numeric_limits<double>::infinity();
  return std::numeric_limits<double>::quiet_NaN();
}

}  // namespace

const NamedValue* Summary::find(std::string_view name) const {
  const auto found =
      std::find_if(quantities.begin(), quantities.end(), [&](const NamedValue& s) { return s.name == name; });
  return found == quantities.end() ? nullptr : &*found;
}

void write_summary(const std::filesystem::path& path, const Summary& summary) {
  Json quantities = Json::object();
  for (const NamedValue& quantity : summary.quantities) {
    if (quantities.contains(quantity.name)) throw std::invalid_argument("summary: " + quantity.name + " stands twice");
    Json entry{{"value", quantity.value}, {"unit", quantity.unit}};  // a value that is not finite is written as null
    if (!std::isfinite(quantity.value))
      entry["reason"] = std::isnan(quantity.value) ? not_a_number : quantity.value > 0 ? infinite : minus_infinity;
    quantities[quantity.name] = std::move(entry);
  }
  Json regime = Json::array();
  for (const RegimeLine& line : summary.regime)
    regime.push_back(
        {{"quantity", line.quantity}, {"value", line.value}, {"meaning", line.meaning}, {"warning", line.warning}});
  Json key_results = Json::array();
  for (const Answer& answer : summary.answers) {
    key_results.push_back({{"title", answer.question}, {"value", answer.answer}});
    if (!answer.by_hand.empty()) key_results.back()["estimate"] = answer.by_hand;
  }
  write_json(path, {{"status", summary.status},
                    {"wall_seconds", summary.wall_seconds},
                    {"instruction_set", summary.instruction_set},
                    {"warnings", summary.warnings},
                    {"regime", regime},
                    {"key_results", key_results},
                    {"quantities", quantities}});
}

Summary read_summary(const std::filesystem::path& path) {
  return read_json(path, "a summary", [](const Json& json) {
    Summary summary{.status = json.at("status"),
                    .wall_seconds = json.at("wall_seconds"),
                    .instruction_set = json.value("instruction_set", ""),
                    .quantities = {},
                    .warnings = {},
                    .answers = {},
                    .regime = {}};
    for (const auto& [name, entry] : json.at("quantities").items())
      summary.quantities.push_back({name, entry.at("unit"), value_of(entry)});
    summary.warnings = json.value("warnings", std::vector<std::string>());
    for (const Json& line : json.value("regime", Json::array()))
      summary.regime.push_back(
          {line.at("quantity"), line.at("value"), line.at("meaning"), line.at("warning").get<bool>()});
    for (const Json& line : json.value("key_results", Json::array()))
      summary.answers.push_back({line.at("title"), line.at("value"), line.value("estimate", "")});
    return summary;
  });
}

namespace {

/// Times by file name; empty where there is no index, or none that can be understood: it is rebuilt then.
std::map<std::string, double> known_times(const std::filesystem::path& index) {
  std::map<std::string, double> times;
  if (!std::filesystem::exists(index)) return times;
  try {
    read_json(index, "an index of snapshots", [&](const Json& json) {
      for (const Json& file : json.at("files")) times[file.at("name")] = file.at("time");
    });
  } catch (const FileError&) {
    times.clear();
  }
  return times;
}

}  // namespace

void index_snapshots(const RunFolder& folder, int latest, std::string_view kind, KnownTimes known) {
  std::map<std::string, double> times;
  if (known == KnownTimes::of_index) times = known_times(folder.snapshot_index(kind));
  times.erase(folder.snapshot(latest, kind).filename());  // it has just been written, perhaps by a resumed run
  Json files = Json::array();
  for (const int number : folder.snapshot_numbers(kind)) {
    if (number > latest) break;  // left from before the run was resumed; they will be replaced
    const std::filesystem::path path = folder.snapshot(number, kind);
    const std::string name = path.filename();
    const auto time = times.find(name);
    files.push_back({{"name", name}, {"time", time == times.end() ? read_points_time(path) : time->second}});
  }
  write_json(folder.snapshot_index(kind), {{"file-series-version", "1.0"}, {"files", files}}, Flush::later);
}

}  // namespace talus
