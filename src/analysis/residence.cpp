// SPDX-License-Identifier: Apache-2.0
#include "analysis/residence.hpp"

#include <algorithm>
#include <cmath>

#include "analysis/curve.hpp"

namespace talus {

Residence::Residence(const Snapshot& start, double outlet, std::size_t layers)
    : outlet_(outlet), low_(outlet), count_(layers) {
  const auto position = start.positions();
  const auto identity = start.integers("identity");
  double high = outlet;
  for (const Vector3& x : position) high = std::max(high, x.z);
  step_ = (high - low_) / static_cast<double>(layers);
  for (std::size_t i = 0; i < position.size(); ++i) {
    const double z = position[i].z;
    if (z < outlet) continue;
    const auto layer = step_ > 0 ? static_cast<std::size_t>((z - low_) / step_) : 0;
    tagged_.emplace(identity[i], Tagged{std::min(layer, count_ - 1), z, no_value, 0});
  }
}

void Residence::take(const Snapshot& next, double time) {
  const auto position = next.positions();
  const auto identity = next.integers("identity");
  ++taken_;
  for (std::size_t i = 0; i < position.size(); ++i) {
    const auto found = tagged_.find(identity[i]);
    if (found == tagged_.end()) continue;
    Tagged& particle = found->second;
    particle.seen = taken_;
    const double before = particle.height, z = position[i].z;
    particle.height = z;
    if (!std::isnan(particle.passed) || !(before >= outlet_ && z < outlet_)) continue;
    particle.passed = time_ + (time - time_) * (before - outlet_) / (before - z);
  }
  for (auto& [name, particle] : tagged_)
    if (particle.seen + 1 == taken_ && std::isnan(particle.passed)) particle.passed = 0.5 * (time_ + time);
  time_ = time;
}

std::vector<LayerResidence> Residence::layers() const {
  std::vector<std::vector<double>> passed(count_);
  std::vector<double> held(count_);
  for (const auto& [identity, particle] : tagged_) {
    ++held[particle.layer];
    if (!std::isnan(particle.passed)) passed[particle.layer].push_back(particle.passed);
  }
  std::vector<LayerResidence> layers;
  for (std::size_t n = 0; n < count_; ++n) {
    std::vector<double>& times = passed[n];
    std::sort(times.begin(), times.end());  // the map has no order: its sum would have none
    double sum = 0;
    for (const double t : times) sum += t;
    const bool any = !times.empty();
    layers.push_back({.low = low_ + static_cast<double>(n) * step_,
                      .high = low_ + static_cast<double>(n + 1) * step_,
                      .particles = held[n],
                      .share_out = held[n] > 0 ? static_cast<double>(times.size()) / held[n] : no_value,
                      .first = any ? times.front() : no_value,
                      .mean = any ? sum / static_cast<double>(times.size()) : no_value,
                      .last = any ? times.back() : no_value});
  }
  return layers;
}

}  // namespace talus
