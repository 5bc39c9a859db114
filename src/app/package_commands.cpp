// SPDX-License-Identifier: Apache-2.0
/// Commands that are modules of the package python/talus: ensemble, compare, reproduce. Here are their options, for
/// help, completion and man page; the module gets them checked. And talus answer: what the package asks of the program,
/// JSON on stdin and stdout. A question is an object {"question": NAME, ...}; its answer {"answer": ...}, or
/// {"problems": [text, ...]} where the input is wrong. Numbers that are not finite are texts.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <iostream>
#include <iterator>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "analysis/measure.hpp"
#include "app/commands.hpp"
#include "app/law/shear_data.hpp"
#include "app/materials/materials.hpp"
#include "app/models/models.hpp"
#include "app/project/project.hpp"
#include "app/report/report.hpp"
#include "app/runs/run_case.hpp"
#include "base/unit.hpp"
#include "io/file_list.hpp"
#include "io/points_csv.hpp"
#include "io/report_page.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"

namespace talus::app {

namespace {

/// What options are bound to; no one reads it: the words are of the options.
struct PackageOptions {
  CaseOptions case_options;
  std::string text, out;
  std::vector<std::string> texts;
  int number = 0;
  bool flag = false;
};

CLI::App* add_command(CLI::App& app, Action& action, const std::shared_ptr<PackageOptions>& options,
                      const std::string& name, const std::string& text, const std::string& footer) {
  CLI::App* command = app.add_subcommand(name, text);
  command->footer(footer);
  command->callback([command, options, &action] {
    action = [command, words = words_of(*command)] { return become_package(command->get_name(), words); };
  });
  return command;
}

CLI::Option* add_jobs_option(CLI::App& command, PackageOptions& options) {
  return command
      .add_option("--jobs", options.number, "runs at a time, each on one thread; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->default_str("processors");
}

using Json = nlohmann::ordered_json;
using Texts = std::vector<std::string>;

Json number(double value) {
  return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value));
}

Json json_of(const Vector3& v) {
  return {v.x, v.y, v.z};
}

template <class Number>
Json json_of(const Number& value) {
  return value;
}

double number_of(const Json& value) {
  return value.is_string() ? std::stod(value.get<std::string>()) : value.get<double>();
}

/// {"value", "unit"} in the unit in which Talus writes such a quantity, {"si"} as well; or {"why"} it is none.
Json quantity(const std::string& text) {
  std::string why;
  const auto parsed = parse_quantity(text, &why);
  if (!parsed) return {{"why", why}};
  const std::string unit = unit_name(parsed->dimension);
  return {{"value", std::stod(format_quantity(parsed->value, unit))}, {"unit", unit}, {"si", parsed->value}};
}

/// {"texts"}; a list of quantities.
Json quantities(const Json& question) {
  Json all = Json::array();
  for (const std::string text : question.at("texts")) all.push_back(quantity(text));
  return all;
}

/// The yield loci of {"file"}: {"consolidation", "bulk_density" or null, "points", "angle", "major", "strength"}, SI.
Json yield_loci(const Json& question) {
  Json all = Json::array();
  for (const MeasuredLocus& found : read_shear_data(question.at("file").get<std::string>())) {
    Json points = Json::array();
    for (const granular::YieldPoint& point : found.points) points.push_back({point.normal, point.shear});
    all.push_back({{"consolidation", found.consolidation},
                   {"bulk_density", found.bulk_density ? Json(*found.bulk_density) : Json()},
                   {"points", std::move(points)},
                   {"angle", found.locus.angle},
                   {"major", found.locus.major},
                   {"strength", found.locus.strength}});
  }
  return all;
}

/// The points of {"file"}, a wall yield locus: [normal stress, shear stress], Pa.
Json wall_locus(const Json& question) {
  Json points = Json::array();
  for (const granular::YieldPoint& point : read_wall_data(question.at("file").get<std::string>()))
    points.push_back({point.normal, point.shear});
  return points;
}

/// Of {"file"}, a material: true. \throws InputError with what a case that names it would be refused for
Json material(const Json& question) {
  const std::vector<Problem> problems = problems_of_material(question.at("file").get<std::string>());
  if (!problems.empty()) throw InputError(problems);
  return true;
}

/// The quantities of summaries: {"name", "unit", "may_be_missing"} of all models.
Json measures(const Json& /*question*/) {
  Json all = Json::array();
  for (const MeasureText& m : all_measures())
    all.push_back({{"name", m.name}, {"unit", m.unit}, {"may_be_missing", m.may_be_missing}});
  return all;
}

bool has_seed(const PreparedCase& prepared) {
  return std::any_of(prepared.parameters.begin(), prepared.parameters.end(), [](const DescribedParameter& item) {
    return item.parameter.key == "seed" && item.parameter.condition.holds;
  });
}

/// The members of a group: member k has the case's seed + k; where nothing is random there is one, in the group's
/// folder.
Json members_of(CaseFile file, const Texts& settings, const std::filesystem::path& folder, int count, bool resume) {
  const PreparedCase first = prepare_case(file);
  check_memory(first, file);
  const bool random = has_seed(first);
  Json members = Json::array();
  for (int k = 0; k < (random ? count : 1); ++k) {
    const std::int64_t seed = first.seed + k;
    std::filesystem::path of_member = folder;
    Texts own = settings;
    if (random) {
      own.push_back(fmt::format("seed={}", seed));
      file.set(own.back());
      of_member /= fmt::format("seed_{:04}", seed);
    }
    const PreparedCase prepared = resume ? prepare_to_resume(file, of_member) : prepare_case(file);
    members.push_back({{"seed", seed},
                       {"settings", own},
                       {"folder", of_member.string()},
                       {"fingerprint", case_fingerprint(prepared)},
                       {"end", prepared.run.end}});
  }
  return members;
}

/// Reads and checks the case of every group of an ensemble: {"case", "settings", "groups": [{"folder", "settings"}],
/// "members", "resume"}; {"groups": [[{"seed", "settings", "folder", "fingerprint", "end"}]], "pictures", "problems"}.
Json plan(const Json& question) {
  Json answer = {{"groups", Json::array()}, {"pictures", true}, {"problems", Json::array()}};
  Json& problems = answer["problems"];
  for (const Json& group : question.at("groups")) try {
      CaseFile file = CaseFile::read(question.at("case").get<std::string>());
      Texts settings = question.at("settings");
      for (const std::string& setting : settings) file.set(setting);
      for (const std::string setting : group.at("settings")) {
        file.set(setting, "--vary");
        settings.push_back(setting);
      }
      answer["groups"].push_back(members_of(file, settings, group.at("folder").get<std::string>(),
                                            question.at("members"), question.at("resume")));
      answer["pictures"] = prepare_case(file).run.pictures;
      const ModelEntry& model = model_of(file);
      if (!model.measures) continue;
      for (const MeasureText& measure : model.measures())
        answer["quantities"][std::string(measure.name)] = measure.unit;
    } catch (const InputError& error) {  // the case's own faults come with every group: once is enough
      for (const Problem& problem : error.problems())
        if (const std::string text = to_string(problem);
            std::find(problems.begin(), problems.end(), text) == problems.end())
          problems.push_back(text);
    }
  return answer;
}

/// The columns of {"file"}, points as CSV: {"name", "unit", "values"}.
Json points(const Json& question) {
  Json columns = Json::array();
  for (const PointSet::Column& column : read_points_csv(question.at("file").get<std::string>()).columns) {
    Json values = Json::array();
    std::visit(
        [&](const auto& all) {
          for (const auto& value : all) values.push_back(json_of(value));
        },
        column.values);
    columns.push_back({{"name", column.name}, {"unit", column.unit}, {"values", std::move(values)}});
  }
  return columns;
}

/// Whether a folder may be used, and makes it: {"folder", "resume", "known": runs have begun there}.
Json begin(const Json& question) {
  begin_output(question.at("folder").get<std::string>(),
               question.at("resume").get<bool>() ? Existing::resume : Existing::refuse, "--resume",
               question.at("known"));
  return nullptr;
}

/// Makes {"folders"} and enters {"files"} into the lists of what Talus wrote.
Json claim(const Json& question) {
  for (const std::string folder : question.at("folders")) make_folder(folder);
  for (const std::string file : question.at("files")) claim_file(file);
  return nullptr;
}

/// {"quantity": name or null, "at", "from", "to"} of a run: {"reaches": the end of the window, "value" or "fault"}.
Json answer_of_run(OpenedRun& run, const Json& question) {
  Window window{.from = number_of(question.at("from")), .to = number_of(question.at("to"))};
  if (!question.at("at").is_null()) window.at = number_of(question.at("at"));
  const double last = window.at.value_or(std::isfinite(window.to) ? window.to : window.from);
  Json answer = {{"reaches", !std::isfinite(last) || run.reaches(last)}};
  if (!answer["reaches"] || question.at("quantity").is_null()) return answer;
  try {
    answer["value"] = number(run.number(question.at("quantity"), window));
  } catch (const std::logic_error& error) {
    answer["fault"] = error.what();
  }
  return answer;
}

/// Quantities of runs over windows of time: {"runs": [{"folder", "questions"}]}; a list of answers a run.
Json numbers_in(const Json& question) {
  Json all = Json::array();
  for (const Json& asked : question.at("runs")) {
    const auto run = open_run(asked.at("folder").get<std::string>(), OpenedRun::many_times);
    Json answers = Json::array();
    for (const Json& one : asked.at("questions")) answers.push_back(answer_of_run(*run, one));
    all.push_back(std::move(answers));
  }
  return all;
}

/// Writes the page of runs: {"path", "title", "runs", "comparisons"} as talus.lab.gathered gives them. Without the page
/// of reports nothing.
Json report(const Json& question) {
  if (!has_report_page()) return false;
  ReportRequest request = request_of(question.dump());
  request.title = question.at("title");
  write_report(request, question.at("path").get<std::string>());
  return true;
}

struct Question {
  std::string_view name;
  Json (*answer)(const Json& question);
};
constexpr Question questions[] = {
    {"plan", plan},         {"begin", begin},           {"claim", claim},          {"points", points},
    {"measures", measures}, {"quantities", quantities}, {"numbers", numbers_in},   {"report", report},
    {"material", material}, {"yield-loci", yield_loci}, {"wall-locus", wall_locus}};

ExitStatus answer_question() {
  const std::string text(std::istreambuf_iterator<char>(std::cin), {});
  Json said;
  try {
    const Json asked = Json::parse(text);
    const auto found = std::find_if(std::begin(questions), std::end(questions),
                                    [&](const Question& one) { return one.name == asked.at("question"); });
    if (found == std::end(questions)) throw FileError("talus answer", "there is no such question");
    said["answer"] = found->answer(asked);
  } catch (const InputError& error) {
    for (const Problem& problem : error.problems()) said["problems"].push_back(to_string(problem));
  } catch (const Json::exception& error) {
    throw FileError("talus answer", error.what());
  }
  fmt::print("{}\n", said.dump(-1, ' ', false, Json::error_handler_t::replace));
  return ExitStatus::done;
}

}  // namespace

