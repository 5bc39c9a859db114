// SPDX-License-Identifier: Apache-2.0
/// talus movie: all snapshots of one or several runs, side by side.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <limits>
#include <memory>

#include "app/commands.hpp"
#include "app/picture/options.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "io/movie.hpp"
#include "run/progress.hpp"

namespace talus::app {

namespace {

struct Options {
  PictureOptions picture;
  std::string from, to;
  double rate = 10;
};

/// The snapshots of each run, frame by frame: the run with the most snapshots gives the times; the others show the
/// nearest that they have.
std::vector<std::vector<std::size_t>> frames_of(const std::vector<RunFrames>& runs, const Options& options) {
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

ExitStatus movie(const Options& options) {
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

void add_movie_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
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
