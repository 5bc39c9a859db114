// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/answers.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <limits>

#include "app/continuum/engineering_units.hpp"
#include "io/scratch_folder.hpp"
#include "io/series.hpp"
#include "small_silo.hpp"

namespace talus::app {
namespace {

constexpr double none = std::numeric_limits<double>::quiet_NaN();

const std::vector<NamedValue> emptied = {{"discharge_steady", "kg/s", 0.4791},
                                         {"discharge_steady_error", "kg/s", 0.011},
                                         {"discharge_rate_beverloo", "kg/s", 0.502},
                                         {"emptying_time", "s", 0.7197},
                                         {"emptying_time_by_hand", "s", 0.654},
                                         {"residual_fraction", "1", 0.004},
                                         {"residual_mass", "kg", 0.0014},
                                         {"flow_stop_time", "s", 0.75},
                                         {"outlet_packing", "1", 0.01},
                                         {"share_that_moves", "1", 1},
                                         {"mass_flow_half_angle_jenike", "deg", 42.24},
                                         {"weight_balance_error_at_rest", "1", -0.0084}};

class Answers : public ::testing::Test {
 protected:
  Answers() { std::filesystem::create_directories(scratch / "analysis"); }

  void set(std::string_view name, double value) {
    for (NamedValue& q : quantities)
      if (q.name == name) q.value = value;
  }
  std::vector<Answer> all() const { return answers_of(continuum::Setup(small_silo()), quantities, 1, folder); }
  Answer find(const std::string& question) const {
    for (const Answer& answer : all())
      if (answer.question == question) return answer;
    return {"", "no such answer", ""};
  }

