// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.hpp"
#include "io/hdf5.hpp"
#include "io/scratch_folder.hpp"

namespace talus {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

PointSet sample() {
  return {.time = 0.1,
          .step = 123456789012,
          .columns = {{"radius", "m", std::vector{0.005, 0x1.0p-1074, std::numeric_limits<double>::infinity()}},
                      {"position", "m", std::vector<Vector3>{{0.1, -0.0, 3}, {1e-300, 1.0 / 3, 2}, {4, 5, 6}}},
                      {"number", "1", std::vector<std::int64_t>{-1, 9007199254740993, INT64_MIN}}}};
}

template <class T>
void expect_same_bits(const std::vector<T>& a, const std::vector<T>& b) {
  ASSERT_EQ(a.size(), b.size());
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(T)), 0);
}

TEST(VtkHdf, ReadsBackBitForBit) {
  const ScratchFolder folder;
  const PointSet written = sample();
  write_points(folder / "p.vtkhdf", written.view());
  const PointSet read = read_points(folder / "p.vtkhdf");
  EXPECT_EQ(read.time, 0.1);
  EXPECT_EQ(read.step, 123456789012u);
  ASSERT_EQ(read.columns.size(), 3u);
  EXPECT_EQ(read.columns[0].name, "position");
  EXPECT_EQ(read.columns[0].unit, "m");
  EXPECT_EQ(read.columns[1].name, "number");
  EXPECT_EQ(read.columns[1].unit, "1");
  EXPECT_EQ(read.columns[2].name, "radius");
  expect_same_bits(std::get<1>(read.columns[0].values), std::get<1>(written.columns[1].values));
  expect_same_bits(std::get<2>(read.columns[1].values), std::get<2>(written.columns[2].values));
  expect_same_bits(std::get<0>(read.columns[2].values), std::get<0>(written.columns[0].values));
}

TEST(VtkHdf, SurfacesAreDeflatedAndKeptBitForBit) {
  const ScratchFolder folder;
  constexpr std::size_t count = 40000, triangles_of_a_field = 20;
  SurfaceSnapshot walls{.time = 1, .points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, .triangles = {}, .columns = {}};
  std::vector<double> pressure;
  std::vector<Vector3> shear;
  for (std::size_t n = 0; n < count; ++n) {
    const auto field = static_cast<double>(n / triangles_of_a_field);
    walls.triangles.push_back({0, 1, 2});
    pressure.push_back(1 / (3 + field)), shear.push_back({-0.0, std::sqrt(field), 1 / (7 + field)});
  }
  walls.columns = {{"pressure", "Pa", pressure}, {"shear", "Pa", shear}};
  write_surface(folder / "walls.vtkhdf", walls);
  EXPECT_LT(std::filesystem::file_size(folder / "walls.vtkhdf"), count * 4 * sizeof(double) / 4);
  const hdf5::Reader file(folder / "walls.vtkhdf");
  expect_same_bits(file.doubles("VTKHDF/CellData/pressure"), pressure);
  expect_same_bits(file.vectors("VTKHDF/CellData/shear"), shear);
  EXPECT_EQ(file.integers("VTKHDF/Connectivity").size(), 3 * count);
  EXPECT_EQ(file.integers("VTKHDF/Offsets").back(), static_cast<std::int64_t>(3 * count));
}

