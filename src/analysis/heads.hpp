// SPDX-License-Identifier: Apache-2.0
/// Heads of an avalanche: dense groups of grains at its front, found from the number of grains around each grain
/// (Niiya, Awazu & Nishimori 2020, section 4.1), and their size (Figure 8c). What the paper leaves
/// open is a choice.
#pragma once

#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "analysis/links.hpp"
#include "base/vector.hpp"

namespace talus {

/// Numbers of neighbours, Eq. 11.
struct NeighbourNumbers {
  std::vector<std::uint32_t> direct;    ///< n_i: grains closer than the reach, Eq. 11a
  std::vector<std::uint32_t> indirect;  ///< n'_i: sum of n_j over them, Eq. 11b
};

NeighbourNumbers neighbour_numbers(const Links& links);

/// The heads, the one with the most grains first (of equal ones the one farther down), each by index.
///
/// Parts are the connected sets of all grains, two being connected if closer than 4 a (Eq. 11). Of each part whose
/// largest n' is above a quarter of the largest of all (section 4.1; choice: a few grains left behind are no part), the
/// grains above a quarter of its own largest n' ("the maximum value calculated for each aggregated part"), and the
/// links between them, make sets; sets of at least five grains are heads (choice: below five a group has no shape).
/// \param position centres, m; \param mean_radius a of the case, > 0, m
std::vector<GrainSet> find_heads(std::span<const Vector3> position, double mean_radius);

/// Size of a head in the plane x, y; lengths in m, from outer edge to outer edge of the grains (choice). Thickness
/// and inner edge are nan if no grain lies in the central half, which a head of a few grains may do.
struct HeadSize {
  double width = 0;      ///< w_h: across, y
  double thickness = 0;  ///< l_h: foremost edge less inner edge
  double centre = 0;     ///< y in the middle between the two outermost edges
  double foremost = 0;   ///< x of the foremost edge
  /// x of the most advanced point of the rear boundary in the central half. Choice: the paper's Figure 8c shows "the
  /// forefront of the inner position".
  double inner = 0;

  double aspect_ratio() const { return width / thickness; }
  bool in_central_half(const Vector3& x) const { return 4 * std::abs(x.y - centre) <= width; }
};

/// The rear boundary at a grain is the rearmost edge among the head's grains whose y differs by at most 2 a from its
/// own (choice). \param head grains, at least one
HeadSize head_size(std::span<const Vector3> position, std::span<const double> radius, const GrainSet& head,
                   double mean_radius);

}  // namespace talus