void add_ensemble_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PackageOptions>();
  CLI::App* command = add_command(
      app, action, options, "ensemble", "run many members of a case: seeds and varied keys",
      "Each member is an ordinary run's folder, FOLDER/GROUP/seed_0001. Beside them: members.csv, quantities.csv "
      "(mean\n"
      "and standard deviation), bands_*.csv and pictures; with --vary, FOLDER/sweep.csv and sweep.json: the varied "
      "keys\n"
      "against every quantity, and sweep.png. A killed ensemble goes on with --resume. Exit status 3 if a member "
      "failed; those that did\n"
      "are listed.");
  options->case_options.add_to(*command);
  command
      ->add_option("--members", options->number,
                   "members of each group; member k has the case's seed + k; one where nothing is random")
      ->check(CLI::Range(1, 1000000))
      ->default_str("20");
  command->add_option("--vary", options->texts, "one group for each value; several --vary: all combinations")
      ->type_name("KEY=V1,V2,...")
      ->allow_extra_args(false);
  add_jobs_option(*command, *options);
  add_out_option(*command, options->out, "folder of the results; results/NAME-ensemble if not given");
  auto* resume = command->add_flag("--resume", options->flag, "go on with the ensemble in the folder");
  command->add_option("--plot", options->texts, "quantities that sweep.png shows; those that differ if not given")
      ->delimiter(',')
      ->type_name("NAME,...");
  auto* launch = add_launch_options(*command, options->text, options->texts,
                                    "where the members run: here, or slurm: as an array job, gathered by another");
  command->add_flag("--gather", options->flag, "run nothing: tables and pictures of the members that are done")
      ->excludes(resume)
      ->excludes(launch);
}

