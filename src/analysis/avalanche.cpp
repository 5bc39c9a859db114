// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <algorithm>
#include <stdexcept>

#include "analysis/fronts.hpp"

namespace talus {

namespace {

constexpr double reach_of_gradient = 4;  // mean radii, as of the neighbours of Eq. 11

template <class T, class Make>
const T& made_once(std::optional<T>& value, Make&& make) {
  if (!value) value.emplace(make());
  return *value;
}

}  // namespace

AvalancheSnapshot::AvalancheSnapshot(const AvalancheScales& of, AvalancheView seen, Snapshot grains, double speed)
    : scales(of), view(seen), now(std::move(grains)), front_speed(speed) {
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

const HeadMotion& AvalancheSnapshot::head_motion() const {
  return made_once(head_motion_, [&] {
    constexpr double none = AvalancheRun::none;
    if (!head_size()) return HeadMotion{none, none, none, none};
    const Links links(position(), reach_of_gradient * scales.mean_radius);
    return talus::head_motion(position(), now.vectors("velocity"), links, heads()[0], *head_size(), front_speed);
  });
}

const ThicknessProfile& AvalancheSnapshot::profile() const {
  return made_once(profile_, [&] { return thickness_profile(position(), now.scalars("radius"), scales.mean_radius); });
}

const HeadTailMotion& AvalancheSnapshot::head_tail_motion() const {
  return made_once(head_tail_motion_, [&] {
    return talus::head_tail_motion(position(), now.vectors("velocity"), profile(), front_speed);
  });
}

const FallingCloud& AvalancheSnapshot::fall() const {
  return made_once(fall_, [&] {
    Vector3 centre;
    for (const Vector3& x : start) centre += (1.0 / static_cast<double>(start.size())) * x;
    double radius = 0;
    for (const Vector3& x : start) radius = std::max(radius, norm(x - centre));
    return measure_falling_cloud(now.positions(), now.vectors("velocity"), gravity, radius);
  });
}

double front_speed_at(const Curve& front, double time, const AvalancheScales& scales) {
  const double window = front_speed_window * scales.time(), rounding = 1e-9 * window;
  if (front.time.empty() || time - window < front.time.front() - rounding || time > front.time.back() + rounding)
    return AvalancheRun::none;
  return talus::front_speed(front, time, window);
}

AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales, std::size_t grains) {
  AvalancheRun run{.scales = scales, .grains = static_cast<double>(grains), .end = end / scales.time()};
  const double window = front_speed_window * scales.time();
  run.front_speed = front_speed_curve(front, window, front.time.empty() ? end : std::min(end, front.time.back()));
  for (double& t : run.front_speed.time) t /= scales.time();
  for (double& v : run.front_speed.value) v /= scales.stokes_speed;
  run.front_speed_last = front_speed_at(front, end, scales) / scales.stokes_speed;
  return run;
}

AvalancheRun mean_run(std::span<const AvalancheRun> members) {
  if (members.empty()) throw std::invalid_argument("a mean needs members");
  const double share = 1.0 / static_cast<double>(members.size());
  AvalancheRun mean = members[0];
  mean.head_widths.clear();
  mean.front_speed_last = mean.overlap_max = 0;
  std::vector<Curve> speeds;
  std::vector<double> time(members[0].snapshots.time().size());
  for (const AvalancheRun& member : members) {
    if (member.snapshots.time().size() != time.size())
      throw std::invalid_argument("members differ in their number of data");
    speeds.push_back(member.front_speed);
    mean.front_speed_last += share * member.front_speed_last;
    mean.overlap_max += share * member.overlap_max;
    for (std::size_t n = 0; n < time.size(); ++n) time[n] += share * member.snapshots.time()[n];
  }
  mean.front_speed = spread(common_part(std::move(speeds))).mean;
  std::vector<AvalancheRun::Numbers> numbers;
  for (const AvalancheRun& member : members) numbers.push_back(member.snapshots);
  mean.snapshots = {std::move(time), [=](std::size_t n, AvalancheRun::Numbers::Number number, const Place& place) {
                      double sum = 0;
                      for (const auto& member : numbers) sum += share * member.value(n, number, place);
                      return sum;
                    }};
  return mean;
}

}  // namespace talus
