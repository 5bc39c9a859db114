// SPDX-License-Identifier: Apache-2.0
#include "base/unit.hpp"

#include <fmt/format.h>

#include <array>
#include <cctype>
#include <cstdlib>
#include <utility>
#include <vector>

#include "base/decimal.hpp"
#include "base/text.hpp"

namespace talus {

namespace {

/// A unit's size in SI and its reciprocal, as digits and a power of ten: exact, or to 50 digits.
struct Unit {
  std::string_view symbol;
  Dimension dimension;
  int power_of_ten = 0;
  bool takes_prefix = true;
  std::string_view digits = "1";
  std::string_view reciprocal_digits = "1";
  int digits_exponent = 0, reciprocal_exponent = 0;
};

constexpr auto units = std::to_array<Unit>({
    {"m", {1, 0, 0, 0}},
    {"g", {0, 1, 0, 0}, -3},
    {"s", {0, 0, 1, 0}},
    {"rad", {0, 0, 0, 1}},
    {"N", {1, 1, -2, 0}},
    {"Pa", {-1, 1, -2, 0}},
    {"J", {2, 1, -2, 0}},
    {"W", {2, 1, -3, 0}},
    {"Hz", {0, 0, -1, 0}},
    {"bar", {-1, 1, -2, 0}, 5},
    {"hPa", {-1, 1, -2, 0}, 2, false},
    {"min", {0, 0, 1, 0}, 0, false, "60", "16666666666666666666666666666666666666666666666667", 0, -51},
    {"h", {0, 0, 1, 0}, 0, false, "3600", "27777777777777777777777777777777777777777777777778", 0, -53},
    {"deg",
     {0, 0, 0, 1},
     0,
     false,
     "17453292519943295769236907684886127134428718885417", /* pi/180 */
     "57295779513082320876798154814105170332405472466564",
     -51,
     -48},
    {"d", {0, 0, 1, 0}, 0, false, "86400", "11574074074074074074074074074074074074074074074074", 0, -54},
    {"t", {0, 1, 0, 0}, 3, false},
    {"kt", {0, 1, 0, 0}, 6, false},
    {"L", {3, 0, 0, 0}, -3},
    {"l", {3, 0, 0, 0}, -3},
    {"P", {-1, 1, -1, 0}, -1, false},  // poise
    {"cP", {-1, 1, -1, 0}, -3, false},
    {"dm", {1, 0, 0, 0}, -1, false},
    {"cc", {3, 0, 0, 0}, -6, false},
    {"in", {1, 0, 0, 0}, 0, false, "254", "39370078740157480314960629921259842519685039370079", -4, -48},
    {"ft", {1, 0, 0, 0}, 0, false, "3048", "32808398950131233595800524934383202099737532808399", -4, -49},
    {"lb", {0, 1, 0, 0}, 0, false, "45359237", "22046226218487758072297380134502703385420702733602", -8, -49},
    {"lbf", {1, 1, -2, 0}, 0, false, "44482216152605", "22480894309971048291003941340317747024132300768970", -13, -50},
    {"psf",
     {-1, 1, -2, 0},
     0,
     false,
     "47880258980335842616129676703797852040148524741494",
     "20885434233150126982210708024971932644928441036317",
     -48,
     -51},
    {"psi",
     {-1, 1, -2, 0},
     0,
     false,
     "68947572931683613367226734453468906937813875627751",
     "14503773773020921515424102795119397670089195164109",
     -46,
     -53},
    {"rev",
     {0, 0, 0, 1},
     0,
     false,
     "62831853071795864769252867665590057683943387987502", /* 2 pi */
     "15915494309189533576888376337251436203445964574046",
     -49,
     -50},
    {"rpm",
     {0, 0, -1, 1},
     0,
     false,
     "10471975511965977461542144610931676280657231331250", /* pi/30 */
     "95492965855137201461330258023508618220675787444274",
     -50,
     -49},
});

struct Prefix {
  char symbol;
  int power_of_ten;
};
constexpr auto prefixes =
    std::to_array<Prefix>({{'p', -12}, {'n', -9}, {'u', -6}, {'m', -3}, {'c', -2}, {'k', 3}, {'M', 6}, {'G', 9}});

/// Non-ASCII spellings and their ASCII equivalents.
constexpr auto synonyms = std::to_array<std::pair<std::string_view, std::string_view>>({{"\u00b5", "u"},
                                                                                        {"\u03bc", "u"},
                                                                                        {"\u00b0", "deg"},
                                                                                        {"\u00b7", "*"},
                                                                                        {"\u22c5", "*"},
                                                                                        {"\u2212", "-"},
                                                                                        {"\u207b", "^-"},
                                                                                        {"\u00b9", "1"},
                                                                                        {"\u00b2", "2"},
                                                                                        {"\u00b3", "3"},
                                                                                        {"\u2074", "4"},
                                                                                        {"\u00a0", " "},
                                                                                        {"\u202f", " "}});

/// Words that people write for units.
constexpr auto words = std::to_array<std::pair<std::string_view, std::string_view>>(
    {{"meter", "m"},       {"metre", "m"},        {"micron", "um"},     {"micrometer", "um"}, {"micrometre", "um"},
     {"millimeter", "mm"}, {"millimetre", "mm"},  {"gram", "g"},        {"kilogram", "kg"},   {"sec", "s"},
     {"second", "s"},      {"millisecond", "ms"}, {"msec", "ms"},       {"minute", "min"},    {"hour", "h"},
     {"hr", "h"},          {"degree", "deg"},     {"radian", "rad"},    {"newton", "N"},      {"pascal", "Pa"},
     {"hertz", "Hz"},      {"mps", "m/s"},        {"tonne", "t"},       {"ton", "t"},         {"tph", "t/h"},
     {"inch", "in"},       {"inches", "in"},      {"foot", "ft"},       {"feet", "ft"},       {"pound", "lb"},
     {"lb", "lb"},         {"lbm", "lb"},         {"liter", "L"},       {"litre", "L"},       {"day", "d"},
     {"poise", "P"},       {"centipoise", "cP"},  {"revolution", "rev"}});

std::string replace_synonyms(std::string_view text) {
  std::string result;
  while (!text.empty()) {
    std::string_view from = text.substr(0, 1), to = from;
    for (const auto& [writing, meaning] : synonyms)
      if (text.starts_with(writing)) from = writing, to = meaning;
    result += to;
    text.remove_prefix(from.size());
  }
  return result;
}

std::string lower(std::string_view text) {
  std::string result(text);
  for (char& c : result) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return result;
}

/// What the writer of an unknown unit meant, if that is plain: "meters" -> "m", "KPA" -> "kPa".
std::string likely_unit(std::string_view symbol) {
  const std::string wanted = lower(symbol);
  for (const auto& [word, unit] : words)
    if (wanted == word || wanted == std::string(word) + "s") return std::string(unit);
  // Of those that differ in case alone, the one that differs least: MPa of MPA, not mPa.
  std::string likely;
  std::size_t most = 0;
  const auto take = [&](const std::string& name) {
    if (lower(name) != wanted) return;
    std::size_t same = 1;
    for (std::size_t n = 0; n < name.size(); ++n) same += name[n] == symbol[n];
    if (same > most) most = same, likely = name;
  };
  for (const Unit& unit : units) {
    take(std::string(unit.symbol));
    if (!unit.takes_prefix) continue;
    for (const Prefix& prefix : prefixes) take(prefix.symbol + std::string(unit.symbol));
  }
  return likely;
}

constexpr std::size_t max_factors = 8;
constexpr int max_power = 9;
constexpr std::size_t max_text_length = 400;

/// One unit of a product, with its prefix.
struct Factor {
  const Unit* unit;
  int prefix = 0;
  int power = 1;
};

bool is_letter(char c) {
  return std::isalpha(static_cast<unsigned char>(c)) || c == '%' || static_cast<unsigned char>(c) >= 0x80;
}

/// Products, quotients and powers of units. A fault leaves its description in `why`.
class UnitReader {
 public:
  explicit UnitReader(std::string_view text) : rest_(text) {}

