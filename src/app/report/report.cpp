// SPDX-License-Identifier: Apache-2.0
#include "app/report/report.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <nlohmann/json.hpp>

#include "analysis/hopper.hpp"
#include "analysis/measure.hpp"
#include "app/models/models.hpp"
#include "app/project/project.hpp"
#include "base/error.hpp"
#include "base/system.hpp"
#include "io/parameter_writer.hpp"
#include "io/report_page.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/series.hpp"
#include "run/interrupt.hpp"

namespace talus::app {

namespace {

using Json = nlohmann::ordered_json;

/// Viewers side by side; a report of more runs shows the particles of the first ones.
constexpr std::size_t max_viewers = 4;
constexpr std::uintmax_t max_bytes_of_pictures = 4'000'000;

/// What is no measure of the run but of the machine that it ran on.
struct MachineText {
  std::string_view name, text;
};
constexpr std::array<MachineText, 5> machine_texts{{{"wall_seconds", "wall time of the time loop"},
                                                    {"cpu_seconds", "processor time of the time loop, all threads"},
                                                    {"peak_memory", "largest resident memory of the program"},
                                                    {"threads", "threads used; the results do not depend on them"},
                                                    {"steps", "time steps"}}};

Json numbers(const Vector3& v) {
  return {v.x, v.y, v.z};
}

Json json_of(const Scene& scene) {
  Json json{{"walls", Json::array()}, {"slope", scene.slope}, {"radius", scene.radius}, {"view", scene.view}};
  for (const WallLine& wall : scene.walls) {
    Json line{{"from", numbers(wall.from)}, {"to", numbers(wall.to)}};
    if (std::isfinite(wall.until)) line["until"] = wall.until;
    json["walls"].push_back(std::move(line));
  }
  if (scene.box) json["box"] = {numbers(scene.box->first), numbers(scene.box->second)};
  return json;
}

Json json_of(const Manifest& m) {
  return {{"version", m.version},
          {"revision", m.revision},
          {"compiler", m.compiler},
          {"seed", m.seed},
          {"instruction_set", m.instruction_set},
          {"threads", m.threads},
          {"processor", m.processor},
          {"cores", m.cores},
          {"system", m.system},
          {"started", m.started},
          {"fingerprint", m.fingerprint}};
}

/// Numbers that are not finite are null.
Json quantities_of(const ReportEntry& entry, const Summary& summary) {
  Json quantities = Json::array();
  if (entry.quantities.empty())
    for (const NamedValue& q : summary.quantities)
      quantities.push_back({{"name", q.name}, {"unit", q.unit}, {"values", {q.value}}});
  for (const ReportEntry::Quantity& q : entry.quantities)
    quantities.push_back({{"name", q.name}, {"unit", q.unit}, {"values", q.values}});
  return quantities;
}

/// analysis/wall_loads.csv, the numbers of each column; none where there is no such table.
Json loads_on_walls(const std::filesystem::path& run_folder) {
  Json json;
  const std::filesystem::path path = run_folder / "analysis" / "wall_loads.csv";
  if (!std::filesystem::exists(path)) return json;
  const Series table = read_series(path);
  for (std::size_t c = 0; c < table.names.size(); ++c) json[table.names[c]] = table.columns[c];
  return json;
}

Json json_of(const ReportEntry& entry, bool with_particles, const ReportLimits& limits,
             std::vector<std::string>& blocks, OpenedRun* open) {
  const RunFolder folder(entry.folder);
  const Manifest manifest = read_manifest(folder.manifest());
  const Summary summary = read_summary(folder.summary());
  const CaseFile resolved = CaseFile::from_text(manifest.case_text, folder.manifest().string());
  const ModelEntry& model = model_of(resolved);
  const Series series = read_series(folder.series());
  const bool has_gate = series.has("gate_time") && series.rows() > 0;
  const double origin = has_gate ? gate_time_of(series) : 0;

  Json run{{"name", entry.name}, {"members", entry.members}, {"model", model.name}, {"status", summary.status}};
  run["from_gate"] = has_gate;
  run["manifest"] = json_of(manifest);
  run["case"] = manifest.case_text;
  run["keys"] = resolved_values(manifest.case_text);
  run["warnings"] = summary.warnings;
  run["regime"] = Json::array();
  for (const RegimeLine& line : summary.regime)
    run["regime"].push_back(
        {{"quantity", line.quantity}, {"value", line.value}, {"meaning", line.meaning}, {"warning", line.warning}});
  run["key_results"] = Json::array();
  for (const Answer& answer : summary.answers)
    run["key_results"].push_back({{"title", answer.question}, {"value", answer.answer}, {"estimate", answer.by_hand}});
  std::unique_ptr<OpenedRun> opened;
  if (!open || !std::filesystem::equivalent(open->folder(), entry.folder)) {
    opened = model.open(resolved, entry.folder, OpenedRun::many_times);
    open = opened.get();
  }
  if (series.rows() > 0)
    if (const auto time = open->telling_time(); time && std::isfinite(*time)) run["telling_time"] = *time;
  run["quantities"] = quantities_of(entry, summary);
  if (model.name == "continuum") run["symbols"] = symbols_of_hopper_measures;
  if (model.name == "cloud") run["symbols"] = symbols_of_avalanche_measures;
  run["scene"] = json_of(open->scene());
  if (with_particles) run["frames"] = pack_run(entry.folder, origin, limits, blocks);
  if (entry.bands.empty()) {
    run["tables"] = pack_tables(entry.folder, series, origin, blocks);
    if (Json loads = loads_on_walls(entry.folder); !loads.is_null()) run["wall_loads"] = std::move(loads);
  } else {
    run["tables"] = Json::array();
    for (const auto& [name, table] : entry.bands)
      if (table.rows() > 0) run["tables"].push_back(pack_table(name, table, 0, blocks));
  }
  return run;
}

/// The texts of all names that the runs' quantities and tables have.
Json definitions_of(const Json& runs) {
  Json definitions = Json::object();
  const auto add = [&](std::string name) {
    for (const std::string_view ending : {"_mean", "_deviation"})
      if (!find_measure(name) && name.ends_with(ending)) name.resize(name.size() - ending.size());
    if (const auto measure = find_measure(name)) definitions[name] = measure->text;
    for (const MachineText& machine : machine_texts)
      if (machine.name == name) definitions[name] = machine.text;
  };
  for (const Json& run : runs) {
    for (const Json& quantity : run["quantities"]) add(quantity["name"]);
    for (const Json& table : run["tables"])
      for (const Json& column : table["columns"]) add(column["name"]);
  }
  return definitions;
}

/// Those of the first run, as many as there is room for.
std::vector<std::filesystem::path> pictures_of(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> kept;
  std::uintmax_t bytes = 0;
  for (const auto& path : files_of_run(folder, "pictures", ".png"))
    if (bytes + std::filesystem::file_size(path) <= max_bytes_of_pictures) {
      bytes += std::filesystem::file_size(path);
      kept.push_back(path);
    }
  return kept;
}

/// null: no number.
std::vector<double> numbers_of(const Json& values) {
  std::vector<double> numbers;
  for (const Json& value : values) numbers.push_back(value.is_null() ? std::nan("") : value.get<double>());
  return numbers;
}

bool is_run(const std::filesystem::path& folder) {
  return std::filesystem::exists(RunFolder(folder).manifest()) && std::filesystem::exists(RunFolder(folder).summary());
}

}  // namespace

void write_report(const ReportRequest& request, const std::filesystem::path& path, OpenedRun* open) {
  ReportContent content{.title = request.title, .header = {}, .blocks = {}, .pictures = {}};
  Json header{{"title", request.title}, {"version", program_version()}, {"revision", program_revision()}};
  header["runs"] = Json::array();
  for (const ReportEntry& entry : request.runs)
    header["runs"].push_back(json_of(entry, header["runs"].size() < max_viewers, request.limits, content.blocks, open));
  header["definitions"] = definitions_of(header["runs"]);
  header["comparisons"] = Json::array();
  for (const std::string& comparison : request.comparisons) header["comparisons"].push_back(Json::parse(comparison));
  content.header = header.dump(-1, ' ', false, Json::error_handler_t::replace);
  content.pictures = pictures_of(request.runs.front().folder);
  write_report(path, content);
}

ReportRequest request_of(const std::string& json) {
  const Json read = Json::parse(json);
  ReportRequest request;
  for (const Json& run : read.at("runs")) {
    ReportEntry entry{
        .folder = run.at("folder").get<std::string>(), .name = run.at("name"), .members = run.at("members")};
    for (const Json& band : run.at("bands")) {
      Series table{.names = band.at("names"), .units = band.at("units"), .columns = {}};
      for (const Json& column : band.at("columns")) table.columns.push_back(numbers_of(column));
      entry.bands.emplace_back(band.at("name"), std::move(table));
    }
    for (const Json& q : run.at("quantities"))
      entry.quantities.push_back({q.at("name"), q.at("unit"), numbers_of(q.at("values"))});
    request.runs.push_back(std::move(entry));
  }
  for (const Json& comparison : read.at("comparisons")) request.comparisons.push_back(comparison.dump());
  return request;
}

ReportRequest gathered(const std::filesystem::path& folder) {
  const auto python = find_python({"numpy", "h5py"});
  const std::filesystem::path path = folder.has_filename() ? folder : folder.parent_path();
  const ReportRequest alone{.runs = {{.folder = path, .name = path.filename().string()}}};
  if (!python && is_run(folder)) return alone;
  if (!python)
    throw FileError(folder.string(),
                    "runs together take python3 with numpy, h5py and the package talus (Debian: "
                    "python3-numpy, python3-h5py, python3-talus)");
  if (!std::filesystem::is_directory(folder)) throw FileError(folder.string(), "no such folder");
  ReportRequest request;
  try {
    request = request_of(said_by_package(*python, "talus.lab.gathered", {folder.string()}, folder));
  } catch (const FileError&) {  // a signal ends the package too; the run has been done
    if (run::signal_has_come() && is_run(folder)) return alone;
    throw;
  }
  if (request.runs.empty())
    throw InputError({{.where = folder.string(),
                       .what = "holds no finished run",
                       .allowed = "the folder of a run, of an ensemble, or of reproduce"}});
  return request;
}

void write_run_report(OpenedRun& run) {
  ReportRequest request = gathered(run.folder());
  request.title = title_of_run(run.folder());
  write_report(request, RunFolder(run.folder()).report(), &run);
}

std::string title_of_run(const std::filesystem::path& folder) {
  const RunFolder run(folder);
  const CaseFile resolved = CaseFile::from_text(read_manifest(run.manifest()).case_text, run.manifest().string());
  const CaseEntry* const title = resolved.find("title");
  const auto* const text = title ? std::get_if<std::string>(&title->value.value) : nullptr;
  return text && !text->empty() ? *text : (folder.has_filename() ? folder : folder.parent_path()).filename().string();
}

}  // namespace talus::app
