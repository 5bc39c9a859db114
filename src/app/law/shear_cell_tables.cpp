// SPDX-License-Identifier: Apache-2.0
#include <vector>

#include "app/law/shear_cell_results.hpp"
#include "io/series.hpp"

namespace talus::app {

void write_shear_tables(std::span<const granular::ShearTest> tests, const std::filesystem::path& folder) {
  const auto append = [](SeriesWriter& writer, std::vector<double> values) { writer.append(values); };
  SeriesWriter loci(folder / "yield-loci.csv",
                    {{"consolidation", "Pa"}, {"normal_stress", "Pa"}, {"shear_stress", "Pa"}});
  SeriesWriter triaxial(folder / "triaxial.csv",
                        {{"consolidation", "Pa"}, {"lateral_stress", "Pa"}, {"axial_stress", "Pa"}});
  if (!tests.empty() && !tests.front().on_wall.empty()) {
    SeriesWriter wall(folder / "wall-yield-loci.csv",
                      {{"consolidation", "Pa"}, {"normal_stress", "Pa"}, {"shear_stress", "Pa"}});
    for (const granular::ShearTest& test : tests)
      for (const granular::YieldPoint& point : test.on_wall)
        append(wall, {test.pre_shear.normal, point.normal, point.shear});
    wall.sync();
  }
  SeriesWriter flow(folder / "flow-function.csv", {{"consolidation", "Pa"},
                                                   {"shear_stress", "Pa"},
                                                   {"bulk_density", "kg/m3"},
                                                   {"cohesion", "Pa"},
                                                   {"friction_angle", "rad"},
                                                   {"effective_angle", "rad"},
                                                   {"major_stress", "Pa"},
                                                   {"unconfined_strength", "Pa"},
                                                   {"strength_in_plane_strain", "Pa"},
                                                   {"strength_of_cylinder", "Pa"},
                                                   {"density_in_oedometer", "kg/m3"},
                                                   {"lateral_stress_in_oedometer", "Pa"}});
  for (const granular::ShearTest& test : tests) {
    const double load = test.pre_shear.normal;
    for (const granular::YieldPoint& point : test.points) append(loci, {load, point.normal, point.shear});
    for (const granular::Compression& sample : test.triaxial) append(triaxial, {load, sample.lateral, sample.axial});
    append(flow, {load, test.pre_shear.shear, test.density, test.locus.cohesion, test.locus.angle,
                  test.locus.effective_angle, test.locus.major, test.locus.strength, test.strength_in_plane_strain,
                  test.strength_of_cylinder, test.density_in_oedometer, test.oedometer.lateral});
  }
  for (SeriesWriter* writer : {&loci, &triaxial, &flow}) writer->sync();
}

}  // namespace talus::app
