// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/answers.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <limits>

#include "io/series.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

const std::vector<NamedValue> emptied = {{"discharge_steady", "kg/s", 0.4791},
                                         {"discharge_steady_error", "kg/s", 0.011},
                                         {"discharge_rate_beverloo", "kg/s", 0.502},
                                         {"emptying_time", "s", 0.7197},
                                         {"emptying_time_by_hand", "s", 0.654},
                                         {"residual_fraction", "1", -3e-14},
                                         {"share_that_moves", "1", 1},
                                         {"mass_flow_half_angle_jenike", "deg", 42.24},
                                         {"weight_balance_error_at_rest", "1", -0.0084}};

class Answers : public ::testing::Test {
 protected:
  Answers() : folder(std::filesystem::path(::testing::TempDir()) / "answers") {
    std::filesystem::remove_all(folder);
    std::filesystem::create_directories(folder / "analysis");
  }
  ~Answers() override { std::filesystem::remove_all(folder); }

  std::filesystem::path folder;
};

const Answer* find(const std::vector<Answer>& answers, const std::string& question) {
  for (const Answer& answer : answers)
    if (answer.question == question) return &answer;
  return nullptr;
}

TEST_F(Answers, StandBesideTheFormulasUsedByHand) {
  const std::vector<Answer> answers = answers_of(small_silo(), emptied, folder);
  ASSERT_TRUE(find(answers, "steady discharge"));
  EXPECT_EQ(find(answers, "steady discharge")->answer, "0.479 ± 0.011 kg/s");
  EXPECT_EQ(find(answers, "steady discharge")->by_hand, "0.502 kg/s (Beverloo; Rose & Tanaka)");
  EXPECT_EQ(find(answers, "99 % have left")->answer, "after 0.72 s");
  EXPECT_EQ(find(answers, "99 % have left")->by_hand, "0.654 s (at the discharge by hand)");
  EXPECT_EQ(find(answers, "above the outlet at the end")->answer, "0.0 % of the bed");
  EXPECT_EQ(find(answers, "kind of flow")->answer, "mass flow, 100 % of the bed moves");
  EXPECT_EQ(find(answers, "kind of flow")->by_hand,
            "mass flow, 30 degrees of at most 42 (Jenike, grains of 30 degrees in plane strain)");
  EXPECT_EQ(find(answers, "walls bear at rest")->answer, "99.2 % of the weight");
}

TEST_F(Answers, HaveTheErrorToThePlaceOfTheNumber) {
  std::vector<NamedValue> rate = emptied;
  const auto written = [&](double number, double error) {
    rate[0].value = number, rate[1].value = error;
    return find(answers_of(small_silo(), rate, folder), "steady discharge")->answer;
  };
  EXPECT_EQ(written(0.4788, 0.00918), "0.479 ± 0.009 kg/s");
  EXPECT_EQ(written(0.02418, 0.00031), "0.0242 ± 0.0003 kg/s");
  EXPECT_EQ(written(12.34, 1.04), "12.3 ± 1.0 kg/s");
  EXPECT_EQ(written(4321, 52), "4321 ± 52 kg/s");
}

TEST_F(Answers, OfASiloThatDoesNotEmptySaySo) {
  std::vector<NamedValue> stuck = emptied;
  stuck[3].value = std::numeric_limits<double>::quiet_NaN();
  stuck[5].value = 0.2;
  stuck[6].value = 0.6;
  const std::vector<Answer> answers = answers_of(small_silo(), stuck, folder);
  EXPECT_EQ(find(answers, "99 % have left")->answer, "not by the end");
  EXPECT_EQ(find(answers, "above the outlet at the end")->answer, "20.0 % of the bed");
  stuck[7].value = 25;
  EXPECT_EQ(find(answers_of(small_silo(), stuck, folder), "kind of flow")->answer,
            "funnel flow, 60 % of the bed moves");
  EXPECT_EQ(find(answers_of(small_silo(), stuck, folder), "kind of flow")->by_hand,
            "funnel flow, 30 degrees of at most 25 (Jenike, grains of 30 degrees in plane strain)");
}

TEST_F(Answers, NameTheBandOfEachWallThatBearsMost) {
  write_table(
      folder / "analysis/wall_loads.csv",
      {{"patch", "1"}, {"low", "m"}, {"high", "m"}, {"pressure_at_rest", "Pa"}, {"pressure_at_rest_by_hand", "Pa"}},
      {{1, 0.09, 0.1, 270, 289},
       {1, 0.1, 0.11, 216, 224},
       {2, 0.06, 0.07, 538, 523},
       {2, 0.07, 0.08, 572, 621},
       {3, 0.05, 0.06, 0.6, 0}});
  const std::vector<Answer> answers = answers_of(small_silo(), {}, folder);
  ASSERT_EQ(answers.size(), 2u) << "the third bears next to nothing";
  EXPECT_EQ(answers[0].question, "largest pressure at rest, cylinder");
  EXPECT_EQ(answers[0].answer, "270 Pa at z = 95 mm");
  EXPECT_EQ(answers[0].by_hand, "289 Pa (Janssen)");
  EXPECT_EQ(answers[1].answer, "572 Pa at z = 75 mm");
  EXPECT_EQ(answers[1].by_hand, "621 Pa (Walker)");
}

TEST_F(Answers, AreOfVesselsAlone) {
  EXPECT_TRUE(answers_of(continuum::Parameters{}, emptied, folder).empty());
}

}  // namespace
}  // namespace talus::app
