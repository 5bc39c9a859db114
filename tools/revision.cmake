# Writes the header with the program's version and the commit it is built from; run at every build. The file changes
# only if one of the two has.
#   cmake -DSOURCE=... -DVERSION=... -DOUTPUT=revision.hpp -P revision.cmake
execute_process(COMMAND git describe --always --dirty --abbrev=12 --exclude=* WORKING_DIRECTORY ${SOURCE}
  OUTPUT_VARIABLE REVISION OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE failed)
if(failed OR NOT REVISION)
  set(REVISION "unknown")
endif()
file(CONFIGURE OUTPUT ${OUTPUT} @ONLY CONTENT [[
#pragma once
#include <string_view>
namespace talus::generated {
inline constexpr std::string_view version = "@VERSION@", revision = "@REVISION@";
}
]])
