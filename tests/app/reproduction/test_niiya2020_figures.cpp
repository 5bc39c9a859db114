// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "app/reproduction/niiya2020_curves.hpp"
#include "app/reproduction/niiya2020_heads.hpp"
#include "app/reproduction/niiya2020_snapshots.hpp"
#include "io/run_folder.hpp"
#include "io/scratch_folder.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {
namespace {

constexpr double radius = 5e-3, stokes_speed = 40;

/// A member whose numbers are those of the others plus `shift`, at 0, 10, 20 a/v_s.
AvalancheRun member(double mean_radius, double shift) {
  AvalancheRun run{.scales = {mean_radius, stokes_speed}, .grains = 400};
  for (int n = 1; n <= 80; ++n) {
    run.front_speed.time.push_back(0.25 * n);
    run.front_speed.value.push_back(50 - n / 4.0 + shift);
  }
  run.front_speed_end = 30 + shift;
  for (int n = 0; n <= 2; ++n) {
    AvalancheFrame frame;
    frame.time = 10 * n;
    frame.front_speed = n == 0 ? AvalancheFrame::none : 50 - 10 * n + shift;
    frame.head_count = 2;
    frame.head_particles = 100 - 10 * n + shift;
    frame.head_width = (40 - n) * mean_radius;
    frame.head_thickness = 10 * mean_radius;
    frame.head_widths = {11 * mean_radius, (13 + shift) * mean_radius};
    frame.frontal_angle = 90 - 10 * n + shift;
    frame.head_curl_left = 0.3 + 0.1 * shift, frame.head_curl_right = -0.3;
    frame.head_rear_relative_velocity = 0.1, frame.head_front_outward_velocity = 0.4;
    frame.head_upper_relative_velocity = -3 + shift, frame.head_lower_relative_velocity = -1;
    frame.tail_relative_velocity = -20, frame.front_rear_thickness_ratio = 4;
    run.frames.push_back(frame);
  }
  return run;
}

AvalancheEnsemble ensemble(const std::string& case_name, const std::string& label, double mean_radius) {
  return {.case_name = case_name,
          .radius = label,
          .contact_weight_ratio = 5,
          .folders = {"none", "none", "none"},
          .runs = {member(mean_radius, -1), member(mean_radius, 0), member(mean_radius, 1)}};
}

/// The run's folder with three snapshots: 400 grains in a bow that runs along x.
std::filesystem::path write_run(const std::filesystem::path& folder, bool from_the_side) {
  std::filesystem::create_directories(folder / "snapshots");
  for (int n = 0; n <= 2; ++n) {
    PointSet points{.time = 10 * n * radius / stokes_speed, .step = static_cast<std::uint64_t>(n), .columns = {}};
    std::vector<Vector3> position, velocity;
    for (int i = 0; i < 400; ++i) {
      const double across = 2.2 * (i % 40 - 19.5), along = 2.2 * (i / 40) - 0.01 * across * across + 300 * n;
      position.push_back(from_the_side ? Vector3{along, 0, 1 + 2.2 * (i % 40)} : Vector3{along, across, 0});
      position.back() = radius * position.back();
      velocity.push_back(stokes_speed * Vector3{40 + 0.05 * across, 0, 0});
    }
    points.columns = {
        {"position", "m", position}, {"velocity", "m/s", velocity}, {"radius", "m", std::vector<double>(400, radius)}};
    write_points(RunFolder(folder).snapshot(n), points.view());
  }
  return folder;
}

/// Width and height that a PNG file's header tells; {0, 0} if it is none.
std::pair<int, int> size_of_png(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(24, '\0');
  file.read(head.data(), 24);
  if (head.substr(0, 8) != "\x89PNG\r\n\x1a\n") return {0, 0};
  auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = 0; k < 4; ++k) value = 256 * value + static_cast<unsigned char>(head[at + k]);
    return value;
  };
  return {number(16), number(20)};
}

const figure::Line* line_of(const figure::Chart& chart, std::size_t n) {
  return std::get_if<figure::Line>(&chart.series.at(n));
}

TEST(Niiya2020Curves, RadiiComeInTheirOrderAndOtherCasesStayOut) {
  const std::vector<AvalancheEnsemble> ensembles = {ensemble("circle", "5 mm", 5e-3),
                                                    ensemble("rectangle", "1 mm", 1e-3),
                                                    ensemble("circle", "1 mm", 1e-3),
                                                    {"circle", "2.5 mm", 0, {}, {}}};
  const Radii radii = radii_of(ensembles, "circle");
  ASSERT_EQ(radii.size(), 2u) << "an ensemble without a finished run is left out";
  EXPECT_EQ(radii[0]->radius, "1 mm");
  EXPECT_EQ(radii[1]->radius, "5 mm");
}

