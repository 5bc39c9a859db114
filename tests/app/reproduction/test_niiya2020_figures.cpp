// SPDX-License-Identifier: Apache-2.0
#include "app/reproduction/niiya2020_figures.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "app/reproduction/niiya2020_curves.hpp"
#include "io/run_folder.hpp"
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
    run.frames.push_back(frame);
  }
  return run;
}

StudiedEnsemble ensemble(const std::string& case_name, const std::string& label, double mean_radius) {
  return {.case_name = case_name,
          .radius = label,
          .contact_weight_ratio = 5,
          .folders = {"none", "none", "none"},
          .runs = {member(mean_radius, -1), member(mean_radius, 0), member(mean_radius, 1)}};
}

/// The run's folder with three snapshots: 400 grains in a bow that runs along x.
std::filesystem::path write_run(const std::string& name, bool from_the_side) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / ("talus_figures_" + name);
  std::filesystem::remove_all(folder);
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

std::string head_of(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  std::string head(8, '\0');
  file.read(head.data(), 8);
  return head;
}

const figure::Line* line_of(const figure::Chart& chart, std::size_t n) {
  return std::get_if<figure::Line>(&chart.series.at(n));
}

TEST(Niiya2020Curves, RadiiComeInTheirOrderAndOtherCasesStayOut) {
  const std::vector<StudiedEnsemble> ensembles = {ensemble("circle", "5 mm", 5e-3),
                                                  ensemble("rectangle", "1 mm", 1e-3),
                                                  ensemble("circle", "1 mm", 1e-3),
                                                  {"circle", "2.5 mm", 0, {}, {}}};
  const Radii radii = radii_of(ensembles, "circle");
  ASSERT_EQ(radii.size(), 2u) << "an ensemble without a finished run is left out";
  EXPECT_EQ(radii[0]->radius, "1 mm");
  EXPECT_EQ(radii[1]->radius, "5 mm");
}

TEST(Niiya2020Curves, MembersThatLackANumberAreLeftOut) {
  StudiedEnsemble circle = ensemble("circle", "5 mm", radius);
  circle.runs[2].frames[1].frontal_angle = AvalancheFrame::none;
  const MembersCurve curve = members_curve(circle, &AvalancheFrame::frontal_angle, 0);
  EXPECT_THAT(curve.time, testing::ElementsAre(0, 10, 20));
  EXPECT_THAT(curve.mean, testing::ElementsAre(90, 79.5, 70));
  EXPECT_DOUBLE_EQ(curve.deviation[0], 1);
  EXPECT_DOUBLE_EQ(curve.deviation[1], std::sqrt(0.5));
  EXPECT_THAT(members_curve(circle, &AvalancheFrame::head_particles).mean, testing::ElementsAre(90, 80));
}

TEST(Niiya2020Curves, FrontSpeedsAreMeansWithBandsOverThePrintedRange) {
  const std::vector<StudiedEnsemble> ensembles = {ensemble("circle", "5 mm", radius)};
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

TEST(Niiya2020Curves, WidthsAreDensitiesAndProportionalToTheRadius) {
  const std::vector<StudiedEnsemble> ensembles = {ensemble("rectangle", "1 mm", 1e-3),
                                                  ensemble("rectangle", "5 mm", 5e-3)};
  const figure::Chart densities = width_distributions(radii_of(ensembles, "rectangle"));
  ASSERT_EQ(densities.series.size(), 3u) << "two radii and the Gaussian";
  for (std::size_t k = 0; k < 2; ++k) {
    double area = 0;
    for (const double density : line_of(densities, k)->y) area += 2 * density;
    EXPECT_NEAR(area, 1, 1e-12);
  }
  const figure::Chart widths = width_against_radius(radii_of(ensembles, "rectangle"));
  const auto* points = std::get_if<figure::Points>(&widths.series.at(0));
  ASSERT_NE(points, nullptr);
  EXPECT_NEAR(points->y[0], 12, 1e-9) << "mm: the mean of 11 and 12, 13, 14 radii";
  EXPECT_NEAR(points->y[1], 60, 1e-9);
  EXPECT_NEAR(line_of(widths, 1)->y[1] / line_of(widths, 1)->x[1], 12, 1e-9);
}

TEST(Niiya2020Figures, DrawsEveryFigureOfAStudy) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "talus_figures";
  std::filesystem::remove_all(folder);
  std::vector<StudiedEnsemble> ensembles = {ensemble("circle", "5 mm", radius), ensemble("rectangle", "5 mm", radius),
                                            ensemble("triangle", "5 mm", radius)};
  for (StudiedEnsemble& e : ensembles) e.folders[0] = write_run(e.case_name, e.case_name == "triangle");
  const std::vector<FigureOfStudy> drawn = draw_niiya2020(ensembles, folder);
  ASSERT_EQ(drawn.size(), 9u) << "Figures 3 to 11";
  std::uintmax_t bytes = 0;
  for (const FigureOfStudy& figure : drawn) {
    EXPECT_EQ(head_of(figure.path), "\x89PNG\r\n\x1a\n") << figure.path;
    EXPECT_THAT(figure.caption, testing::HasSubstr("As Figure "));
    bytes += std::filesystem::file_size(figure.path);
  }
  EXPECT_GT(bytes, 200'000u);
  EXPECT_LT(bytes, 3'000'000u);
}

TEST(Niiya2020Figures, LeavesOutWhatIsNotThere) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "talus_figures_few";
  std::filesystem::remove_all(folder);
  std::vector<StudiedEnsemble> ensembles = {ensemble("triangle", "5 mm", radius)};
  ensembles[0].folders[0] = write_run("alone", true);
  std::vector<std::string> names;
  for (const FigureOfStudy& figure : draw_niiya2020(ensembles, folder)) names.push_back(figure.path.filename());
  EXPECT_THAT(names, testing::ElementsAre("figure_03.png", "figure_07.png", "figure_11.png"));
  EXPECT_TRUE(draw_niiya2020({}, folder).empty());
}

}  // namespace
}  // namespace talus::app
