// SPDX-License-Identifier: Apache-2.0
#include "io/parameter_writer.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <regex>
#include <set>
#include <string>

#include "io/example_case.hpp"
#include "io/parameter_reader.hpp"

namespace talus {
namespace {

using nlohmann::json;

ParameterList defaults() {
  ParameterList list;
  const example::Parameters parameters;
  const example::Run run;
  for_each_parameter(list, parameters);
  for_each_parameter(list, run);
  return list;
}

const json& schema() {
  static const json parsed = json::parse(json_schema(defaults(), "a case"));
  return parsed;
}

bool has_type(const json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number() && value.get<double>() == std::floor(value.get<double>());
  ADD_FAILURE() << "not a type of JSON Schema: " << type;
  return false;
}

/// Whether a value satisfies a schema: the keywords that Talus uses, and no others.
bool satisfies(const json& value, const json& schema) {
  const std::set<std::string> annotations = {"$schema", "title", "description", "default"};
  if (!has_type(value, schema.at("type"))) return false;
  for (const auto& [keyword, rule] : schema.items()) {
    bool good = true;
    if (keyword == "type" || annotations.contains(keyword)) continue;
    if (keyword == "properties") {
      for (const auto& [key, inner] : rule.items())
        good = good && (!value.contains(key) || satisfies(value[key], inner));
    } else if (keyword == "additionalProperties") {
      EXPECT_EQ(rule, false);
      for (const auto& [key, inner] : value.items()) good = good && schema.at("properties").contains(key);
    } else if (keyword == "required") {
      for (const json& key : rule) good = good && value.contains(key.get<std::string>());
    } else if (keyword == "items") {
      for (const json& element : value) good = good && satisfies(element, rule);
    } else if (keyword == "minItems") {
      good = value.size() >= rule.get<std::size_t>();
    } else if (keyword == "maxItems") {
      good = value.size() <= rule.get<std::size_t>();
    } else if (keyword == "enum") {
      good = std::find(rule.begin(), rule.end(), value) != rule.end();
    } else if (keyword == "pattern") {
      good = std::regex_search(value.get<std::string>(), std::regex(rule.get<std::string>()));
    } else if (keyword == "minimum") {
      good = value >= rule;
    } else if (keyword == "maximum") {
      good = value <= rule;
    } else if (keyword == "exclusiveMinimum") {
      good = value > rule;
    } else if (keyword == "exclusiveMaximum") {
      good = value < rule;
    } else {
      ADD_FAILURE() << "unexpected keyword " << keyword;
    }
    if (!good) return false;
  }
  return true;
}

json to_json(const CaseValue& value) {
  struct Convert {
    json operator()(const std::vector<CaseValue>& values) const {
      json array = json::array();
      for (const CaseValue& element : values) array.push_back(to_json(element));
      return array;
    }
    json operator()(const CaseTable&) const { return json::object(); }
    json operator()(const CaseDate& date) const { return date.text; }
    json operator()(bool flag) const { return flag; }
    json operator()(std::int64_t integer) const { return integer; }
    json operator()(double number) const { return number; }
    json operator()(const std::string& text) const { return text; }
  };
  return std::visit(Convert{}, value.value);
}

json to_json(const CaseFile& file) {
  json root = json::object();
  for (const CaseEntry& entry : file.entries()) {
    std::string pointer = "/" + entry.key;
    std::replace(pointer.begin(), pointer.end(), '.', '/');
    root[json::json_pointer(pointer)] = to_json(entry.value);
  }
  return root;
}

bool reader_accepts(const CaseFile& file) {
  example::Parameters parameters;
  example::Run run;
  try {
    ParameterReader reader(file);
    for_each_parameter(reader, parameters);
    for_each_parameter(reader, run);
    reader.finish();
  } catch (const InputError&) {
    return false;
  }
  return true;
}

/// Every schema has a type, every parameter a description and a default that satisfies it.
void expect_well_formed(const json& schema, const std::string& place) {
  ASSERT_TRUE(schema.contains("type")) << place;
  EXPECT_TRUE(!schema.contains("default") || satisfies(schema["default"], schema)) << place;
  if (schema["type"] != "object") {
    EXPECT_FALSE(schema.value("description", "").empty()) << place;
    return;
  }
  EXPECT_EQ(schema.at("additionalProperties"), false) << place;
  for (const auto& [key, inner] : schema.at("properties").items()) expect_well_formed(inner, place + "/" + key);
  for (const json& key : schema.value("required", json::array()))
    EXPECT_TRUE(schema["properties"].contains(key.get<std::string>())) << place << key;
}

TEST(Schema, OfAnArrayOfTablesIsThatOfEachOfThem) {
  ParameterList list;
  list({"plates.1.thick", {}, {}, "thickness", true}, 1.0);
  list({"plates.1.note", {}, {}, "a note"}, std::string("none"));
  const json root = json::parse(json_schema(list, "a case"));
  const json& plates = root["properties"]["plates"];
  EXPECT_EQ(plates["type"], "array");
  EXPECT_EQ(plates["items"]["required"], json::array({"thick"}));
  EXPECT_TRUE(plates["items"]["properties"].contains("note"));
  EXPECT_FALSE(root.contains("required")) << "there may be none";
  EXPECT_NE(reference_page(list).find("## [[plates]]\n"), std::string::npos);
}

TEST(JsonSchema, IsWellFormed) {
  EXPECT_EQ(schema().at("$schema"), "https://json-schema.org/draft/2020-12/schema");
  EXPECT_EQ(schema().at("title"), "a case");
  expect_well_formed(schema(), "");
  EXPECT_EQ(schema().at("required"), json({"particles", "run"})) << "tables with a required key";
  EXPECT_EQ(schema().at("/properties/particles/required"_json_pointer), json({"shape", "radius"}));
}

TEST(JsonSchema, TellsWhatAParameterIs) {
  const json& particles = schema().at("/properties/particles/properties"_json_pointer);
  EXPECT_EQ(particles.at("shape"), json({{"type", "string"},
                                         {"enum", {"circle", "rectangle", "triangle"}},
                                         {"description", "shape at the start: circle, rectangle, triangle"}}));
  EXPECT_EQ(particles.at("count"), json({{"type", "integer"},
                                         {"minimum", 1},
                                         {"maximum", 10000000},
                                         {"description", "number of particles: a whole number, from 1 to 10000000"},
                                         {"default", 2000}}));
  EXPECT_EQ(particles.at("density").at("default"), "2500 kg/m3");
  EXPECT_EQ(particles.at("density").at("description"),
            "true density: a density, above 0 kg/m3, such as \"2500 kg/m3\"");
  EXPECT_FALSE(particles.at("radius").contains("default")) << "required";
  EXPECT_FALSE(particles.at("size").contains("default")) << "optional";
  EXPECT_EQ(schema().at("/properties/numerics/properties/porosity/exclusiveMaximum"_json_pointer), 1.0);
}

TEST(JsonSchema, NestsTablesAndRequiresThemOnce) {
  ParameterList list;
  list(Parameter{"a.b.c", {}, {}, "x", true}, true);
  list(Parameter{"a.b.d", {}, {}, "x", true}, true);
  const json nested = json::parse(json_schema(list, ""));
  EXPECT_TRUE(satisfies(json::parse(R"({"a": {"b": {"c": true, "d": false}}})"), nested));
  EXPECT_FALSE(satisfies(json::parse(R"({"a": {"b": {"c": true}}})"), nested));
  EXPECT_FALSE(satisfies(json::parse(R"({"a": {}})"), nested));
  EXPECT_FALSE(satisfies(json::parse(R"({})"), nested));
  EXPECT_EQ(nested.at("required"), json::array({"a"}));
}

TEST(JsonSchema, AgreesWithTheReader) {
  const std::string good[] = {
      "",
      "seed = 0",
      "seed = 2e3",
      "title = \"\"",
      "particles.count = 10000000",
      "particles.radius_spread = 0",
      "particles.radius_spread = 0.9",
      "particles.size = \"5 mm\"",
      "particles.size = \".5e-2m\"",
      "particles.size = \" +5. mm \"",
      "particles.size = \"5 µm\"",
      "particles.size = \"5 (m)\"",
      "particles.density = \"1e3 kg m^-3\"",
      "particles.density = \"1e3 /m3 kg\"",
      "particles.density = \"1e3 1/m3 kg\"",
      "slope.enabled = false",
      "slope.angle = \"30°\"",
      "gravity.direction = [0, 1, 2.5]",
      "gravity.origin = [\"0 m\", \"1 mm\", \"-1 m\"]",
      "numerics.scheme = \"euler\"",
      "numerics.porosity = 0.5",
      "numerics.temperature_slope = -1e-3",
      "output.snapshots = []",
      "output.snapshots = [\"1 ms\"]",
      "output.weights = [1, 2.5]",
  };
  const std::string bad[] = {
      "seed = -1",
      "seed = 1.5",
      "seed = \"1\"",
      "title = 1",
      "titel = \"x\"",
      "particles.count = 0",
      "particles.count = 10000001",
      "particles.colour = 1",
      "particles.radius_spread = -0.1",
      "particles.radius_spread = \"0.1\"",
      "particles.size = 5",
      "particles.size = \"5\"",
      "particles.size = \"5e3\"",
      "particles.size = \"5.5\"",
      "particles.size = \"mm\"",
      "particles.size = \"\"",
      "particles.size = \"5 %\"",
      "particles.size = \"0,5 mm\"",
      "particles.size = [\"5 mm\"]",
      "slope.enabled = 1",
      "slope.enabled = \"true\"",
      "slope = 3",
      "gravity.direction = [0, 1]",
      "gravity.direction = [0, 1, 2, 3]",
      "gravity.direction = [0, 1, \"2\"]",
      "gravity.direction = \"down\"",
      "gravity.origin = [0, 0, 0]",
      "numerics.scheme = \"Euler\"",
      "numerics.scheme = 1",
      "numerics.porosity = 0",
      "numerics.porosity = 1",
      "numerics.temperature_slope = 0",
      "output.snapshots = \"1 ms\"",
      "output.snapshots = [1]",
      "output.weights = [true]",
      "colours.red = 1",
  };
  const std::string coarse[] = {// what only the reader sees: dimensions, units, ranges of quantities
                                "particles.size = \"5 s\"", "particles.size = \"5 quux\"", "particles.size = \"-5 m\"",
                                "slope.angle = \"91 deg\""};
  const auto verdicts = [](const std::string& line) {
    const CaseFile file = CaseFile::from_text(line + example::minimal_case, "c");
    return std::pair(reader_accepts(file), satisfies(to_json(file), schema()));
  };
  for (const std::string& line : good) EXPECT_EQ(verdicts(line), std::pair(true, true)) << line;
  for (const std::string& line : bad) EXPECT_EQ(verdicts(line), std::pair(false, false)) << line;
  for (const std::string& line : coarse) EXPECT_EQ(verdicts(line), std::pair(false, true)) << line;
  const CaseFile empty = CaseFile::from_text("", "c");
  EXPECT_FALSE(reader_accepts(empty));
  EXPECT_FALSE(satisfies(to_json(empty), schema()));
}

TEST(ReferencePage, HasARowForEveryKey) {
  const std::string page = reference_page(defaults());
  EXPECT_THAT(page, testing::StartsWith("## Top level\n\n"
                                        "| key | type | unit | allowed | default | meaning |\n"
                                        "|---|---|---|---|---|---|\n"
                                        "| `seed` | whole number |  | from 0 to 9000000000000000 | `1` | seed of the "
                                        "radii |\n"
                                        "| `title` | text |  |  | `\"\"` | a title \\| free text |\n"
                                        "\n## [particles]\n\n"));
  for (const char* row :
       {"| `shape` | choice |  | `circle`, `rectangle`, `triangle` | **required** | shape at the start |\n",
        "| `radius` | length | m | above 0 mm | **required** | mean radius |\n",
        "| `density` | density | kg/m3 | above 0 kg/m3 | `\"2500 kg/m3\"` | true density |\n",
        "| `size` | length | m | above 0 mm | none | size of the shape |\n",
        "| `enabled` | true or false |  |  | `true` | whether there is a slope |\n",
        "| `angle` | angle | deg | from 0 deg to 90 deg | `\"45 deg\"` | incline |\n",
        "| `direction` | 3 × number |  |  | `[0.0, 0.0, -1.0]` | direction of gravity |\n",
        "| `snapshots` | n × time | s | at least 0 ms | `[\"0.001 s\", \"0.002 s\"]` | times of the snapshots |\n"})
    EXPECT_THAT(page, testing::HasSubstr(row));
  std::size_t rows = 0;
  for (std::size_t at = page.find("\n| `"); at != std::string::npos; at = page.find("\n| `", at + 1)) ++rows;
  EXPECT_EQ(rows, 18u);
}

}  // namespace
}  // namespace talus