TEST(VtkHdf, OfASectorHoldsItOnceAndReadsTheWhole) {
  const ScratchFolder folder;
  PointSet part{.time = 1,
                .step = 2,
                .columns = {{"identity", "1", std::vector<std::int64_t>{0}},
                            {"position", "m", std::vector<Vector3>{{2, 1, 5}}},
                            {"velocity", "m/s", std::vector<Vector3>{{1, 0, 0}}}},
                .copies = SectorCopies{.axis = {1, 1, 0}, .count = 4, .identities = 1}};
  write_points(folder / "p.vtkhdf", part.view());
  EXPECT_EQ(hdf5::Reader(folder / "p.vtkhdf").describe("VTKHDF/Points").shape[0], 1u);
  const PointSet read = read_points(folder / "p.vtkhdf");
  const Snapshot whole = read.view();
  ASSERT_EQ(whole.size(), 4u);
  EXPECT_LT(norm(whole.positions()[1] - Vector3{1, 2, 5}), 1e-15);
  EXPECT_LT(norm(whole.vectors("velocity")[3] - Vector3{0, -1, 0}), 1e-15);
  EXPECT_THAT(whole.integers("identity"), ElementsAre(0, 1, 2, 3));
  EXPECT_EQ(read_copies(folder / "p.vtkhdf"), 4);
  write_points(folder / "whole.vtkhdf", sample().view());
  EXPECT_EQ(read_copies(folder / "whole.vtkhdf"), 1);
  part.copies->count = 3;
  write_points(folder / "q.vtkhdf", part.view());
  EXPECT_THAT(message_of<InputError>([&] { read_points(folder / "q.vtkhdf"); }), HasSubstr("describe no sector"));
}

