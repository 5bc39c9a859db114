// SPDX-License-Identifier: Apache-2.0
/// talus picture: runs at one time, or a strip of times, as a PNG.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>

#include "app/commands.hpp"
#include "app/picture/options.hpp"
#include "base/text.hpp"

namespace talus::app {

namespace {

struct Options {
  PictureOptions picture;
  std::vector<std::string> times;
  int columns = 0;
};

/// Runs below each other, each with its times; one run, or one time, alone in rows of equal length.
int columns_of(const Options& options, const Artist& artist, std::size_t runs, std::size_t times) {
  if (options.columns > 0) return options.columns;
  if (runs > 1 && times > 1) return static_cast<int>(times);
  const std::size_t panels = runs * times, most = static_cast<std::size_t>(artist.panels_in_a_row());
  const std::size_t rows = (panels + most - 1) / most;
  return static_cast<int>((panels + rows - 1) / rows);
}

ExitStatus picture(const Options& options) {
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

}  // namespace

void add_picture_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<Options>();
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

}  // namespace talus::app
