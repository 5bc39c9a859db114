// SPDX-License-Identifier: Apache-2.0
/// Quantities in the units that engineers of bulk solids use, three digits.
#pragma once

#include <string>

namespace talus::app {

std::string pressure_text(double pascals);  ///< "1.23 kPa"; "45 Pa" below 0.1 kPa
std::string length_text(double metres);     ///< "75 mm", "1.2 m"
std::string mass_text(double kilograms);    ///< "350 g", "12.3 kg", "15.2 t"
std::string time_text(
    double seconds);  ///< "19 ms", "0.72 s"; from two minutes on "3 min 20 s", from two hours on "2 h 5 min"
std::string share_text(double share);  ///< "0.2 %", "45 %", "99.8 %"

/// "0.479 ± 0.009 kg/s": from 10 kg/s on in t/h, below 0.1 kg/s in g/s; the error to the place of the last digit, left
/// out where it is none.
std::string rate_text(double kilograms_a_second, double error);

}  // namespace talus::app
