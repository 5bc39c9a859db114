// SPDX-License-Identifier: Apache-2.0
#include "app/case_options.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <thread>

#include "app/project/project.hpp"

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

std::filesystem::path default_results(const std::string& case_path) {
  return std::filesystem::path("results") / std::filesystem::path(case_path).stem();
}

void add_out_option(CLI::App& command, std::string& out, const std::string& text) {
  command.add_option("--out", out, text)
      ->check(
          CLI::Validator([](std::string& given) { return given.empty() ? "is empty; allowed: a folder" : ""; }, ""));
}

void add_threads_option(CLI::App& command, int& threads) {
  threads = std::max(1, static_cast<int>(std::thread::hardware_concurrency()));
  command.add_option("--threads", threads, "threads; the results do not depend on it")
      ->check(CLI::Range(1, 1024))
      ->capture_default_str();
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
