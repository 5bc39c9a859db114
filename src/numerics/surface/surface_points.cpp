// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface_points.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "numerics/cell_grid.hpp"

namespace talus {

namespace {

constexpr double small = 1.0 / 3;  // of a square
constexpr double near = 1.5;       // how far a rest looks for a square, in sides of it

/// A flat piece of the surface: triangles of a smooth part in one plane that hang together.
struct Facet {
  std::vector<std::uint32_t> triangles;
  Vector3 along, across;  // unit vectors in its plane
};

struct Sum {
  double area = 0;
  Vector3 place, normal;  // times the area

  void add(double a, const Vector3& x, const Vector3& n) {
    area += a;
    place += a * x;
    normal += a * n;
  }
};

/// Squares along the longest edge at the border of the facet: a rectangle is cut without rests.
/// \param sector whose triangles are taken, null: all
std::vector<Facet> facets_of(const Surface& surface, const Sector* sector) {
  std::vector<Facet> facets(surface.facets());
  for (std::uint32_t t = 0; t < surface.triangles().size(); ++t)
    if (!sector || sector->copy_at(surface.triangles()[t].middle()) == 0)
      facets[surface.facet(t)].triangles.push_back(t);
  std::erase_if(facets, [](const Facet& facet) { return facet.triangles.empty(); });
  for (Facet& facet : facets) {
    std::map<std::array<double, 6>, int> edges;
    for (const std::uint32_t t : facet.triangles)
      for (std::size_t c = 0; c < 3; ++c) {
        const Vector3 &a = surface.triangles()[t].corner[c], &b = surface.triangles()[t].corner[(c + 1) % 3];
        const std::array<double, 6> forward{a.x, a.y, a.z, b.x, b.y, b.z}, backward{b.x, b.y, b.z, a.x, a.y, a.z};
        ++edges[std::min(forward, backward)];
      }
    double longest = 0;
    for (const auto& [e, times] : edges) {
      const Vector3 d{e[3] - e[0], e[4] - e[1], e[5] - e[2]};
      if (times == 1 && norm(d) > longest) longest = norm(d), facet.along = (1 / longest) * d;
    }
    const Vector3& n = surface.normal(facet.triangles.front());
    if (!(longest > 0)) {  // no border: cannot be flat
      const Triangle& t = surface.triangles()[facet.triangles.front()];
      facet.along = t.corner[1] - t.corner[0];
      facet.along = (1 / norm(facet.along)) * facet.along;
    }
    facet.across = cross(n, facet.along);
  }
  return facets;
}

using Polygon = std::vector<std::array<double, 2>>;

/// What of a convex polygon lies above (side 1) or below (-1) a coordinate of one of its axes.
Polygon clipped(const Polygon& polygon, std::size_t axis, double bound, int side) {
  Polygon rest;
  for (std::size_t n = 0; n < polygon.size(); ++n) {
    const auto &p = polygon[n], &q = polygon[(n + 1) % polygon.size()];
    const double a = side * (p[axis] - bound), b = side * (q[axis] - bound);
    if (a >= 0) rest.push_back(p);
    if ((a >= 0) != (b >= 0)) {
      const double t = a / (a - b);
      rest.push_back({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return rest;
}

/// Area and middle of a convex polygon.
std::pair<double, std::array<double, 2>> area_of(const Polygon& polygon) {
  double area = 0;
  std::array<double, 2> middle{};
  for (std::size_t n = 2; n < polygon.size(); ++n) {
    const auto &p = polygon[0], &q = polygon[n - 1], &r = polygon[n];
    const double part = 0.5 * std::abs((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]));
    area += part;
    for (std::size_t axis = 0; axis < 2; ++axis) middle[axis] += part * (p[axis] + q[axis] + r[axis]) / 3;
  }
  if (area > 0) middle = {middle[0] / area, middle[1] / area};
  return {area, middle};
}

/// What of a facet lies in each square.
void cut(const Surface& surface, const Facet& facet, double distance, std::vector<Sum>& squares) {
  const Vector3 origin = surface.triangles()[facet.triangles.front()].corner[0];
  const auto flat = [&](const Vector3& x) {
    return std::array<double, 2>{dot(x - origin, facet.along), dot(x - origin, facet.across)};
  };
  constexpr double infinity = std::numeric_limits<double>::infinity();
  std::array<double, 2> low{infinity, infinity}, high{-infinity, -infinity}, side{};
  std::array<int, 2> count{};
  for (const std::uint32_t t : facet.triangles)
    for (const Vector3& c : surface.triangles()[t].corner)
      for (std::size_t axis = 0; axis < 2; ++axis) {
        low[axis] = std::min(low[axis], flat(c)[axis]);
        high[axis] = std::max(high[axis], flat(c)[axis]);
      }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    count[axis] = std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / distance - 1e-9)));
    side[axis] = (high[axis] - low[axis]) / count[axis];
  }
  std::map<std::pair<int, int>, Sum> cells;
  for (const std::uint32_t t : facet.triangles) {
    Polygon triangle;
    for (const Vector3& c : surface.triangles()[t].corner) triangle.push_back(flat(c));
    const auto range = [&](const Polygon& polygon, std::size_t axis) {
      double least = infinity, most = -infinity;
      for (const auto& p : polygon) least = std::min(least, p[axis]), most = std::max(most, p[axis]);
      const auto cell = [&](double x) {
        return std::clamp(static_cast<int>(std::floor((x - low[axis]) / side[axis])), 0, count[axis] - 1);
      };
      return std::pair(cell(least), cell(most));
    };
    const auto [first_row, last_row] = range(triangle, 1);
    for (int row = first_row; row <= last_row; ++row) {
      const Polygon strip =
          clipped(clipped(triangle, 1, low[1] + row * side[1], 1), 1, low[1] + (row + 1) * side[1], -1);
      if (strip.size() < 3) continue;
      const auto [first, last] = range(strip, 0);
      for (int column = first; column <= last; ++column) {
        const Polygon piece =
            clipped(clipped(strip, 0, low[0] + column * side[0], 1), 0, low[0] + (column + 1) * side[0], -1);
        const auto [area, middle] = area_of(piece);
        if (area > 0)
          cells[{row, column}].add(area, origin + middle[0] * facet.along + middle[1] * facet.across,
                                   surface.normal(facet.triangles.front()));
      }
    }
  }
  for (const auto& [cell, sum] : cells) squares.push_back(sum);
}

SurfacePoint point_of(const Sum& sum, std::uint32_t patch, std::uint32_t part) {
  return {(1 / sum.area) * sum.place, (1 / norm(sum.normal)) * sum.normal, sum.area, patch, part};
}

std::vector<SurfacePoint> spread(const Surface& surface, double distance, const Sector* sector) {
  struct Rest {
    std::uint32_t part, patch;
    std::array<std::int64_t, 3> cell;
    Sum sum;
  };
  const double least = small * distance * distance;
  std::vector<SurfacePoint> points;
  std::vector<Rest> rests;
  const auto take = [&](const Sum& sum, std::uint32_t patch, std::uint32_t part) {
    if (sum.area >= least) return points.push_back(point_of(sum, patch, part));
    const Vector3 x = (1 / distance) * ((1 / sum.area) * sum.place - surface.low());
    const auto whole = [](double c) { return static_cast<std::int64_t>(std::floor(c)); };
    rests.push_back({part, patch, {whole(x.x), whole(x.y), whole(x.z)}, sum});
  };
  std::vector<Sum> squares;
  for (const Facet& facet : facets_of(surface, sector)) {
    squares.clear();
    cut(surface, facet, distance, squares);
    const std::uint32_t t = facet.triangles.front();
    for (const Sum& sum : squares) take(sum, surface.triangles()[t].patch, surface.part(t));
  }
  // Rests of a cell together.
  std::stable_sort(rests.begin(), rests.end(),
                   [](const Rest& a, const Rest& b) { return std::tie(a.part, a.cell) < std::tie(b.part, b.cell); });
  std::vector<Rest> left;
  for (std::size_t begin = 0, end = 0; begin < rests.size(); begin = end) {
    Rest all = rests[begin];
    for (end = begin + 1; end < rests.size() && rests[end].part == all.part && rests[end].cell == all.cell; ++end) {
      all.sum.area += rests[end].sum.area;
      all.sum.place += rests[end].sum.place;
      all.sum.normal += rests[end].sum.normal;
    }
    if (all.sum.area >= least || points.empty())
      points.push_back(point_of(all.sum, all.patch, all.part));
    else
      left.push_back(all);
  }
  // What is still small joins the nearest point.
  if (left.empty()) return points;
  std::vector<Vector3> places;
  for (const SurfacePoint& point : points) places.push_back(point.place);
  const CellGrid grid(places, near * distance);
  for (const Rest& rest : left) {
    const Vector3 x = (1 / rest.sum.area) * rest.sum.place;
    std::size_t best = places.size();
    double closest = near * distance;
    grid.for_each_candidate(x, [&](std::uint32_t n) {
      const double d = norm(places[n] - x);
      if (points[n].part == rest.part && (d < closest || (d == closest && n < best))) closest = d, best = n;
    });
    if (best == places.size()) {
      points.push_back(point_of(rest.sum, rest.patch, rest.part));
      continue;
    }
    SurfacePoint& point = points[best];
    Sum sum = rest.sum;
    sum.add(point.area, point.place, point.normal);
    point = point_of(sum, point.patch, point.part);
  }
  return points;
}

}  // namespace

std::vector<SurfacePoint> spread_points(const Surface& surface, double distance) {
  return spread(surface, distance, nullptr);
}

std::vector<SurfacePoint> spread_points(const Surface& surface, double distance, const Sector& sector) {
  std::vector<SurfacePoint> points = spread(surface, distance, &sector);
  const std::size_t own = points.size();
  for (int k = 1; k < sector.copies(); ++k)
    for (std::size_t n = 0; n < own; ++n) {
      SurfacePoint copy = points[n];
      copy.place = sector.turned(copy.place, k);
      copy.normal = sector.turn(k) * copy.normal;
      points.push_back(copy);
    }
  return points;
}

}  // namespace talus
