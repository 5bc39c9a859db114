// SPDX-License-Identifier: Apache-2.0
/// A tree of boxes over triangles, which finds those near a position, along a line or near each other. The time grows
/// with the logarithm of their number, whatever their sizes are. Triangles are halved at the median of their middles
/// along the longest extent of these, down to leaves of a few. Source: Ericson, Real-Time Collision Detection (Morgan
/// Kaufmann, 2005), 6.2.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "base/vector.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus {

// Slabs: where triangles of a surface lie that are nearly in one plane. Who looks at a finely triangulated surface
// from some distance looks at a few of these.

inline double square_distance_from_box(const Vector3& low, const Vector3& high, const Vector3& x) {
  double sum = 0;
  for (int axis = 0; axis < 3; ++axis) {
    const double below = low[axis] - x[axis], above = x[axis] - high[axis];
    const double out = below > 0 ? below : above > 0 ? above : 0;
    sum += out * out;
  }
  return sum;
}

/// Some triangles lie in the box and where |normal x - offset| <= slack.
struct Slab {
  Vector3 low, high;             ///< corners of the box, m
  Vector3 normal;                ///< unit
  double offset = 0, slack = 0;  ///< m
  std::uint32_t patch = 0;

  double height(const Vector3& x) const { return dot(normal, x) - offset; }
  /// No triangle is nearer to x, m.
  double distance(const Vector3& x) const {
    return std::max(std::abs(height(x)) - slack, std::sqrt(square_distance_from_box(low, high, x)));
  }
};

/// Writes the slabs within reach of x, their normals towards it: who is higher than the slack of each, and no farther
/// than the reach, is not hidden from x by what lies in them. \returns whether x is itself higher than each
bool find_half_spaces(const Vector3& x, double reach, std::span<const Slab> slabs, std::vector<Slab>& half_spaces);

class TriangleTree {
 public:
  TriangleTree() = default;
  /// \param triangles finite
  explicit TriangleTree(std::span<const Triangle> triangles);

  /// Calls visit(number) for triangles among which are all within a distance of x. The nearer of two boxes comes first,
  /// and visit may lower the distance: what is farther than that is left out from then on.
  template <class Visit>
  void near_place(const Vector3& x, double& within, Visit&& visit) const {
    if (nodes_.empty()) return;
    struct Entry {
      std::uint32_t node;
      double square;
    };
    std::array<Entry, max_levels> stack;
    std::size_t size = 0;
    stack[size++] = {0, square_distance(nodes_[0], x)};
    while (size > 0) {
      const auto [n, square] = stack[--size];
      // Boxes around what is at an angle to the axes are thick; slabs are not.
      if (square * (1 - rounding) > within * within || is_farther(flatness_[n], x, within + margin_)) continue;
      const Node& node = nodes_[n];
      if (node.second == 0) {
        for (std::uint32_t t = node.begin; t < node.end; ++t) visit(order_[t]);
        continue;
      }
      Entry nearer{n + 1, square_distance(nodes_[n + 1], x)};
      Entry farther{node.second, square_distance(nodes_[node.second], x)};
      if (farther.square < nearer.square) std::swap(nearer, farther);
      stack[size++] = farther;
      stack[size++] = nearer;
    }
  }

