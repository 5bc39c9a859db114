// SPDX-License-Identifier: Apache-2.0
#include "run/jobs.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
#include <string_view>
#include <thread>

#include "base/error.hpp"
#include "io/file_list.hpp"

namespace talus::run {

namespace {

using Clock = std::chrono::steady_clock;

struct Running {
  std::size_t job;
  Clock::time_point start;
};

/// \param input, output, errors descriptors of the new process's stdin, stdout and stderr; 0: its parent's stdin
pid_t start(const std::vector<std::string>& words, int input, int output, int errors) {
  std::vector<char*> arguments;
  for (const std::string& word : words) arguments.push_back(const_cast<char*>(word.c_str()));
  arguments.push_back(nullptr);

  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    // Only calls that are safe between fork and exec. A process group of its own keeps Ctrl-C for the parent, which
    // passes it on.
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(126);
    if (input != STDIN_FILENO) dup2(input, STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(errors, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  if (child < 0) throw FileError(words[0], std::string("cannot be started: ") + std::strerror(errno));
  return child;
}

/// A descriptor that is closed at its end.
class Descriptor {
 public:
  Descriptor(int number, const std::string& name) : number_(number) {
    if (number < 0) throw FileError(name, std::string("cannot be opened: ") + std::strerror(errno));
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;
  ~Descriptor() { close(number_); }
  int number() const { return number_; }

 private:
  int number_;
};

pid_t start(const Job& job) {
  claim_file(job.output);
  const Descriptor output(open(job.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666),
                          job.output.string());
  return start(job.arguments, STDIN_FILENO, output.number(), output.number());
}

/// A file in memory alone.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC), name) {}
  int descriptor() const { return descriptor_.number(); }

  /// From here on it is read from its beginning.
  void write_all(std::string_view text) const {
    while (!text.empty()) {
      const ssize_t written = ::write(descriptor_.number(), text.data(), text.size());
      if (written < 0) throw FileError("memory", std::string("cannot be written: ") + std::strerror(errno));
      text.remove_prefix(static_cast<std::size_t>(written));
    }
    lseek(descriptor_.number(), 0, SEEK_SET);
  }
  std::string read_all() const {
    lseek(descriptor_.number(), 0, SEEK_SET);
    std::string text;
    char part[4096];
    for (ssize_t n = 0; (n = ::read(descriptor_.number(), part, sizeof part)) > 0;)
      text.append(part, static_cast<std::size_t>(n));
    return text;
  }

 private:
  Descriptor descriptor_;
};

int exit_status(int wait_status) {
  return WIFEXITED(wait_status) ? WEXITSTATUS(wait_status) : 128 + WTERMSIG(wait_status);
}

}  // namespace

bool run_jobs(const std::vector<Job>& jobs, int at_once, const std::function<void(const JobEnd&)>& on_end,
              const std::function<void()>& on_wait, const std::function<bool()>& interrupted) {
  std::map<pid_t, Running> running;
  std::size_t next = 0;
  bool stopping = false;
  auto stop_all = [&] {
    for (const auto& [pid, job] : running) kill(pid, SIGTERM);
    stopping = true;
  };
  auto collect = [&](bool wait) {
    int status = 0;
    const pid_t pid = waitpid(-1, &status, wait ? 0 : WNOHANG);
    const auto found = running.find(pid);
    if (found == running.end()) return false;
    const Running ended = found->second;
    running.erase(found);
    on_end({ended.job, exit_status(status), std::chrono::duration<double>(Clock::now() - ended.start).count()});
    return true;
  };

  while (next < jobs.size() || !running.empty()) {
    if (!stopping && interrupted()) stop_all();
    if (stopping && running.empty()) break;
    while (!stopping && next < jobs.size() && running.size() < static_cast<std::size_t>(at_once)) {
      try {
        running[start(jobs[next])] = {next, Clock::now()};
      } catch (...) {
        stop_all();
        while (!running.empty()) collect(true);
        throw;
      }
      ++next;
    }
    while (collect(false)) {
    }
    if (!running.empty()) {
      on_wait();
      std::this_thread::sleep_for(std::chrono::milliseconds(20));
    }
  }
  return !stopping;
}

ProgramEnd run_program(const std::vector<std::string>& arguments, const std::string& input,
                       const std::function<bool()>& interrupted) {
  const MemoryFile given("input"), output("output"), errors("errors");
  given.write_all(input);
  const pid_t child = start(arguments, given.descriptor(), output.descriptor(), errors.descriptor());
  int status = 0;
  bool stopped = false;
  for (pid_t ended = 0; ended != child;) {
    ended = waitpid(child, &status, WNOHANG);
    if (ended < 0) throw FileError(arguments[0], std::string("cannot be waited for: ") + std::strerror(errno));
    if (ended == child) break;
    if (!stopped && interrupted()) kill(child, SIGTERM), stopped = true;
    std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  return {exit_status(status), output.read_all(), errors.read_all()};
}

std::string own_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw FileError("/proc/self/exe", error.message());
  return path.string();
}

}  // namespace talus::run
