// SPDX-License-Identifier: Apache-2.0
/// The attack on the readers in short: every input of the corpus, and mutations of them from a fixed seed. The long
/// form is the preset `fuzz`; without clang, TALUS_MUTATIONS=N makes N mutations a target in place of some hundred
/// (docs/fuzzing.md).
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include "base/random.hpp"
#include "fuzz/targets.hpp"
#include "io/file.hpp"

namespace talus::fuzz {
namespace {

namespace fs = std::filesystem;

constexpr int mutations = 700;         // a target
constexpr unsigned max_seconds = 120;  // of an input, which is a hang above; the machine may be busy

int count_of_mutations() {
  const char* const given = std::getenv("TALUS_MUTATIONS");
  return given ? std::max(1, std::atoi(given)) : mutations;
}

void add_files(const fs::path& folder, const std::string& extension, std::vector<std::string>& inputs) {
  std::vector<fs::path> paths;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file() && (extension.empty() || entry.path().extension() == extension))
      paths.push_back(entry.path());
  std::sort(paths.begin(), paths.end());
  for (const fs::path& path : paths) inputs.push_back(read_whole_file(path));
}

/// The corpus of a target, and the files of the project that are of its kind.
std::vector<std::string> inputs_of(std::string_view target) {
  const fs::path project = TALUS_SOURCE_DIR;
  std::vector<std::string> inputs;
  add_files(project / "tests/fuzz/corpus" / target, "", inputs);
  if (target == "case") add_files(project / "cases", ".toml", inputs);
  if (target == "path") add_files(project / "cases/law", ".csv", inputs);
  return inputs;
}

class Mutator {
 public:
  explicit Mutator(std::vector<std::string> inputs) : inputs_(std::move(inputs)) {}

  std::string next() {
    std::string text = inputs_[below(inputs_.size())];
    // Large files are cut to a window, so that a change matters.
    if (text.size() > 3000) text = text.substr(below(text.size() - 2000), 2000);
    for (std::size_t changes = 1 + below(4); changes > 0; --changes) change(text);
    return text;
  }

 private:
  std::size_t below(std::size_t count) {
    return std::min(count - 1, static_cast<std::size_t>(random_.uniform() * static_cast<double>(count)));
  }

  void change(std::string& text) {
    static constexpr std::string_view words[] = {
        "=",  "\"",    "[",      "]",           "[[plates]]\n", ".", ",",   "\n",  "\\u001b", "\x1b",  "\xff",
        "-",  "1e308", "1e-308", "99999999999", "-1",           "0", "nan", "inf", "true",    " mm",   "m^",
        "**", "(",     ")",      "1e99999",     "\xc2\xb5",     "{", "}",   "#",   "'''",     "\"\"\""};
    const std::size_t place = below(text.size() + 1);
    const std::size_t length = std::min(text.size() - place, 1 + below(20));
    switch (below(6)) {
      case 0:
        if (place < text.size()) text[place] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(place, length);
        break;
      case 2:
        text.insert(place, text.substr(place, length));
        break;
      case 3:
        text.insert(place, words[below(std::size(words))]);
        break;
      case 4:
        text.replace(place, length, words[below(std::size(words))]);
        break;
      default: {
        const std::string& other = inputs_[below(inputs_.size())];
        const std::size_t from = below(other.size() + 1);
        text.insert(place, other.substr(from, 1 + below(60)));
      }
    }
  }

  std::vector<std::string> inputs_;
  Random random_{20261122};
};

class Readers : public testing::TestWithParam<Target> {};

TEST_P(Readers, TakeTheCorpus) {
  const std::vector<std::string> inputs = inputs_of(GetParam().name);
  ASSERT_GE(inputs.size(), 3u);
  for (const std::string& input : inputs) EXPECT_NO_THROW(GetParam().read(input)) << input;
}

TEST_P(Readers, TakeMutations) {
  Mutator mutator(inputs_of(GetParam().name));
  for (int n = 0, count = count_of_mutations(); n < count; ++n) {
    const std::string input = mutator.next();
    ::alarm(max_seconds);  // ends the program
    EXPECT_NO_THROW(GetParam().read(input)) << "mutation " << n << ":\n" << input;
  }
  ::alarm(0);
}

INSTANTIATE_TEST_SUITE_P(Fuzz, Readers, testing::ValuesIn(targets),
                         [](const auto& instance) { return std::string(instance.param.name); });

}  // namespace
}  // namespace talus::fuzz
