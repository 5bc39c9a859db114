// SPDX-License-Identifier: Apache-2.0
#include "app/report/report.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>

#include "app/case/scene.hpp"
#include "io/report_page.hpp"
#include "io/run_folder.hpp"
#include "io/vtkhdf.hpp"

namespace talus::app {

namespace {

using Json = nlohmann::ordered_json;

constexpr int levels_of_position = 65535;
constexpr int levels_of_field = 1023;  // four times as fine as a colour shows
constexpr float none = std::numeric_limits<float>::quiet_NaN();

Json described(const PackedFrames& packed, std::vector<std::string>& blocks) {
  blocks.push_back(packed.text);
  return {{"low", packed.low}, {"high", packed.high}, {"levels", packed.levels}, {"block", blocks.size() - 1}};
}

/// One number of every particle in every frame.
struct Column {
  std::string unit;
  std::vector<std::vector<float>> frames;

  /// All frames, as long as the longest particle's number demands.
  std::vector<float> joined(std::size_t particles) const {
    std::vector<float> all;
    all.reserve(frames.size() * particles);
    for (const std::vector<float>& frame : frames) {
      all.insert(all.end(), frame.begin(), frame.end());
      all.resize(all.size() + particles - frame.size(), none);
    }
    return all;
  }
};

bool is_constant(std::span<const float> values) {
  return std::all_of(values.begin(), values.end(),
                     [&](float v) { return v == values.front() || (std::isnan(v) && std::isnan(values.front())); });
}

/// The same particle has the same position in every frame, whatever the order in the files.
class Particles {
 public:
  Particles(std::size_t frames, std::size_t most) : frames_(frames), max_particles_(most) {}

  void add(const Snapshot& snapshot) {
    of_particles_ = std::max(of_particles_, snapshot.size());
    if (frame_ == 0)
      share_ = static_cast<double>(max_particles_) / static_cast<double>(std::max<std::size_t>(1, snapshot.size()));
    choose(snapshot);
    for_each_number(
        snapshot, [&](const std::string& name, const std::string& unit, const auto& value) { put(name, unit, value); });
    ++frame_;
  }

  /// Once: the values go as they are packed.
  void describe(Json& run, std::vector<std::string>& blocks) {
    const std::size_t count = identities_.size();
    run["count"] = count;
    run["of_particles"] = of_particles_;
    if (std::any_of(slots_.begin(), slots_.end(),
                    [](const auto& slot) { return slot.first != static_cast<std::int64_t>(slot.second); })) {
      blocks.push_back(pack_numbers(identities_));
      run["identity"] = blocks.size() - 1;
    }
    run["position"] = run["fields"] = Json::array();
    for (auto& [name, column] : columns_) {
      const std::vector<float> values = column.joined(count);
      column.frames = {};
      const bool is_position = name.starts_with("position_");
      if (values.empty() || (is_constant(values) && !is_position && name != "radius")) continue;
      Json field = described(pack_frames(values, count, is_position ? levels_of_position : levels_of_field), blocks);
      field["name"] = name;
      field["unit"] = column.unit;
      run[is_position ? "position" : "fields"].push_back(std::move(field));
    }
  }

 private:
  /// Evenly whatever their order: the fractional part of a multiple of the golden ratio.
  bool is_chosen(std::int64_t identity) const {
    const double turn = static_cast<double>(identity) * 0.6180339887498949;
    return share_ >= 1 || turn - std::floor(turn) < share_;
  }

  void choose(const Snapshot& snapshot) {
    chosen_.assign(snapshot.size(), std::nullopt);
    for (std::size_t n = 0; n < snapshot.size(); ++n) {
      const auto identity = snapshot.has("identity") ? snapshot.integers("identity")[n] : static_cast<std::int64_t>(n);
      if (frame_ == 0 && is_chosen(identity)) slots_.emplace(identity, 0);
      if (frame_ > 0 && is_chosen(identity) && slots_.emplace(identity, identities_.size()).second)
        identities_.push_back(static_cast<double>(identity));
    }
    if (frame_ == 0)
      for (auto& [identity, slot] : slots_) {
        slot = identities_.size();
        identities_.push_back(static_cast<double>(identity));
      }
    for (std::size_t n = 0; n < snapshot.size(); ++n) {
      const auto identity = snapshot.has("identity") ? snapshot.integers("identity")[n] : static_cast<std::int64_t>(n);
      if (const auto slot = slots_.find(identity); slot != slots_.end()) chosen_[n] = slot->second;
    }
  }

  template <class Value>
  void put(const std::string& name, const std::string& unit, const Value& value) {
    Column& column = columns_[name];
    column.unit = unit;
    column.frames.resize(frames_);
    std::vector<float>& frame = column.frames[frame_];
    frame.assign(identities_.size(), none);
    for (std::size_t n = 0; n < chosen_.size(); ++n)
      if (chosen_[n]) frame[*chosen_[n]] = static_cast<float>(value(n));
  }

