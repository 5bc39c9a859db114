// SPDX-License-Identifier: Apache-2.0
/// Grains that come and go: [[inlet]], [removal].
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/error.hpp"
#include "base/parameter.hpp"
#include "base/vector.hpp"

namespace talus::continuum {

struct Layout;
struct Parameters;

enum class InletShape { rectangle, disc };
enum class InletClock { start, gate };

/// One of [[inlet]]: a level window through which grains come down. SI.
struct Inlet {
  InletShape shape = InletShape::rectangle;
  std::array<double, 3> centre{};
  double width = 0, depth = 0, radius = 0;
  std::array<double, 3> velocity{};
  double rate = 0;  ///< kg/s
  InletClock clock = InletClock::start;
  double from = 0;
  std::optional<double> to;

  double end() const { return to.value_or(std::numeric_limits<double>::infinity()); }
  double speed() const { return std::hypot(velocity[0], velocity[1], velocity[2]); }
};

struct Removal {
  std::optional<double> below;
  bool outside = false;

  bool is_any() const { return below || outside; }
};

/// Whether grains are still to come in by the clock of the run. \param time s
inline bool is_being_filled(const std::vector<Inlet>& inlets, double time) {
  return std::any_of(inlets.begin(), inlets.end(),
                     [&](const Inlet& inlet) { return inlet.clock == InletClock::start && time < inlet.end(); });
}
/// Whether they come in now.
inline bool is_pouring(const std::vector<Inlet>& inlets, double time) {
  return std::any_of(inlets.begin(), inlets.end(), [&](const Inlet& inlet) {
    return inlet.clock == InletClock::start && inlet.from <= time && time < inlet.end();
  });
}

/// Those that begin after a run of such an end, s, has ended. A bed that settles first may take longer.
std::vector<std::size_t> inlets_after(const Parameters& parameters, double end);

/// Those most of whose grains meet no wall on their free fall down to where the vessel ends, above an open floor.
std::vector<std::size_t> inlets_past_vessel(const Layout& layout);

/// What the faces of the box leave of a window that reaches over them.
struct CutWindow {
  double width = 0, depth = 0;  ///< m
  bool by_wall = false;         ///< not by planes of symmetry alone
};
/// Nothing where they leave all of it.
std::optional<CutWindow> cut_window(const Layout& layout, const Inlet& inlet);

/// The key of the nth of [[inlet]], from 0.
std::string inlet_key(std::size_t n, std::string_view name);

template <class Visit, class I, class R>
void for_each_parameter_of_inlets(Visit&& visit, I& inlets, R& removal) {
  for (std::size_t n = 0; n < inlets.size(); ++n) {
    auto& inlet = inlets[n];
    const auto key = [n](std::string_view name) { return inlet_key(n, name); };
    visit(Parameter{key("shape"), {}, {}, "level window through which grains come in: a rectangle or a disc"},
          inlet.shape);
    auto square = only_if(where(key("shape"), inlet.shape, InletShape::rectangle), visit);
    auto round = only_if(where(key("shape"), inlet.shape, InletShape::disc), visit);
    visit(Parameter{key("centre"), dimension::length, {}, "its middle", true}, inlet.centre);
    square(Parameter{key("width"), dimension::length, above(0), "extent along x", true}, inlet.width);
    square(Parameter{key("depth"), dimension::length, above(0), "extent along y", true}, inlet.depth);
    round(Parameter{key("radius"), dimension::length, above(0), "radius", true}, inlet.radius);
    visit(Parameter{key("velocity"), dimension::velocity, {}, "of the grains that come in; downwards", true},
          inlet.velocity);
    visit(Parameter{key("rate"),
                    {0, 1, -1, 0},
                    above(0),
                    "mass that comes in a second, layer by layer. A layer for which grains leave no room waits until "
                    "they do",
                    true},
          inlet.rate);
    visit(
        Parameter{
            key("clock"), {}, {}, "whether its times count from the start of the run or from the opening of the gate"},
        inlet.clock);
    visit(Parameter{key("from"), dimension::time, at_least(0), "when grains begin to come in"}, inlet.from);
    visit(Parameter{key("to"), dimension::time, above(0), "when they end; left out: never"}, inlet.to);
  }
  visit(Parameter{"removal.below",
                  dimension::length,
                  {},
                  "height below which particles are taken away and counted, as by a conveyor; left out: none"},
        removal.below);
  visit(Parameter{"removal.outside",
                  {},
                  {},
                  "whether particles two spacings beyond an open face of the box are taken away and counted"},
        removal.outside);
}

/// Contradictions between these keys that are each valid by themselves.
std::vector<Problem> check_inlets(const Layout& layout);

/// What comes in together.
struct InletLayer {
  std::vector<Vector3> places;  ///< m
  std::vector<double> density;  ///< bulk, of each, as the kernel sees it within the stream, kg/m^3
  double interval = 0;          ///< between layers, s
};
/// Places on a lattice of bed.spacing in what closed faces of the box leave of the window, apart from these, and no
/// nearer to a wall than the contact distance.
InletLayer layer_of(const Layout& layout, const Inlet& inlet);

}  // namespace talus::continuum

namespace talus {
template <>
inline constexpr auto choices<continuum::InletShape> = std::to_array<std::string_view>({"rectangle", "disc"});
template <>
inline constexpr auto choices<continuum::InletClock> = std::to_array<std::string_view>({"start", "gate"});
}  // namespace talus
