// SPDX-License-Identifier: Apache-2.0
#include "io/points_csv.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/error.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::SizeIs;

class PointsCsv : public ::testing::Test {
 protected:
  PointSet read(const std::string& content, std::span<const std::string_view> required = {}) const {
    put_content(folder_ / "points.csv", content);
    return read_points_csv(folder_ / "points.csv", required);
  }

  std::vector<std::string> problems(const std::string& content, std::span<const std::string_view> required = {}) const {
    std::vector<std::string> texts;
    try {
      read(content, required);
    } catch (const InputError& error) {
      for (const Problem& problem : error.problems())
        texts.push_back(to_string(problem).substr((folder_ / "points.csv").string().size()));
    }
    return texts;
  }

  const ScratchFolder folder_;
};

TEST_F(PointsCsv, ConvertsUnitsToTheNearestDouble) {
  const PointSet points = read(
      "x [mm],y[um], z ,radius [mm],angle [deg],mass [g],count,energy [J]\n"
      "1.1,200,3,5,180,2,7,4\n"
      "+2,-0.3,4,0.7,90,0.1,8.5,5\n");
  const Snapshot view = points.view();
  EXPECT_THAT(view.positions(), ElementsAre(Vector3{0.0011, 0.0002, 3}, Vector3{0.002, -3e-7, 4}));
  EXPECT_THAT(view.scalars("radius"), ElementsAre(0.005, 0.0007));
  EXPECT_THAT(view.scalars("angle"), ElementsAre(3.141592653589793, 1.5707963267948966));
  EXPECT_THAT(view.scalars("mass"), ElementsAre(0.002, 0.0001));
  EXPECT_THAT(view.scalars("count"), ElementsAre(7, 8.5));
  std::vector<std::string> units;
  for (const auto& column : points.columns) units.push_back(column.unit);
  EXPECT_THAT(units, ElementsAre("m", "m", "rad", "kg", "1", "J"));
}

TEST_F(PointsCsv, ToleratesBlanksLineEndsAndByteOrderMark) {
  const PointSet points = read("\xEF\xBB\xBF\"x [m]\",\"z [m]\"\r\n\r\n 1 ,\t2 \r\n3,4");
  EXPECT_THAT(points.view().positions(), ElementsAre(Vector3{1, 0, 2}, Vector3{3, 0, 4}));
  EXPECT_THAT(read("x\n1\n").view().positions(), ElementsAre(Vector3{1, 0, 0}));
  EXPECT_EQ(read("x\n").view().size(), 0u);
}

TEST_F(PointsCsv, TakesSemicolonsAndTabsWithDecimalCommasOrPoints) {
  for (const char* text : {"x [m];z [m]\n1,5;2\n3;-4,25e-1\n", "x [m]\tz [m]\n1.5\t2\n3\t-4.25e-1\n"})
    EXPECT_THAT(read(text).view().positions(), ElementsAre(Vector3{1.5, 0, 2}, Vector3{3, 0, -0.425}));
  EXPECT_THAT(problems("x;z\n1,5;2.5\n"), ElementsAre(":2: z: '2.5' has another decimal mark than entries before; "
                                                      "allowed: one mark, and no thousands"));
  EXPECT_THAT(problems("x;z\n1.000,5;2\n"), ElementsAre(":2: x: '1.000,5' is not a number"));
}

TEST_F(PointsCsv, ReportsEveryBadLineAtOnce) {
  EXPECT_THAT(problems("x [mm],radius\n"
                       "1,two\n"
                       "1,2\n"
                       "1,2,3\n"
                       "\n"
                       "nan,1e999\n"
                       ",4 mm\n"),
              ElementsAre(":2: radius: 'two' is not a number", ":4: has 3 entries for 2 columns",
                          ":6: x: 'nan' is not finite", ":6: radius: '1e999' is beyond what a double holds",
                          ":7: x: missing entry", ":7: radius: '4 mm' is not a number"));
}

