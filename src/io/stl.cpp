// SPDX-License-Identifier: Apache-2.0
#include "io/stl.hpp"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <optional>

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/file.hpp"

namespace talus {

namespace {

constexpr std::size_t head = 84, of_triangle = 50;

[[noreturn]] void refuse(std::string_view name, int line, std::string what, std::string allowed) {
  throw InputError(
      {{.where = std::string(name), .line = line, .what = std::move(what), .allowed = std::move(allowed)}});
}

/// Numbers of the file are little-endian.
std::uint32_t integer_at(std::string_view bytes, std::size_t offset) {
  std::uint32_t value = 0;
  for (std::size_t n = 4; n-- > 0;) value = value << 8 | static_cast<unsigned char>(bytes[offset + n]);
  return value;
}

double number_at(std::string_view bytes, std::size_t offset) {
  const std::uint32_t bits = integer_at(bytes, offset);
  float value = 0;
  std::memcpy(&value, &bits, sizeof value);
  return static_cast<double>(value);
}

std::vector<Triangle> from_binary(std::string_view content, std::string_view name) {
  const std::size_t count = integer_at(content, 80), expected = head + of_triangle * count;
  if (content.size() != expected)
    refuse(name, 0,
           fmt::format("is no ASCII STL file, and as a binary one {}: {} triangles take {} bytes, and it has {}",
                       content.size() < expected ? "it is cut off" : "it goes on after its end", count, expected,
                       content.size()),
           "an STL file, ASCII or binary");
  std::vector<Triangle> triangles(count);
  for (std::size_t t = 0; t < count; ++t)
    for (std::size_t c = 0; c < 3; ++c) {
      const std::size_t offset = head + of_triangle * t + 12 * (c + 1);
      triangles[t].corner[c] = {number_at(content, offset), number_at(content, offset + 4),
                                number_at(content, offset + 8)};
    }
  return triangles;
}

/// The words of an ASCII file, one after the other.
class Words {
 public:
  Words(std::string_view text, std::string_view name) : rest_(text), name_(name) {}

  /// The next word; empty at the end.
  std::string_view next() {
    while (!rest_.empty() && is_blank(rest_.front())) skip();
    std::size_t n = 0;
    while (n < rest_.size() && !is_blank(rest_[n])) ++n;
    const std::string_view word = rest_.substr(0, n);
    rest_.remove_prefix(n);
    return word;
  }
  void end_line() {
    while (!rest_.empty() && rest_.front() != '\n') skip();
  }
  int line() const { return line_; }

  void expect(std::string_view wanted, std::size_t triangle) {
    const std::string_view word = next();
    if (!is_same(word, wanted)) fail(word, fmt::format("\"{}\"", wanted), triangle);
  }
  double number(std::size_t triangle) {
    std::string_view word = next();
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    if (word.empty() || error != std::errc() || end != word.data() + word.size()) fail(word, "a number", triangle);
    return value;
  }
  /// \param triangle from 1
  [[noreturn]] void fail(std::string_view word, const std::string& wanted, std::size_t triangle) const {
    refuse(name_, line_,
           word.empty() ? fmt::format("ends within triangle {}", triangle)
                        : fmt::format("triangle {}: \"{}\"", triangle, printable(word.substr(0, 40))),
           wanted + " here");
  }
  static bool is_same(std::string_view a, std::string_view b) {
    if (a.size() != b.size()) return false;
    for (std::size_t n = 0; n < a.size(); ++n)
      if ((a[n] >= 'A' && a[n] <= 'Z' ? static_cast<char>(a[n] + 32) : a[n]) != b[n]) return false;
    return true;
  }

 private:
  static bool is_blank(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }
  void skip() {
    line_ += rest_.front() == '\n';
    rest_.remove_prefix(1);
  }
  std::string_view rest_, name_;
  int line_ = 1;
};

std::vector<Triangle> from_text(std::string_view content, std::string_view name) {
  std::vector<Triangle> triangles;
  Words words(content, name);
  words.next();  // "solid", and a name up to the end of the line
  words.end_line();
  while (true) {
    const std::string_view word = words.next();
    if (Words::is_same(word, "endsolid")) {
      words.end_line();
      if (words.next().empty()) return triangles;  // else another solid
      words.end_line();
      continue;
    }
    const std::size_t number = triangles.size() + 1;
    if (!Words::is_same(word, "facet")) words.fail(word, "\"facet\" or \"endsolid\"", number);
    words.expect("normal", number);
    for (int n = 0; n < 3; ++n) words.next();
    words.expect("outer", number);
    words.expect("loop", number);
    Triangle triangle;
    for (Vector3& corner : triangle.corner) {
      words.expect("vertex", number);
      for (int axis = 0; axis < 3; ++axis) corner[axis] = words.number(number);
    }
    words.expect("endloop", number);
    words.expect("endfacet", number);
    triangles.push_back(triangle);
  }
}

}  // namespace

std::vector<Triangle> stl_triangles(std::string_view content, std::string_view name) {
  const bool binary = content.size() >= head && content.size() == head + of_triangle * integer_at(content, 80);
  // A binary one that is cut off may begin so too, but has zeros: the last byte of its count at least.
  const bool text = content.substr(0, 5) == "solid" && content.find('\0') == std::string_view::npos;
  std::vector<Triangle> triangles;
  if (!binary && text)
    triangles = from_text(content, name);
  else if (content.size() >= head)
    triangles = from_binary(content, name);
  else
    refuse(name, 0, "is no STL file", "an STL file, ASCII or binary");
  if (triangles.empty()) refuse(name, 0, "holds no triangles", "an STL file with triangles");
  return triangles;
}

std::vector<Triangle> read_stl(const std::filesystem::path& path) {
  return stl_triangles(read_whole_file(path.string()), path.string());
}

}  // namespace talus
