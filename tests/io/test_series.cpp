// SPDX-License-Identifier: Apache-2.0
#include "io/series.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>
#include <stdexcept>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

const std::vector<SeriesColumn> columns{{"time", "s"}, {"speed", "m/s"}};
const std::string header = "time [s],speed [m/s]\n";

TEST(Series, WritesAHeaderAndShortestNumbersAndIsReadableWhileItGrows) {
  const ScratchFolder folder;
  SeriesWriter writer(folder / "series.csv", columns);
  EXPECT_EQ(content_of(folder / "series.csv"), header);
  writer.append(std::vector{0.1, 1e-05});
  EXPECT_EQ(content_of(folder / "series.csv"), header + "0.1,1e-05\n");
  writer.append(std::vector{2.0, std::nan("")});
  EXPECT_EQ(content_of(folder / "series.csv"), header + "0.1,1e-05\n2,nan\n");
  EXPECT_EQ(writer.position(), 2u);
  EXPECT_THROW(writer.append(std::vector{1.0}), std::invalid_argument);
  EXPECT_THROW(SeriesWriter(folder / "x.csv", {{"a,b", "m"}}), std::invalid_argument);
}

TEST(Series, ReadsBackBitForBit) {
  const ScratchFolder folder;
  const std::vector<double> values{
      1.0 / 3, -0.0, 0x1.0p-1074, 1.7976931348623157e308, 9007199254740993.0, std::numeric_limits<double>::infinity()};
  SeriesWriter writer(folder / "series.csv", columns);
  for (const double value : values) writer.append(std::vector{value, -value});
  const Series series = read_series(folder / "series.csv");
  EXPECT_THAT(series.names, ElementsAre("time", "speed"));
  EXPECT_THAT(series.units, ElementsAre("s", "m/s"));
  ASSERT_EQ(series.rows(), values.size());
  EXPECT_EQ(std::memcmp(series.column("time").data(), values.data(), values.size() * sizeof(double)), 0);
  EXPECT_TRUE(std::signbit(series.column("speed")[0]));
  EXPECT_THAT(message_of<std::out_of_range>([&] { series.column("spede"); }), HasSubstr("there are: time, speed"));
}

TEST(Series, ResumesAfterAnyRowWhateverStandsBehindIt) {
  const std::string rows = "1,10\n2,20\n3,30\n";
  for (const std::string tail : {"", "4", "4,40", "4,40\n5,5"}) {
    const ScratchFolder folder;
    put_content(folder / "series.csv", header + rows + tail);
    SeriesWriter writer = SeriesWriter::resume(folder / "series.csv", columns, 2);
    EXPECT_EQ(writer.position(), 2u);
    EXPECT_EQ(content_of(folder / "series.csv"), header + "1,10\n2,20\n");
    writer.append(std::vector{3.5, 35.0});
    EXPECT_EQ(content_of(folder / "series.csv"), header + "1,10\n2,20\n3.5,35\n");
    EXPECT_EQ(writer.position(), 3u);
  }
}

TEST(Series, RefusesToResumeAnotherOrAShorterFile) {
  const ScratchFolder folder;
  put_content(folder / "series.csv", "time [s],speed [mm/s]\n1,10\n2,2");
  const auto resume = [&](std::uint64_t rows) { SeriesWriter::resume(folder / "series.csv", columns, rows); };
  EXPECT_THAT(message_of<FileError>([&] { resume(1); }),
              HasSubstr("found: time [s],speed [mm/s]; expected: time [s],speed [m/s]"));
  put_content(folder / "series.csv", header + "1,10\n2,2");
  EXPECT_THAT(message_of<FileError>([&] { resume(2); }),
              HasSubstr("it has 1 whole rows, the checkpoint was made after 2"));
  EXPECT_EQ(content_of(folder / "series.csv"), header + "1,10\n2,2");
  EXPECT_THAT(message_of<FileError>([&] { SeriesWriter::resume(folder / "none.csv", columns, 0); }),
              HasSubstr("none.csv: cannot open: No such file or directory"));
}

TEST(Series, ReaderIgnoresAnIncompleteLastLineAndNamesABadOne) {
  const ScratchFolder folder;
  put_content(folder / "series.csv", header + "1,10\n2,2");
  EXPECT_THAT(read_series(folder / "series.csv").column("speed"), ElementsAre(10));
  const auto message = [&](const std::string& content) {
    put_content(folder / "series.csv", content);
    return message_of<FileError>([&] { read_series(folder / "series.csv"); });
  };
  EXPECT_THAT(message(header + "1,10\n2\n"), HasSubstr("line 3: 1 values for 2 columns"));
  EXPECT_THAT(message(header + "1,1O\n"), HasSubstr("line 2: speed: '1O' is not a number"));
  EXPECT_THAT(message("time,speed\n"), HasSubstr("line 1: 'time' is not of the form 'name [unit]'"));
  EXPECT_THAT(message("time [s]"), HasSubstr("has no header line"));
}

}  // namespace
}  // namespace talus
