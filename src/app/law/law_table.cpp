// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <cmath>

#include "app/law/law_case.hpp"
#include "io/series.hpp"
#include "physics/granular/collisional_stress.hpp"

namespace talus::app {

namespace {

double pressure_of(const granular::PathPoint& point) {
  return trace(point.stress) / 3;
}
double shear_of(const granular::PathPoint& point) {
  return norm(deviator(point.stress)) / std::sqrt(2.0);
}
/// Not a number without pressure.
double friction_of(const granular::PathPoint& point) {
  return pressure_of(point) > 0 ? shear_of(point) / pressure_of(point) : std::nan("");
}

constexpr const char* components[] = {"xx", "yy", "zz", "xy", "yz", "zx"};

void add_columns(std::vector<SeriesColumn>& columns, const std::string& name, const std::string& unit) {
  for (const char* component : components) columns.push_back({name + "_" + component, unit});
}
void add_values(std::vector<double>& values, const SymmetricTensor3<>& t) {
  values.insert(values.end(), {t.xx, t.yy, t.zz, t.xy, t.yz, t.zx});
}

}  // namespace

std::vector<NamedValue> quantities_of(const FollowedPath& path) {
  double pressure = 0, shear = 0, friction = 0;
  for (const granular::PathPoint& point : path.points) {
    pressure = std::max(pressure, pressure_of(point));
    shear = std::max(shear, shear_of(point));
    friction = std::fmax(friction, friction_of(point));
  }
  const granular::PathPoint& last = path.points.back();
  const double sound = std::visit([&](const auto& law) { return law.sound_speed(path.options.density); }, path.law);
  return {{"sound_speed_bound", "m/s", sound},
          {"pressure_max", "Pa", pressure},
          {"shear_stress_max", "Pa", shear},
          {"friction_max", "1", friction},
          {"pressure_end", "Pa", pressure_of(last)},
          {"shear_stress_end", "Pa", shear_of(last)},
          {"packing_end", "1", last.density / path.parameters.grains.density},
          {"work", "J/m3", granular::work_of_path(path.stretches, path.points)}};
}

void write_path_table(const FollowedPath& path, const std::filesystem::path& file) {
  const granular::CollisionParameters& collisions = path.parameters.collisions;
  const bool collide = collisions.form != granular::Collisions::none;
  const double fall_time = std::sqrt(path.parameters.grains.diameter / path.parameters.gravity.acceleration);
  std::vector<SeriesColumn> columns{{"time", "s"},      {"stretch", "1"},       {"packing", "1"},
                                    {"pressure", "Pa"}, {"shear_stress", "Pa"}, {"friction", "1"}};
  add_columns(columns, "strain", "1");
  add_columns(columns, "stress", "Pa");
  if (collide) add_columns(columns, "collision_stress", "Pa");
  for (const granular::HistorySlot& slot : granular::history_of(path.law))
    columns.push_back({std::string("law_") + slot.name, slot.unit});

  SeriesWriter writer(file, columns);
  std::vector<double> values;
  for (std::size_t k = 0; k < path.points.size(); ++k) {
    const granular::PathPoint& point = path.points[k];
    // A point ends the stretch that led to it; the first begins the first.
    const std::size_t stretch = k == 0 ? 0 : (k - 1) / static_cast<std::size_t>(path.options.points);
    values = {point.time,
              static_cast<double>(stretch + 1),
              point.density / path.parameters.grains.density,
              pressure_of(point),
              shear_of(point),
              friction_of(point)};
    add_values(values, point.strain);
    add_values(values, point.stress);
    if (collide)
      add_values(values, granular::collisional_stress(collisions, fall_time, std::max(pressure_of(point), 0.0),
                                                      path.stretches[stretch].velocity_gradient));
    values.insert(values.end(), point.history.begin(), point.history.end());
    writer.append(values);
  }
  writer.sync();
}

}  // namespace talus::app
