// SPDX-License-Identifier: Apache-2.0
#include "app/commands.hpp"

#include <fmt/ranges.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "app/project/project.hpp"
#include "app/usage/tree.hpp"
#include "base/error.hpp"
#include "base/system.hpp"
#include "base/text.hpp"

namespace talus::app {

void CaseOptions::add_to(CLI::App& command) {
  command.add_option("CASE", path, "case file (TOML)")
      ->required()
      ->transform(CLI::Validator([](std::string& given) { return given = found_file(given), std::string(); }, ""));
  command
      .add_option("--set", settings,
                  "override or add a key: table.key=value, a quantity with its unit; may be repeated")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

CaseFile CaseOptions::read() const {
  CaseFile file = CaseFile::read(path);
  for (const std::string& setting : settings) file.set(setting);
  return file;
}

std::vector<double> numbers_of(const std::string& option, const std::string& text, const Dimension& unit, double below,
                               const std::string& allowed, std::vector<Problem>& problems) {
  std::vector<double> numbers;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t comma = std::min(text.find(',', from), text.size());
    const std::string word = text.substr(from, comma - from);
    std::string why;
    const auto quantity = parse_quantity(word, &why);
    if (quantity && quantity->dimension == unit && quantity->value > 0 && quantity->value < below)
      numbers.push_back(quantity->value);
    else
      problems.push_back({.where = fmt::format("{} {}", option, text),
                          .what = fmt::format("\"{}\" {}", word,
                                              !quantity                                ? why
                                              : quantity->dimension == unit            ? "is out of range"
                                              : quantity->dimension == dimension::none ? "has no unit"
                                                                                       : "has another unit"),
                          .allowed = allowed});
    from = comma + 1;
  }
  return numbers;
}

std::filesystem::path default_results(const std::string& case_path) {
  return std::filesystem::path("results") / std::filesystem::path(case_path).stem();
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

void add_out_option(CLI::App& command, std::string& out, const std::string& text) {
  command.add_option("--out", out, text)
      ->check(
          CLI::Validator([](std::string& given) { return given.empty() ? "is empty; allowed: a folder" : ""; }, ""));
}

void add_threads_option(CLI::App& command, int& threads) {
  threads = processors();
  command.add_option("--threads", threads, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
}

void add_completion_command(CLI::App& app, Action& action) {
  auto shell = std::make_shared<std::string>();
  CLI::App* command = app.add_subcommand("completion", "print a script that completes commands and options in a shell");
  command->add_option("SHELL", *shell, "which shell")->required()->check(CLI::IsMember({"bash", "zsh", "fish"}));
  command->footer(
      "  bash  source <(talus completion bash)\n"
      "  zsh   talus completion zsh > FOLDER/_talus, a folder of fpath\n"
      "  fish  talus completion fish > ~/.config/fish/completions/talus.fish");
  command->callback([&app, shell, &action] {
    action = [&app, shell] {
      print("{}", completion_for(*shell, usage_of(app)));
      return ExitStatus::done;
    };
  });
}

void add_man_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("man", "print the man page");
  command->footer("  talus man > talus.1 && man -l talus.1");
  command->callback([&app, &action] {
    action = [&app] {
      print("{}", man_page(usage_of(app)));
      return ExitStatus::done;
    };
  });
}

CLI::Option* add_launch_options(CLI::App& command, std::string& launch, std::vector<std::string>& of_sbatch,
                                const std::string& text) {
  auto* option =
      command.add_option("--launch", launch, text)->check(CLI::IsMember({"here", "slurm"}))->default_str("here");
  command.add_option("--slurm", of_sbatch, "an option of sbatch: --slurm=--time=2:00:00; may be repeated")
      ->type_name("OPTION")
      ->allow_extra_args(false)
      ->needs(option);
  return option;
}

std::vector<std::string> words_of(const CLI::App& command) {
  std::vector<std::string> words, places{"--"};
  for (const CLI::Option* option : command.get_options()) {
    if (option->count() == 0) continue;
    if (option->get_items_expected_max() == 0) {
      words.push_back(option->get_name());
      continue;
    }
    for (const std::string& value : option->as<std::vector<std::string>>())
      option->get_positional() ? places.push_back(value) : words.push_back(option->get_name() + "=" + value);
  }
  words.insert(words.end(), places.begin(), places.end());
  return words;
}

}  // namespace talus::app
