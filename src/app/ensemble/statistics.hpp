// SPDX-License-Identifier: Apache-2.0
/// What an ensemble's members have in common: mean and standard deviation of every quantity and of every table that
/// grows with time. Everything is read from the members' folders in the order of their seeds, so the result depends
/// neither on the order in which they ran nor on how many ran at once.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "app/ensemble/plan.hpp"
#include "numerics/run_record.hpp"

namespace talus::app {

/// A quantity over the members that have it.
struct QuantitySpread {
  std::string name, unit;
  std::vector<double> values;  ///< finite ones, in the order of the seeds
  double mean = 0, deviation = 0;
};

/// Quantities of a group's members that are done, in the order in which they first occur; those about the machine
/// (times, memory, threads) are left out.
std::vector<QuantitySpread> quantity_spreads(const EnsembleGroup& group);

/// Mean and standard deviation, row by row, of one table of the members that are done: columns "time", then NAME_mean
/// and NAME_deviation, of every column that any member has. A row is the mean over the members that have it: by its
/// number where all have as many rows, otherwise by its time. Values that are not finite do not count.
/// \param table path within a member's folder: "analysis/front_speed.csv"
Series table_spread(const EnsembleGroup& group, const std::filesystem::path& table);

/// Names of the tables, with time as first column, that any done member has under analysis/ with at least one row.
std::vector<std::string> time_tables(const EnsembleGroup& group);

/// Writes, in the group's folder: members.csv, quantities.csv and bands_TABLE.csv. \throws FileError
void write_group(const EnsembleGroup& group, const std::filesystem::path& folder);

/// Enters the pictures that talus.charts makes of a group into the list of files that are Talus's. \throws FileError
void claim_pictures(const EnsembleGroup& group, const std::filesystem::path& folder);

}  // namespace talus::app
