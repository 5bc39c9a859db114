// SPDX-License-Identifier: Apache-2.0
#include "run/jobs.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <map>
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

pid_t start(const Job& job) {
  claim_file(job.output);
  const int output = open(job.output.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW | O_CLOEXEC, 0666);
  if (output < 0) throw FileError(job.output.string(), std::string("cannot be opened: ") + std::strerror(errno));
  std::vector<char*> arguments;
  for (const std::string& argument : job.arguments) arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);

  const pid_t parent = getpid();
  const pid_t child = fork();
  if (child == 0) {
    // Only calls that are safe between fork and exec. A process group of its own keeps Ctrl-C for the parent, which
    // passes it on.
    setpgid(0, 0);
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != parent) _exit(126);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    execv(arguments[0], arguments.data());
    _exit(127);
  }
  const int error = errno;
  close(output);
  if (child < 0) throw FileError(job.arguments[0], std::string("cannot be started: ") + std::strerror(error));
  return child;
}

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

std::string own_program() {
  std::error_code error;
  const auto path = std::filesystem::read_symlink("/proc/self/exe", error);
  if (error) throw FileError("/proc/self/exe", error.message());
  return path.string();
}

}  // namespace talus::run
