// SPDX-License-Identifier: Apache-2.0
#include "io/report_page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "base/error.hpp"
#include "io/file.hpp"

// The page stands in the program as it was built. TALUS_REPORT_PAGE: the path of that file; empty where the build had
// no npm.
#ifdef TALUS_REPORT_PAGE
__asm__(
    ".pushsection .rodata\n"
    "talus_report_page_begin: .incbin \"" TALUS_REPORT_PAGE
    "\"\n"
    "talus_report_page_end: .byte 0\n"
    ".popsection\n");
// NOLINTNEXTLINE(modernize-avoid-c-arrays): marks of the assembler
extern "C" const char talus_report_page_begin[], talus_report_page_end[];
#endif
#include <zlib.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <memory>
#include <new>
#include <stdexcept>
#include <vector>

namespace talus {

namespace {

constexpr std::string_view generator = "<meta name=\"generator\" content=\"Talus report\">";

std::string_view page() {
#ifdef TALUS_REPORT_PAGE
  return {talus_report_page_begin, static_cast<std::size_t>(talus_report_page_end - talus_report_page_begin)};
#else
  return {};
#endif
}

std::string escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    if (c == '&' || c == '<' || c == '>' || c == '"')
      out += fmt::format("&#{};", static_cast<int>(c));
    else
      out += c;
  }
  return out;
}

/// JSON within a script: no text in it may look like the script's end.
std::string without_tags(std::string_view json) {
  std::string out;
  for (const char c : json) out += c == '<' ? std::string("\\u003c") : std::string(1, c);
  return out;
}

/// Copies the page up to a mark, which what follows replaces.
std::string_view copy_until(std::string_view mark, std::string_view rest, std::string& out) {
  const std::size_t at = rest.find(mark);
  if (at == std::string_view::npos) throw FileError("web/report", fmt::format("the page has no {}", mark));
  out += rest.substr(0, at);
  return rest.substr(at + mark.size());
}

void check_replaceable(const std::filesystem::path& path) {
  std::error_code none;
  if (!std::filesystem::exists(path, none)) return;
  std::string begin(4096, '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), static_cast<std::streamsize>(begin.size()));
  if (begin.find(generator) == std::string::npos)
    throw FileError(path.string(), "is there, and no report of Talus; it is not replaced");
}

}  // namespace

bool has_report_page() {
  return !page().empty();
}

std::string without_report_page() {
  return "this program was built without the page of the report: npm was missing, or could not fetch its packages. "
         "Install npm (Debian: apt-get install nodejs npm) and build again";
}

void write_report(const std::filesystem::path& path, const ReportContent& content) {
  if (!has_report_page()) throw FileError(path.string(), without_report_page());
  check_replaceable(path);
  std::string out;
  std::string_view rest = copy_until("<!--talus:title-->", page(), out);
  out += escaped(content.title);
  rest = copy_until("<!--talus:pictures-->", rest, out);
  for (const std::filesystem::path& picture : content.pictures)
    out += fmt::format(
        "<figure><img loading=\"lazy\" alt=\"{0}\" "
        "src=\"data:image/png;base64,{1}\"><figcaption>{0}</figcaption></figure>\n",
        escaped(picture.stem().string()), base64(read_whole_file(picture)));
  rest = copy_until("<!--talus:data-->", rest, out);
  out +=
      fmt::format("<script type=\"application/json\" id=\"talus-header\">{}</script>\n", without_tags(content.header));
  for (std::size_t n = 0; n < content.blocks.size(); ++n)
    out += fmt::format("<script type=\"text/plain\" id=\"talus-block-{}\">{}</script>\n", n, content.blocks[n]);
  out += rest;
  write_atomically(path, out, Flush::later);
}

