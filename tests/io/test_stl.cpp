// SPDX-License-Identifier: Apache-2.0
#include "io/stl.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <string>

#include "base/error.hpp"

namespace talus {
namespace {

using testing::HasSubstr;

const std::string two =
    "solid wedge\n"
    "  facet normal 0 0 1\n    outer loop\n      vertex 0 0 0\n      vertex 1 0 0\n      vertex 1.5e0 1 -0.25\n"
    "    endloop\n  endfacet\n"
    "  FACET NORMAL 0 0 1\n    OUTER LOOP\n      VERTEX 0 0 0\n      VERTEX +1 1 0\n      VERTEX 0 1 0\n"
    "    ENDLOOP\n  ENDFACET\n"
    "endsolid wedge\n";

std::string binary(const std::vector<Triangle>& triangles) {
  std::string bytes(80, ' ');
  bytes.replace(0, 5, "solid");  // as some programs write it
  const auto add = [&](auto value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    bytes.append(raw, sizeof value);
  };
  add(static_cast<std::uint32_t>(triangles.size()));
  for (const Triangle& t : triangles) {
    for (int n = 0; n < 3; ++n) add(0.0f);
    for (const Vector3& c : t.corner)
      for (int axis = 0; axis < 3; ++axis) add(static_cast<float>(c[axis]));
    add(std::uint16_t{0});
  }
  return bytes;
}

std::string refusal(const std::string& content) {
  try {
    stl_triangles(content, "a.stl");
  } catch (const InputError& error) {
    return error.what();
  }
  return "taken";
}

TEST(Stl, AsciiAndBinaryAreTheSame) {
  const std::vector<Triangle> ascii = stl_triangles(two, "a.stl");
  ASSERT_EQ(ascii.size(), 2u);
  EXPECT_EQ(ascii[0].corner[2], (Vector3{1.5, 1, -0.25}));
  const std::vector<Triangle> again = stl_triangles(binary(ascii), "a.stl");
  ASSERT_EQ(again.size(), 2u);
  for (std::size_t t = 0; t < 2; ++t) EXPECT_EQ(again[t].corner, ascii[t].corner);
}

TEST(Stl, SeveralSolidsAreOneSurface) {
  EXPECT_EQ(stl_triangles(two + two, "a.stl").size(), 4u);
}

TEST(Stl, FaultsNameTheLineAndTheTriangle) {
  std::string text = two;
  text.replace(text.find("1.5e0"), 5, "wide ");
  EXPECT_THAT(refusal(text), HasSubstr("a.stl:6: triangle 1: \"wide\""));
  text = two;
  text.replace(text.find("ENDLOOP"), 7, "vertex ");
  EXPECT_THAT(refusal(text), HasSubstr("a.stl:14: triangle 2: \"vertex\""));
  EXPECT_THAT(refusal(two.substr(0, two.find("ENDLOOP"))), HasSubstr("ends within triangle 2"));
  EXPECT_THAT(refusal("solid nothing\nendsolid nothing\n"), HasSubstr("holds no triangles"));
  EXPECT_THAT(refusal("a text"), HasSubstr("no STL file"));
}

TEST(Stl, ABinaryFileOfTheWrongLengthIsRefusedWhateverItBeginsWith) {
  for (const std::string head : {"other", "solid"}) {
    std::string bytes = binary(stl_triangles(two, "a.stl"));
    bytes.replace(0, 5, head);
    EXPECT_EQ(refusal(bytes), "taken");
    EXPECT_THAT(refusal(bytes.substr(0, bytes.size() - 30)),
                HasSubstr("it is cut off: 2 triangles take 184 bytes, and it has 154"));
    EXPECT_THAT(refusal(bytes + "x"),
                HasSubstr("it goes on after its end: 2 triangles take 184 bytes, and it has 185"));
  }
}

}  // namespace
}  // namespace talus
