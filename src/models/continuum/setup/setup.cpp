// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/setup/setup.hpp"

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

}  // namespace talus::continuum
