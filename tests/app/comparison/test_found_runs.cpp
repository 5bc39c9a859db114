// SPDX-License-Identifier: Apache-2.0
#include "app/comparison/found_runs.hpp"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "base/error.hpp"
#include "io/run_folder.hpp"
#include "io/run_json.hpp"
#include "io/scratch_folder.hpp"

namespace talus::app {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

Reference reference() {
  Reference reference{.path = "reference.toml"};
  reference.cases = {{.name = "hopper",
                      .where = {{"model", "\"continuum\""}, {"box.depth", "\"5 mm\""}},
                      .variants = {{.label = "coarse"},
                                   {.label = "fine", .told_by = {{"bed.spacing", "\"1.25 mm\""}}},
                                   {.label = "fine-stiff",
                                    .told_by = {{"bed.spacing", "\"1.25 mm\""}, {"law.yuu-umekage.scale", "39.2"}}},
                                   {.label = "air", .told_by = {{"air.enabled", "true"}}}}},
                     {.name = "hopper-without-walls",
                      .where = {{"model", "\"continuum\""}, {"box.depth", "\"5 mm\""}, {"walls", "\"none\""}},
                      .variants = {{.label = "coarse"}}}};
  return reference;
}

class FoundRuns : public testing::Test {
 protected:
  void put(const std::string& name, const std::string& case_text, std::int64_t seed = 0,
           const std::string& status = "done") const {
    const RunFolder folder(scratch_ / name);
    std::filesystem::create_directories(scratch_ / name);
    Manifest manifest = manifest_of_this_program();
    manifest.case_text = case_text;
    manifest.seed = seed;
    write_manifest(folder.manifest(), manifest);
    write_summary(folder.summary(), {.status = status});
  }
  std::vector<std::string> found() const {
    std::vector<std::string> found;
    for (const FoundEnsemble& e : find_ensembles(scratch_.path(), reference())) {
      std::vector<std::string> folders;
      for (const auto& folder : e.folders) folders.push_back(folder.filename());
      found.push_back(fmt::format("{} {}: {}", e.case_name, e.variant, fmt::join(folders, " ")));
      EXPECT_EQ(e.files.size(), e.folders.size());
    }
    std::sort(found.begin(), found.end());
    return found;
  }
  ScratchFolder scratch_;
};

const std::string hopper = "model = \"continuum\"\nbox.depth = \"0.005 m\"\n";

TEST_F(FoundRuns, AreSortedToTheVariantWithMostOfTheirSettings) {
  put("a", hopper + "bed.spacing = \"0.0016666667 m\"\nlaw.yuu-umekage.scale = 9.8");
  put("b", hopper + "bed.spacing = \"0.00125 m\"\nlaw.yuu-umekage.scale = 9.8");
  put("c", hopper + "bed.spacing = \"0.00125 m\"\nlaw.yuu-umekage.scale = 39.2");
  put("d", hopper + "air.enabled = true");
  put("e", hopper + "air.enabled = false");
  put("f", hopper + "walls = \"none\"");
  EXPECT_THAT(found(), ElementsAre("hopper air: d", "hopper coarse: a e", "hopper fine-stiff: c", "hopper fine: b",
                                   "hopper-without-walls coarse: f"));
}

TEST_F(FoundRuns, StandInTheOrderOfTheirSeedsHoweverDeepTheyLie) {
  put("deep/er/x", hopper, 1);
  put("a", hopper, 3);
  put("b", hopper, 2);
  EXPECT_THAT(found(), ElementsAre("hopper coarse: x b a"));
}

TEST_F(FoundRuns, OfNoCaseOrNotDoneArePassedOver) {
  put("a", hopper);
  put("unfinished", hopper, 1, "interrupted");
  put("deeper-box", "model = \"continuum\"\nbox.depth = \"6 mm\"");
  put("cloud", "model = \"cloud\"");
  EXPECT_THAT(found(), ElementsAre("hopper coarse: a"));
}

TEST_F(FoundRuns, NoneIsAnError) {
  put("cloud", "model = \"cloud\"");
  EXPECT_THAT(message_of<InputError>([&] { find_ensembles(scratch_.path(), reference()); }),
              HasSubstr("holds no finished run of a case of reference.toml"));
  EXPECT_THROW(find_ensembles(scratch_ / "nowhere", reference()), FileError);
}

}  // namespace
}  // namespace talus::app
