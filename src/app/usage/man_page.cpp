// SPDX-License-Identifier: Apache-2.0
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "app/usage/tree.hpp"
#include "base/system.hpp"

namespace talus::app {

namespace {

/// A text as roff prints it: no escapes, no request at the start of a line, hyphens that can be copied.
std::string roff(const std::string& text) {
  std::string safe;
  for (const char c : text) {
    if (c == '\\') {
      safe += "\\e";
    } else if (c == '-') {
      safe += "\\-";
    } else if ((c == '.' || c == '\'') && (safe.empty() || safe.back() == '\n')) {
      safe += std::string("\\&") + c;
    } else {
      safe += c;
    }
  }
  return safe;
}

std::string synopsis(const UsageCommand& command) {
  std::string line = fmt::format("\\fBtalus {}\\fR", roff(command.name));
  if (!command.commands.empty()) return line + " \\fICOMMAND\\fR";
  for (const UsageOption& option : command.options)
    if (option.is_place)
      line += option.is_required ? fmt::format(" \\fI{}\\fR", roff(option.names.front()))
                                 : fmt::format(" [\\fI{}\\fR]", roff(option.names.front()));
  return line + " [\\fIOPTIONS\\fR]";
}

std::string option_text(const UsageOption& option) {
  std::string text = ".TP\n";
  if (option.is_place) {
    text += fmt::format("\\fI{}\\fR\n", roff(option.names.front()));
  } else {
    std::vector<std::string> names;
    for (const std::string& name : option.names) names.push_back(fmt::format("\\fB{}\\fR", roff(name)));
    text += fmt::format("{}{}\n", fmt::join(names, ", "),
                        option.value.empty() ? "" : fmt::format(" \\fI{}\\fR", roff(option.value)));
  }
  text += roff(option.text);
  if (!option.choices.empty()) text += roff(fmt::format("; one of {}", fmt::join(option.choices, ", ")));
  if (!option.standard.empty()) text += roff(fmt::format(" [{}]", option.standard));
  return text + "\n";
}

}  // namespace

std::string man_page(const std::vector<UsageCommand>& usage) {
  const UsageCommand& program = usage.front();
  std::string text = fmt::format(
      ".TH TALUS 1 \"\" \"talus {}\" \"User Commands\"\n.SH NAME\ntalus \\- granular flow and air\n"
      ".SH SYNOPSIS\n\\fBtalus\\fR \\fICOMMAND\\fR [\\fIARGUMENTS\\fR] [\\fIOPTIONS\\fR]\n"
      ".SH DESCRIPTION\n{}\n.PP\n.nf\n{}\n.fi\n.SH COMMANDS\n",
      program_version(), roff(program.text), roff(program.footer));
  for (const UsageCommand& command : usage) {
    if (command.name.empty()) continue;
    text += fmt::format(".SS {}\n{}\n.PP\n{}.\n", roff("talus " + command.name), synopsis(command), roff(command.text));
    for (const UsageOption& option : command.options)
      if (option.names.front() != "--help") text += option_text(option);
    if (!command.footer.empty()) text += fmt::format(".PP\n.nf\n{}\n.fi\n", roff(command.footer));
  }
  return text + ".SH SEE ALSO\nThe documents in docs/ of the source.\n";
}

}  // namespace talus::app