  std::optional<std::vector<Factor>> read() {
    std::vector<Factor> factors;
    if (!rest_.empty() && !product(factors)) return std::nullopt;
    if (!rest_.empty()) return fail(fmt::format("has '{}' where a unit is due", rest_)), std::nullopt;
    return factors;
  }
  const std::string& why() const { return why_; }

 private:
  void fail(std::string why) { why_ = std::move(why); }

  void skip_blanks() {
    while (!rest_.empty() && std::isspace(static_cast<unsigned char>(rest_.front()))) rest_.remove_prefix(1);
  }

  bool take(std::string_view token) {
    if (!rest_.starts_with(token)) return false;
    rest_.remove_prefix(token.size());
    return true;
  }

  /// factor {[*|/] factor}, up to ')' or the end; may begin with '/' or "1/".
  bool product(std::vector<Factor>& factors) {
    skip_blanks();
    const bool one = take("1");
    skip_blanks();
    bool divide = take("/");
    if (one && !divide) return fail("has a second number after the first"), false;
    while (true) {
      skip_blanks();
      const std::size_t first = factors.size();
      if (!factor(factors)) return false;
      for (std::size_t i = first; divide && i < factors.size(); ++i) factors[i].power *= -1;
      if (factors.size() > max_factors) return fail("has too many units"), false;
      skip_blanks();
      if (rest_.empty() || rest_.front() == ')') return true;
      divide = take("/");
      if (!divide && !take("*")) take(".");
    }
  }