TEST(Niiya2020Curves, MembersThatLackANumberAreLeftOut) {
  AvalancheEnsemble circle = ensemble("circle", "5 mm", radius);
  circle.runs[2].frames[1].frontal_angle = AvalancheFrame::none;
  const MembersCurve curve = members_curve(circle, &AvalancheFrame::frontal_angle, 0);
  EXPECT_THAT(curve.time, testing::ElementsAre(0, 10, 20));
  EXPECT_THAT(curve.mean, testing::ElementsAre(90, 79.5, 70));
  EXPECT_DOUBLE_EQ(curve.deviation[0], 1);
  EXPECT_DOUBLE_EQ(curve.deviation[1], std::sqrt(0.5));
  EXPECT_THAT(members_curve(circle, &AvalancheFrame::head_particles).mean, testing::ElementsAre(90, 80));
}

TEST(Niiya2020Curves, FrontSpeedsAreMeansWithBandsOverThePrintedRange) {
  const std::vector<AvalancheEnsemble> ensembles = {ensemble("circle", "5 mm", radius)};
  const figure::Chart chart = front_speeds(radii_of(ensembles, "circle"), 30, 70);
  ASSERT_EQ(chart.series.size(), 2u);
  const auto* printed = std::get_if<figure::Reference>(&chart.series[0]);
  ASSERT_NE(printed, nullptr);
  EXPECT_EQ(printed->low, 30);
  EXPECT_EQ(printed->high, 70);
  const figure::Line* line = line_of(chart, 1);
  ASSERT_NE(line, nullptr);
  EXPECT_DOUBLE_EQ(line->y.front(), 49.75);
  EXPECT_DOUBLE_EQ(line->y.back(), 30);
  EXPECT_DOUBLE_EQ(line->spread.front(), 1);
  EXPECT_EQ(front_speeds(radii_of(ensembles, "circle"), 0, 0).series.size(), 1u) << "nothing printed, nothing drawn";
}

const figure::Points& points_of(const figure::Chart& chart, std::size_t n) {
  return std::get<figure::Points>(chart.series.at(n));
}

TEST(Niiya2020Curves, LengthsAreInRadiiAndRatiosThoseOfTheMembers) {
  const std::vector<AvalancheEnsemble> ensembles = {ensemble("circle", "1 mm", 1e-3), ensemble("circle", "5 mm", 5e-3)};
  const Radii radii = radii_of(ensembles, "circle");
  const figure::Chart sizes = head_sizes(radii);
  ASSERT_EQ(sizes.series.size(), 6u) << "two numbers at two radii, and what filled and open symbols mean";
  for (const std::size_t k : {0u, 1u}) {
    for (const double thickness : points_of(sizes, k).y) EXPECT_NEAR(thickness, 10, 1e-12);
    EXPECT_NEAR(points_of(sizes, 2 + k).y.at(0), 39, 1e-12);
    EXPECT_NEAR(points_of(sizes, 2 + k).y.at(1), 38, 1e-12);
  }
  EXPECT_NE(points_of(sizes, 0).symbol, points_of(sizes, 2).symbol);
  EXPECT_EQ(points_of(sizes, 1).label, "*a*_{p} = 5 mm");
  EXPECT_EQ(points_of(sizes, 3).label, "") << "each radius once";
  EXPECT_NEAR(points_of(head_aspect_ratios(radii), 0).y.at(1), 3.8, 1e-12);
}

