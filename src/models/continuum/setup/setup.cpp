// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/setup.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "models/continuum/setup/time_scale.hpp"
#include "numerics/sph/cubic_spline.hpp"

namespace talus::continuum {

Setup::Setup(Layout layout)
    : Layout(std::move(layout)),
      density(given.bed.packing * given.grains.density),
      material(given),
      sound_speed(material.sound_speed(density)),
      smoothing_length(given.sph.smoothing_ratio * sph::smoothing_length(lattice.mass, density)),
      scales(time_scales_of(given)),
      loading(given.settle.filling, loading_time(given, depth, scales, sound_speed), bottom, depth) {}

double Setup::viscosity_at_outlet(double alpha) const {
  const double width = outlet_width.value_or(std::numeric_limits<double>::quiet_NaN());
  return alpha * sound_speed * smoothing_length / (width * std::sqrt(given.gravity.acceleration * width));
}

double Setup::default_viscosity() const {
  constexpr double usual = 0.1, least = 0.01;  // with less a bed does not come to rest
  const double viscosity = viscosity_at_outlet(usual);
  return viscosity > max_viscosity ? std::max(least, usual * max_viscosity / viscosity) : usual;
}

}  // namespace talus::continuum