  /// A unit or a product in parentheses, with its power.
  bool factor(std::vector<Factor>& factors) {
    const std::size_t first = factors.size();
    if (take("(")) {
      if (!product(factors)) return false;
      if (!take(")")) return fail("has a parenthesis that is not closed"), false;
    } else {
      std::size_t length = 0;
      while (length < rest_.size() && is_letter(rest_[length])) ++length;
      if (length == 0 && rest_.empty()) return fail("lacks a unit at the end"), false;
      if (length == 0) return fail(fmt::format("has '{}' where a unit is due", rest_)), false;
      const auto unit = find(rest_.substr(0, length));
      if (!unit) return false;
      factors.push_back(*unit);
      rest_.remove_prefix(length);
    }
    const auto exponent = power();
    if (!exponent) return false;
    for (std::size_t i = first; i < factors.size(); ++i) {
      factors[i].power *= *exponent;
      if (std::abs(factors[i].power) > max_power) return fail("has a power above 9"), false;
    }
    return true;
  }

  std::optional<int> power() {
    const bool sign_due = take("**") || take("^");
    const bool negative = take("-");
    if (!negative) take("+");
    std::size_t digits = 0;
    while (digits < rest_.size() && is_digit(rest_[digits])) ++digits;
    const int value = digits == 1 ? rest_.front() - '0' : 0;  // longer ones are refused whatever they say
    rest_.remove_prefix(digits);
    if (digits == 0 && !sign_due && !negative) return 1;
    const bool fraction = rest_.size() > 1 && rest_[0] == '.' && is_digit(rest_[1]);
    if (value == 0 || fraction) return fail("has a power that is no digit from 1 to 9"), std::nullopt;
    return negative ? -value : value;
  }

  std::optional<Factor> find(std::string_view symbol) {
    for (const Unit& unit : units)
      if (unit.symbol == symbol) return Factor{&unit};
    for (const Prefix& prefix : prefixes)
      for (const Unit& unit : units)
        if (unit.takes_prefix && symbol.front() == prefix.symbol && symbol.substr(1) == unit.symbol)
          return Factor{&unit, prefix.power_of_ten};
    if (symbol == "%") return fail("is in percent, which is no unit; write 0.05 for 5 %"), std::nullopt;
    why_ = fmt::format("has the unknown unit '{}'", symbol);
    if (const std::string likely = likely_unit(symbol); !likely.empty()) why_ += fmt::format("; write '{}'", likely);
    return std::nullopt;
  }

  std::string_view rest_;
  std::string why_;
};

struct Scale {
  Decimal size{"1"};
  Decimal reciprocal{"1"};
  Dimension dimension;
};

Scale scale_of(const std::vector<Factor>& factors) {
  Scale scale;
  for (const auto& [unit, prefix, power] : factors) {
    Decimal size{std::string(unit->digits), unit->digits_exponent + unit->power_of_ten + prefix};
    Decimal reciprocal{std::string(unit->reciprocal_digits), unit->reciprocal_exponent - unit->power_of_ten - prefix};
    if (power < 0) std::swap(size, reciprocal);
    for (int i = 0; i < std::abs(power); ++i) {
      scale.size = scale.size * size;
      scale.reciprocal = scale.reciprocal * reciprocal;
    }
    scale.dimension.length += power * unit->dimension.length;
    scale.dimension.mass += power * unit->dimension.mass;
    scale.dimension.time += power * unit->dimension.time;
    scale.dimension.angle += power * unit->dimension.angle;
  }
  return scale;
}

}  // namespace

std::optional<Quantity> parse_quantity(std::string_view written, std::string* why) {
  const auto fail = [&](std::string reason) {
    if (why) *why = std::move(reason);
    return std::nullopt;
  };
  const std::string plain = replace_synonyms(written);
  std::string_view text = trimmed(plain);
  if (text.empty()) return fail("is empty");
  if (text.size() > max_text_length) return fail("is too long");
  const std::optional<Decimal> number = take_decimal(text);
  if (!number) return fail("does not begin with a number");
  if (text.size() > 1 && text.front() == ',' && is_digit(text[1])) return fail("has a comma; write a decimal point");
  UnitReader reader(text);
  const auto factors = reader.read();
  if (!factors) return fail(reader.why());
  const Scale scale = scale_of(*factors);
  const std::optional<double> value = to_double(*number * scale.size);
  if (!value) return fail("is outside the range of numbers");
  return Quantity{*value, scale.dimension};
}

std::string format_quantity(double value, std::string_view unit) {
  const std::string unit_text = replace_synonyms(unit);
  const auto factors = UnitReader(unit_text).read();
  const Scale scale = scale_of(factors ? *factors : std::vector<Factor>{});
  const std::string suffix = std::string(unit.empty() ? 0 : 1, ' ').append(unit);
  // A unit that is a power of ten only shifts the point. For the others, more and more digits of the quotient are
  // tried.
  std::string text = to_string(shortest_decimal(value) * scale.reciprocal) + suffix;
  const bool power_of_ten = scale.size.digits.find_first_not_of("01") == std::string::npos;
  const Decimal quotient = to_decimal(value) * scale.reciprocal;
  for (std::size_t count = 1; !power_of_ten && count <= 20; ++count) {
    text = to_string(rounded(quotient, count)) + suffix;
    if (const auto quantity = parse_quantity(text); quantity && quantity->value == value) break;
  }
  return text;
}

}  // namespace talus
