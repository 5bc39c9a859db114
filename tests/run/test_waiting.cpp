// SPDX-License-Identifier: Apache-2.0
#include "run/waiting.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdio>
#include <string>
#include <thread>

namespace talus::run {
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
