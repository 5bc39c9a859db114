// SPDX-License-Identifier: Apache-2.0
#include "app/picture/options.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>

#include "app/report/report.hpp"
#include "base/error.hpp"
#include "base/unit.hpp"

namespace talus::app {

namespace {

constexpr const char* no_colours = "none";

std::optional<std::pair<double, double>> read_range(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::size_t comma = text.find(',');
  const auto low = parse_quantity(text.substr(0, comma));
  const auto high = comma == std::string::npos ? std::nullopt : parse_quantity(text.substr(comma + 1));
  if (low && high && low->dimension == dimension::none && high->dimension == dimension::none &&
      low->value < high->value)
    return {{low->value, high->value}};
  throw InputError({{.where = "--range " + text,
                     .what = "is no range",
                     .allowed = "LOW,HIGH, two rising numbers in the unit of the colours, such as 0.4,0.7"}});
}

}  // namespace

void PictureOptions::add_to(CLI::App& command) {
  command.add_option("DIR", folders, "folders of runs")->required();
  command
      .add_option("--color", color,
                  "the number that colours the particles: any of a snapshot, a vector by its size or as NAME_x, "
                  "pressure; air.NAME: of the air's cells; none")
      ->capture_default_str();
  command.add_option("--range", range, "ends of the colours, LOW,HIGH; those of nearly all that is shown if not given");
  command.add_option("--unit", style.unit, "unit of the colours, such as kPa; SI if not given");
  command.add_option("--arrows", style.shown.arrows, "arrows of a vector: air (its velocity), or one of the particles");
  command.add_option("--view", style.view, "direction of view [default: the case's]")
      ->check(CLI::IsMember(std::vector<std::string>(std::begin(picture_views), std::end(picture_views))));
  command.add_option("--names", names, "names of the runs, in place of those of their folders")->delimiter(',');
  command.add_option("--title", style.title, "a line above everything; the case's title of a single run if not given");
  command.add_option("--width", style.width, "width, pixels")->check(CLI::Range(100, 20000));
  command.add_option("-o,--out", out, "the file to write");
}

std::vector<RunFrames> PictureOptions::read_runs() const {
  std::vector<RunFrames> runs;
  for (const std::string& folder : folders) runs.emplace_back(folder);
  return runs;
}

std::vector<std::string> PictureOptions::run_names() const {
  if (!names.empty() && names.size() != folders.size())
    throw InputError({{.where = "--names",
                       .what = fmt::format("{} for {} runs", names.size(), folders.size()),
                       .allowed = "one for each run, with commas between"}});
  if (!names.empty()) return names;
  std::vector<std::string> all;
  for (const std::string& folder : folders) {
    const std::filesystem::path path(folder);
    all.push_back((path.has_filename() ? path : path.parent_path()).filename().string());
  }
  return all;
}

PictureStyle PictureOptions::style_for(const std::vector<RunFrames>& runs) const {
  PictureStyle full = style;
  full.range = read_range(range);
  full.shown.color = color == no_colours ? std::string() : color;
  // A run of the air alone has no particles to colour.
  if (color == "velocity" &&
      std::none_of(runs.begin(), runs.end(), [](const RunFrames& r) { return r.has_particles(); }))
    full.shown.color = "air.velocity";
  if (full.title.empty() && runs.size() == 1) full.title = title_of_run(runs.front().folder());
  return full;
}

double read_time(const std::string& text, const std::string& option) {
  const auto time = parse_quantity(text);
  if (time && (time->dimension == dimension::none || time->dimension == dimension::time)) return time->value;
  throw InputError({{.where = option,
                     .what = fmt::format("'{}' is not a time (unit missing?)", text),
                     .allowed = "seconds, or a time such as 170 ms"}});
}

std::filesystem::path read_out(const std::string& text, const std::vector<std::string>& endings) {
  const std::filesystem::path path(text);
  const bool known = std::find(endings.begin(), endings.end(), path.extension().string()) != endings.end();
  if (known && !std::filesystem::is_directory(path)) {
    const std::filesystem::path folder = path.has_parent_path() ? path.parent_path() : std::filesystem::path(".");
    if (!std::filesystem::is_directory(folder)) throw FileError(path.string(), "its folder is not there");
    return path;
  }
  throw InputError({{.where = text.empty() ? "-o" : "-o " + text,
                     .what = text.empty() ? "missing"
                             : known      ? "is a folder"
                                          : "has another ending",
                     .allowed = fmt::format("a file that ends in {}", fmt::join(endings, ", "))}});
}

}  // namespace talus::app
