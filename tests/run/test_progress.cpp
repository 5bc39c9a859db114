// SPDX-License-Identifier: Apache-2.0
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

#include "run/progress.hpp"

namespace talus::run {

namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using namespace std::chrono_literals;

TEST(Progress, CutsCharactersNotBytes) {
  EXPECT_EQ(cut("abc", 3), "abc");
  EXPECT_EQ(cut("abc", 2), "ab");
  EXPECT_EQ(cut("1 ± 2 µm", 3), "1 ±");
  EXPECT_EQ(cut("1 ± 2 µm", 8), "1 ± 2 µm");
  EXPECT_EQ(cut("", 5), "");
}

TEST(Progress, SaysTimesAsOneWould) {
  EXPECT_EQ(format_seconds(59.4), "59 s");
  EXPECT_EQ(format_seconds(75), "1 min 15 s");
  EXPECT_EQ(format_seconds(3 * 3600 + 125), "3 h 2 min");
  EXPECT_EQ(format_seconds(5.6 * 86400), "6 days");
  EXPECT_EQ(format_seconds(7221 * 3600 + 180), "10 months");
  EXPECT_EQ(format_seconds(3e8), "10 years");
}

/// Lines of a phase that goes at these speeds, a pair (duration, way) each; what is told does not depend on the
/// machine's speed as long as the last speed lasts.
class Lines {
 public:
  Lines() : file_(std::tmpfile()), progress_(file_, [this](const std::string& line) { lines.push_back(line); }) {}
  ~Lines() { std::fclose(file_); }
  Lines(const Lines&) = delete;
  Lines& operator=(const Lines&) = delete;

  Progress& operator*() { return progress_; }
  std::vector<std::string> lines;

  /// What went to the stream.
  std::string written() const {
    std::string text;
    std::rewind(file_);
    for (int c = 0; (c = std::fgetc(file_)) != EOF;) text += static_cast<char>(c);
    return text;
  }

 private:
  std::FILE* file_;
  Progress progress_;
};

TEST(Progress, TellsATenthAsALineAndNoMore) {
  Lines lines;
  (*lines).begin({.start = 0, .end = 100});
  for (int n = 0; n < 1000; ++n) (*lines).update(n < 500 ? 5 : 31, [] { return "text"; });
  // Below a tenth, and the third: the lines between are passed over.
  EXPECT_THAT(lines.lines, ElementsAre(HasSubstr("text   31 %")));
  for (int n = 0; n < 1000; ++n) (*lines).update(39.9, [] { return "text"; });
  EXPECT_EQ(lines.lines.size(), 1u);
  EXPECT_EQ(lines.written(), lines.lines[0] + "\n");
}

TEST(Progress, APhaseHasItsOwnSpeed) {
  Lines lines;
  (*lines).begin({.start = 0, .end = 1, .name = "settling", .after = 2});
  std::this_thread::sleep_for(1200ms);
  (*lines).update(0.2, [] { return "a"; });
  // 1.2 s for a fifth: at most 4.8 s more, then 12 s.
  ASSERT_EQ(lines.lines.size(), 1u);
  EXPECT_THAT(lines.lines[0], ::testing::MatchesRegex("a  settling, at most [0-9]+ s, then about [0-9]+ s"));
  (*lines).begin({.start = 0, .end = 2});
  std::this_thread::sleep_for(1100ms);
  (*lines).update(1.9, [] { return "b"; });
  ASSERT_EQ(lines.lines.size(), 2u);
  EXPECT_THAT(lines.lines[1], ::testing::MatchesRegex("b   95 %  ETA [0-9]+ s"));
}

}  // namespace

namespace {

using namespace std::chrono_literals;

std::string said_in(std::chrono::milliseconds phase) {
  std::FILE* file = std::tmpfile();
  {
    const Waiting waiting("drawing pictures", file, 0.05);
    std::this_thread::sleep_for(phase);
  }
  std::string text;
  std::rewind(file);
  for (int c = 0; (c = std::fgetc(file)) != EOF;) text += static_cast<char>(c);
  std::fclose(file);
  return text;
}

TEST(Waiting, NamesAPhaseThatLasts) {
  const std::string said = said_in(800ms);  // 50, 100, 200, 400 ms
  EXPECT_THAT(said, ::testing::HasSubstr("drawing pictures ... 0 s\n"));
  EXPECT_LE(std::count(said.begin(), said.end(), '\n'), 5);
}

TEST(Waiting, SaysNothingOfAShortOne) {
  EXPECT_EQ(said_in(0ms), "");
}

}  // namespace

}  // namespace talus::run
