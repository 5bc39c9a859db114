// SPDX-License-Identifier: Apache-2.0
/// The vessel of a case: walls of any shape in space, each a patch of one surface of triangles.
#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "models/continuum/setup/choices.hpp"
#include "numerics/surface/surface.hpp"
#include "numerics/surface/surface_faults.hpp"
#include "numerics/surface/triangle.hpp"

namespace talus::continuum {

struct Parameters;

enum class VesselShape { cylinder, cone, disc, box, pyramid, plate, stl };
/// The direction of an axis.
enum class Along { z, x, y };
enum class FileUnit { m, cm, mm, inch };

/// Corners of a box around something, m.
struct VesselBounds {
  Vector3 low, high;
};

/// How the triangles of a file are turned: the axis of the file that points upwards is made z, then angles about x, y
/// and z one after the other, axes that stay where they are.
struct Turn {
  Along up = Along::z;
  std::array<double, 3> angles{};
  bool operator==(const Turn&) const = default;
};

/// The triangles of a file, mended, and what was found in it.
class DrawnSurface {
 public:
  explicit DrawnSurface(std::vector<Triangle> of_file);

  std::span<const Triangle> triangles() const { return mended_.triangles; }
  const MendedSurface& mended() const { return mended_; }
  std::span<const SurfaceFault> faults() const { return faults_; }  ///< of the file as it is, rims among them
  std::span<const Rim> rims() const { return rims_; }               ///< of the mended triangles
  std::size_t size_of_file() const { return size_of_file_; }
  /// Around the triangles once they are turned, in the unit of the file. Remembered: it is asked for at every row.
  VesselBounds bounds(const Turn& turn) const;

 private:
  std::size_t size_of_file_;
  std::vector<SurfaceFault> faults_;
  MendedSurface mended_;
  std::vector<Rim> rims_;
  mutable std::mutex mutex_;
  mutable std::optional<Turn> turn_;  // of the bounds
  mutable VesselBounds bounds_;
};

/// One of [[vessel]]. SI.
struct VesselPart {
  std::string name;
  VesselShape shape = VesselShape::cylinder;
  Along along = Along::z;
  std::vector<double> centre;  ///< of the axis, across it in the order of x, y, z; empty: the middle of the box
  double bottom = 0, top = 0, height = 0;
  double radius = 0, hole = 0, lower_radius = 0, upper_radius = 0;
  double width = 0, depth = 0, lower_width = 0, lower_depth = 0, upper_width = 0, upper_depth = 0;
  std::array<double, 3> corner{}, first_edge{}, second_edge{};
  std::string file;
  FileUnit unit = FileUnit::mm;
  Along up = Along::z;
  double scale = 1;
  std::array<double, 3> rotate{}, move{};
  bool closed = false;
  std::optional<WallMaterial> material;
  std::optional<double> friction, adhesion;
  double spin = 0;   ///< rad/s
  double slide = 0;  ///< m/s
  std::optional<std::array<double, 3>> belt;
  bool gate = false;
  double opens_after = 0;
  std::optional<double> closes_after, repeats_every;