namespace {

/// A zlib stream that knows runs of the same byte but no other repetition: changes of fields have none, and a search
/// for some takes six times as long for 2 % of the size (docs/design/report.md).
std::string compressed(std::string_view bytes) {
  constexpr int window_bits = 15, memory = 9;
  z_stream stream{};
  if (deflateInit2(&stream, Z_DEFAULT_COMPRESSION, Z_DEFLATED, window_bits, memory, Z_RLE) != Z_OK)
    throw std::bad_alloc();
  const std::unique_ptr<z_stream, decltype(&deflateEnd)> end(&stream, deflateEnd);
  std::string out;
  constexpr std::size_t most = std::size_t{1} << 30;  // zlib counts in 32 bits
  std::size_t taken = 0, written = 0;
  int status = Z_OK;
  do {
    const std::size_t rest = std::min(most, bytes.size() - taken);
    const bool last = taken + rest == bytes.size();
    stream.next_in = reinterpret_cast<const Bytef*>(bytes.data() + taken);
    stream.avail_in = static_cast<uInt>(rest);
    do {
      out.resize(written + deflateBound(&stream, stream.avail_in));
      stream.next_out = reinterpret_cast<Bytef*>(out.data() + written);
      stream.avail_out = static_cast<uInt>(out.size() - written);
      status = deflate(&stream, last ? Z_FINISH : Z_NO_FLUSH);
      if (status == Z_STREAM_ERROR) throw std::bad_alloc();
      written = out.size() - stream.avail_out;
    } while (stream.avail_out == 0);
    taken += rest;
  } while (status != Z_STREAM_END);
  out.resize(written);
  return out;
}

/// All bytes of one position, then all of the next: alike ones stand together.
template <class Word>
std::string planes(const std::vector<Word>& words) {
  std::string bytes(words.size() * sizeof(Word), '\0');
  char* byte = bytes.data();
  for (unsigned shift = 0; shift < 8 * sizeof(Word); shift += 8)
    for (const Word word : words) *byte++ = static_cast<char>(word >> shift);
  return bytes;
}

}  // namespace

PackedFrames pack_frames(std::span<const float> values, std::size_t per_frame, int levels) {
  if (levels < 2 || levels > 65535) throw std::invalid_argument("pack_frames: 2 to 65535 levels");
  if (per_frame == 0 ? !values.empty() : values.size() % per_frame != 0)
    throw std::invalid_argument("pack_frames: values that are no whole frames");
  PackedFrames packed{.levels = levels, .text = {}};
  bool any = false;
  for (const float v : values) {
    if (!std::isfinite(v)) continue;
    packed.low = any ? std::min(packed.low, static_cast<double>(v)) : v;
    packed.high = any ? std::max(packed.high, static_cast<double>(v)) : v;
    any = true;
  }
  const double scale = packed.high > packed.low ? (levels - 1) / (packed.high - packed.low) : 0;
  std::vector<std::uint16_t> codes(values.size());
  for (std::size_t n = 0; n < values.size(); ++n)
    codes[n] = static_cast<std::uint16_t>(
        std::isfinite(values[n]) ? std::lround((static_cast<double>(values[n]) - packed.low) * scale) : levels);
  for (std::size_t n = codes.size(); n-- > per_frame;)
    codes[n] = static_cast<std::uint16_t>(codes[n] - codes[n - per_frame]);
  packed.text = base64(compressed(planes(codes)));
  return packed;
}

std::string pack_numbers(std::span<const double> values) {
  std::vector<std::uint32_t> words;
  for (const double v : values) words.push_back(std::bit_cast<std::uint32_t>(static_cast<float>(v)));
  return base64(compressed(planes(words)));
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string text;
  text.reserve((bytes.size() + 2) / 3 * 4);
  for (std::size_t n = 0; n < bytes.size(); n += 3) {
    const std::size_t count = std::min<std::size_t>(3, bytes.size() - n);
    std::uint32_t word = 0;
    for (std::size_t k = 0; k < 3; ++k) word = word << 8U | (k < count ? static_cast<unsigned char>(bytes[n + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) text += k <= count ? letters[word >> (18 - 6 * k) & 63U] : '=';
  }
  return text;
}

}  // namespace talus
