// SPDX-License-Identifier: Apache-2.0
#include "analysis/avalanche.hpp"

#include <algorithm>
#include <numbers>
#include <stdexcept>

#include "analysis/displacement.hpp"
#include "analysis/frontal_angle.hpp"
#include "analysis/fronts.hpp"
#include "analysis/head_tail.hpp"
#include "analysis/heads.hpp"
#include "analysis/vortices.hpp"

namespace talus {

namespace {

constexpr double reach_of_gradient = 4;  // mean radii, as of the neighbours of Eq. 11

/// m/s; none unless the front was there during the window that ends at t.
double speed_at(const Curve& front, double t, double window) {
  const double rounding = 1e-9 * window;
  if (front.time.empty() || t - window < front.time.front() - rounding || t > front.time.back() + rounding)
    return AvalancheFrame::none;
  return front_speed(front, t, window);
}

void look_from_above(AvalancheFrame& frame, const GrainsInMotion& grains, double front_speed,
                     const AvalancheScales& scales) {
  const double a = scales.mean_radius, v_s = scales.stokes_speed;
  const std::vector<GrainSet> heads = find_heads(grains.position, a);
  frame.head_count = static_cast<double>(heads.size());
  frame.head_particles = heads.empty() ? 0 : static_cast<double>(heads[0].size());
  for (const GrainSet& head : heads)
    frame.head_widths.push_back(head_size(grains.position, grains.radius, head, a).width);
  if (heads.empty()) return;
  const HeadSize size = head_size(grains.position, grains.radius, heads[0], a);
  frame.head_width = size.width;
  frame.head_thickness = size.thickness;
  frame.head_concavity = size.concavity;
  const Links links(grains.position, reach_of_gradient * a);
  const HeadMotion motion = head_motion(grains.position, grains.velocity, links, heads[0], size, front_speed);
  frame.head_curl_left = motion.curl_left * a / v_s;
  frame.head_curl_right = motion.curl_right * a / v_s;
  frame.head_rear_relative_velocity = motion.rear_relative_velocity / v_s;
  frame.head_front_outward_velocity = motion.front_outward_velocity / v_s;
}

void look_from_the_side(AvalancheFrame& frame, const GrainsInMotion& grains, double front_speed,
                        const AvalancheScales& scales) {
  const ThicknessProfile profile = thickness_profile(grains.position, grains.radius, scales.mean_radius);
  frame.front_rear_thickness_ratio = profile.head_thickness() / profile.rear_thickness();
  const HeadTailMotion motion = head_tail_motion(grains.position, grains.velocity, profile, front_speed);
  frame.head_upper_relative_velocity = motion.upper_head / scales.stokes_speed;
  frame.head_lower_relative_velocity = motion.lower_head / scales.stokes_speed;
  frame.tail_relative_velocity = motion.tail / scales.stokes_speed;
  if (const auto angle = angle_of_line(grains.position, surface_walk(grains.position, scales.mean_radius)))
    frame.frontal_angle = *angle * 180 / std::numbers::pi;
}

}  // namespace

AvalancheFrame avalanche_frame(const GrainsInMotion& grains, const Curve& front, const AvalancheScales& scales,
                               AvalancheView view) {
  AvalancheFrame frame{.time = grains.time / scales.time()};
  const double window = front_speed_window * scales.time();
  const double speed = speed_at(front, grains.time, window);
  frame.front_speed = speed / scales.stokes_speed;
  if (view == AvalancheView::from_above)
    look_from_above(frame, grains, speed, scales);
  else
    look_from_the_side(frame, grains, speed, scales);
  return frame;
}

std::span<const AvalancheFrame> AvalancheRun::data() const {
  if (frames.size() < 2) throw std::invalid_argument("the run has no data after its start");
  return std::span(frames).subspan(1);
}

Curve AvalancheRun::curve(double AvalancheFrame::*number, std::size_t first) const {
  Curve result;
  for (std::size_t n = first; n < frames.size(); ++n) {
    result.time.push_back(frames[n].time);
    result.value.push_back(frames[n].*number);
  }
  return result;
}

AvalancheRun avalanche_run(const Curve& front, double end, const AvalancheScales& scales, std::size_t grains) {
  AvalancheRun run{.scales = scales, .grains = static_cast<double>(grains)};
  const double window = front_speed_window * scales.time();
  run.front_speed = front_speed_curve(front, window, front.time.empty() ? end : std::min(end, front.time.back()));
  for (double& t : run.front_speed.time) t /= scales.time();
  for (double& v : run.front_speed.value) v /= scales.stokes_speed;
  run.front_speed_end = speed_at(front, end, window) / scales.stokes_speed;
  return run;
}

void set_displacements(AvalancheRun& run, std::span<const Vector3> before, std::span<const Vector3> after) {
  const DisplacementSpread spread = displacement_spread(before, after);
  run.displacement_spread = spread.along / spread.mean;
  run.displacement_lateral = spread.lateral / run.scales.mean_radius;
}

AvalancheRun mean_run(std::span<const AvalancheRun> members) {
  if (members.empty()) throw std::invalid_argument("a mean needs members");
  const double share = 1.0 / static_cast<double>(members.size());
  std::vector<Curve> speeds;
  AvalancheRun mean{.scales = members[0].scales, .grains = members[0].grains};
  mean.displacement_spread = mean.displacement_lateral = mean.overlap_max = 0;
  mean.frames.resize(members[0].frames.size());
  for (AvalancheFrame& frame : mean.frames)
    for (const auto& entry : avalanche_frame_numbers) frame.*entry.number = 0;
  for (const AvalancheRun& member : members) {
    if (member.frames.size() != mean.frames.size())
      throw std::invalid_argument("members differ in their number of data");
    speeds.push_back(member.front_speed);
    mean.front_speed_end += share * member.front_speed_end;
    mean.displacement_spread += share * member.displacement_spread;
    mean.displacement_lateral += share * member.displacement_lateral;
    mean.overlap_max += share * member.overlap_max;
    for (std::size_t n = 0; n < mean.frames.size(); ++n)
      for (const auto& entry : avalanche_frame_numbers)
        mean.frames[n].*entry.number += share * member.frames[n].*entry.number;
  }
  mean.front_speed = spread(common_part(std::move(speeds))).mean;
  return mean;
}

}  // namespace talus