TEST(Niiya2020Curves, TheTimeAxisEndsRoundAndMotionsHaveTheirSigns) {
  std::vector<AvalancheEnsemble> ensembles = {ensemble("circle", "5 mm", radius)};
  const Radii radii = radii_of(ensembles, "circle");
  EXPECT_DOUBLE_EQ(*head_curls(radii).x.high, 20);
  for (AvalancheRun& run : ensembles[0].runs) run.frames.back().time = 20.3;
  EXPECT_DOUBLE_EQ(*head_curls(radii).x.high, 25);
  EXPECT_NEAR(points_of(head_curls(radii), 0).y.at(1), 0.3, 1e-12);
  EXPECT_NEAR(points_of(head_curls(radii), 0).y_error.at(1), 0.1, 1e-12);
  EXPECT_NEAR(points_of(head_curls(radii), 1).y.at(1), -0.3, 1e-12);
  EXPECT_NEAR(points_of(layer_motions(radii), 0).y.at(0), -3, 1e-12);
  EXPECT_NEAR(points_of(layer_motions(radii), 1).y.at(0), -1, 1e-12);
  EXPECT_NEAR(points_of(tail_motions(radii), 0).y.at(0), -20, 1e-12);
  EXPECT_NEAR(points_of(thickness_ratios(radii), 0).y.at(0), 4, 1e-12);
  EXPECT_EQ(points_of(frontal_angles(radii), 0).x.size(), 3u) << "the angle has a value at the start";
}

TEST(Niiya2020Heads, WidthsAreDensitiesAndProportionalToTheRadius) {
  const std::vector<AvalancheEnsemble> ensembles = {ensemble("rectangle", "1 mm", 1e-3),
                                                    ensemble("rectangle", "5 mm", 5e-3)};
  const Radii radii = radii_of(ensembles, "rectangle");
  const figure::Chart densities = width_distributions(radii);
  ASSERT_EQ(densities.series.size(), 5u) << "lines and points of two radii, and the Gaussian";
  for (const std::size_t k : {0u, 2u}) {
    double area = 0;
    for (const double density : line_of(densities, k)->y) area += 2 * density;
    EXPECT_NEAR(area, 1, 1e-12);
    EXPECT_EQ(points_of(densities, k + 1).y, line_of(densities, k)->y);
  }
  EXPECT_THAT(points_of(densities, 1).label, testing::HasSubstr("6 heads"));
  const figure::Line& gaussian = *line_of(densities, 4);
  double area = 0, first = 0;
  for (std::size_t n = 1; n < gaussian.x.size(); ++n) {
    area += gaussian.y[n] * (gaussian.x[n] - gaussian.x[n - 1]);
    first += gaussian.x[n] * gaussian.y[n] * (gaussian.x[n] - gaussian.x[n - 1]);
  }
  EXPECT_NEAR(area, 1, 0.05);
  EXPECT_NEAR(first, 12, 1) << "the widths lie from 11 to 14";

  const figure::Chart widths = width_against_radius(radii);
  EXPECT_NEAR(points_of(widths, 0).y[0], 12, 1e-9) << "mm: the mean of 11 and 12, 13, 14 radii";
  EXPECT_NEAR(points_of(widths, 0).y[1], 60, 1e-9);
  EXPECT_NEAR(line_of(widths, 1)->y[1] / line_of(widths, 1)->x[1], 12, 1e-9);

  const figure::Chart counts = head_counts(radii);
  EXPECT_THAT(points_of(counts, 0).x, testing::ElementsAre(1, 5));
  EXPECT_THAT(points_of(counts, 0).y, testing::ElementsAre(2, 2));
  EXPECT_THAT(points_of(counts, 1).y, testing::ElementsAre(17.20, 13.95, 14.85));
}

TEST(Niiya2020Snapshots, MeasuresTheShapesAndTheHeadOnTheirGrains) {
  AvalancheEnsemble circle = ensemble("circle", "5 mm", radius);
  const ScratchFolder scratch;
  circle.folders[0] = write_run(scratch / "measured", false);
  MemberSnapshots member(circle);
  const figure::ParticlePicture band = member.rectangle_at_start();
  ASSERT_EQ(band.segments.size(), 1u);
  EXPECT_NEAR(norm(band.segments[0].to - band.segments[0].from) / radius, 39 * 2.2, 1e-9);

  const figure::ParticlePicture head = member.head_by(HeadRule::Measure::indirect, 10);
  const auto& by = std::get<figure::ByCategory>(head.colouring);
  double left = -1, right = 1;
  int measured = 0;
  for (std::size_t i = 0; i < by.of.size(); ++i) {
    if (by.of[i] == 0) continue;
    left = std::max(left, head.positions[i].y + radius), right = std::min(right, head.positions[i].y - radius);
    measured += by.of[i] == 2;
  }
  EXPECT_GE(measured, 3);
  EXPECT_LE(measured, 4) << "the foremost and the inner grain may be one";
  const auto width = std::find_if(head.segments.begin(), head.segments.end(),
                                  [](const figure::Segment& segment) { return segment.label == "*w*_{h}"; });
  ASSERT_NE(width, head.segments.end());
  EXPECT_NEAR(norm(width->to - width->from), left - right, 1e-12);
}

