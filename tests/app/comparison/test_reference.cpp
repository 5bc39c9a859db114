// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/reference.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "app/models/models.hpp"
#include "base/error.hpp"
#include "io/case_file.hpp"
#include "io/file.hpp"
#include "io/scratch_folder.hpp"

namespace talus::app {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

TEST(Reference, ThoseOfTheStudiesCanBeRead) {
  for (const std::string study : {"niiya2020", "yuu2011"}) {
    const Reference reference = read_reference(TALUS_SOURCE_DIR "/validation/" + study + "/reference.toml");
    EXPECT_EQ(reference.study, study);
    EXPECT_GT(reference.rows.size(), 50u);
    for (const std::string& label : reference.quick.variants)
      EXPECT_TRUE(std::any_of(reference.cases.begin(), reference.cases.end(), [&](const ReferenceCase& c) {
        return std::any_of(c.variants.begin(), c.variants.end(), [&](const auto& v) { return v.label == label; });
      })) << label;
  }
}

TEST(Reference, EveryRunOfTheStudiesIsAValidCase) {
  for (const std::string study : {"niiya2020", "yuu2011", "yuu2011/laws", "dem-hopper"})
    for (const ReferenceCase& c : read_reference(TALUS_SOURCE_DIR "/validation/" + study + "/reference.toml").cases)
      for (const ReferenceCase::Variant& variant : c.variants) {
        CaseFile file = CaseFile::read(TALUS_SOURCE_DIR "/cases/" + c.file);
        for (const auto& [key, value] : variant.settings) file.set(key + "=" + value);
        EXPECT_NO_THROW(prepare_case(file)) << study << ' ' << variant.label;
      }
}

constexpr const char* head = R"(study = "s"
title = "t"
source = "u"
members = 2
quick = { variants = ["fine"], settings = { "run.end" = "1 s" } }
[case.hopper]
file = "hopper.toml"
where = { "model" = "continuum" }
told_by = ["a"]
[case.hopper.variant]
coarse = {}
fine = { "a" = 2, "b" = "3 mm" }
[[row]]
)";
constexpr const char* row = R"(id = "one"
number = 1
quantity = "packing_max"
case = "hopper"
variant = ["coarse", "fine"]
estimator = "e"
from = "each"
window = { from = 0.1, to = "end" }
printed = "about 1"
unit = "1"
criterion = { value = 1, within = 0.1 }
source = "p"
)";

Reference read(const std::string& text) {
  const ScratchFolder scratch;
  put_content(scratch / "r.toml", text);
  return read_reference((scratch / "r.toml").string());
}

TEST(Reference, VariantsAreToldByTheirOwnKeys) {
  const Reference reference = read(std::string(head) + row);
  EXPECT_EQ(reference.members, 2);
  EXPECT_EQ(reference.quick.settings, (Settings{{"run.end", "\"1 s\""}}));
  const ReferenceCase& c = reference.cases.at(0);
  EXPECT_EQ(c.where, (Settings{{"model", "\"continuum\""}}));
  ASSERT_EQ(c.variants.size(), 2u);
  EXPECT_EQ(c.variants[1].settings, (Settings{{"a", "2"}, {"b", "\"3 mm\""}}));
  EXPECT_EQ(c.variants[1].told_by, (Settings{{"a", "2"}}));
  const ComparisonRow& read_row = reference.rows.at(0);
  EXPECT_THAT(read_row.variants, testing::ElementsAre("coarse", "fine"));
  EXPECT_EQ(read_row.window.from, 0.1);
  EXPECT_TRUE(std::isinf(read_row.window.to));
  EXPECT_EQ(to_string(read_row.criterion), "1 ± 0.1");
}

TEST(Reference, EveryFaultIsReportedAtOnce) {
  std::string text = std::string(head) + row;
  const auto replace = [&](const std::string& from, const std::string& to) {
    text.replace(text.find(from), from.size(), to);
  };
  replace("packing_max", "packing_mix");
  replace("[\"coarse\", \"fine\"]", "[\"course\"]");
  replace("value = 1, within = 0.1", "about = 1");
  replace("source = \"p\"", "sorce = \"p\"");
  EXPECT_THAT(message_of<InputError>([&] { read(text); }),
              AllOf(HasSubstr("packing_max"), HasSubstr("course"), HasSubstr("is none that can be evaluated"),
                    HasSubstr("sorce"), HasSubstr("source")));
}

TEST(Reference, APlaceIsOfTheMeasuresOfAStudy) {
  const auto with = [](const std::string& quantity, const std::string& place) {
    std::string text = std::string(head) + row;
    text.replace(text.find("packing_max"), 11, quantity);
    return text + "place = { " + place + " }\n";
  };
  const ScratchFolder folder;
  write_atomically(folder / "measures.py", "");
  write_atomically(folder / "reference.toml", with("packing_at_a_height", "height = \"20 mm\""));
  const ComparisonRow row_of_study = read_reference((folder / "reference.toml").string()).rows.at(0);
  EXPECT_TRUE(row_of_study.of_study);
  EXPECT_EQ(row_of_study.place, (Place{{"height", 0.02}}));
  const auto fault = [&](const std::string& quantity, const std::string& place) {
    return message_of<InputError>([&] { read(with(quantity, place)); });
  };
  EXPECT_THAT(fault("packing_max", "distance = 20"), HasSubstr("is not a length (unit missing?)"));
  EXPECT_THAT(fault("packing_max", "distance = \"20 mm\""), HasSubstr("takes no distance"));
  EXPECT_THAT(fault("fed_mass", "distance = \"20 mm\""), HasSubstr("kg")) << "another unit than the row's";
}

}  // namespace
}  // namespace talus::app
