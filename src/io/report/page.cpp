// SPDX-License-Identifier: Apache-2.0
#include "io/report/page.hpp"

#include <fmt/format.h>

#include <fstream>
#include <string_view>

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/report/packed.hpp"

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

}  // namespace talus
