// SPDX-License-Identifier: Apache-2.0
/// Cairo's own text interface places characters one after the other and knows nothing of marks, so each character is a
/// piece of its own here, and a mark is centred on the ink of the letter before it.

#include <algorithm>
#include <string>
#include <vector>

#include "io/figure/canvas.hpp"

namespace talus::figure {

namespace {

constexpr double script_size = 0.72, subscript_drop = 0.18, superscript_rise = 0.40;
constexpr double slant = 0.2;  // DejaVu Sans Oblique leans by 11 degrees

/// One character on the line.
struct Piece {
  std::string character;
  double x = 0, rise = 0;  ///< units; rise above the baseline
  double size = 0;
  bool slanted = false;
};

struct Line {
  std::vector<Piece> pieces;
  TextExtent extent;
};

std::size_t utf8_length(unsigned char lead) {
  return lead < 0x80 ? 1 : lead < 0xe0 ? 2 : lead < 0xf0 ? 3 : 4;
}

/// Combining diacritical marks, U+0300 to U+036F.
bool is_mark(std::string_view character) {
  return character.size() == 2 && (character[0] == '\xcc' || (character[0] == '\xcd' && character[1] <= '\xaf'));
}

/// Letters that Unicode has with the tilde in one, taken apart so that they look like those it has not.
std::string_view decomposed(std::string_view character) {
  static constexpr std::string_view pairs[][2] = {
      {"ã", "a\xcc\x83"}, {"ñ", "n\xcc\x83"}, {"õ", "o\xcc\x83"}, {"ṽ", "v\xcc\x83"}, {"ỹ", "y\xcc\x83"}};
  for (const auto& pair : pairs) {
    if (character == pair[0]) return pair[1];
  }
  return character;
}

void select_font(cairo_t* context, double size, bool slanted, bool bold) {
  cairo_select_font_face(context, "DejaVu Sans", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  const cairo_matrix_t matrix{size, 0, slanted ? -slant * size : 0, size, 0, 0};
  cairo_set_font_matrix(context, &matrix);
}

cairo_text_extents_t measure(cairo_t* context, const std::string& character) {
  cairo_text_extents_t extents;
  cairo_text_extents(context, character.c_str(), &extents);
  return extents;
}

class Setter {
 public:
  Setter(cairo_t* context, const TextStyle& style) : context_(context), style_(style) {}

  Line set(std::string_view text) {
    for (std::size_t i = 0; i < text.size();) {
      const std::size_t length = utf8_length(static_cast<unsigned char>(text[i]));
      const std::string_view character = text.substr(i, length);
      if (character == "*" && (slanted_ || text.find('*', i + 1) != text.npos)) {
        slanted_ = !slanted_;
      } else if ((character == "_" || character == "^") && text.substr(i + 1, 1) == "{") {
        script_ = character == "_" ? -1 : 1;
        ++i;
      } else if (character == "}" && script_ != 0) {
        script_ = 0;
      } else if (character == "-" && script_ > 0) {
        add("−");
      } else {
        const std::string_view parts = decomposed(character);
        const std::size_t letter = utf8_length(static_cast<unsigned char>(parts[0]));
        add(parts.substr(0, letter));
        if (letter < parts.size()) add(parts.substr(letter));
      }
      i += length;
    }
    line_.extent.width = pen_;
    return std::move(line_);
  }

 private:
  void add(std::string_view character) {
    const double size = script_ == 0 ? style_.size : script_size * style_.size;
    const double rise = script_ < 0 ? -subscript_drop * style_.size : script_ * superscript_rise * style_.size;
    Piece piece{std::string(character), pen_, rise, size, slanted_};
    select_font(context_, size, slanted_, style_.bold);
    const cairo_text_extents_t ink_box = measure(context_, piece.character);
    if (is_mark(character)) {
      const double middle = letter_middle_ - (ink_box.x_bearing + 0.5 * ink_box.width);
      const double small_letter = -measure(context_, "x").y_bearing;  // the font's marks sit right above an x
      piece.rise += std::max(0.0, letter_top_ - small_letter);
      piece.x = middle + (slanted_ ? slant * piece.rise : 0.0);
    } else {
      letter_middle_ = pen_ + ink_box.x_bearing + 0.5 * ink_box.width;
      letter_top_ = -ink_box.y_bearing;
      pen_ += ink_box.x_advance;
    }
    line_.extent.ascent = std::max(line_.extent.ascent, piece.rise - ink_box.y_bearing);
    line_.extent.descent = std::max(line_.extent.descent, ink_box.y_bearing + ink_box.height - piece.rise);
    line_.pieces.push_back(std::move(piece));
  }

  cairo_t* context_;
  const TextStyle& style_;
  Line line_;
  double pen_ = 0, letter_middle_ = 0, letter_top_ = 0;
  bool slanted_ = false;
  int script_ = 0;
};

void set_font_options(cairo_t* context) {
  // Without hinting the letters keep their shape and their distances at every scale.
  cairo_font_options_t* options = cairo_font_options_create();
  cairo_font_options_set_antialias(options, CAIRO_ANTIALIAS_GRAY);
  cairo_font_options_set_hint_style(options, CAIRO_HINT_STYLE_NONE);
  cairo_font_options_set_hint_metrics(options, CAIRO_HINT_METRICS_OFF);
  cairo_set_font_options(context, options);
  cairo_font_options_destroy(options);
}

}  // namespace

TextExtent text_extent(cairo_t* context, std::string_view text, const TextStyle& style) {
  const Saved saved(context);
  set_font_options(context);
  return Setter(context, style).set(text).extent;
}

void draw_text(cairo_t* context, std::string_view text, double x, double y, const TextStyle& style, Align align,
               double angle) {
  const Saved saved(context);
  set_font_options(context);
  const Line line = Setter(context, style).set(text);
  cairo_translate(context, x, y);
  cairo_rotate(context, -angle);
  const double start = align == Align::left     ? 0
                       : align == Align::centre ? -0.5 * line.extent.width
                                                : -line.extent.width;
  set_colour(context, style.colour);
  for (const Piece& piece : line.pieces) {
    select_font(context, piece.size, piece.slanted, style.bold);
    cairo_move_to(context, start + piece.x, -piece.rise);
    cairo_show_text(context, piece.character.c_str());
  }
}

}  // namespace talus::figure

#ifdef __SANITIZE_ADDRESS__
/// Fontconfig keeps its fonts until the process ends, which the leak check would report.
extern "C" const char* __lsan_default_suppressions() {
  return "leak:libfontconfig";
}
#endif