class Niiya2020Figures : public testing::Test {
 protected:
  std::vector<AvalancheEnsemble> whole_study() const;
  ScratchFolder scratch_;
};

std::vector<AvalancheEnsemble> Niiya2020Figures::whole_study() const {
  std::vector<AvalancheEnsemble> ensembles = {ensemble("circle", "5 mm", radius), ensemble("rectangle", "5 mm", radius),
                                              ensemble("triangle", "5 mm", radius)};
  for (AvalancheEnsemble& e : ensembles) e.folders[0] = write_run(scratch_ / e.case_name, e.case_name == "triangle");
  return ensembles;
}

TEST_F(Niiya2020Figures, DrawsEveryFigureOfAStudy) {
  const std::vector<FigureOfStudy> drawn = draw_niiya2020(whole_study(), scratch_ / "all");
  ASSERT_EQ(drawn.size(), 10u) << "Figures 3 to 11, and the motions";
  std::uintmax_t bytes = 0;
  for (const FigureOfStudy& figure : drawn) {
    const auto [width, height] = size_of_png(figure.path);
    EXPECT_EQ(width, &figure == &drawn.front() ? 1181 : 1440) << figure.path;
    EXPECT_GT(height, 400) << figure.path;
    EXPECT_LT(height, 2 * width) << figure.path;
    EXPECT_THAT(figure.title, testing::HasSubstr("Figure"));
    EXPECT_THAT(figure.caption, testing::StartsWith("(a) "));
    EXPECT_EQ(figure.caption.find('\n'), std::string::npos);
    bytes += std::filesystem::file_size(figure.path);
  }
  EXPECT_GT(bytes, 200'000u);
  EXPECT_LT(bytes, 3'000'000u);
  EXPECT_THAT(drawn[2].caption, testing::HasSubstr("3 members"));
}

TEST_F(Niiya2020Figures, SaysWhatOneRadiusLacks) {
  const std::vector<FigureOfStudy> drawn = draw_niiya2020(whole_study(), scratch_ / "one_radius");
  const auto sizes = std::find_if(drawn.begin(), drawn.end(),
                                  [](const FigureOfStudy& f) { return f.path.filename() == "figure_10.png"; });
  ASSERT_NE(sizes, drawn.end());
  EXPECT_THAT(sizes->caption, testing::HasSubstr("Left out: width against radius"));
  EXPECT_THAT(sizes->caption, testing::HasSubstr("(c) their number"));
  EXPECT_THAT(sizes->caption, testing::Not(testing::HasSubstr("(d)")));
}

TEST_F(Niiya2020Figures, DrawsWhatFailedMembersLeave) {
  std::vector<AvalancheEnsemble> ensembles = whole_study();
  AvalancheEnsemble fewer = ensemble("circle", "1 mm", 1e-3);
  fewer.folders = {"none"};
  fewer.runs.resize(1);
  ensembles.push_back(fewer);
  ensembles[2].runs[1].frames[2].frontal_angle = AvalancheFrame::none;
  const std::vector<FigureOfStudy> drawn = draw_niiya2020(ensembles, scratch_ / "fewer");
  ASSERT_EQ(drawn.size(), 10u);
  EXPECT_THAT(drawn[2].caption, testing::HasSubstr("1 to 3 members"));
}

TEST_F(Niiya2020Figures, LeavesOutWhatIsNotThere) {
  std::vector<AvalancheEnsemble> ensembles = {ensemble("triangle", "5 mm", radius)};
  ensembles[0].folders[0] = write_run(scratch_ / "alone", true);
  const std::vector<FigureOfStudy> drawn = draw_niiya2020(ensembles, scratch_ / "few");
  std::vector<std::string> names;
  for (const FigureOfStudy& figure : drawn) names.push_back(figure.path.filename());
  EXPECT_THAT(names, testing::ElementsAre("figure_03.png", "figure_07.png", "figure_11.png", "figure_motions.png"));
  EXPECT_THAT(drawn[0].caption,
              testing::HasSubstr("Left out for want of finished runs: Figures 4, 5, 8 and 9 (circle), "
                                 "Figure 6 (rectangle)."));
  EXPECT_TRUE(draw_niiya2020({}, scratch_ / "none").empty());
}

}  // namespace
}  // namespace talus::app
