// SPDX-License-Identifier: Apache-2.0
#include "io/movie.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <fstream>
#include <stdexcept>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/system.hpp"
#include "io/file.hpp"
#include "io/file_list.hpp"

namespace talus {

namespace {

/// What makes the movie of frames, by the ending of its name. One thread and `bitexact`: the same bytes every time.
std::vector<std::string> encoding(const std::string& ending) {
  const std::string even = "pad=ceil(iw/2)*2:ceil(ih/2)*2:color=white";
  if (ending == ".gif")
    return {"-filter_complex",
            "split[a][b];[a]palettegen=max_colors=128:stats_mode=full[p];[b][p]paletteuse=dither=none", "-f", "gif"};
  if (ending == ".webm")
    return {"-vf", even,      "-c:v", "libvpx-vp9", "-crf",    "32", "-b:v",
            "0",   "-row-mt", "0",    "-pix_fmt",   "yuv420p", "-f", "webm"};
  return {"-vf", even,       "-c:v",    "libx264",   "-preset",    "medium", "-crf",
          "22",  "-pix_fmt", "yuv420p", "-movflags", "+faststart", "-f",     "mp4"};
}

std::string name_of(const std::filesystem::path& path, const char* ending) {
  std::filesystem::path with = path;
  with += ending;
  return with.string();
}

}  // namespace

bool MovieWriter::knows(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  return ending == ".mp4" || ending == ".webm" || ending == ".gif";
}

std::filesystem::path MovieWriter::find_encoder() {
  if (const auto program = find_program("ffmpeg")) return *program;
  throw FileError("ffmpeg", "is not on the PATH; movies need it (Debian: apt-get install ffmpeg)");
}

MovieWriter::MovieWriter(std::filesystem::path path, int width, int height, double rate)
    : path_(std::move(path)),
      part_(name_of(path_, ".part")),
      said_(name_of(path_, ".said")),
      width_(width),
      height_(height) {
  const std::string program = find_encoder().string();
  const std::filesystem::path folder = path_.has_parent_path() ? path_.parent_path() : std::filesystem::path(".");
  if (::access(folder.c_str(), W_OK) != 0)
    throw FileError(path_.string(), "cannot be written: " + system_reason(errno));
  claim_file(path_);
  std::vector<std::string> arguments = {program,
                                        "-nostdin",
                                        "-loglevel",
                                        "error",
                                        "-y",
                                        "-threads",
                                        "1",
                                        "-filter_complex_threads",
                                        "1",
                                        "-f",
                                        "rawvideo",
                                        "-pixel_format",
                                        "bgr0",
                                        "-video_size",
                                        fmt::format("{}x{}", width, height),
                                        "-framerate",
                                        fmt::format("{}", rate),
                                        "-i",
                                        "pipe:0",
                                        "-an"};
  for (std::string& argument : encoding(path_.extension().string())) arguments.push_back(std::move(argument));
  for (const char* argument : {"-threads", "1", "-fflags", "+bitexact", "-flags:v", "+bitexact", "-map_metadata", "-1"})
    arguments.emplace_back(argument);
  arguments.push_back("file:" + part_.string());  // whatever its name begins with
  std::vector<char*> pointers;
  for (std::string& argument : arguments) pointers.push_back(argument.data());
  pointers.push_back(nullptr);

  // A socket in place of a pipe: writing to an ffmpeg that has ended is then an error, not a signal.
  int ends[2] = {-1, -1};
  if (::socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, ends) != 0)
    throw FileError(path_.string(), "cannot hand over frames: " + system_reason(errno));
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[0], STDIN_FILENO);
  posix_spawn_file_actions_addopen(&actions, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, STDERR_FILENO, said_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_NOFOLLOW,
                                   0666);
  const int error = ::posix_spawn(&encoder_, program.c_str(), &actions, nullptr, pointers.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[0]);
  frames_ = ends[1];
  if (error != 0) {
    encoder_ = -1;
    ::close(frames_);
    ::unlink(said_.c_str());
    throw FileError(path_.string(), fmt::format("{} cannot be started: {}", program, system_reason(error)));
  }
}

MovieWriter::~MovieWriter() {
  if (frames_ >= 0) ::close(frames_);
  if (encoder_ > 0) wait();
  ::unlink(part_.c_str());
  ::unlink(said_.c_str());
}

int MovieWriter::wait() {
  int status = -1;
  while (::waitpid(encoder_, &status, 0) < 0 && errno == EINTR) {
  }
  encoder_ = -1;
  return status;
}

void MovieWriter::fail() {
  std::ifstream file(said_);
  std::string line, said;
  while (std::getline(file, line))
    if (!line.empty()) said = line;
  throw FileError(path_.string(), "ffmpeg could not write it" + (said.empty() ? std::string() : ": " + said));
}

void MovieWriter::add(const figure::Pixels& frame) {
  if (frame.width != width_ || frame.height != height_)
    throw std::invalid_argument(
        fmt::format("a frame of {} x {} in a movie of {} x {}", frame.width, frame.height, width_, height_));
  for (std::size_t sent = 0; sent < frame.bytes.size();) {
    const ssize_t count = ::send(frames_, frame.bytes.data() + sent, frame.bytes.size() - sent, MSG_NOSIGNAL);
    if (count > 0) sent += static_cast<std::size_t>(count);
    if (count <= 0 && errno != EINTR) {
      wait();
      fail();
    }
  }
}

void MovieWriter::finish() {
  ::close(std::exchange(frames_, -1));
  if (wait() != 0) fail();
  std::error_code error;
  std::filesystem::rename(part_, path_, error);
  if (error) throw FileError(path_.string(), "cannot rename into place: " + error.message());
}

}  // namespace talus
