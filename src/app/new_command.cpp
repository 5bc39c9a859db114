// SPDX-License-Identifier: Apache-2.0
/// talus new: a commented case from a few numbers.
#include <fmt/format.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <iostream>
#include <memory>

#include "app/commands.hpp"
#include "app/models/models.hpp"
#include "app/new/kind.hpp"
#include "base/error.hpp"
#include "base/text.hpp"
#include "io/case_file.hpp"
#include "io/file.hpp"

namespace talus::app {

namespace {

struct NewOptions {
  const Kind* kind = nullptr;
  std::map<std::string, std::string> texts = {};  // by the names of the questions
  std::map<std::string, bool> flags = {};
  std::string out = {};
  bool overwrite = false;
};

/// Asks until there is an answer; an empty one takes the standard.
void ask(const Question& question, Answers& answers) {
  for (;;) {
    print("{} [{}]: ", question.text,
          question.is_flag            ? std::string_view("no")
          : question.standard.empty() ? std::string_view("none")
                                      : question.standard);
    std::fflush(stdout);
    std::string line;
    if (!std::getline(std::cin, line))
      throw InputError(std::vector<Problem>{{.where = "talus new", .what = "the answers end"}});
    if (question.is_flag) {
      if (line.empty() || line == "no" || line == "n" || line == "yes" || line == "y")
        return answers.set(question.name, line.starts_with('y') ? 1 : 0);
      print("yes or no\n");
      continue;
    }
    if (line.empty()) line = question.standard;
    if (line.empty()) return;
    const Answer answer = read_answer(question, line);
    if (answer.value) return answers.set(question.name, *answer.value);
    if (answer.word) return answers.set(question.name, *answer.word);
    print("'{}' {}; allowed: {}\n", line, answer.what, answer.allowed);
  }
}

/// From the options; on a terminal what was not given is asked. \throws InputError with every problem
Answers answers_of(const NewOptions& options) {
  const bool asks = isatty(STDIN_FILENO) == 1 && isatty(STDOUT_FILENO) == 1;
  if (asks && !options.kind->sketch.empty()) print("{}\n", options.kind->sketch);
  Answers answers;
  std::vector<Problem> problems;
  for (const Question& question : options.kind->questions) {
    const std::string name(question.name);
    std::string text = options.texts.at(name);
    const bool given = question.is_flag ? options.flags.at(name) : !text.empty();
    if (!given && asks) {
      ask(question, answers);
      continue;
    }
    if (question.is_flag) {
      answers.set(question.name, given ? 1 : 0);
      continue;
    }
    if (!given) text = question.standard;
    if (text.empty()) continue;
    const Answer answer = read_answer(question, text);
    if (answer.value)
      answers.set(question.name, *answer.value);
    else if (answer.word)
      answers.set(question.name, *answer.word);
    else
      problems.push_back({.where = fmt::format("--{} {}", name, text),
                          .what = answer.what,
                          .allowed = answer.allowed,
                          .nearest = answer.nearest});
  }
  if (problems.empty() && options.kind->check)
    problems = by_option(*options.kind, options.texts, options.kind->check(answers));
  if (!problems.empty()) throw InputError(problems);
  return answers;
}

ExitStatus write_case(const NewOptions& options) {
  const std::filesystem::path path = options.out.empty() ? fmt::format("{}.toml", options.kind->name) : options.out;
  if (std::filesystem::exists(path) && !options.overwrite)
    throw InputError({{.where = path.string(), .what = "is there already", .allowed = "another -o, or --overwrite"}});
  const std::string text = options.kind->write(answers_of(options));
  try {
    prepare_case(CaseFile::from_text(text, path.string()));  // before anything is written: what talus check would say
  } catch (const InputError& error) {
    throw InputError(by_option(*options.kind, options.texts, error.problems()));
  }
  write_atomically(path, text);
  print("Case: {}\nNext: talus check {}\n      talus run {}\n", path.string(), path.string(), path.string());
  return ExitStatus::done;
}

}  // namespace

void add_new_command(CLI::App& app, Action& action) {
  CLI::App* command = app.add_subcommand("new", "write a commented case from a few numbers");
  command->require_subcommand(1);
  command->footer(
      "What is not given takes the value in brackets; on a terminal it is asked for. The case is checked before it is\n"
      "written, and is an ordinary text file: change it as you like.\n"
      "  talus new hopper --outlet \"20 mm\" --half-angle \"30 deg\" --air -o wedge.toml");
  for (const Kind& kind : kinds()) {
    auto options = std::make_shared<NewOptions>();
    options->kind = &kind;
    CLI::App* of_kind = command->add_subcommand(std::string(kind.name), std::string(kind.text));
    for (const Question& question : kind.questions) {
      const std::string name(question.name), text(question.text);
      if (question.is_flag) {
        of_kind->add_flag("--" + name, options->flags[name], text);
        options->texts[name] = {};
      } else {
        of_kind->add_option("--" + name, options->texts[name],
                            question.standard.empty() ? text : fmt::format("{} [{}]", text, question.standard));
      }
    }
    of_kind->add_option("-o,--out", options->out, fmt::format("the file to write; {}.toml if not given", kind.name));
    of_kind->add_flag("--overwrite", options->overwrite, "replace the file");
    if (!kind.sketch.empty()) of_kind->footer(std::string(kind.sketch));
    of_kind->callback([options, &action] { action = [options] { return write_case(*options); }; });
  }
}

}  // namespace talus::app
