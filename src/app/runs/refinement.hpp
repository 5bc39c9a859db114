// SPDX-License-Identifier: Apache-2.0
/// A run and a finer one of the same case: what their numbers say of the error by the spacing of the particles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/case_file.hpp"
#include "io/run_json.hpp"

namespace talus::app {

/// By how much the spacing is divided: enough to see a difference, and with a bed in space five times the work.
inline constexpr double refinement = 1.5;

/// The case with bed.spacing divided by that. \throws InputError where that is another case, or none: of a model
/// without particles of a chosen spacing, a section less than three particles deep, a fixed time step
CaseFile refined_case(const CaseFile& file);

struct RefinedQuantity {
  std::string name, unit;
  double coarse = 0, fine = 0;
  double extrapolated = 0;  ///< to no spacing
  double error = 0;         ///< of the fine one: how far it is from that
};

/// The quantities that both summaries have as finite numbers, except quantities of the machine and of the scheme. To
/// first order in the spacing, fine + (fine - coarse)/(ratio - 1): what an edge or a surface takes is a length that
/// goes with the spacing (validation/slots, validation/orifice). \param ratio of the spacings, above 1
std::vector<RefinedQuantity> extrapolated(const Summary& coarse, const Summary& fine, double ratio);

/// As a table for reading.
std::string table_of(const std::vector<RefinedQuantity>& quantities);

/// {"ratio": 1.5, "quantities": {NAME: {"unit": ..., "coarse": ..., "fine": ..., "extrapolated": ..., "error": ...}}}
/// \throws FileError
void write_refinement(const std::filesystem::path& path, const std::vector<RefinedQuantity>& quantities);

}  // namespace talus::app
