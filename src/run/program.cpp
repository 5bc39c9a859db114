// SPDX-License-Identifier: Apache-2.0
#include "run/program.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

#include "base/error.hpp"
#include "run/interrupt.hpp"

namespace talus::run {

namespace {

/// \param input, output, errors descriptors of the new process's stdin, stdout and stderr
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
    dup2(input, STDIN_FILENO);
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

/// A file in memory alone.
class MemoryFile {
 public:
  explicit MemoryFile(const char* name) : descriptor_(memfd_create(name, MFD_CLOEXEC), name) {}
  int descriptor() const { return descriptor_.number(); }

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

ProgramEnd run_program(const std::vector<std::string>& arguments) {
  const Descriptor nothing(open("/dev/null", O_RDONLY | O_CLOEXEC), "/dev/null");
  const MemoryFile output("output"), errors("errors");
  const pid_t child = start(arguments, nothing.number(), output.descriptor(), errors.descriptor());
  int status = 0;
  bool stopped = false;
  for (pid_t ended = 0; ended != child;) {
    ended = waitpid(child, &status, WNOHANG);
    if (ended < 0) throw FileError(arguments[0], std::string("cannot be waited for: ") + std::strerror(errno));
    if (ended == child) break;
    if (!stopped && signal_has_come()) kill(child, SIGTERM), stopped = true;
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