  /// Calls visit(number) for triangles among which are all that the straight line from a to b meets. What lies in a
  /// slab on one side of which the whole line is is left out.
  template <class Visit>
  void along_line(const Vector3& a, const Vector3& b, Visit&& visit) const {
    if (nodes_.empty()) return;
    const Line line(a, b, margin_);
    std::array<std::uint32_t, max_levels> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t n = stack[--size];
      const Node& node = nodes_[n];
      if (!line.meets(node.low, node.high) || is_beside(flatness_[n], a, b, line.margin)) continue;
      if (node.second == 0) {
        for (std::uint32_t t = node.begin; t < node.end; ++t) visit(order_[t]);
      } else {
        stack[size++] = node.second;
        stack[size++] = n + 1;
      }
    }
  }

  /// Calls of_some(slab) and of_one(number) for triangles among which are all that reach into a box: of_some for those
  /// of one patch that lie together in a slab which is thin and no wider than that, of_one for the others. They return
  /// whether to go on.
  template <class Some, class One>
  void slabs_within(const Vector3& low, const Vector3& high, double thin, double wide, Some&& of_some,
                    One&& of_one) const {
    if (nodes_.empty()) return;
    std::array<std::uint32_t, max_levels> stack;
    std::size_t size = 0;
    stack[size++] = 0;
    while (size > 0) {
      const std::uint32_t n = stack[--size];
      const Node& node = nodes_[n];
      if (!overlap(node.low, node.high, low, high)) continue;
      const Flatness& flatness = flatness_[n];
      if (flatness.slack <= thin && norm(node.high - node.low) <= wide) {
        if (!of_some(Slab{node.low, node.high, flatness.normal, flatness.offset, flatness.slack, flatness.patch}))
          return;
      } else if (node.second == 0) {
        for (std::uint32_t t = node.begin; t < node.end; ++t)
          if (!of_one(order_[t])) return;
      } else {
        stack[size++] = node.second;
        stack[size++] = n + 1;
      }
    }
  }

  /// Calls visit(a, b) once for pairs of triangles among which are all whose boxes overlap.
  template <class Visit>
  void for_each_near_pair(Visit&& visit) const {
    if (!nodes_.empty()) pairs_within(0, visit);
  }

 private:
  static constexpr std::size_t leaf = 4, max_levels = 64;
  static constexpr double rounding = 1e-12;

  /// Triangles order_[begin] to order_[end - 1]. The first child follows its parent.
  struct Node {
    Vector3 low, high;
    std::uint32_t begin, end;
    std::uint32_t second;  // child; 0: a leaf
  };
  struct Middle {
    Vector3 place;
    std::uint32_t triangle;
  };
  /// The slab of a node's triangles; infinitely thick if they are not of one patch.
  struct Flatness {
    Vector3 normal;
    double offset, slack;
    std::uint32_t patch;
  };
  /// A line from its middle, and a box's separation from it along the axes and across both.
  struct Line {
    Vector3 middle, half, size;
    double margin;

    Line(const Vector3& a, const Vector3& b, double least)
        : middle(0.5 * (a + b)), half(0.5 * (b - a)), size{std::abs(half.x), std::abs(half.y), std::abs(half.z)} {
      margin = least + 1e-9 * (size.x + size.y + size.z);
      size += Vector3{margin, margin, margin};
    }
    bool meets(const Vector3& low, const Vector3& high) const {
      const Vector3 m = middle - 0.5 * (low + high), e = 0.5 * (high - low) + Vector3{margin, margin, margin};
      if (std::abs(m.x) > e.x + size.x || std::abs(m.y) > e.y + size.y || std::abs(m.z) > e.z + size.z) return false;
      return std::abs(m.y * half.z - m.z * half.y) <= e.y * size.z + e.z * size.y &&
             std::abs(m.z * half.x - m.x * half.z) <= e.z * size.x + e.x * size.z &&
             std::abs(m.x * half.y - m.y * half.x) <= e.x * size.y + e.y * size.x;
    }
  };

  static bool is_farther(const Flatness& slab, const Vector3& x, double distance) {
    return std::abs(dot(slab.normal, x) - slab.offset) - slab.slack > distance;
  }
  static bool is_beside(const Flatness& slab, const Vector3& a, const Vector3& b, double margin) {
    const double at_a = dot(slab.normal, a) - slab.offset, at_b = dot(slab.normal, b) - slab.offset;
    const double beyond = slab.slack + margin;
    return (at_a > beyond && at_b > beyond) || (at_a < -beyond && at_b < -beyond);
  }
  static double square_distance(const Node& node, const Vector3& x) {
    return square_distance_from_box(node.low, node.high, x);
  }
  static bool overlap(const Vector3& low, const Vector3& high, const Vector3& other_low, const Vector3& other_high) {
    return low.x <= other_high.x && other_low.x <= high.x && low.y <= other_high.y && other_low.y <= high.y &&
           low.z <= other_high.z && other_low.z <= high.z;
  }
  static bool overlap(const Node& a, const Node& b) { return overlap(a.low, a.high, b.low, b.high); }
  std::uint32_t add(std::span<Middle> middles, std::uint32_t begin, std::uint32_t end);
  void find_boxes(std::span<const Triangle> in_order);
  void find_flatness(std::span<const Triangle> in_order);
  template <class Visit>
  void pairs_within(std::uint32_t n, Visit& visit) const {
    const Node& node = nodes_[n];
    if (node.second != 0) {
      pairs_within(n + 1, visit);
      pairs_within(node.second, visit);
      return pairs_between(n + 1, node.second, visit);
    }
    for (std::uint32_t a = node.begin; a < node.end; ++a)
      for (std::uint32_t b = node.begin; b < a; ++b) visit(order_[b], order_[a]);
  }
  template <class Visit>
  void pairs_between(std::uint32_t n, std::uint32_t m, Visit& visit) const {
    const Node &a = nodes_[n], &b = nodes_[m];
    if (!overlap(a, b)) return;
    if (a.second == 0 && b.second == 0) {
      for (std::uint32_t s = a.begin; s < a.end; ++s)
        for (std::uint32_t t = b.begin; t < b.end; ++t) visit(order_[s], order_[t]);
    } else if (b.second == 0 || (a.second != 0 && a.end - a.begin >= b.end - b.begin)) {
      pairs_between(n + 1, m, visit);
      pairs_between(a.second, m, visit);
    } else {
      pairs_between(n, m + 1, visit);
      pairs_between(n, b.second, visit);
    }
  }

  std::vector<Node> nodes_;
  std::vector<Flatness> flatness_;    // of the nodes
  std::vector<std::uint32_t> order_;  // triangles by leaf
  double margin_ = 0;                 // m
};

}  // namespace talus
