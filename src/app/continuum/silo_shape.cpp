// SPDX-License-Identifier: Apache-2.0
#include "app/continuum/silo_shape.hpp"

namespace talus::app {

using continuum::VesselPart;
using continuum::VesselShape;

double friction_of(const continuum::Layout& layout, const VesselPart& v) {
  const auto part = static_cast<std::size_t>(&v - layout.given.vessel.data());
  return layout.boundary->patches()[layout.boundary->patch_of_part(part)].friction;
}

double bulk_density(const continuum::Parameters& p) {
  return p.bed.packing * p.grains.density;
}

double tangent_of(const VesselPart& cone) {
  return (cone.upper_radius - cone.lower_radius) / (cone.top - cone.bottom);
}

bool is_hopper(const VesselPart& v) {
  return v.shape == VesselShape::cone && v.along == continuum::Along::z && v.upper_radius > v.lower_radius;
}

double hydraulic_radius(const VesselPart& v) {
  if (v.along != continuum::Along::z) return 0;
  if (v.shape == VesselShape::cylinder) return 0.5 * v.radius;
  if (v.shape == VesselShape::box) return 0.5 * v.width * v.depth / (v.width + v.depth);
  return 0;
}

const VesselPart* upright_at(const continuum::Parameters& p, double height) {
  const VesselPart* nearest = nullptr;
  for (const VesselPart& v : p.vessel)
    if (hydraulic_radius(v) > 0 && v.top > height && (!nearest || v.bottom < nearest->bottom)) nearest = &v;
  return nearest;
}

}  // namespace talus::app
