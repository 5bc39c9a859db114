// SPDX-License-Identifier: Apache-2.0
#include "run/snapshot_writer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>

#include "io/file.hpp"
#include "io/run_json.hpp"
#include "io/series.hpp"
#include "io/vtkhdf.hpp"

namespace talus::run {

namespace {

constexpr std::array<std::string_view, 3> kinds{"particles", "air", "walls"};

std::string entry_of(std::string_view kind) {
  return fmt::format("run/sums_of_{}", kind);
}

}  // namespace

void SnapshotWriter::keep_sum(std::size_t kind, const std::filesystem::path& path) {
  sums_[kind].resize(taken_ + 1);
  sums_[kind][taken_] = checksum_of_file(path);
}

void SnapshotWriter::write(const AnyModel& model) {
  const auto number = static_cast<int>(taken_);
  if (const PointSource particles = model.stored(); !particles.columns.empty()) {
    const std::filesystem::path path = folder_.snapshot(number);
    write_points(path, particles);
    keep_sum(0, path);
    index_snapshots(folder_, number);
  }
  if (const std::optional<GridSnapshot> air = model.grid()) {
    const std::filesystem::path path = folder_.snapshot(number, "air");
    write_grid(path, *air);
    keep_sum(1, path);
    index_snapshots(folder_, number, "air");
  }
  if (const std::optional<SurfaceSnapshot> walls = model.walls()) {
    const std::filesystem::path path = folder_.snapshot(number, "walls");
    write_surface(path, *walls);
    keep_sum(2, path);
    index_snapshots(folder_, number, "walls");
  }
}

void SnapshotWriter::take(const AnyModel& model) {
  write(model);
  ++taken_;
  step_ = model.step();
  next_time_ = interval_ * (std::floor(model.time() / interval_) + 1);
}

void SnapshotWriter::take_last(const AnyModel& model) {
  if (step_ != model.step()) write(model);
}

void SnapshotWriter::save(CheckpointWriter& checkpoint) const {
  checkpoint.put("run/snapshots", taken_);
  checkpoint.put("run/snapshot_step", step_);
  checkpoint.put("run/next_snapshot_time", next_time_, "s");
  for (std::size_t kind = 0; kind < kinds.size(); ++kind)
    if (!sums_[kind].empty()) checkpoint.put(entry_of(kinds[kind]), sums_[kind]);
}

void SnapshotWriter::resume(const CheckpointReader& checkpoint) {
  checkpoint.get("run/snapshots", taken_);
  checkpoint.get("run/snapshot_step", step_);
  checkpoint.get("run/next_snapshot_time", next_time_);
  const auto taken = static_cast<int>(taken_);
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    folder_.remove_snapshots(taken, kinds[kind]);
    const std::vector<int> numbers = folder_.snapshot_numbers(kinds[kind]);
    if (!numbers.empty()) index_snapshots(folder_, taken - 1, kinds[kind], KnownTimes::of_snapshots);
    if (checkpoint.has(entry_of(kinds[kind]))) {
      checkpoint.get(entry_of(kinds[kind]), sums_[kind]);
      sums_[kind].resize(taken_);  // behind it stands that of the last state
    } else if (!numbers.empty()) {
      // A run of a version that kept none: they count as they are now.
      sums_[kind].resize(taken_);
      for (const int number : numbers)
        if (number < taken)
          sums_[kind][static_cast<std::size_t>(number)] = checksum_of_file(folder_.snapshot(number, kinds[kind]));
    }
  }
}

FilesFound compare_files(const RunFolder& folder, const CheckpointReader& checkpoint, bool ended) {
  FilesFound found;
  const auto compare = [&](const std::filesystem::path& path, std::int64_t expected, auto&& sum_of) {
    ++found.compared;
    if (!std::filesystem::exists(path))
      found.missing.push_back(path.string());
    else if (const std::int64_t sum = sum_of(); sum != expected)
      found.changed.push_back(
          fmt::format("{}: its checksum is {:08x} in place of {:08x}", path.string(), sum, expected));
  };
  if (checkpoint.has("run/sum_of_series")) {
    found.has_sums = true;
    std::uint64_t rows = 0, expected = 0;
    checkpoint.get("run/rows", rows);
    checkpoint.get("run/sum_of_series", expected);
    compare(folder.series(), static_cast<std::int64_t>(expected),
            [&] { return ended ? checksum_of_file(folder.series()) : checksum_of_series(folder.series(), rows); });
  }
  std::uint64_t taken = 0;
  checkpoint.get("run/snapshots", taken);
  for (const std::string_view kind : kinds) {
    if (!checkpoint.has(entry_of(kind))) continue;
    std::vector<std::int64_t> sums;
    checkpoint.get(entry_of(kind), sums);
    if (!ended) sums.resize(std::min<std::size_t>(sums.size(), taken));
    for (std::size_t number = 0; number < sums.size(); ++number) {
      const std::filesystem::path path = folder.snapshot(static_cast<int>(number), kind);
      compare(path, sums[number], [&] { return checksum_of_file(path); });
    }
  }
  return found;
}

}  // namespace talus::run
