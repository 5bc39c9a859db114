// SPDX-License-Identifier: Apache-2.0
#include "io/case_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

template <class T>
T get(const CaseFile& file, std::string_view key) {
  const CaseEntry* entry = file.find(key);
  if (!entry) throw std::runtime_error("no key " + std::string(key));
  return std::get<T>(entry->value.value);
}

std::vector<std::string> keys(const CaseFile& file) {
  std::vector<std::string> result;
  for (const CaseEntry& entry : file.entries()) result.push_back(entry.key);
  return result;
}

Problem syntax_problem(std::string_view text) {
  try {
    CaseFile::from_text(text, "case.toml");
  } catch (const InputError& error) {
    EXPECT_EQ(error.problems().size(), 1u);
    return error.problems().front();
  }
  ADD_FAILURE() << "read without an error: " << text;
  return {};
}

TEST(CaseFile, NumbersTheTablesOfAnArray) {
  const CaseFile file =
      CaseFile::from_text("[[plates]]\nfrom = [1, 2]\n\n[[plates]]\nfrom = [3]\nx.y = 4\n", "case.toml");
  EXPECT_THAT(keys(file), ElementsAre("plates", "plates.1", "plates.1.from", "plates.2", "plates.2.from", "plates.2.x",
                                      "plates.2.x.y"));
  EXPECT_EQ(file.tables("plates"), 2u);
  EXPECT_EQ(file.tables("plate"), 0u);
  EXPECT_EQ(file.find("plates.2.from")->line, 5);
  // As a resolved case has it.
  EXPECT_EQ(CaseFile::from_text("[plates.1]\nfrom = [1]\n[plates.2]\nfrom = [2]\n", "case.toml").tables("plates"), 2u);
  EXPECT_EQ(CaseFile::from_text("numbers = [1, 2]\n", "case.toml").tables("numbers"), 0u);
}

TEST(CaseFile, HoldsValuesByDottedKeyWithTheirLines) {
  const CaseFile file = CaseFile::from_text(
      "flag = true\n"
      "[b.c]\n"
      "text = \"x\"   # a comment\n"
      "inner = {whole = 3, real = 2.5}\n"
      "\n"
      "[a]\n"
      "list = [1,\n"
      "        \"2\"]\n"
      "date = 2020-02-03\n"
      "dotted.key = 1\n"
      "\"odd.part\" = 1\n",
      "case.toml");
  EXPECT_THAT(keys(file), ElementsAre("flag", "b", "b.c", "b.c.text", "b.c.inner", "b.c.inner.real", "b.c.inner.whole",
                                      "a", "a.list", "a.date", "a.dotted", "a.dotted.key", "a.\"odd.part\""));
  EXPECT_TRUE(get<bool>(file, "flag"));
  EXPECT_EQ(get<std::string>(file, "b.c.text"), "x");
  EXPECT_EQ(get<std::int64_t>(file, "b.c.inner.whole"), 3);
  EXPECT_EQ(get<double>(file, "b.c.inner.real"), 2.5);
  EXPECT_EQ(get<CaseDate>(file, "a.date").text, "2020-02-03");
  const auto list = get<std::vector<CaseValue>>(file, "a.list");
  EXPECT_EQ(std::get<std::string>(list.at(1).value), "2");
  EXPECT_EQ(file.find("b.c.text")->line, 3);
  EXPECT_EQ(file.find("a.list")->line, 7);
  EXPECT_EQ(file.find("a.\"odd.part\"")->line, 11);
  EXPECT_EQ(file.find("a")->where, "case.toml");
  EXPECT_FALSE(file.contains("text"));
}

TEST(CaseFile, ASyntaxErrorStandsAloneWithLineAndColumn) {
  const Problem unclosed = syntax_problem("a = 1\n[table\nb = 2\n");
  EXPECT_EQ(unclosed.where, "case.toml");
  EXPECT_EQ(unclosed.line, 2);
  EXPECT_EQ(unclosed.column, 7);
  EXPECT_THAT(unclosed.what, HasSubstr("not valid TOML: "));
  EXPECT_THAT(unclosed.what, HasSubstr("expected ']'"));

  const Problem twice = syntax_problem("[a]\nb = 1\nb = 2\n");
  EXPECT_EQ(twice.line, 3);
  EXPECT_THAT(twice.what, HasSubstr("redefine"));
  EXPECT_EQ(syntax_problem("[a]\n[b]\n[a]\n").line, 3);
  EXPECT_EQ(syntax_problem("a = 1\nb = \"\xff\"\n").line, 2);
}

TEST(CaseFile, AdvisesQuotesWhereTheyAreForgotten) {
  EXPECT_EQ(syntax_problem("[p]\nradius = 5 mm  # mean\n").allowed, "text and quantities in quotes: radius = \"5 mm\"");
  EXPECT_EQ(syntax_problem("shape = circle").allowed, "text and quantities in quotes: shape = \"circle\"");
  EXPECT_EQ(syntax_problem("a = [1, 2\nb = 3").allowed, "");
  EXPECT_EQ(syntax_problem("= 3").allowed, "");
  EXPECT_EQ(syntax_problem("[a").allowed, "");
}

TEST(CaseFile, ReadsAFileAndSaysWhyItCannot) {
  const ScratchFolder folder;
  const std::string path = (folder / "case.toml").string();
  std::ofstream(path) << "a = 1\n" << std::string(40000, '#') << "\nb = 2\n";
  const CaseFile file = CaseFile::read(path);
  EXPECT_EQ(file.name(), path);
  EXPECT_EQ(file.find("b")->line, 3);
  std::ofstream(path) << "";
  EXPECT_TRUE(CaseFile::read(path).entries().empty());

  for (const std::string& bad : {(folder / "missing.toml").string(), folder.path().string()}) {
    try {
      CaseFile::read(bad);
      FAIL() << bad;
    } catch (const FileError& error) {
      EXPECT_EQ(error.path(), bad);
      EXPECT_THAT(error.what(), HasSubstr(bad == folder.path().string() ? "Is a directory" : "No such file"));
    }
  }
}

