// SPDX-License-Identifier: Apache-2.0
/// One value of a case file as a parameter needs it: right type, right dimension, within its range, finite; or why not.
#pragma once

#include <optional>
#include <string>

#include "base/parameter.hpp"
#include "io/case_file.hpp"
#include "io/parameter_value.hpp"

namespace talus {

/// Why a value cannot be taken.
struct ValueFault {
  std::string what;          ///< "\"5 kg\" is not a length but a mass"
  std::string nearest = {};  ///< the choice that was probably meant
};

/// \returns nothing if the value cannot be taken; `fault` then says why
std::optional<ParameterValue> convert_value(const CaseEntry& entry, const Parameter& parameter, const ValueType& type,
                                            ValueFault& fault);

/// A value as it was written, for messages: `"5 mm"`, `2.5`, `an array`; long text is cut.
std::string as_written(const CaseValue& value);

}  // namespace talus