  std::size_t frames_, max_particles_, frame_ = 0, of_particles_ = 0;
  double share_ = 1;
  std::map<std::int64_t, std::size_t> slots_;       // of the chosen ones, by identity
  std::vector<double> identities_;                  // by slot
  std::vector<std::optional<std::size_t>> chosen_;  // slot of each particle of this frame
  std::map<std::string, Column> columns_;
};

/// Every so many cells along each axis, of a thin axis the middle one, such that there are not too many.
struct Thinned {
  std::array<int, 3> first{}, stride{}, count{};

  Thinned(const GridSnapshot& grid, std::size_t most) {
    constexpr double thin = 0.15;  // of the longest side
    double longest = 0;
    for (std::size_t a = 0; a < 3; ++a) longest = std::max(longest, grid.count[a] * grid.spacing[static_cast<int>(a)]);
    for (int m = 1;; ++m) {
      std::size_t cells = 1;
      for (std::size_t a = 0; a < 3; ++a) {
        const bool layer = grid.count[a] * grid.spacing[static_cast<int>(a)] < thin * longest;
        stride[a] = layer ? grid.count[a] : std::min(m, grid.count[a]);
        first[a] = stride[a] / 2;
        count[a] = (grid.count[a] - 1 - first[a]) / stride[a] + 1;
        cells *= static_cast<std::size_t>(count[a]);
      }
      if (cells <= most) return;
    }
  }
};

/// Velocity of the air at the times of the frames. \returns null if there is none at one of them
Json pack_air(const RunFolder& folder, const std::vector<int>& numbers, std::size_t most,
              std::vector<std::string>& blocks) {
  std::array<std::vector<float>, 3> velocity;
  Json air;
  for (const int number : numbers) {
    if (!std::filesystem::exists(folder.snapshot(number, "air"))) return nullptr;
    const GridSnapshot grid = read_grid(folder.snapshot(number, "air"));
    const Thinned thinned(grid, most);
    for (int k = 0; k < thinned.count[2]; ++k)
      for (int j = 0; j < thinned.count[1]; ++j)
        for (int i = 0; i < thinned.count[0]; ++i) {
          const auto at = [&](int n, std::size_t a) { return thinned.first[a] + n * thinned.stride[a]; };
          const Vector3 u = grid.vectors("velocity")[grid.index(at(i, 0), at(j, 1), at(k, 2))];
          for (int a = 0; a < 3; ++a) velocity[static_cast<std::size_t>(a)].push_back(static_cast<float>(u[a]));
        }
    if (!air.is_null()) continue;
    const Vector3 first = grid.centre(thinned.first[0], thinned.first[1], thinned.first[2]), h = grid.spacing;
    air["count"] = thinned.count;
    air["first"] = {first.x, first.y, first.z};
    air["spacing"] = {h.x * thinned.stride[0], h.y * thinned.stride[1], h.z * thinned.stride[2]};
  }
  if (air.is_null()) return air;
  air["velocity"] = Json::array();
  for (const auto& component : velocity)
    air["velocity"].push_back(
        described(pack_frames(component, component.size() / numbers.size(), levels_of_field), blocks));
  return air;
}

}  // namespace

std::vector<std::size_t> evenly(std::size_t count, std::size_t most) {
  std::vector<std::size_t> chosen;
  const std::size_t kept = std::min(count, std::max<std::size_t>(most, 2));
  for (std::size_t n = 0; n < kept; ++n) chosen.push_back(kept == 1 ? 0 : n * (count - 1) / (kept - 1));
  return chosen;
}

Json pack_run(const std::filesystem::path& path, double origin, const ReportLimits& limits,
              std::vector<std::string>& blocks) {
  const RunFolder folder(path);
  const std::vector<int> of_particles = folder.snapshot_numbers(), of_air = folder.snapshot_numbers("air");
  const std::vector<int>& all = of_particles.empty() ? of_air : of_particles;
  if (all.empty()) return nullptr;
  std::vector<int> numbers;
  for (const std::size_t n : evenly(all.size(), limits.frames)) numbers.push_back(all[n]);

  Json run;
  run["of_frames"] = all.size();
  run["time"] = Json::array();
  Particles particles(numbers.size(), limits.particles);
  for (const int number : numbers) {
    if (of_particles.empty()) {
      run["time"].push_back(read_points_time(folder.snapshot(number, "air")) - origin);
      continue;
    }
    const PointSet points = read_points(folder.snapshot(number));
    run["time"].push_back(points.time - origin);
    particles.add(points.view());
  }
  particles.describe(run, blocks);
  if (!of_air.empty())
    if (Json air = pack_air(folder, numbers, limits.arrows, blocks); !air.is_null()) run["air"] = std::move(air);
  return run;
}

}  // namespace talus::app
