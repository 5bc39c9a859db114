// SPDX-License-Identifier: Apache-2.0
/// talus law: the constitutive law of a case, tried on one material point.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <cmath>
#include <memory>
#include <optional>

#include "app/commands.hpp"
#include "app/law/law_case.hpp"
#include "app/project/project.hpp"
#include "base/text.hpp"
#include "io/file_list.hpp"

namespace talus::app {

namespace {

struct LawOptions {
  CaseOptions case_options;
  std::string path, out;
  bool overwrite = false;
};

constexpr double max_steps = 1e9;

/// \throws InputError if the path would take all day
void check_steps(const FollowedPath& path, const std::string& file) {
  const double steps = granular::steps_of_path(path.stretches, path.options);
  if (steps <= max_steps) return;
  throw InputError(
      {{.where = file,
        .what = fmt::format("takes {:.2g} steps of path.max_increment = {:g}", steps, path.options.max_increment),
        .allowed = fmt::format("at most {:.0g} steps: less strain, or a larger increment", max_steps)}});
}

/// \throws NumericalError at the first point that is not finite
void check_finite(const FollowedPath& path) {
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    const granular::PathPoint& point = path.points[k];
    if (std::isfinite(norm(point.stress)) && std::isfinite(norm(point.strain)) && std::isfinite(point.density))
      continue;
    throw NumericalError({.what = "the stress, strain or density is not finite",
                          .term = "law " + std::string(choice_name(path.parameters.law.name)),
                          .place = fmt::format("stretch {} of the path", 1 + (k - 1) / path.options.points),
                          .step = k,
                          .time = point.time,
                          .advice = "less strain on the stretch"});
  }
}

Existing existing_of(const LawOptions& options) {
  return options.overwrite ? Existing::overwrite : Existing::refuse;
}

/// \throws InputError if it may not be used
std::filesystem::path folder_of(const LawOptions& options) {
  const auto stem = [](const std::string& name) { return std::filesystem::path(name).stem().string(); };
  const std::filesystem::path folder =
      options.out.empty()
          ? std::filesystem::path("results") / (stem(options.case_options.path) + "-" + stem(options.path))
          : std::filesystem::path(options.out);
  check_output(folder, existing_of(options), "--overwrite");
  return folder;
}

ExitStatus follow(const LawOptions& options) {
  const LawCase parameters = read_law_case(options.case_options.read());
  const std::vector<granular::PathStretch> stretches = read_path(found_file(options.path));
  FollowedPath path{.parameters = parameters,
                    .law = granular::make_law(parameters.law, parameters.grains.density, parameters.grains.diameter),
                    .stretches = stretches,
                    .options = path_options(parameters, stretches.size()),
                    .points = {}};
  check_steps(path, options.path);
  const std::filesystem::path folder = folder_of(options);
  path.points = granular::follow_path(path.law, path.stretches, path.options);
  check_finite(path);

  begin_output(folder, existing_of(options), "--overwrite");
  write_path_table(path, folder / "path.csv");
  const auto fits = with_chosen_law(parameters.law, []<class Law>(const typename Law::Parameters& own) {
    if constexpr (requires { own.fits; }) return std::optional<granular::Fits>(own.fits);
    return std::optional<granular::Fits>();
  });
  if (fits) write_functions(*fits, folder / "functions.csv");
  for (const char* picture : {"path.png", "functions.png"}) claim_file(folder / picture);
  std::string files = fits ? "path.csv, functions.csv" : "path.csv";
  for (const std::filesystem::path& drawn : draw_charts({"law", folder.string()}, folder))
    files += ", " + drawn.filename().string();

  print("{:18} {}\n", "law", choice_name(parameters.law.name));
  for (const NamedValue& quantity : quantities_of(path))
    print("{:18} {:.6g}{}\n", quantity.name, quantity.value, quantity.unit == "1" ? "" : " " + quantity.unit);
  print("{}: {}\n", folder.string(), files);
  return ExitStatus::done;
}

}  // namespace

void add_law_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<LawOptions>();
  CLI::App* command = app.add_subcommand(
      "law", "drive one material point along a strain path (element test): its stress as table and plot");
  options->case_options.add_to(*command);
  command->add_option("--path", options->path, "the path (CSV); see below")->required();
  add_out_option(*command, options->out, "folder of the results; results/CASE-PATH if not given");
  command->add_flag("--overwrite", options->overwrite, "replace what an earlier path left in the folder");
  command->footer(
      "CASE holds a table [law] with that of its law, [law.NAME], and may hold [collisions], grains.density,\n"
      "grains.diameter and gravity.acceleration, as a case of the model continuum does; of such a case the rest is\n"
      "passed over. Its table [path] has packing, points and max_increment.\n\n"
      "A line of the path is a stretch: how long it lasts, and the velocity gradient du_x/dz as gradient_xz, ...;\n"
      "components left out are zero. The grains are squashed by 0.02 %, then sheared, back, and on:\n"
      "  duration [s],gradient_zz [1/s],gradient_xz [1/s]\n"
      "  1,-0.0002,0\n"
      "  1,0,0.002\n"
      "  1,0,-0.0001\n"
      "  1,0,0.002\n\n"
      "A column stress_zz [Pa] (or _xx, _yy, _xz) prescribes that stress, reached evenly by the end of each stretch,\n"
      "and the law finds gradient_zz: sheared under a constant load by duration [s],stress_zz [kPa],gradient_xz "
      "[1/s].\n\n"
      "Stress and strain are positive in compression, and the law's answer does not depend on the durations but for\n"
      "a law's smoothing_time, the law critical-state and the stress by collisions.");
  command->callback([options, &action] { action = [options] { return follow(*options); }; });
}

}  // namespace talus::app
