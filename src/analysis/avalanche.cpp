// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/fronts.hpp"

namespace talus {

namespace {

template <class T, class Make>
const T& made_once(std::optional<T>& value, Make&& make) {
  if (!value) value.emplace(make());
  return *value;
}

}  // namespace

AvalancheSnapshot::AvalancheSnapshot(const AvalancheScales& of, AvalancheView seen, Snapshot grains)
    : scales(of), view(seen), now(std::move(grains)) {
  if (view != AvalancheView::from_the_side) return;
  projected_.assign(now.positions().begin(), now.positions().end());
  for (Vector3& x : projected_) x.y = 0;
}

std::span<const Vector3> AvalancheSnapshot::position() const {
  return view == AvalancheView::from_the_side ? std::span<const Vector3>(projected_) : now.positions();
}

const std::vector<GrainSet>& AvalancheSnapshot::heads() const {
  return made_once(heads_, [&] { return find_heads(position(), scales.mean_radius); });
}

const std::optional<HeadSize>& AvalancheSnapshot::head_size() const {
  return made_once(head_size_, [&] {
    return heads().empty() ? std::optional<HeadSize>{}
                           : talus::head_size(position(), now.scalars("radius"), heads()[0], scales.mean_radius);
  });
}

const FallingCloud& AvalancheSnapshot::fall() const {
  return made_once(
      fall_, [&] { return measure_falling_cloud(now.positions(), now.vectors("velocity"), gravity, initial_radius); });
}

AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales) {
  AvalancheRun run{.scales = scales, .end = end / scales.time()};
  const double window = front_speed_window * scales.time();
  run.front_speed = front_speed_curve(front, window, front.time.empty() ? end : std::min(end, front.time.back()));
  for (double& t : run.front_speed.time) t /= scales.time();
  for (double& v : run.front_speed.value) v /= scales.stokes_speed;
  return run;
}

}  // namespace talus
