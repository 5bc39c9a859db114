// SPDX-License-Identifier: Apache-2.0
/// The particles in the figures of Niiya, Awazu & Nishimori 2020: one member's snapshots, which stay in memory until
/// the pictures that look at them are drawn.
#pragma once

#include <deque>
#include <span>
#include <vector>

#include "analysis/heads.hpp"
#include "app/cloud/avalanche_ensembles.hpp"
#include "io/figure/particle_picture.hpp"
#include "numerics/snapshot.hpp"

namespace talus::app {

class MemberSnapshots {
 public:
  /// The first member of an ensemble that has a run.
  explicit MemberSnapshots(const AvalancheEnsemble& ensemble);

  /// All grains at the snapshot nearest to t, in a/v_s; plain. The title tells the time. \throws FileError
  figure::ParticlePicture at(double t, const figure::View& view);

  /// Figure 3: the shapes at the start with their sizes R, W and D in radii, measured between the outermost centres.
  figure::ParticlePicture circle_at_start();
  figure::ParticlePicture rectangle_at_start();
  figure::ParticlePicture triangle_at_start();

  /// Figures 4 and 6: the grains of heads blue.
  figure::ParticlePicture with_heads(double t, const figure::View& view);
  /// The same from above, so far about the front that all frames of a series show grains at one scale.
  figure::ParticlePicture front_with_heads(double t);
  /// Figure 5b: the largest head, with the velocities relative to the front.
  figure::ParticlePicture motion_in_head(double t);
  /// Figure 7a: coloured by the speed along the slope relative to the front's, in v_s, about the front.
  figure::ParticlePicture relative_speed(double t);
  /// Figure 8: the front of the avalanche with its heads by n or n'; by n' also the width and thickness of the largest,
  /// and the four grains between which they are measured.
  figure::ParticlePicture head_by(HeadRule::Measure measure, double t);
  /// Figure 11a: the front with the grains of its surface and the line through them.
  figure::ParticlePicture frontal_surface(double t);

 private:
  struct Loaded {
    PointSet points;
    double time = 0, front_speed = 0;  // a/v_s, v_s
    std::vector<std::int64_t> category = {};
    std::vector<double> value = {};
    std::vector<Vector3> arrow = {};
  };
  Loaded& load(double t);
  figure::ParticlePicture plain(const Loaded& loaded, const figure::View& view) const;
  void mark(Loaded& loaded, const std::vector<GrainSet>& heads, figure::ParticlePicture& picture) const;
  /// What lies about the foremost grain; lengths in radii.
  figure::Window about_front(std::span<const Vector3> position, double behind, double ahead, double below,
                             double above) const;

  const AvalancheEnsemble& ensemble_;
  double radius_;              // a, m
  std::deque<Loaded> loaded_;  // their addresses stay
};

}  // namespace talus::app
