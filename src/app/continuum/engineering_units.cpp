// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/engineering_units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace talus::app {

namespace {

/// Three digits without a power of ten: 1234567 as "1230000".
std::string digits(double number, int places) {
  if (places >= 0) return fmt::format("{:.{}f}", number, places);
  const double power = std::pow(10, -places);
  return fmt::format("{:.0f}", std::round(number / power) * power);
}

int places_of(double number) {
  return number != 0 ? 2 - static_cast<int>(std::floor(std::log10(std::abs(number)))) : 2;
}

std::string three_digits(double number) {
  std::string text = digits(number, std::min(9, places_of(number)));
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.ends_with('.')) text.pop_back();
  return text == "-0" ? "0" : text;
}

}  // namespace

std::string pressure_text(double pascals) {
  return std::abs(pascals) < 100 ? three_digits(pascals) + " Pa" : three_digits(1e-3 * pascals) + " kPa";
}

std::string length_text(double metres) {
  return std::abs(metres) < 1 ? three_digits(1e3 * metres) + " mm" : three_digits(metres) + " m";
}

std::string mass_text(double kilograms) {
  if (std::abs(kilograms) < 1) return three_digits(1e3 * kilograms) + " g";
  return std::abs(kilograms) < 1e4 ? three_digits(kilograms) + " kg" : three_digits(1e-3 * kilograms) + " t";
}

std::string time_text(double seconds) {
  if (std::abs(seconds) < 0.1) return three_digits(1e3 * seconds) + " ms";
  if (std::abs(seconds) < 120) return three_digits(seconds) + " s";
  const long whole = std::lround(seconds);
  if (whole < 7200) return fmt::format("{} min {} s", whole / 60, whole % 60);
  return fmt::format("{} h {} min", whole / 3600, whole / 60 % 60);
}

std::string share_text(double share) {
  const double percent = 100 * share;
  // Nearly nothing and nearly all are told from nothing and all.
  const bool near_end = percent < 10 || percent > 90;
  return fmt::format("{:.{}f} %", std::max(0.0, percent), near_end && percent > 0.05 && percent < 99.95 ? 1 : 0);
}

std::string rate_text(double rate, double error) {
  struct Unit {
    double factor;
    const char* name;
  };
  const Unit unit = std::abs(rate) >= 10    ? Unit{3.6, "t/h"}
                    : std::abs(rate) >= 0.1 ? Unit{1, "kg/s"}
                                            : Unit{1e3, "g/s"};
  const int places = std::max(0, places_of(unit.factor * rate));
  const std::string number = digits(unit.factor * rate, places);
  if (!std::isfinite(error)) return fmt::format("{} {}", number, unit.name);
  return fmt::format("{} ± {} {}", number, digits(unit.factor * error, places), unit.name);
}

}  // namespace talus::app
