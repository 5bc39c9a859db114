// SPDX-License-Identifier: Apache-2.0
/// Rows of quantities that only a study needs: validation/STUDY/measures.py measures them, on python/talus. The program
/// asks for all of a comparison at once, and makes the numbers of members into those of the rows.
#pragma once

#include <vector>

#include "app/comparison/evaluation.hpp"

namespace talus::app {

/// Sets values and `missing` of the rows `of_study`. Without a python3 that has numpy and h5py they say so; all other
/// rows are left as they are. \param faults noted: no row is asked for whose runs are not there \param jobs processes
/// at a time \throws InputError if the study has no such quantity, or it has another unit or place; FileError if its
/// measures.py fails
void evaluate_by_study(const Reference& reference, const std::vector<FoundEnsemble>& found, const StudiedRuns& runs,
                       Faults faults, int jobs, std::vector<EvaluatedRow>& rows);

}  // namespace talus::app