TEST(CaseFile, OptionsOverrideAndAdd) {
  CaseFile file = CaseFile::from_text("[p]\ncount = 1\nradius = \"5 mm\"\n", "case.toml");
  file.set("p.count=2");
  file.set("p.count = 3");
  file.set("p.radius=2 mm");
  file.set("p.flag=true");
  file.set("p.list=[1, 2]");
  file.set("p.word=circle");
  file.set("p.quoted=\"7\"");
  file.set("p.empty=");
  file.set("p.equals=a=b");
  file.set("p.lines=1\nq = 2");
  EXPECT_TRUE(file.problems().empty());
  EXPECT_EQ(get<std::int64_t>(file, "p.count"), 3);
  EXPECT_EQ(get<std::string>(file, "p.radius"), "2 mm");
  EXPECT_TRUE(get<bool>(file, "p.flag"));
  EXPECT_EQ(get<std::vector<CaseValue>>(file, "p.list").size(), 2u);
  EXPECT_EQ(get<std::string>(file, "p.word"), "circle");
  EXPECT_EQ(get<std::string>(file, "p.quoted"), "7");
  EXPECT_EQ(get<std::string>(file, "p.empty"), "");
  EXPECT_EQ(get<std::string>(file, "p.equals"), "a=b");
  EXPECT_EQ(get<std::string>(file, "p.lines"), "1\nq = 2");
  EXPECT_FALSE(file.contains("q"));
  const CaseEntry& entry = *file.find("p.count");
  EXPECT_TRUE(entry.is_option);
  EXPECT_EQ(entry.where, "--set p.count = 3");
  EXPECT_EQ(entry.line, 0);
}

TEST(CaseFile, AnOptionMayGiveOrReplaceATable) {
  CaseFile file = CaseFile::from_text("[p]\ncount = 1\nradius = \"5 mm\"\n", "case.toml");
  file.set("p={count = 2, shape = \"ball\"}");
  EXPECT_EQ(get<std::int64_t>(file, "p.count"), 2);
  EXPECT_EQ(get<std::string>(file, "p.shape"), "ball");
  EXPECT_EQ(get<std::string>(file, "p.radius"), "5 mm");
  file.set("p=4");
  EXPECT_THAT(keys(file), ElementsAre("p"));
}

TEST(CaseFile, KeepsOptionsThatCannotBeRead) {
  CaseFile file = CaseFile::from_text("", "case.toml");
  file.set("count");
  file.set("=3");
  file.set("a..b=3");
  file.set("a b=3");
  ASSERT_EQ(file.problems().size(), 4u);
  EXPECT_EQ(to_string(file.problems()[0]), "--set count: has no '='; allowed: table.key=value");
  EXPECT_EQ(to_string(file.problems()[1]), "--set =3: '' is no key; allowed: table.key=value");
  EXPECT_EQ(to_string(file.problems()[2]), "--set a..b=3: 'a..b' is no key; allowed: table.key=value");
  EXPECT_TRUE(file.entries().empty());
}

TEST(Keys, TableAndLastPart) {
  EXPECT_TRUE(lies_in("a.b.c", "a.b"));
  EXPECT_TRUE(lies_in("a.b.c", "a"));
  EXPECT_TRUE(lies_in("a", ""));
  EXPECT_FALSE(lies_in("a.b", "a.b"));
  EXPECT_FALSE(lies_in("ab.c", "a"));
  EXPECT_EQ(table_of("a.b.c"), "a.b");
  EXPECT_EQ(table_of("a"), "");
  EXPECT_EQ(last_part("a.b.c"), "c");
  EXPECT_EQ(last_part("a"), "a");
}

// Each took the parser's stack, or memory for the square of the number of parts.
TEST(CaseFile, RefusesKeysOfThousandsOfParts) {
  std::string deep = "a";
  for (int n = 0; n < 100000; ++n) deep += ".a";
  for (const std::string& text : {deep + " = 1", "[" + deep + "]", "x = {" + deep + " = 1}"}) {
    try {
      CaseFile::from_text("y = 1\n" + text, "case.toml");
      ADD_FAILURE() << "taken";
    } catch (const InputError& error) {
      EXPECT_EQ(error.problems().front().what, "a key has more than 64 parts");
      EXPECT_EQ(error.problems().front().line, 2);
    }
  }
  CaseFile file =
      CaseFile::from_text("title = \"" + std::string(200, '.') + "\" # " + std::string(200, '.'), "case.toml");
  file.set(deep + "=1");
  file.set("x={" + deep + "=1}");
  EXPECT_EQ(file.problems().size(), 1u);
  EXPECT_EQ(file.entries().size(), 2u);  // what is no TOML value is text
}

TEST(CaseFile, CountsManyTablesInAMoment) {
  std::string text;
  for (int n = 0; n < 30000; ++n) text += "[[plates]]\nfrom = 1\n";
  EXPECT_EQ(CaseFile::from_text(text, "case.toml").tables("plates"), 30000u);
  EXPECT_EQ(CaseFile::from_text("[plates.1]\n[plates.3]\n[plates.02]\n[plates.x]", "c").tables("plates"), 1u);
}

}  // namespace
}  // namespace talus
