// SPDX-License-Identifier: Apache-2.0
/// talus picture: runs at one time, or a strip of times, as a PNG. talus movie: all snapshots of one or several runs,
/// side by side.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>

#include "app/commands.hpp"
#include "app/picture/artist.hpp"
#include "app/report/report.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "base/unit.hpp"
#include "io/movie.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

/// What both have in common on the command line.
struct PictureOptions {
  std::vector<std::string> folders = {}, names = {};
  std::string color = "velocity", range = {}, out = {};
  PictureStyle style = {};

  void add_to(CLI::App& command);

  /// \throws FileError
  std::vector<RunFrames> read_runs() const;
  /// Names of the runs: those given, or of their folders. \throws InputError if there are others than runs
  std::vector<std::string> run_names() const;
  /// \param runs give the colours where none were asked for \throws InputError
  PictureStyle style_for(const std::vector<RunFrames>& runs) const;
};

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

/// "0.2" or "200 ms" in seconds. \throws InputError naming the option
double read_time(const std::string& text, const std::string& option) {
  const auto time = parse_quantity(text);
  if (time && (time->dimension == dimension::none || time->dimension == dimension::time)) return time->value;
  throw InputError({{.where = option,
                     .what = fmt::format("'{}' is not a time (unit missing?)", text),
                     .allowed = "seconds, or a time such as 170 ms"}});
}

struct StripOptions {
  PictureOptions picture;
  std::vector<std::string> times;
  int columns = 0;
};

/// Runs below each other, each with its times; one run, or one time, alone in rows of equal length.
int columns_of(const StripOptions& options, const Artist& artist, std::size_t runs, std::size_t times) {
  if (options.columns > 0) return options.columns;
  if (runs > 1 && times > 1) return static_cast<int>(times);
  const std::size_t panels = runs * times, most = static_cast<std::size_t>(artist.panels_in_a_row());
  const std::size_t rows = (panels + most - 1) / most;
  return static_cast<int>((panels + rows - 1) / rows);
}

ExitStatus picture(const StripOptions& options) {
  const std::filesystem::path path = read_out(options.picture.out, {".png"});
  const std::vector<RunFrames> runs = options.picture.read_runs();
  Artist artist(runs, options.picture.run_names(), options.picture.style_for(runs));
  const Shown shown = options.picture.style_for(runs).shown;
  std::vector<double> times;
  for (const std::string& time : options.times) times.push_back(read_time(time, "--time " + time));
  std::vector<std::vector<Frame>> frames(runs.size());
  for (std::size_t run = 0; run < runs.size(); ++run) {
    if (options.times.empty()) times = {runs[run].times().back()};
    for (std::size_t n = 0; n < times.size(); ++n) {
      const std::size_t at = runs[run].at(times[n], "--time " + (options.times.empty() ? "" : options.times[n]));
      frames[run].push_back(runs[run].read(at, shown));
      artist.look_at(run, frames[run].back());
    }
  }
  std::vector<Artist::Panel> panels;
  for (std::size_t run = 0; run < runs.size(); ++run)
    for (const Frame& frame : frames[run]) panels.push_back({run, &frame});
  figure::write_png(artist.figure(panels, columns_of(options, artist, runs.size(), times.size())), path);
  print("Picture: {}\n", path.string());
  return ExitStatus::done;
}

struct MovieOptions {
  PictureOptions picture;
  std::string from, to;
  double rate = 10;
};

/// The snapshots of each run, frame by frame: the run with the most snapshots gives the times; the others show the
/// nearest that they have.
std::vector<std::vector<std::size_t>> frames_of(const std::vector<RunFrames>& runs, const MovieOptions& options) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const double from = options.from.empty() ? -infinity : read_time(options.from, "--from " + options.from);
  const double to = options.to.empty() ? infinity : read_time(options.to, "--to " + options.to);
  std::vector<double> times;
  for (const RunFrames& run : runs) {
    std::vector<double> of_run;
    for (const double time : run.times())
      if (time >= from - 1e-9 && time <= to + 1e-9) of_run.push_back(time);
    if (of_run.size() > times.size()) times = std::move(of_run);
  }
  if (times.size() < 2)
    throw InputError(
        {{.where = "--from, --to",
          .what = "fewer than two snapshots are between these times",
          .allowed = fmt::format("{:.4g} to {:.4g} s", runs.front().times().front(), runs.front().times().back())}});
  std::vector<std::vector<std::size_t>> frames;
  for (const double time : times) {
    frames.emplace_back();
    for (const RunFrames& run : runs)
      frames.back().push_back(
          run.at(std::clamp(time, run.times().front(), run.times().back()), fmt::format("{:g} s", time)));
  }
  return frames;
}