  /// What the file holds, as it stands there, without the unit. Not a key: who reads the case fills it in.
  std::shared_ptr<const DrawnSurface> drawn = nullptr;
};

/// The key of the nth of [[vessel]], from 0.
std::string vessel_key(std::size_t n, std::string_view name);

template <class Visit, class P>
void for_each_parameter_of_vessel(Visit&& visit, P& parts) {
  for (std::size_t n = 0; n < parts.size(); ++n) {
    auto& v = parts[n];
    using enum VesselShape;
    const auto key = [n](std::string_view name) { return vessel_key(n, name); };
    visit(Parameter{key("name"), {}, {}, "name of the wall, in the columns of its load; left out: its shape"}, v.name);
    visit(Parameter{key("shape"),
                    {},
                    {},
                    "wall in space without thickness, a patch of the vessel: an upright cylinder, a cone (or a frustum "
                    "of one), a horizontal disc (with a hole in its middle), the four upright walls of a box, the four "
                    "walls of a pyramid (or a frustum), a plate (a parallelogram at any angle), or the triangles of an "
                    "STL file",
                    true},
          v.shape);
    const auto of = [&](std::initializer_list<VesselShape> shapes, std::string_view names) {
      bool holds = false;
      for (const VesselShape shape : shapes) holds = holds || shape == v.shape;
      return Condition{key("shape"), "is " + value_text(v.shape), "= " + std::string(names), holds};
    };
    auto round = only_if(
        of({cylinder, cone, disc, box, pyramid}, "\"cylinder\", \"cone\", \"disc\", \"box\" or \"pyramid\""), visit);
    auto upright = only_if(of({cylinder, cone, box, pyramid}, "\"cylinder\", \"cone\", \"box\" or \"pyramid\""), visit);
    auto circular = only_if(of({cylinder, disc}, "\"cylinder\" or \"disc\""), visit);
    auto conical = only_if(of({cone}, "\"cone\""), visit);
    auto flat = only_if(of({disc}, "\"disc\""), visit);
    auto square = only_if(of({box}, "\"box\""), visit);
    auto tapered = only_if(of({pyramid}, "\"pyramid\""), visit);
    auto oblique = only_if(of({plate}, "\"plate\""), visit);
    auto drawn = only_if(of({stl}, "\"stl\""), visit);
    auto prismatic = only_if(of({cylinder, box}, "\"cylinder\" or \"box\""), visit);
    auto revolved = only_if(of({cylinder, cone, disc}, "\"cylinder\", \"cone\" or \"disc\""), visit);
    revolved(Parameter{key("along"),
                       {},
                       {},
                       "direction of its axis: with x or y `bottom`, `top` and `height` are places along it"},
             v.along);
    round(Parameter{key("centre"),
                    dimension::length,
                    {},
                    "x and y of its axis, or of one along x y and z, of one along y x and z; left out: the middle of "
                    "the box"},
          v.centre);
    upright(Parameter{key("bottom"), dimension::length, {}, "height of its lower end", true}, v.bottom);
    upright(Parameter{key("top"), dimension::length, {}, "height of its upper end", true}, v.top);
    flat(Parameter{key("height"), dimension::length, {}, "height of the disc", true}, v.height);
    circular(Parameter{key("radius"), dimension::length, above(0), "radius", true}, v.radius);
    flat(Parameter{key("hole"), dimension::length, at_least(0), "radius of the hole in the disc; 0: none"}, v.hole);
    conical(Parameter{key("lower_radius"), dimension::length, at_least(0), "radius at the lower end", true},
            v.lower_radius);
    conical(Parameter{key("upper_radius"), dimension::length, at_least(0), "radius at the upper end", true},
            v.upper_radius);
    square(Parameter{key("width"), dimension::length, above(0), "extent along x", true}, v.width);
    square(Parameter{key("depth"), dimension::length, above(0), "extent along y", true}, v.depth);
    tapered(Parameter{key("lower_width"), dimension::length, at_least(0), "extent along x at the lower end", true},
            v.lower_width);
    tapered(Parameter{key("lower_depth"), dimension::length, at_least(0), "extent along y at the lower end", true},
            v.lower_depth);
    tapered(Parameter{key("upper_width"), dimension::length, at_least(0), "extent along x at the upper end", true},
            v.upper_width);
    tapered(Parameter{key("upper_depth"), dimension::length, at_least(0), "extent along y at the upper end", true},
            v.upper_depth);
    oblique(Parameter{key("corner"), dimension::length, {}, "a corner of the plate", true}, v.corner);
    oblique(Parameter{key("first_edge"), dimension::length, {}, "from there to the next corner", true}, v.first_edge);
    oblique(Parameter{key("second_edge"), dimension::length, {}, "and to the one on its other side", true},
            v.second_edge);
    drawn(Parameter{key("file"),
                    {},
                    {},
                    "STL file, ASCII or binary; a path without / in front starts at the case's "
                    "folder",
                    true},
          v.file);
    drawn(Parameter{key("unit"), {}, {}, "unit of the numbers in the file, which an STL file does not say", true},
          v.unit);
    drawn(Parameter{key("up"),
                    {},
                    {},
                    "axis of the file that points upwards: with y its (x, y, z) become (x, -z, y), with x (-z, y, x)"},
          v.up);
    drawn(Parameter{key("scale"), dimension::none, above(0), "factor of all places of the file, about its origin"},
          v.scale);
    drawn(Parameter{key("rotate"),
                    dimension::angle,
                    {},
                    "angles by which it is turned about the x, y and z axes of the box through the file's origin, one "
                    "after the other, each right-handed (roll, pitch, yaw); after `up`"},
          v.rotate);
    drawn(Parameter{key("move"),
                    dimension::length,
                    {},
                    "by how much it is moved at last: where the file's origin comes to lie in the box"},
          v.move);
    drawn(
        Parameter{
            key("closed"), {}, {}, "whether the surface of the file is to have no rim, as that of a body has none"},
        v.closed);
    visit(Parameter{key("material"),
                    {},
                    {},
                    "what this wall is made of: its friction follows with grains.material, where its `friction` is not "
                    "given; left out: as the other walls"},
          v.material);
    visit(Parameter{key("friction"), dimension::none, friction_coefficient(),
                    "coefficient of friction of this wall; left out: walls.coefficient"},
          v.friction);
    visit(
        Parameter{key("adhesion"), dimension::pressure, at_least(0),
                  "shear stress that this wall bears besides, of grains that stick together; left out: walls.adhesion"},
        v.adhesion);
    revolved(
        Parameter{key("spin"),
                  {0, 0, -1, 1},
                  {},
                  "angular velocity about its own axis, right-handed, from the opening of the gate of the case on: "
                  "it takes grains along by its friction"},
        v.spin);
    prismatic(
        Parameter{key("slide"),
                  dimension::velocity,
                  {},
                  "velocity of its surface along its own axis, from its bottom to its top positive, from the "
                  "opening of the gate of the case on, as of a tube that is drawn up; the wall stays where it is"},
        v.slide);
    oblique(Parameter{key("belt"),
                      dimension::velocity,
                      {},
                      "velocity of its surface along itself, from the opening of the gate of the case on, as of a "
                      "conveyor's belt; the plate stays where it is"},
            v.belt);
    visit(Parameter{key("gate"), {}, {}, "whether it is taken away when the gate of the case opens"}, v.gate);
    auto gated = only_if(where(key("gate"), v.gate, true), visit);
    gated(Parameter{key("opens_after"), dimension::time, at_least(0), "so long after the gate of the case opens"},
          v.opens_after);
    gated(Parameter{key("closes_after"), dimension::time, at_least(0),
                    "so long after the gate of the case opens it is there again; left out: it stays away"},
          v.closes_after);
    gated(Parameter{key("repeats_every"), dimension::time, above(0),
                    "after which it opens and closes again, as long as the run lasts; left out: it does so once"},
          v.repeats_every);
  }
}

/// Contradictions between keys of the vessel that are each valid by themselves, and faults of its files.
std::vector<Problem> check_vessel(const Parameters& parameters);

/// Walls that are not where the box is, or of another size by orders of magnitude, with what would bring them there
/// (vessel_extent.cpp). \pre check_vessel() finds nothing
std::vector<Problem> check_extents(const Parameters& parameters);

/// The share of a part's area that lies within the box, 0 to 1.
double share_in_box(const Parameters& parameters, std::size_t part);
/// "tray spans -30..30 x -30..30 x -10..-10 mm, the box 0..80 x 0..80 x 0..80 mm"
std::string extents_text(const Parameters& parameters, std::size_t part);

/// What was mended in the files of the vessel, a sentence each.
std::vector<std::string> remarks_of_vessel(const Parameters& parameters);

/// Of a part: that of its key, or its shape and number.
std::string name_of(const Parameters& parameters, std::size_t part);

/// A place of a round part from one of a part whose axis is z.
Vector3 placed(const VesselPart& part, const Vector3& place);
/// A place on the axis of a round part, m.
Vector3 on_axis(const Parameters& parameters, const VesselPart& part);

/// Whether the surface of a wall moves.
bool is_moving(const VesselPart& part);

/// The triangles of one part, whose patch is its number. Round parts are polygons whose sides are nowhere farther from
/// the circle than a fiftieth of bed.spacing, and whose area of cross-section is the circle's.
std::vector<Triangle> triangles_of(const Parameters& parameters, std::size_t part);

/// Whether the vessel has a file that cannot be read: nothing follows of where its walls are.
bool has_unread_file(const Parameters& parameters);

/// The box around a part, m, and around the vessel, without making its surface.
VesselBounds bounds_of(const Parameters& parameters, std::size_t part);
VesselBounds bounds_of_vessel(const Parameters& parameters);

/// m
double metres(FileUnit unit);
Turn turn_of(const VesselPart& part);
/// The triangles of the file of a part, turned, scaled and moved into the box, m.
std::vector<Triangle> placed_triangles(const VesselPart& part);
VesselBounds placed_bounds(const VesselPart& part);
/// Rims of its surface, with the numbers of the triangles there.
std::vector<Rim> placed_rims(const VesselPart& part);

/// What cannot be mended in the file of the nth of [[vessel]], by triangle and place.
void check_file(const VesselPart& part, std::size_t n, std::vector<Problem>& problems);

}  // namespace talus::continuum

namespace talus {
template <>
inline constexpr auto choices<continuum::VesselShape> =
    std::to_array<std::string_view>({"cylinder", "cone", "disc", "box", "pyramid", "plate", "stl"});
template <>
inline constexpr auto choices<continuum::Along> = std::to_array<std::string_view>({"z", "x", "y"});
template <>
inline constexpr auto choices<continuum::FileUnit> = std::to_array<std::string_view>({"m", "cm", "mm", "in"});
}  // namespace talus