  ScratchFolder scratch;
  const std::filesystem::path& folder = scratch.path();
  std::vector<NamedValue> quantities = emptied;
};

TEST_F(Answers, StandBesideTheAnalyticalEstimates) {
  EXPECT_EQ(all().front().question, "Flow");
  EXPECT_EQ(find("Flow").answer, "has emptied after 0.72 s, 1.4 g (0.4 %) left");
  EXPECT_EQ(find("Steady discharge").answer, "0.479 ± 0.011 kg/s (95 % interval)");
  EXPECT_EQ(find("Steady discharge").by_hand, "0.502 kg/s (Beverloo; Rose & Tanaka)");
  EXPECT_EQ(find("Emptying time (99 %)").answer, "0.72 s");
  EXPECT_EQ(find("Emptying time (99 %)").by_hand, "0.654 s (at the estimated discharge)");
  EXPECT_EQ(find("Flow regime").answer, "mass flow, stagnant zone 0 %");
  EXPECT_EQ(find("Flow regime").by_hand,
            "mass flow, half angle 30° of at most 42° (Jenike, grains of 30° in plane strain)");
  EXPECT_EQ(find("Walls carry at rest").answer, "99.2 % of the weight");
}

TEST_F(Answers, SayWhatInletsCouldNotBringIn) {
  continuum::Parameters p = small_silo();
  continuum::Inlet inlet;
  inlet.centre = {0.05, 0.05, 0.15}, inlet.radius = 0.01, inlet.shape = continuum::InletShape::disc;
  inlet.velocity = {0, 0, -1}, inlet.rate = 0.5, inlet.from = 1, inlet.to = 3;
  p.inlets = {inlet};
  p.gate.opens = continuum::GateOpens::when_settled;
  const auto fed = [&](double mass) {
    quantities.push_back({"fed_mass", "kg", mass});
    std::string found;
    for (const Answer& answer : answers_of(continuum::Setup(p), quantities, 1, folder))
      if (answer.question == "Fed") found = answer.answer;
    quantities.pop_back();
    return found;
  };
  EXPECT_EQ(fed(0.98), "");
  EXPECT_EQ(fed(0.4), "400 g of 1 kg: inlets had no room for more");
}

TEST_F(Answers, OfAChuteHaveItsThroughputBesideWhatComesIn) {
  continuum::Parameters p = small_silo();
  p.vessel.resize(1);
  continuum::Inlet inlet;
  inlet.centre = {0.05, 0.05, 0.15}, inlet.radius = 0.01, inlet.shape = continuum::InletShape::disc;
  inlet.velocity = {0, 0, -1}, inlet.rate = 0.2;
  p.inlets = {inlet};
  quantities = {{"throughput", "kg/s", 0.1992}, {"throughput_error", "kg/s", 0.0024}};
  const Answer found = answers_of(continuum::Setup(p), quantities, 1, folder).front();
  EXPECT_EQ(found.question, "Throughput, steady");
  EXPECT_EQ(found.answer, "0.199 ± 0.002 kg/s");
  EXPECT_EQ(found.by_hand, "0.200 kg/s (inlets)");
  p.inlets.push_back(inlet);
  EXPECT_EQ(answers_of(continuum::Setup(p), quantities, 1, folder).front().by_hand, "0.400 kg/s (inlets)");
  p.inlets[1].from = 0.5;
  EXPECT_EQ(answers_of(continuum::Setup(p), quantities, 1, folder).front().by_hand, "") << "not together";
}

TEST_F(Answers, OfASiloThatWasNotOpenForLongClaimNoArch) {
  set("residual_fraction", 1), set("residual_mass", 12.3), set("flow_stop_time", none), set("outlet_packing", 0.6);
  set("emptying_time", none);
  continuum::Parameters p = small_silo();
  granular::CriticalState::Parameters law;
  law.tensile_strength = 1000;
  p.law = law;
  const auto flow = [&](double opens, double end) {
    p.vessel.back().opens_after = opens;
    return answers_of(continuum::Setup(p), quantities, end, folder).front().answer;
  };
  EXPECT_EQ(flow(1, 0.9), "was shut until the end of the run: 12.3 kg (100 %) left");
  EXPECT_EQ(flow(1, 1.1), "has not started: 12.3 kg (100 %) left");
  quantities.push_back({"discharge_rate_max", "kg/s", 0.1});
  for (const Answer& answer : all()) EXPECT_THAT(answer.question, testing::Not(testing::StartsWith("Peak discharge")));
  EXPECT_EQ(flow(1, 2), "arched at once, over the outlet: 12.3 kg (100 %) left");
}

TEST_F(Answers, OfASiloThatJammedClaimNoFlow) {
  set("residual_fraction", 0.998), set("residual_mass", 12.34), set("flow_stop_time", 0.31);
  set("outlet_packing", 0.55);
  for (const char* unknown : {"emptying_time", "share_that_moves", "discharge_steady", "discharge_steady_error"})
    set(unknown, none);
  EXPECT_EQ(all().front().answer, "has stopped after 0.31 s with 12.3 kg (99.8 %) left: arch over the outlet");
  EXPECT_EQ(find("Flow regime").answer, "not yet known: 0.2 % has left, 10 % needed");
  EXPECT_EQ(find("Steady discharge").answer, "not yet known: 0.2 % has left, 10 % needed");
  EXPECT_EQ(find("Emptying time (99 %)").answer, "not reached");
}

TEST_F(Answers, OfASiloThatKeepsARestSayWhereItIs) {
  set("emptying_time", none), set("residual_fraction", 0.2), set("residual_mass", 35), set("share_that_moves", 0.6);
  set("flow_stop_time", 200);
  EXPECT_EQ(all().front().answer,
            "has stopped after 3 min 20 s with 35 kg (20 %) left: stagnant at its angle of repose");
  set("mass_flow_half_angle_jenike", 25);
  EXPECT_EQ(find("Flow regime").answer, "funnel flow, stagnant zone 40 %");
  EXPECT_EQ(find("Flow regime").by_hand,
            "funnel flow, half angle 30° of at most 25° (Jenike, grains of 30° in plane strain)");
}

TEST_F(Answers, OfAFlowThatGoesOnOrNeverBeganSaySo) {
  set("emptying_time", none), set("flow_stop_time", none), set("residual_fraction", 0.45), set("residual_mass", 0.2);
  EXPECT_EQ(all().front().answer, "still flows at the end of the run: 200 g (45 %) left");
  set("discharge_steady_error", none);
  EXPECT_EQ(find("Steady discharge").answer, "0.479 kg/s (too short for an uncertainty)");
  set("residual_fraction", 1), set("residual_mass", 0.44);
  EXPECT_EQ(all().front().answer, "has not started: 440 g (100 %) left");
}

TEST_F(Answers, OfAGateThatClosedSaySoUnlessTheFlowHadStoppedBefore) {
  continuum::Parameters closing = small_silo();
  ASSERT_TRUE(closing.vessel.back().gate);
  closing.vessel.back().closes_after = 0.5;
  const auto flow = [&](double end) {
    return answers_of(continuum::Setup(closing), quantities, end, folder).front().answer;
  };
  set("emptying_time", none), set("residual_fraction", 0.5), set("residual_mass", 0.44), set("flow_stop_time", none);
  EXPECT_EQ(flow(0.4), "still flows at the end of the run: 440 g (50 %) left");
  EXPECT_EQ(flow(0.6), "was shut after 0.5 s: 440 g (50 %) left");
  set("flow_stop_time", 0.51), set("outlet_packing", 0.55);
  EXPECT_EQ(flow(1), "was shut after 0.5 s: 440 g (50 %) left");
  set("flow_stop_time", 0.2);
  EXPECT_EQ(flow(1), "has stopped after 0.2 s with 440 g (50 %) left: arch over the outlet");
}

TEST_F(Answers, OfACohesivePowderSayWhereItArchedOrThatAChannelStands) {
  continuum::Parameters sticky = small_silo();
  sticky.law = granular::CriticalState::Parameters{.static_friction = 0.5, .tensile_strength = 200};
  const auto flow = [&] { return answers_of(continuum::Setup(sticky), quantities, 1, folder); };
  set("emptying_time", none), set("residual_fraction", 1), set("residual_mass", 0.44), set("flow_stop_time", none);
  set("outlet_packing", 0.55);
  EXPECT_EQ(flow().front().answer, "arched at once, over the outlet: 440 g (100 %) left");
  // Of uniform strength, by its shear tester: f_c = 1.618 a, H = 2 + 30/60.
  EXPECT_EQ(flow()[1].question, "Critical outlet");
  EXPECT_EQ(flow()[1].answer, "25.4 mm here");
  EXPECT_TRUE(flow()[1].by_hand.starts_with("55 mm (Jenike: flow factor")) << flow()[1].by_hand;
  set("residual_fraction", 0.5), set("flow_stop_time", 0.31);
  EXPECT_EQ(flow().front().answer, "arched at 0.31 s, over the outlet: 440 g (50 %) left");
  set("outlet_packing", 0.01);
  quantities.push_back({"rathole_height", "m", 3 * 0.0254});
  EXPECT_EQ(flow().front().answer, "has stopped after 0.31 s with 440 g (50 %) left: rathole");
  set("rathole_height", 0.0254);
  EXPECT_EQ(flow().front().answer, "has stopped after 0.31 s with 440 g (50 %) left: stagnant at its angle of repose");
}

TEST_F(Answers, NameTheBandOfEachWallThatBearsMost) {
  write_table(folder / "analysis/wall_loads.csv",
              {{"patch", "1"},
               {"low", "m"},
               {"high", "m"},
               {"pressure_at_rest", "Pa"},
               {"pressure_in_flow", "Pa"},
               {"pressure_largest", "Pa"},
               {"time_of_largest", "s"},
               {"pressure_at_rest_by_hand", "Pa"},
               {"pressure_in_flow_by_hand", "Pa"},
               {"pressure_in_flow_enstad", "Pa"},
               {"en_pressure_filling", "Pa"},
               {"en_pressure_discharge", "Pa"}},
              {{1, 0.09, 0.1, 270, 210, 310, 0.1, 289, 289, none, 400, 460},
               {1, 0.1, 0.11, 216, 240, 290, 0.2, 224, 224, none, 300, 345},
               {2, 0.06, 0.07, 538, 400, 1200, 0.02, 523, 600, 550, none, none},
               {2, 0.07, 0.08, 572, 0.2, 900, 0.1, 621, 700, none, none, none},
               {3, 0.05, 0.06, 0.6, 0, 1, 0, 0, none, none, none, none}});
  const std::string walker = "0.6 kPa (Walker, μ 0.3, φ 30° in plane strain), 0.55 kPa (Enstad, the same)";
  quantities.push_back({"wall_pressure_ratio", "1", 0.47});
  EXPECT_EQ(find("Pressure at rest, cylinder").answer, "0.27 kPa at z = 95 mm");
  EXPECT_EQ(find("Pressure at rest, cylinder").by_hand,
            "0.289 kPa (Janssen, K 0.47 as measured, μ 0.3), EN 1991-4: 0.4 kPa filling, upper value");
  EXPECT_EQ(find("Pressure in flow, cylinder").answer, "0.24 kPa at z = 105 mm");
  EXPECT_EQ(find("Pressure in flow, cylinder").by_hand,
            "0.224 kPa (Janssen, K 0.47 as measured, μ 0.3), EN 1991-4: 0.345 kPa discharge, upper value");
  EXPECT_EQ(find("Pressure at rest, cone").answer, "0.572 kPa at z = 75 mm");
  EXPECT_EQ(find("Pressure at rest, cone").by_hand, "0.621 kPa (Walker, μ 0.3)");
  EXPECT_EQ(find("Pressure in flow, cone").by_hand, walker);
  const continuum::Parameters p = small_silo();
  const std::vector<Answer> answers = all();
  const auto peak = std::find_if(answers.begin(), answers.end(), [](const Answer& a) {
    return a.question.starts_with("Peak pressure (") && a.question.ends_with("average), cone");
  });
  ASSERT_NE(peak, answers.end());
  EXPECT_EQ(peak->answer, "1.2 kPa at z = 65 mm, after 20 ms, band 10 mm high, whole circumference");
  EXPECT_EQ(peak->by_hand, walker);
  for (const Answer& answer : answers) EXPECT_FALSE(answer.question.ends_with("lid")) << "it carries almost no load";
  // Before a tenth has left there is no flow to speak of.
  set("residual_fraction", 0.998);
  EXPECT_EQ(find("Pressure in flow, cone").answer, "not yet known: 0.2 % has left, 10 % needed");
}

TEST_F(Answers, GiveAMeanBesideEveryPeak) {
  write_table(folder / "analysis/wall_loads.csv",
              {{"patch", "1"},
               {"low", "m"},
               {"high", "m"},
               {"pressure_at_rest", "Pa"},
               {"pressure_in_flow", "Pa"},
               {"pressure_largest", "Pa"},
               {"time_of_largest", "s"}},
              {{1, 0.09, 0.1, 270, 0.1, 310, 0.1}, {2, 0.06, 0.07, 500, none, 400, 0.1}});
  EXPECT_EQ(find("Pressure in flow, cylinder").answer, "0.1 Pa at z = 95 mm") << "however small";
  EXPECT_EQ(find("Pressure in flow, cone").answer, "not known: the run does not cover its window");
}

TEST_F(Answers, OfABoxAreThoseOfItsWalls) {
  write_table(folder / "analysis/box_walls.csv",
              {{"wall", "1"},
               {"low", "m"},
               {"high", "m"},
               {"pressure_at_rest", "Pa"},
               {"pressure_in_flow", "Pa"},
               {"pressure_largest", "Pa"},
               {"time_of_largest", "s"}},
              {{1, 0, 0.2, 1500, 1200, 2000, 0.1}, {5, 0, 0, 3000, none, 3100, 0.2}});
  quantities.clear();
  continuum::Parameters p;
  p.box.width = p.box.depth = p.box.height = p.bed.height = 1, p.bed.spacing = 0.1;
  const std::vector<Answer> answers = answers_of(continuum::Setup(p), quantities, 1, folder);
  ASSERT_EQ(answers.size(), 4u);
  EXPECT_EQ(answers[0].question, "Pressure at rest, left");
  EXPECT_EQ(answers[0].answer, "1.5 kPa at z = 100 mm");
  EXPECT_EQ(answers[2].question, "Pressure at rest, floor");
  EXPECT_EQ(answers[2].answer, "3 kPa");
}

TEST(EngineeringUnits, AreThoseOfTheSize) {
  EXPECT_EQ(rate_text(0.4788, 0.00918), "0.479 ± 0.009 kg/s");
  EXPECT_EQ(rate_text(0.02418, 0.00031), "24.2 ± 0.3 g/s");
  EXPECT_EQ(rate_text(12.34, 1.04), "44.4 ± 3.7 t/h");
  EXPECT_EQ(rate_text(4321, none), "15556 t/h");
  EXPECT_EQ(pressure_text(45.4), "45.4 Pa");
  EXPECT_EQ(pressure_text(1234), "1.23 kPa");
  EXPECT_EQ(pressure_text(123456), "123 kPa");
  EXPECT_EQ(mass_text(15234), "15.2 t");
  EXPECT_EQ(length_text(1.25), "1.25 m");
  EXPECT_EQ(time_text(7500), "2 h 5 min");
  EXPECT_EQ(time_text(0.0192), "19.2 ms");
  EXPECT_EQ(share_text(0.002), "0.2 %");
  EXPECT_EQ(share_text(0.998), "99.8 %");
  EXPECT_EQ(share_text(1), "100 %");
  EXPECT_EQ(share_text(0), "0 %");
}

}  // namespace
}  // namespace talus::app
