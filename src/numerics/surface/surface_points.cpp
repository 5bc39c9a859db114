// SPDX-License-Identifier: Apache-2.0
#include "numerics/surface/surface.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <tuple>

#include "numerics/cell_grid.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus {

namespace {

constexpr double small = 1.0 / 3;  // of a square
constexpr double near = 1.5;       // how far a rest looks for a square, in sides of it

/// A flat piece of the surface: triangles of a smooth part in one plane that hang together.
struct Facet {
  std::span<const std::uint32_t> triangles;
  Vector3 along, across;  // unit vectors in its plane
};

struct Sum {
  double area = 0;
  Vector3 place, normal;  // times the area

  /// \param n to either side: the sum has it on one
  void add(double a, const Vector3& x, const Vector3& n) { join({a, a * x, a * n}); }
  void join(const Sum& other) {
    area += other.area;
    place += other.place;
    if (dot(normal, other.normal) < 0)
      normal -= other.normal;
    else
      normal += other.normal;
  }
};

/// Squares along the longest edge at the border of the facet: a rectangle is cut without rests. Of edges of one length
/// the one whose ends come first.
struct Longest {
  double length = 0;
  std::array<double, 6> ends{};

  void offer(const Vector3& a, const Vector3& b) {
    const std::array<double, 6> forward{a.x, a.y, a.z, b.x, b.y, b.z}, backward{b.x, b.y, b.z, a.x, a.y, a.z};
    const std::array<double, 6>& e = std::min(forward, backward);
    const double size = norm(Vector3{e[3] - e[0], e[4] - e[1], e[5] - e[2]});
    if (size > length || (size == length && size > 0 && e < ends)) length = size, ends = e;
  }
  Vector3 direction() const { return (1 / length) * Vector3{ends[3] - ends[0], ends[4] - ends[1], ends[5] - ends[2]}; }
};

struct Facets {
  std::vector<std::uint32_t> triangles;  // by facet
  std::vector<Facet> all;
};

/// \param sector whose triangles are taken, null: all
Facets facets_of(const Surface& surface, const Sector* sector) {
  const std::span<const Triangle> triangles = surface.triangles();
  std::vector<bool> left_out(triangles.size());
  std::vector<std::uint32_t> first(surface.facets() + 1, 0);
  for (std::uint32_t t = 0; t < triangles.size(); ++t) {
    left_out[t] = sector && sector->copy_at(triangles[t].middle()) != 0;
    if (!left_out[t]) ++first[surface.facet(t) + 1];
  }
  for (std::size_t f = 1; f < first.size(); ++f) first[f] += first[f - 1];
  Facets result;
  result.triangles.resize(first.back());
  std::vector<std::uint32_t> next(first.begin(), first.end() - 1);
  for (std::uint32_t t = 0; t < triangles.size(); ++t)
    if (!left_out[t]) result.triangles[next[surface.facet(t)]++] = t;
  std::vector<Longest> longest(surface.facets());
  const TriangleEdges edges(triangles, left_out);
  edges.for_each([&](std::span<const TriangleEdges::Edge> same) {
    for (const TriangleEdges::Edge& e : same) {
      const std::uint32_t facet = surface.facet(e.triangle);
      const auto is_of_facet = [&](const TriangleEdges::Edge& other) { return surface.facet(other.triangle) == facet; };
      if (std::count_if(same.begin(), same.end(), is_of_facet) > 1) continue;  // not at its border
      const auto& corner = triangles[e.triangle].corner;
      longest[facet].offer(corner[e.side], corner[(e.side + 1) % 3]);
    }
  });
  for (std::size_t f = 0; f < surface.facets(); ++f) {
    Facet facet{std::span(result.triangles).subspan(first[f], first[f + 1] - first[f]), {}, {}};
    if (facet.triangles.empty()) continue;
    if (longest[f].length > 0) {
      facet.along = longest[f].direction();
    } else {  // no border: cannot be flat
      const Triangle& t = triangles[facet.triangles.front()];
      facet.along = t.corner[1] - t.corner[0];
      facet.along = (1 / norm(facet.along)) * facet.along;
    }
    facet.across = cross(surface.normal(facet.triangles.front()), facet.along);
    result.all.push_back(facet);
  }
  return result;
}

/// Of a triangle that is cut four times there are at most 13 corners, each cut adding half of them where rounding goes
/// against it, and no memory needs to be asked for.
struct Polygon {
  std::array<std::array<double, 2>, 16> corner;
  std::size_t count = 0;