void add_compare_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PackageOptions>();
  CLI::App* command = add_command(
      app, action, options, "compare", "compare runs with a reference, or two runs with each other",
      "Against a reference: every row printed, computed, met or not; exit status 1 if one is not met. Two runs: their\n"
      "quantities side by side, and their series in one picture with --picture. Nothing is written unless asked for.");
  command->add_option("DIR", options->text, "folder of a run, an ensemble or a reproduction")->required();
  command->add_option("OTHER", options->text, "REFERENCE.toml, or the folder of another run")->required();
  command->add_option("--json", options->text, "also write the rows, and which runs they are of, to this file");
  command->add_option("--picture", options->text, "two runs: also draw their series over each other into this PNG");
}

void add_calibrate_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PackageOptions>();
  CLI::App* command = add_command(
      app, action, options, "calibrate", "make a material file of shear tests, the angle of a heap, or beads",
      "Of each number the value, the interval of 95 % and where it is from; a case takes the file by grains.material.\n"
      "Yield loci: CSV with the columns consolidation, normal_stress, shear_stress, or friction_angle, cohesion (or\n"
      "unconfined_strength), consolidation (or major_stress); bulk_density; units in the header: normal_stress [kPa].\n"
      "A heap is poured with the law itself, some times. Beads are discrete elements, by LAMMPS (Debian: lammps):\n"
      "[beads] diameter, density, stiffness, spread, friction, rolling_friction, restitution; [walls.steel] friction.\n"
      "Killed, the same command goes on.");
  command->add_option("--shear-cell", options->text, "yield loci of a shear tester");
  command->add_option("--wall", options->texts, "a wall yield locus: normal_stress, shear_stress")
      ->type_name("steel=FILE")
      ->allow_extra_args(false);
  command->add_option("--repose", options->text, "angle of a poured heap, 18 to 42 deg");
  command->add_option("--grains", options->text, "beads: more than an hour of processor time")->type_name("BEADS.toml");
  command->add_flag("--quick", options->flag, "smaller cells of beads, in ten minutes: wider intervals");
  add_jobs_option(*command, *options);
  command->add_option("--bulk-density", options->text, "of the bed; with --shear-cell that of its file if not given");
  command->add_option("--grain-density", options->text, "of a grain; if not given as of a packing of 0.6");
  command->add_option("--diameter", options->text, "of a grain");
  command->add_option("--out", options->out, "material file")->required()->type_name("NAME.toml");
}

