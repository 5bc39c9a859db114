// SPDX-License-Identifier: Apache-2.0
#include "base/terminal.hpp"

#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"

namespace talus {
namespace {

using namespace std::string_literals;

TEST(Printable, LeavesTextAsItIs) {
  EXPECT_EQ(printable("Discharge through a slit of 40 mm, 45\u00b0, \u00b5m, \u706b \U0001f30b"),
            "Discharge through a slit of 40 mm, 45\u00b0, \u00b5m, \u706b \U0001f30b");
}

TEST(Printable, EscapesWhatMovesACursor) {
  EXPECT_EQ(printable("\x1b[31mred\r\b\a"), "\\u001b[31mred\\u000d\\u0008\\u0007");
  EXPECT_EQ(printable("\x7f\0"s), "\\u007f\\u0000");
  EXPECT_EQ(printable("\u009b31m"), "\\u009b31m");               // a control sequence by one character
  EXPECT_EQ(printable("a\u202eb\u2066c"), "a\\u202eb\\u2066c");  // what follows would be written backwards
}

TEST(Printable, EscapesWhatIsNoUtf8) {
  EXPECT_EQ(printable("\x9b\x33"), "\\x9b3");
  EXPECT_EQ(printable("\xc3"), "\\xc3");
  EXPECT_EQ(printable("\xc0\x9b"), "\\xc0\\x9b");           // an overlong ESC's cousin
  EXPECT_EQ(printable("\xed\xa0\x80"), "\\xed\\xa0\\x80");  // half of a surrogate pair
  EXPECT_EQ(printable("\xf5\x80\x80\x80"), "\\xf5\\x80\\x80\\x80");
}

TEST(Printable, KeepsLineEndsWhereAsked) {
  EXPECT_EQ(printable("a\nb\tc"), "a\\nb\\tc");
  EXPECT_EQ(printable("a\nb\x1b", Controls::line_ends), "a\nb\\u001b");
}

TEST(Printable, HoldsInMessages) {
  EXPECT_EQ(to_string({.where = "a\x1b[2J.toml", .line = 3, .key = "k\ney", .what = "unknown\r"}),
            "a\\u001b[2J.toml:3: k\\ney: unknown\\u000d");
  EXPECT_STREQ(FileError("a\x1b.csv", "cannot open").what(), "a\\u001b.csv: cannot open");
}

TEST(Wrapped, BreaksAtBlanksAndIndents) {
  EXPECT_EQ(wrapped("one two three", 9, 2, 0), "one two\n  three");
  EXPECT_EQ(wrapped("one two three", 9, 2, 5), "one\n  two\n  three");
  EXPECT_EQ(wrapped("one two", 9, 2, 20), "\n  one two");
  EXPECT_EQ(wrapped("", 9, 2, 5), "");
  EXPECT_EQ(wrapped("a word-longer-than-a-line b", 9, 0, 0), "a\nword-longer-than-a-line\nb");
  EXPECT_EQ(wrapped("\u00b5\u00b5\u00b5\u00b5 \u00b5\u00b5\u00b5\u00b5", 9, 0, 0),
            "\u00b5\u00b5\u00b5\u00b5 \u00b5\u00b5\u00b5\u00b5");  // letters count, not bytes
}

}  // namespace
}  // namespace talus