  void add(const std::array<double, 2>& x) { corner[count++] = x; }
};

/// What of a convex polygon lies above (side 1) or below (-1) a coordinate of one of its axes.
Polygon clipped(const Polygon& polygon, std::size_t axis, double bound, int side) {
  Polygon rest;
  for (std::size_t n = 0; n < polygon.count; ++n) {
    const auto &p = polygon.corner[n], &q = polygon.corner[n + 1 < polygon.count ? n + 1 : 0];
    const double a = side * (p[axis] - bound), b = side * (q[axis] - bound);
    if (a >= 0) rest.add(p);
    if ((a >= 0) != (b >= 0)) {
      const double t = a / (a - b);
      rest.add({p[0] + t * (q[0] - p[0]), p[1] + t * (q[1] - p[1])});
    }
  }
  return rest;
}

/// Area and middle of a convex polygon.
std::pair<double, std::array<double, 2>> area_of(const Polygon& polygon) {
  double area = 0;
  std::array<double, 2> middle{};
  for (std::size_t n = 2; n < polygon.count; ++n) {
    const auto &p = polygon.corner[0], &q = polygon.corner[n - 1], &r = polygon.corner[n];
    const double part = 0.5 * std::abs((q[0] - p[0]) * (r[1] - p[1]) - (r[0] - p[0]) * (q[1] - p[1]));
    area += part;
    for (std::size_t axis = 0; axis < 2; ++axis) middle[axis] += part * (p[axis] + q[axis] + r[axis]) / 3;
  }
  if (area > 0) middle = {middle[0] / area, middle[1] / area};
  return {area, middle};
}

/// The squares of a facet, each with what lies in it: in rows, or by what is in them alone where they are very many.
class Squares {
 public:
  Squares(std::int64_t rows, std::int64_t columns)
      : columns_(columns), all_(rows * columns <= most ? static_cast<std::size_t>(rows * columns) : 0) {}

  Sum& at(std::int64_t row, std::int64_t column) {
    return all_.empty() ? some_[{row, column}] : all_[static_cast<std::size_t>(row * columns_ + column)];
  }
  void append_to(std::vector<Sum>& squares) const {
    for (const auto& [place, sum] : some_) squares.push_back(sum);
    for (const Sum& sum : all_)
      if (sum.area > 0) squares.push_back(sum);
  }

 private:
  static constexpr std::int64_t most = 65536;
  std::int64_t columns_;
  std::vector<Sum> all_;
  std::map<std::pair<std::int64_t, std::int64_t>, Sum> some_;
};

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
    for (const Vector3& c : surface.triangles()[t].corner) {
      const std::array<double, 2> x = flat(c);
      for (std::size_t axis = 0; axis < 2; ++axis)
        low[axis] = std::min(low[axis], x[axis]), high[axis] = std::max(high[axis], x[axis]);
    }
  for (std::size_t axis = 0; axis < 2; ++axis) {
    count[axis] = std::max(1, static_cast<int>(std::ceil((high[axis] - low[axis]) / distance - 1e-9)));
    side[axis] = (high[axis] - low[axis]) / count[axis];
  }
  Squares cells(count[1], count[0]);
  for (const std::uint32_t t : facet.triangles) {
    Polygon triangle;
    for (const Vector3& c : surface.triangles()[t].corner) triangle.add(flat(c));
    const auto range = [&](const Polygon& polygon, std::size_t axis) {
      double least = infinity, most = -infinity;
      for (std::size_t n = 0; n < polygon.count; ++n)
        least = std::min(least, polygon.corner[n][axis]), most = std::max(most, polygon.corner[n][axis]);
      const auto cell = [&](double x) {
        return std::clamp(static_cast<int>(std::floor((x - low[axis]) / side[axis])), 0, count[axis] - 1);
      };
      return std::pair(cell(least), cell(most));
    };
    const auto [first_row, last_row] = range(triangle, 1);
    for (int row = first_row; row <= last_row; ++row) {
      const Polygon strip =
          clipped(clipped(triangle, 1, low[1] + row * side[1], 1), 1, low[1] + (row + 1) * side[1], -1);
      if (strip.count < 3) continue;
      const auto [first, last] = range(strip, 0);
      for (int column = first; column <= last; ++column) {
        const Polygon piece =
            clipped(clipped(strip, 0, low[0] + column * side[0], 1), 0, low[0] + (column + 1) * side[0], -1);
        const auto [area, middle] = area_of(piece);
        if (area > 0)
          cells.at(row, column)
              .add(area, origin + middle[0] * facet.along + middle[1] * facet.across,
                   surface.normal(facet.triangles.front()));
      }
    }
  }
  cells.append_to(squares);
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
  const Facets facets = facets_of(surface, sector);
  for (const Facet& facet : facets.all) {
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
    for (end = begin + 1; end < rests.size() && rests[end].part == all.part && rests[end].cell == all.cell; ++end)
      all.sum.join(rests[end].sum);
    if (all.sum.area >= least || points.empty())
      points.push_back(point_of(all.sum, all.patch, all.part));
    else
      left.push_back(all);
  }
  // What is still small joins the nearest point.
  if (left.empty()) return points;
  std::vector<Vector3> positions;
  for (const SurfacePoint& point : points) positions.push_back(point.place);
  const CellGrid grid(positions, near * distance);
  for (const Rest& rest : left) {
    const Vector3 x = (1 / rest.sum.area) * rest.sum.place;
    std::size_t best = positions.size();
    double closest = near * distance;
    grid.for_each_candidate(x, [&](std::uint32_t n) {
      const double d = norm(positions[n] - x);
      if (points[n].part == rest.part && (d < closest || (d == closest && n < best))) closest = d, best = n;
    });
    if (best == positions.size()) {
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

std::vector<SurfacePoint> spread_points(const Surface& surface, double distance, const std::optional<Sector>& sector) {
  std::vector<SurfacePoint> points = spread(surface, distance, sector ? &*sector : nullptr);
  if (!sector) return points;
  const std::size_t own = points.size();
  for (int k = 1; k < sector->copies(); ++k)
    for (std::size_t n = 0; n < own; ++n) {
      SurfacePoint copy = points[n];
      copy.place = sector->turned(copy.place, k);
      copy.normal = sector->turn(k) * copy.normal;
      points.push_back(copy);
    }
  return points;
}

}  // namespace talus