TEST_F(PointsCsv, CountsBadLinesBeyondTwenty) {
  std::string content = "x,y\n";
  for (int i = 0; i < 50; ++i) content += i % 2 ? "a,b\n" : "1,c\n";
  const std::vector<std::string> texts = problems(content);
  ASSERT_THAT(texts, SizeIs(21));
  EXPECT_EQ(texts[19], ":15: x: 'a' is not a number");  // lines 2 to 14 hold 1, 2, 1, ... problems: 19
  EXPECT_EQ(texts[20], ": and 36 more bad lines");
}

TEST_F(PointsCsv, ReportsWhatIsWrongWithTheHeader) {
  const std::string_view required[] = {"radius"};
  EXPECT_THAT(problems("X,y [kg],y,mass [stone],w [m\n1,2,3,4,5\n", required),
              ElementsAre(HasSubstr(":1: y: 'kg' is no unit of length"), ":1: y: stands twice in the header",
                          HasSubstr(":1: mass: "), HasSubstr(":1: w: unit without a closing bracket"),
                          HasSubstr(":1: x: missing column"), ":1: radius: missing column"));
  EXPECT_THAT(problems("x y z\n1 2 3\n"),
              ElementsAre(HasSubstr("missing column; allowed: columns separated by commas")));
  EXPECT_THAT(problems("x [1]\n"), ElementsAre(HasSubstr("needs a unit of length")));
  EXPECT_THAT(problems("\n"), ElementsAre(HasSubstr("has no header line")));
  EXPECT_THAT(message_of<FileError>([&] { read_points_csv(folder_ / "none.csv"); }),
              HasSubstr("none.csv: cannot open: No such file or directory"));
}

TEST_F(PointsCsv, TakesRadiiByTheirUsualNames) {
  EXPECT_THAT(read("x,r\n0,0.002\n1,0.003\n").view().scalars("radius"), ElementsAre(0.002, 0.003));
  EXPECT_THAT(read("x,r [mm]\n0,2\n").view().scalars("radius"), ElementsAre(0.002));
  EXPECT_THAT(read("x,diameter [mm]\n0,2.2\n").view().scalars("radius"), ElementsAre(0.0011));
  EXPECT_THAT(problems("x,r [kg]\n0,1\n"), ElementsAre(HasSubstr(":1: r: 'kg' is no unit of length")));
  EXPECT_THAT(problems("x,diameter\n0,big\n"), ElementsAre(":2: diameter: 'big' is not a number"));
  EXPECT_THAT(problems("x,radius,diameter\n0,1,2\n"),
              ElementsAre(":1: diameter: is the column radius once more; allowed: one of them"));
}

TEST_F(PointsCsv, NamesColumnsThatHaveNoUse) {
  static constexpr KnownColumn id[] = {{"id", dimension::none}};
  static constexpr RefusedColumn refused[] = {{"vx", "no velocities here"}};
  const auto given = [&](const std::string& content) {
    put_content(folder_ / "points.csv", content);
    return read_given_points(folder_ / "points.csv", id, refused);
  };
  const std::string said = message_of<InputError>([&] { given("id,x,radus,colour,vx\n1,0,1,2,3\n"); });
  EXPECT_THAT(said, HasSubstr("points.csv:1: radus: unknown column; allowed: x, y, z, radius, id, r, diameter; did you "
                              "mean 'radius'?"));
  EXPECT_THAT(said, HasSubstr(":1: colour: unknown column; allowed: x, y, z, radius, id, r, diameter"));
  EXPECT_THAT(said, HasSubstr(":1: vx: no velocities here"));
  const GivenPoints points = given("id,x [mm],y,diameter\n7,8,0,0.006\n");
  EXPECT_THAT(points.points.view().scalars("id"), ElementsAre(7));
  EXPECT_THAT(points.points.view().scalars("radius"), ElementsAre(0.003));
  EXPECT_THAT(points.without_unit, ElementsAre("y", "radius"));
}

}  // namespace
}  // namespace talus
