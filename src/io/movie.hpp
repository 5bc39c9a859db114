// SPDX-License-Identifier: Apache-2.0
/// Movies, encoded by the program ffmpeg, to which the frames are handed one by one. The same frames and the same
/// ffmpeg give the same bytes.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

#include "io/figure/canvas.hpp"

namespace talus {

class MovieWriter {
 public:
  /// The endings of movies: .mp4 (H.264), .webm (VP9), .gif (shown by any page).
  static bool knows(const std::filesystem::path& path);

  /// Where ffmpeg is on the PATH. \throws FileError if it is not there, with what to install
  static std::filesystem::path find_encoder();

  /// Starts ffmpeg. Frames of odd size get a white row or column. \param path of the movie, with an ending that knows()
  /// has; \param rate frames a second, > 0 \throws FileError
  MovieWriter(std::filesystem::path path, int width, int height, double rate);
  /// Without finish(): nothing is left, an older movie is as it was.
  ~MovieWriter();
  MovieWriter(const MovieWriter&) = delete;
  MovieWriter& operator=(const MovieWriter&) = delete;

  /// \throws FileError if ffmpeg has ended, with what it said; std::invalid_argument if the frame has another size
  void add(const figure::Pixels& frame);

  /// Waits for ffmpeg and renames the movie into place. \throws FileError with what ffmpeg said
  void finish();

 private:
  [[noreturn]] void fail();
  int wait();

  std::filesystem::path path_, part_, said_;
  int width_, height_, frames_ = -1;  ///< frames_: the socket that ffmpeg reads from
  pid_t encoder_ = -1;
};

}  // namespace talus