ExitStatus movie(const MovieOptions& options) {
  const std::filesystem::path path = read_out(options.picture.out, {".mp4", ".webm", ".gif"});
  MovieWriter::find_encoder();
  const std::vector<RunFrames> runs = options.picture.read_runs();
  const PictureStyle style = options.picture.style_for(runs);
  Artist artist(runs, options.picture.run_names(), style);
  const auto frames = frames_of(runs, options);

  run::Progress progress(stderr);
  progress.begin({.start = 0, .end = 2.0 * static_cast<double>(frames.size()), .recent = 1});
  double done = 0;
  const auto show = [&] { progress.update(++done, [&] { return fmt::format("{} frames", frames.size()); }); };
  for (const auto& frame : frames) {
    for (std::size_t run = 0; run < runs.size(); ++run) artist.look_at(run, runs[run].read(frame[run], style.shown));
    show();
  }
  std::optional<MovieWriter> writer;
  for (const auto& numbers : frames) {
    std::vector<Frame> drawn;
    for (std::size_t run = 0; run < runs.size(); ++run) drawn.push_back(runs[run].read(numbers[run], style.shown));
    std::vector<Artist::Panel> panels;
    for (std::size_t run = 0; run < runs.size(); ++run) panels.push_back({run, &drawn[run]});
    const figure::Pixels pixels =
        figure::pixels(artist.figure(panels, std::min(artist.panels_in_a_row(), static_cast<int>(runs.size()))));
    if (!writer) writer.emplace(path, pixels.width, pixels.height, options.rate);
    writer->add(pixels);
    show();
  }
  writer->finish();
  progress.finish();
  print("Movie: {} ({} frames, {:.1f} MB)\n", path.string(), frames.size(),
        static_cast<double>(std::filesystem::file_size(path)) / 1e6);
  return ExitStatus::done;
}

}  // namespace

void add_picture_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<StripOptions>();
  CLI::App* command = app.add_subcommand("picture", "runs at one time, or at several as a strip, as a picture");
  options->picture.add_to(*command);
  auto* time =
      command->add_option("--time", options->times, "one time, s from the gate's opening; the last if not given")
          ->expected(1);
  command->add_option("--times", options->times, "several, with commas between")->delimiter(',')->excludes(time);
  command->add_option("--columns", options->columns, "pictures in a row")->check(CLI::Range(1, 100));
  command->footer(
      "The snapshot nearest to each time is drawn; a time beyond them is an error. All pictures have the same scale\n"
      "and the same colours (viridis). Several runs stand side by side, or below each other with several times.\n"
      "  talus picture results/hopper --time 0.2 --color packing -o packing.png\n"
      "  talus picture AIR VACUUM --times 0,0.1,0.2,0.4 --color velocity --arrows velocity -o strip.png");
  command->callback([options, &action] { action = [options] { return picture(*options); }; });
}

void add_movie_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<MovieOptions>();
  CLI::App* command = app.add_subcommand("movie", "all snapshots of runs, side by side, as a movie (needs ffmpeg)");
  options->picture.add_to(*command);
  command->add_option("--from", options->from,
                      "first time, s from the gate's opening; the first snapshot if not given");
  command->add_option("--to", options->to, "last time; the last snapshot if not given");
  command->add_option("--fps", options->rate, "frames a second, one for each snapshot")
      ->check(CLI::Range(0.1, 240.0))
      ->capture_default_str();
  command->footer(
      "The file's ending is .mp4 (H.264), .webm (VP9) or .gif. Every frame has the same scale and the same colours;\n"
      "the same runs give the same bytes. For more frames, run with a smaller output.snapshots.\n"
      "  talus movie AIR VACUUM --names \"in air,in a vacuum\" --color packing --from 0 -o flow.mp4");
  command->callback([options, &action] { action = [options] { return movie(*options); }; });
}

}  // namespace talus::app
