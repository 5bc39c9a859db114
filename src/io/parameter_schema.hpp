// SPDX-License-Identifier: Apache-2.0
/// What a case may say, for editors and for people: a JSON Schema and a reference page. Both follow from the lists of
/// parameters; the values in the list are the defaults.
#pragma once

#include <string>
#include <string_view>

#include "io/parameter_value.hpp"

namespace talus {

/// JSON Schema, draft 2020-12. Tables are objects that allow no other keys; quantities are strings with a pattern (that
/// a number and a unit; the dimension is in the description, and checked when the case is read).
std::string json_schema(const ParameterList& defaults, std::string_view title);

/// Markdown: a heading and a table for each table of the case; columns key, type, unit, allowed, default, meaning.
std::string reference_page(const ParameterList& defaults);

}  // namespace talus
