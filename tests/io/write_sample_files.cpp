// SPDX-License-Identifier: Apache-2.0
/// Writes the snapshots and the checkpoint that test_vtkhdf.py reads with VTK and h5py; the numbers are given by
/// formulas that stand there too. Usage: write_sample_files FOLDER
#include "io/checkpoint.hpp"
#include "io/vtkhdf.hpp"

int main(int, char** arguments) {
  const talus::PointSet nobody{.columns = {{"position", "m", std::vector<talus::Vector3>{}},
                                           {"radius", "m", std::vector<double>{}},
                                           {"identity", "1", std::vector<std::int64_t>{}}}};
  talus::write_points(std::string(arguments[1]) + "/empty.vtkhdf", nobody.view());
  for (int frame = 0; frame < 2; ++frame) {
    std::vector<talus::Vector3> position, velocity;
    std::vector<double> radius;
    std::vector<std::int64_t> order;
    for (int i = 0; i < 100; ++i) {
      position.push_back({i / 7.0, -i / 3.0, frame + i / 9.0});
      velocity.push_back({1.0 / (i + 1), 0.0, -2.0 * i});
      radius.push_back(0.005 * (i + 1));
      order.push_back((std::int64_t{1} << 53) + 1 - i);
    }
    const talus::PointSet points{.time = 0.25 * frame,
                                 .step = 1000u * static_cast<unsigned>(frame),
                                 .columns = {{"position", "m", position},
                                             {"velocity", "m/s", velocity},
                                             {"radius", "m", radius},
                                             {"spatial_order", "1", order}}};
    talus::write_points(std::string(arguments[1]) + "/particles_000" + std::to_string(frame) + ".vtkhdf",
                        points.view());
    talus::GridSnapshot grid{.time = 0.25 * frame,
                             .step = points.step,
                             .count = {4, 3, 2},
                             .low = {1, 2, 3},
                             .spacing = {0.5, 0.25, 0.125},
                             .columns = {}};
    std::vector<talus::Vector3> wind;
    std::vector<double> pressure;
    for (int c = 0; c < 24; ++c) wind.push_back({1.0 * c, -2.0 * c, 1.0 * frame}), pressure.push_back(10.0 + c);
    grid.columns = {{"velocity", "m/s", wind}, {"pressure", "Pa", pressure}};
    talus::write_grid(std::string(arguments[1]) + "/air_000" + std::to_string(frame) + ".vtkhdf", grid);
    // The same cells as a section: six long, one deep, four high.
    grid.count = {6, 1, 4};
    talus::write_grid(std::string(arguments[1]) + "/section_000" + std::to_string(frame) + ".vtkhdf", grid);
    // A square of two triangles.
    const talus::SurfaceSnapshot surface{
        .time = 0.25 * frame,
        .step = points.step,
        .points = {{0, 0, 1}, {2, 0, 1}, {2, 3, 1}, {0, 3, 1}},
        .triangles = {{0, 1, 2}, {0, 2, 3}},
        .columns = {{"pressure", "Pa", std::vector<double>{7.0, 8.0 + frame}},
                    {"shear", "Pa", std::vector<talus::Vector3>{{1, 2, 3}, {4, 5, 6}}}}};
    talus::write_surface(std::string(arguments[1]) + "/walls_000" + std::to_string(frame) + ".vtkhdf", surface);
    talus::CheckpointWriter checkpoint("f00d");
    checkpoint(talus::FieldInfo{"position", "m"}, position);
    checkpoint(talus::FieldInfo{"step", "1"}, points.step);
    talus::CheckpointFiles(arguments[1]).save(checkpoint);
  }
}
