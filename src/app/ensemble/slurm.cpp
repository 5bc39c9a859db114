// SPDX-License-Identifier: Apache-2.0
#include "app/ensemble/slurm.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/error.hpp"
#include "base/system.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"
#include "run/interrupt.hpp"
#include "run/jobs.hpp"

namespace talus::app {

namespace {

/// A file name within a directive: "%" begins a pattern there.
std::string in_directive(const std::filesystem::path& path) {
  std::string text;
  for (const char c : path.string()) text += c == '%' ? std::string("%%") : std::string(1, c);
  return '"' + text + '"';
}

std::string command(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + shell_word(word);
  return text;
}

bool is_plain(const std::string& text) {
  return std::none_of(text.begin(), text.end(), [](unsigned char c) { return c < 32 || c == 127 || c == '"'; });
}

std::string members_script(const SlurmRequest& request, const std::filesystem::path& slurm) {
  std::string text = "#!/bin/bash\n";
  text += fmt::format("# The members of {}, one task each. Written by talus ensemble --launch slurm.\n",
                      slurm.parent_path().string());
  text += "#SBATCH --job-name=talus\n";
  text += fmt::format("#SBATCH --array=0-{}{}\n", request.members.size() - 1,
                      request.at_once ? fmt::format("%{}", *request.at_once) : "");
  text += "#SBATCH --cpus-per-task=1\n#SBATCH --signal=B:TERM@120\n";
  text += fmt::format("#SBATCH --output={}\n", in_directive(slurm / "tasks.out"));
  text += "#SBATCH --open-mode=append\n";
  for (const std::string& option : request.options) text += "#SBATCH " + option + "\n";
  text += fmt::format("cd {} || exit 4\n\n", shell_word(std::filesystem::current_path().string()));
  text +=
      "# member FOLDER COMMAND...: goes on where the folder is there. What it says goes beside the folder.\n"
      "member() {\n"
      "  local folder=$1\n"
      "  shift\n"
      "  if [[ -e $folder ]]; then set -- \"$@\" --resume; fi\n"
      "  exec \"$@\" > \"$folder.out\" 2>&1\n"
      "}\n\n"
      "case $SLURM_ARRAY_TASK_ID in\n";
  for (std::size_t k = 0; k < request.members.size(); ++k)
    text += fmt::format("  {}) member {} {} ;;\n", k, shell_word(request.members[k].member.folder.string()),
                        command(arguments_of(request.members[k])));
  return text + "  *) echo \"there is no member $SLURM_ARRAY_TASK_ID\" >&2; exit 2 ;;\nesac\n";
}

std::string gather_script(const SlurmRequest& request, const std::filesystem::path& slurm) {
  return fmt::format(
      "#!/bin/bash\n"
      "# Statistics, tables and pictures of the members that are done.\n"
      "#SBATCH --job-name=talus-gather\n"
      "#SBATCH --cpus-per-task=1\n"
      "#SBATCH --output={}\n"
      "cd {} || exit 4\n"
      "exec {}\n",
      in_directive(slurm / "gather.out"), shell_word(std::filesystem::current_path().string()),
      command(request.gather));
}

std::string submit_script(const std::filesystem::path& slurm) {
  return fmt::format(
      "#!/bin/bash\n"
      "# Submits the members, and what gathers them when all have ended, well or not.\n"
      "set -euo pipefail\n"
      "members=$(sbatch --parsable {})\n"
      "members=${{members%%;*}}\n"
      "gather=$(sbatch --parsable --dependency=\"afterany:$members\" {})\n"
      "echo \"members: job $members; gathered by job ${{gather%%;*}}\"\n",
      shell_word((slurm / "members.sh").string()), shell_word((slurm / "gather.sh").string()));
}

}  // namespace

std::string shell_word(const std::string& word) {
  constexpr std::string_view safe = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789_-+=./:,%@";
  if (!word.empty() && word.find_first_not_of(safe) == std::string::npos) return word;
  std::string quoted = "'";
  for (const char c : word) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

void check_slurm(const std::vector<std::string>& options, const std::filesystem::path& folder) {
  std::vector<Problem> problems;
  for (const std::string& option : options)
    if (!option.starts_with("-") || !is_plain(option))
      problems.push_back({.where = "--slurm " + option,
                          .what = "is no option of sbatch on one line",
                          .allowed = "such as --slurm=--time=2:00:00"});
  if (!is_plain(std::filesystem::absolute(folder).string()))
    problems.push_back(
        {.where = folder.string(), .what = "cannot be named in a script of Slurm", .allowed = "another --out"});
  if (!problems.empty()) throw InputError(problems);
}

std::filesystem::path write_slurm(const SlurmRequest& request) {
  const std::filesystem::path slurm = std::filesystem::absolute(request.folder).lexically_normal() / "slurm";
  check_slurm(request.options, request.folder);
  make_folder(slurm);
  for (const ScheduledRun& run : request.members) {
    make_folder(run.member.folder.parent_path());
    claim_file(output_of(run.member));
  }
  write_atomically(slurm / "members.sh", members_script(request, slurm));
  write_atomically(slurm / "gather.sh", gather_script(request, slurm));
  write_atomically(slurm / "submit.sh", submit_script(slurm));
  return slurm / "submit.sh";
}

std::optional<std::string> submit_slurm(const std::filesystem::path& submit) {
  if (!find_program("sbatch")) return std::nullopt;
  std::filesystem::path said = submit;
  said.replace_extension(".out");
  int status = -1;
  run::run_jobs(
      {{.arguments = {"/bin/bash", submit.string()}, .output = said}}, 1,
      [&](const run::JobEnd& end) { status = end.status; }, [] {}, [] { return run::signal_has_come(); });
  std::string text = read_whole_file(said);
  while (text.ends_with('\n')) text.pop_back();
  if (status != 0) throw FileError(submit.string(), "sbatch refused: " + text);
  return text;
}

}  // namespace talus::app