void add_reproduce_command(CLI::App& app, Action& action) {
  auto options = std::make_shared<PackageOptions>();
  CLI::App* command =
      add_command(app, action, options, "reproduce", "all runs of a paper, and every number it prints beside ours",
                  "Exit status 1 if a row of the paper is not met.");
  command
      ->add_option(
          "STUDY", options->text,
          "niiya2020 or yuu2011, a paper; yuu2011/laws, the constitutive laws side by side; dem-hopper, the hopper "
          "beside beads")
      ->required()
      ->check(CLI::IsMember({"niiya2020", "yuu2011", "yuu2011/laws", "dem-hopper"}));
  command->add_flag("--quick", options->flag, "a small part of it: the [quick] of the study's reference.toml");
  command->add_option("--members", options->number, "members of each case and radius; the paper's if not given")
      ->check(CLI::Range(1, 100000));
  command->add_option("--variant", options->texts,
                      "only these of the reference's variants (radii); may stand several times");
  add_jobs_option(*command, *options);
  add_out_option(*command, options->out, "folder; results/STUDY, or results/STUDY-quick");
  command->add_flag("--resume", options->flag, "go on with what is in the folder");
}

void add_answer_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("answer", "answer a question of the package python/talus, JSON on stdin");
  command->group("");
  command->callback([&action] { action = answer_question; });
}

}  // namespace talus::app