TEST(VtkHdf, LeavesOneFileWhoseBytesDependOnTheSnapshotAlone) {
  const ScratchFolder folder;
  write_points(folder / "a.vtkhdf", sample().view());
  write_points(folder / "b.vtkhdf", sample().view());
  EXPECT_THAT(names_in(folder.path()), ElementsAre("a.vtkhdf", "b.vtkhdf"));
  EXPECT_EQ(content_of(folder / "a.vtkhdf"), content_of(folder / "b.vtkhdf"));
  // Nor on the second in which it is written.
  const hdf5::Handle file(H5Fopen((folder / "a.vtkhdf").c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  for (const char* name : {"VTKHDF/Points", "VTKHDF/PointData/radius", "VTKHDF/FieldData", "VTKHDF"}) {
    H5O_info_t info;
    ASSERT_GE(H5Oget_info_by_name(file.id(), name, &info, H5P_DEFAULT), 0);
    EXPECT_EQ(info.mtime, 0) << name;
    EXPECT_EQ(info.ctime, 0) << name;
  }
}

TEST(VtkHdf, TakesNoParticles) {
  const ScratchFolder folder;
  write_points(folder / "p.vtkhdf", PointSet{.columns = {{"position", "m", std::vector<Vector3>{}}}}.view());
  EXPECT_EQ(read_points(folder / "p.vtkhdf").view().size(), 0u);
}

TEST(VtkHdf, RefusesColumnsOfDifferentLength) {
  const ScratchFolder folder;
  PointSet points = sample();
  std::get<0>(points.columns[0].values).pop_back();
  EXPECT_THROW(write_points(folder / "p.vtkhdf", points.view()), std::invalid_argument);
  EXPECT_THAT(names_in(folder.path()), ElementsAre());
}

/// Another program's file, made with the library's own calls: floats, short integers, tensors, no units.
class ForeignFile {
 public:
  explicit ForeignFile(const std::filesystem::path& path)
      : file_(H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose),
        root_(H5Gcreate2(file_.id(), "VTKHDF", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose),
        data_(H5Gcreate2(root_.id(), "PointData", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Gclose) {
    set_type("PolyData");
    const hsize_t two = 2;
    const int version[] = {2, 0};
    const hdf5::Handle space(H5Screate_simple(1, &two, nullptr), H5Sclose);
    const hdf5::Handle attribute(
        H5Acreate2(root_.id(), "Version", H5T_NATIVE_INT, space.id(), H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
    H5Awrite(attribute.id(), H5T_NATIVE_INT, version);
  }

  /// As h5py writes a str: of variable length.
  void set_type(const char* text) {
    const hdf5::Handle type(H5Tcopy(H5T_C_S1), H5Tclose), space(H5Screate(H5S_SCALAR), H5Sclose);
    H5Tset_size(type.id(), H5T_VARIABLE);
    H5Adelete(root_.id(), "Type");
    const hdf5::Handle attribute(H5Acreate2(root_.id(), "Type", type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT),
                                 H5Aclose);
    H5Awrite(attribute.id(), type.id(), &text);
  }

  template <class T>
  void write(const std::string& name, hid_t type, std::vector<hsize_t> shape, const std::vector<T>& values) {
    const hdf5::Handle space(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
    const hdf5::Handle data(
        H5Dcreate2(root_.id(), name.c_str(), type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT), H5Dclose);
    H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
  }

 private:
  hdf5::Handle file_, root_, data_;
};

TEST(VtkHdf, ReadsForeignFilesOfOtherWidths) {
  const ScratchFolder folder;
  {
    ForeignFile file(folder / "f.hdf");
    file.write<float>("Points", H5T_NATIVE_FLOAT, {2, 3}, {1, 2, 3, 4, 5, 0.5f});
    file.write<float>("PointData/mass", H5T_NATIVE_FLOAT, {2}, {0.25f, 0.1f});
    file.write<std::uint8_t>("PointData/kind", H5T_NATIVE_UINT8, {2}, {7, 255});
    file.write<float>("PointData/pair", H5T_NATIVE_FLOAT, {2, 2}, {1, 2, 3, 4});
    file.write<std::uint64_t>("PointData/id", H5T_NATIVE_UINT64, {2}, {1, INT64_MAX / 2});
  }
  const PointSet points = read_points(folder / "f.hdf");
  const Snapshot view = points.view();
  EXPECT_EQ(view.positions()[1], (Vector3{4, 5, 0.5}));
  EXPECT_THAT(view.scalars("mass"), ElementsAre(0.25, static_cast<double>(0.1f)));
  EXPECT_THAT(view.integers("kind"), ElementsAre(7, 255));
  EXPECT_THAT(view.integers("id"), ElementsAre(1, INT64_MAX / 2));
  EXPECT_THAT(view.scalars("pair_0"), ElementsAre(1, 3));
  EXPECT_THAT(view.scalars("pair_1"), ElementsAre(2, 4));
  EXPECT_EQ(points.columns[0].unit, "m");
  EXPECT_EQ(view.time, 0);
}

TEST(VtkHdf, SaysAllThatIsWrongWithAFile) {
  const ScratchFolder folder;
  {
    ForeignFile file(folder / "f.hdf");
    file.write<float>("Points", H5T_NATIVE_FLOAT, {1, 3}, {1, 2, 3});
    file.write<float>("PointData/mass", H5T_NATIVE_FLOAT, {2}, {1, 2});
    file.write<std::uint64_t>("PointData/id", H5T_NATIVE_UINT64, {1}, {UINT64_MAX});
  }
  try {
    read_points(folder / "f.hdf");
    FAIL();
  } catch (const InputError& error) {
    ASSERT_EQ(error.problems().size(), 2u);
    EXPECT_THAT(to_string(error.problems()[0]), HasSubstr("f.hdf: column 'id' holds integers beyond 2^63"));
    EXPECT_THAT(to_string(error.problems()[1]), HasSubstr("column 'mass' has 2 entries for 1 points"));
  }
  {
    ForeignFile file(folder / "image.hdf");
    file.set_type("ImageData");
  }
  EXPECT_THAT(message_of<InputError>([&] { read_points(folder / "image.hdf"); }),
              HasSubstr("holds 'ImageData', not points; allowed: UnstructuredGrid, PolyData"));
}

TEST(VtkHdf, TellsAMissingFileFromABrokenOneFromAnother) {
  const ScratchFolder folder;
  EXPECT_THAT(message_of<FileError>([&] { read_points(folder / "none.vtkhdf"); }),
              HasSubstr("none.vtkhdf: cannot open: No such file or directory"));
  put_content(folder / "text.vtkhdf", "x,y,z\n1,2,3\n");
  EXPECT_THAT(message_of<FileError>([&] { read_points(folder / "text.vtkhdf"); }),
              HasSubstr("is not a whole HDF5 file: file signature not found"));
  write_points(folder / "p.vtkhdf", sample().view());
  const std::string whole = content_of(folder / "p.vtkhdf");
  put_content(folder / "half.vtkhdf", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(message_of<FileError>([&] { read_points(folder / "half.vtkhdf"); }), HasSubstr("truncated file"));
}

}  // namespace
}  // namespace talus
