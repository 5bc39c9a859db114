// SPDX-License-Identifier: Apache-2.0
#include "models/cloud/parameters.hpp"

#include <fmt/format.h>

#include <cmath>
#include <iterator>
#include <numbers>

#include "models/cloud/spectral_sum.hpp"
#include "numerics/runge_kutta.hpp"
#include "physics/hydrodynamics/stokes.hpp"

namespace talus::cloud {

namespace {

using std::numbers::pi;

double component_in_plane(const Vector3& v, Motion motion) {
  switch (motion) {
    case Motion::xy:
      return std::hypot(v.x, v.y);
    case Motion::xz:
      return std::hypot(v.x, v.z);
    case Motion::xyz:
      return norm(v);
  }
  return 0;
}

/// Area of a plane shape, or volume; 0 where a length is missing or the shape is a file's.
double extent_of_shape(const Parameters& parameters) {
  const Parameters::Particles& p = parameters.particles;
  const double size = p.size.value_or(0);
  switch (p.shape) {
    case Shape::circle:
      return pi * size * size;
    case Shape::rectangle:
      return p.length.value_or(0) * p.width.value_or(0);
    case Shape::triangle:
      return size * size;
    case Shape::wedge:
      return size * size / std::sin(2 * parameters.slope.angle);
    case Shape::ball:
      return 4.0 / 3.0 * pi * size * size * size;
    case Shape::dome:
      return 2.0 / 3.0 * pi * size * size * size;
    case Shape::file:
      return 0;
  }
  return 0;
}

bool is_plane(Shape shape) {
  return shape == Shape::circle || shape == Shape::rectangle || shape == Shape::triangle || shape == Shape::wedge;
}

/// Mean square or cube of the radii over the same power of the mean radius; the cut of the normal distribution is
/// neglected.
double moment(const Parameters::Particles& p, int power) {
  const double variance = p.radius_distribution == RadiusDistribution::uniform ? p.radius_spread * p.radius_spread / 3
                                                                               : p.radius_spread * p.radius_spread;
  return power == 2 ? 1 + variance : 1 + 3 * variance;
}

// Random sequential addition of equal discs jams at 0.547, of spheres at 0.384 (Feder 1980; Cooper 1988).
constexpr double jamming_plane = 0.54;
constexpr double jamming_space = 0.37;

constexpr double max_radii = 5e5;  // that a shape may extend: positions are sorted into cells of a grain's size

}  // namespace

std::vector<Problem> check(const Parameters& p) {
  std::vector<Problem> problems;
  auto add = [&](std::string key, std::string what, std::string allowed) {
    problems.push_back({.key = std::move(key), .what = std::move(what), .allowed = std::move(allowed)});
  };
  const Parameters::Particles& grains = p.particles;
  const std::string shape(choice_name(grains.shape));

  if (grains.shape == Shape::file) {
    if (grains.file.empty()) add("particles.file", "missing: particles.shape is \"file\"", "a CSV file's name");
  } else if (!grains.file.empty()) {
    add("particles.file", "given, but particles.shape is \"" + shape + "\"", "particles.shape = \"file\"");
  }
  if (grains.shape == Shape::rectangle) {
    if (!grains.length) add("particles.length", "missing: a rectangle needs it", "a length above 0");
    if (!grains.width) add("particles.width", "missing: a rectangle needs it", "a length above 0");
    if (grains.size) add("particles.size", "has no meaning for a rectangle", "particles.length and particles.width");
  } else {
    if (grains.shape != Shape::file && !grains.size)
      add("particles.size", "missing: the shape \"" + shape + "\" needs it", "a length above 0");
    if (grains.shape == Shape::file && grains.size) add("particles.size", "has no meaning for a file", "nothing");
    if (grains.length) add("particles.length", "has no meaning for the shape \"" + shape + "\"", "nothing");
    if (grains.width) add("particles.width", "has no meaning for the shape \"" + shape + "\"", "nothing");
  }
  if (is_plane(grains.shape) && p.motion == Motion::xyz)
    add("motion", "\"xyz\" with the plane shape \"" + shape + "\"", "\"xy\" or \"xz\"; or shape ball, dome or file");
  if (!is_plane(grains.shape) && grains.shape != Shape::file && p.motion != Motion::xyz)
    add("motion", "a plane with the shape \"" + shape + "\"", "\"xyz\"; or a plane shape");
  if ((grains.shape == Shape::triangle || grains.shape == Shape::wedge) && p.motion == Motion::xy)
    add("motion", "\"xy\": a " + shape + " stands on the slope", "\"xz\"");
  if (grains.shape == Shape::wedge && !(p.slope.enabled && p.slope.angle > 0 && p.slope.angle < 0.5 * pi))
    add("slope.angle", "a level surface behind a gate needs an incline (slope.enabled)", "above 0 deg, below 90 deg");
  if (grains.shape == Shape::dome && !p.slope.enabled)
    add("slope.enabled", "false, but a dome stands on the slope", "true, or shape \"ball\"");

  const auto check_extent = [&](const char* key, const std::optional<double>& length) {
    if (length && grains.radius > 0 && !(*length <= max_radii * grains.radius))
      add(key, fmt::format("{:.4g} m is {:.3g} times particles.radius", *length, *length / grains.radius),
          fmt::format("at most {:.0e} times", max_radii));
  };
  check_extent("particles.size", grains.size);
  check_extent("particles.length", grains.length);
  check_extent("particles.width", grains.width);
  if (const double extent = extent_of_shape(p); extent > 0 && std::isfinite(extent)) {
    const double fraction = scales(p).volume_fraction;
    const double jamming = is_plane(grains.shape) ? jamming_plane : jamming_space;
    if (fraction > jamming)
      add("particles.count",
          fmt::format("the grains would fill {:.3g} of the shape (particles.shape, particles.size, particles.length, "
                      "particles.width, particles.radius)",
                      fraction),
          fmt::format("at most {}: random packing without overlap jams", jamming));
  }
  if (p.fluid.sum == Sum::spectral && p.fluid.mobility != hydrodynamics::Mobility::none) {
    if (!spectral_accuracy(p.fluid.sum_error))
      add("fluid.sum_error", fmt::format("{:g} is less than the spectral sum reaches", p.fluid.sum_error),
          fmt::format("at least {:g}; or fluid.sum = \"direct\"", std::rbegin(spectral_accuracies)->error));
  }
  if (grains.density == p.fluid.density)
    add("particles.density", "equals fluid.density: nothing would move", "any other density");
  if (p.gravity.direction) {
    const auto& d = *p.gravity.direction;
    if (!(std::hypot(d[0], d[1], d[2]) > 0)) add("gravity.direction", "has no length", "three numbers, not all 0");
  }
  if (!(p.gravity.acceleration > 0))
    add("gravity.acceleration", "is 0: nothing would move", "above 0");
  else if (problems.empty() && !(scales(p).driving > 1e-12))
    add(p.slope.enabled && !p.gravity.direction ? "slope.angle" : "gravity.direction",
        "gravity has no part along the motion: nothing would flow", "a direction with a part in the plane of motion");
  return problems;
}

Scales scales(const Parameters& p) {
  const double a = p.particles.radius;
  Scales s{};
  if (p.gravity.direction) {
    const auto& d = *p.gravity.direction;
    const Vector3 v{d[0], d[1], d[2]};
    s.gravity = (1 / norm(v)) * v;
  } else {
    s.gravity = hydrodynamics::downhill(p.slope.angle);
  }
  s.driving = p.slope.enabled ? std::hypot(s.gravity.x, s.gravity.y) : component_in_plane(s.gravity, p.motion);
  s.mean_weight = hydrodynamics::buoyant_weight(a, p.particles.density, p.fluid.density, p.gravity.acceleration);
  s.stokes_speed = std::abs(s.mean_weight) * s.driving / (6 * pi * p.fluid.viscosity * a);
  s.stokes_time = a / s.stokes_speed;
  s.contact_ratio = p.contact.stiffness * 0.01 * a / std::abs(s.mean_weight);
  if (const double extent = extent_of_shape(p); extent > 0) {
    const double n = static_cast<double>(p.particles.count);
    s.volume_fraction = is_plane(p.particles.shape) ? n * pi * a * a * moment(p.particles, 2) / extent
                                                    : n * 4.0 / 3.0 * pi * a * a * a * moment(p.particles, 3) / extent;
  }
  return s;
}

std::vector<RegimeLine> regime_of_case(const Parameters& p) {
  const Scales s = scales(p);
  const double a = p.particles.radius;
  const double stokes = s.stokes_speed * p.fluid.density * a / p.fluid.viscosity;
  // Time in which a free grain reaches its Stokes speed over the time in which it passes its own radius.
  const double inertia = 2.0 / 9.0 * p.particles.density * a * a / p.fluid.viscosity / s.stokes_time;
  std::vector<RegimeLine> lines = {
      {"Reynolds number of a single grain", fmt::format("{:.3g}", stokes),
       "a v_s rho_f/mu; the Stokes drag and the tensor hold for less than about 0.1", stokes > 0.1},
      {"inertia of a grain", fmt::format("{:.3g}", inertia),
       "relaxation time over a_p/v_s; the model leaves inertia out, which holds for less than about 0.1",
       inertia > 0.1}};
  if (p.particles.density < p.fluid.density)
    lines.push_back({"grain density over the fluid's", fmt::format("{:.3g}", p.particles.density / p.fluid.density),
                     "below 1 grains rise: speeds are negative, and the front, the largest x, is their tail", true});
  if (p.contact.enabled)
    lines.push_back({"contact over weight (gamma, Eq. 9)", fmt::format("{:.3g}", s.contact_ratio),
                     "repulsion at an overlap of 0.01 a_p over the weight; above 1 grains stay apart",
                     s.contact_ratio < 1});
  return lines;
}

double contact_rate(const Parameters& p) {
  if (!p.contact.enabled) return 0;
  const double lattice = p.fluid.mobility == hydrodynamics::Mobility::none ? 6.0 : 1.5;
  return lattice * p.contact.stiffness * hydrodynamics::stokes_mobility(p.particles.radius, p.fluid.viscosity);
}

double max_stable_step(const Parameters& p, double rate) {
  if (p.integration.method == Method::dormand_prince) return dormand_prince::stability / rate;
  constexpr int max_stages = 250;
  return chebyshev_stages(p.integration.method == Method::euler ? 1 : max_stages, stage_damping).stability / rate;
}

}  // namespace talus::cloud
