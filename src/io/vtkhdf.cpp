// SPDX-License-Identifier: Apache-2.0
#include "io/vtkhdf.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/hdf5.hpp"
#include "numerics/geometry/sector.hpp"
#include "numerics/snapshot.hpp"

namespace talus {

namespace {

constexpr std::uint8_t vtk_vertex = 1, vtk_triangle = 5;  // vtkCellType.h

/// A column whose entries follow from their numbers.
template <class Value>
ColumnSource made(ColumnSource::Kind kind, Value&& value) {
  using Entry = decltype(value(std::size_t{}));
  return {{}, {}, kind, [value](std::size_t first, std::size_t count, std::byte* to) {
            for (std::size_t n = 0; n < count; ++n) {
              const Entry entry = value(first + n);
              std::memcpy(to + n * sizeof entry, &entry, sizeof entry);
            }
          }};
}

/// Type, version and cells, all of one kind.
/// \param offsets where the points of each cell begin in `connectivity`, and where the last ends
void write_cells(hdf5::Writer& file, std::size_t points, std::uint8_t cell_type, std::size_t cells,
                 std::size_t connections, ColumnSource offsets, ColumnSource connectivity) {
  const auto single = [](std::size_t n) { return std::vector<std::int64_t>{static_cast<std::int64_t>(n)}; };
  file.group(vtkhdf_root);
  file.attribute(vtkhdf_root, "Type", "UnstructuredGrid");
  file.attribute(vtkhdf_root, "Version", std::vector<std::int64_t>{1, 0});
  file.write(vtkhdf_root + "/NumberOfPoints", single(points));
  file.write(vtkhdf_root + "/NumberOfCells", single(cells));
  file.write(vtkhdf_root + "/NumberOfConnectivityIds", single(connections));
  file.write(vtkhdf_root + "/Offsets", cells + 1, std::move(offsets));
  file.write(vtkhdf_root + "/Connectivity", connections, std::move(connectivity));
  file.write(vtkhdf_root + "/Types", cells,
             made(ColumnSource::Kind::byte, [cell_type](std::size_t) { return cell_type; }));
}

void write_time(hdf5::Writer& file, double time, std::uint64_t step) {
  file.write(vtkhdf_root + "/FieldData/time", std::vector<double>{time}, "s");
  file.write(vtkhdf_root + "/FieldData/TimeValue", std::vector<double>{time}, "s");
  file.write(vtkhdf_root + "/FieldData/step", std::vector<std::int64_t>{static_cast<std::int64_t>(step)}, "1");
}

}  // namespace

void write_points(const std::filesystem::path& path, const PointSource& points) {
  const std::size_t count = points.count;
  hdf5::Writer file(path);
  const ColumnSource numbers =
      made(ColumnSource::Kind::integer, [](std::size_t n) { return static_cast<std::int64_t>(n); });
  write_cells(file, count, vtk_vertex, count, count, numbers, numbers);

  file.group(vtkhdf_root + "/PointData");
  for (const ColumnSource& column : points.columns)
    file.write(vtkhdf_root + "/" + (column.name == "position" ? "Points" : "PointData/" + column.name), count, column);

  write_time(file, points.time, points.step);
  if (const auto& copies = points.copies) {
    file.write(vtkhdf_root + "/FieldData/sector_copies", std::vector<std::int64_t>{copies->count}, "1");
    file.write(vtkhdf_root + "/FieldData/sector_axis", std::vector<Vector3>{copies->axis}, "m");
    file.write(vtkhdf_root + "/FieldData/sector_identities", std::vector<std::int64_t>{copies->identities}, "1");
  }
  file.save();
}

namespace {

using Kind = hdf5::Description::Kind;

template <class T>
std::vector<T> component(const std::vector<T>& values, std::size_t k, std::size_t components) {
  std::vector<T> column(values.size() / components);
  for (std::size_t i = 0; i < column.size(); ++i) column[i] = values[components * i + k];
  return column;
}

/// Collects what is wrong with one file.
class PointsReader {
 public:
  explicit PointsReader(const std::filesystem::path& path) : file_(path) {}

  PointSet read() {
    check_kind();
    stop_at_problems();
    read_positions();
    if (file_.has(data_))
      for (const std::string& name : file_.names(data_)) read_column(name);
    read_time();
    read_sector();
    stop_at_problems();
    return points_.copies ? whole_of(points_.view()) : std::move(points_);
  }

 private:
  void problem(const std::string& what, const std::string& allowed = {}) {
    problems_.push_back({.where = file_.path().string(), .key = {}, .what = what, .allowed = allowed});
  }
  void stop_at_problems() const {
    if (!problems_.empty()) throw InputError(problems_);
  }

  void check_kind() {
    if (!file_.has(vtkhdf_root)) return problem("no VTKHDF file: the group 'VTKHDF' is missing");
    const std::string type = file_.text_attribute(vtkhdf_root, "Type");
    if (type != "UnstructuredGrid" && type != "PolyData")
      problem("holds '" + type + "', not points", "UnstructuredGrid, PolyData");
    const std::vector<std::int64_t> version = file_.integer_attribute(vtkhdf_root, "Version");
    if (version.empty() || version[0] < 1 || version[0] > 2)
      problem(version.empty() ? "has no Version" : fmt::format("has VTKHDF version {}", version[0]), "1 and 2");
    if (file_.has(vtkhdf_root + "/Steps")) problem("holds several times in one file", "one file a time");
    if (!file_.has(vtkhdf_root + "/Points")) problem("has no 'VTKHDF/Points'");
  }

  void read_positions() {
    const std::string name = vtkhdf_root + "/Points";
    const hdf5::Description description = file_.describe(name);
    if (description.kind != Kind::real || description.shape.size() != 2 || description.shape[1] != 3)
      return problem("'VTKHDF/Points' is not n x 3 reals");
    count_ = description.shape[0];
    points_.columns.push_back({"position", unit(name, "m"), file_.vectors(name)});
  }

  void read_column(const std::string& column) {
    const std::string name = data_ + "/" + column;
    const hdf5::Description description = file_.describe(name);
    if (description.kind != Kind::real && description.kind != Kind::integer)
      return problem("column '" + column + "' holds neither reals nor integers");
    if (description.shape.empty() || description.shape.size() > 2 || description.entries() != count_)
      return problem(fmt::format("column '{}' has {} entries for {} points", column, description.entries(), count_));
    if (description.kind == Kind::real) {
      if (description.components() == 3)
        points_.columns.push_back({column, unit(name, "1"), file_.vectors(name)});
      else
        add_components(column, unit(name, "1"), file_.doubles(name), description.components());
    } else if (!description.is_signed && description.element_bytes > 4 && exceeds_64_bits(name)) {
      problem("column '" + column + "' holds integers beyond 2^63");
    } else {
      add_components(column, unit(name, "1"), file_.integers(name), description.components());
    }
  }

  template <class T>
  void add_components(const std::string& column, const std::string& unit, const std::vector<T>& values,
                      std::size_t components) {
    if (components == 1) return points_.columns.push_back({column, unit, values});
    for (std::size_t k = 0; k < components; ++k)
      points_.columns.push_back({fmt::format("{}_{}", column, k), unit, component(values, k, components)});
  }

  void read_time() {
    const std::string fields = vtkhdf_root + "/FieldData/";
    for (const char* name : {"time", "TimeValue"})
      if (file_.has(fields + name)) {
        const std::vector<double> time = file_.doubles(fields + name);
        if (time.size() != 1) return problem(fmt::format("field data '{}' is not one number", name));
        points_.time = time[0];
        break;
      }
    if (!file_.has(fields + "step")) return;
    const std::vector<std::int64_t> step = file_.integers(fields + "step");
    if (step.size() != 1 || step[0] < 0) return problem("field data 'step' is not one number >= 0");
    points_.step = static_cast<std::uint64_t>(step[0]);
  }

  void read_sector() {
    const std::string name = vtkhdf_root + "/FieldData/sector_";
    if (!file_.has(name + "copies")) return;
    constexpr std::int64_t most = std::int64_t{1} << 50;
    const auto number = [&](const char* of) {
      const std::vector<std::int64_t> values =
          file_.has(name + of) ? file_.integers(name + of) : std::vector<std::int64_t>();
      return values.size() == 1 ? values[0] : -1;
    };
    const std::int64_t count = number("copies"), identities = number("identities");
    const std::vector<Vector3> axis = file_.has(name + "axis") ? file_.vectors(name + "axis") : std::vector<Vector3>();
    if (count < Sector::min_copies || count > Sector::max_copies || identities < 0 || identities > most ||
        axis.size() != 1)
      return problem(
          "field data 'sector_copies', 'sector_axis', 'sector_identities' describe no sector",
          fmt::format("{} to {} copies, one axis, a number of identities", Sector::min_copies, Sector::max_copies));
    points_.copies = SectorCopies{.axis = axis[0], .count = static_cast<int>(count), .identities = identities};
  }

  /// The library would turn an integer beyond the range into the nearest one; as a real it shows.
  bool exceeds_64_bits(const std::string& name) const {
    for (const double value : file_.doubles(name))
      if (value >= 0x1.0p63) return true;
    return false;
  }

  std::string unit(const std::string& name, const char* missing) const {
    const std::string unit = file_.text_attribute(name, "units");
    return unit.empty() ? missing : unit;
  }

  hdf5::Reader file_;
  std::string data_ = vtkhdf_root + "/PointData";
  std::size_t count_ = 0;
  std::vector<Problem> problems_;
  PointSet points_;
};

}  // namespace

PointSet read_points(const std::filesystem::path& path) {
  return PointsReader(path).read();
}

int read_copies(const std::filesystem::path& path) {
  const hdf5::Reader file(path);
  const std::string name = vtkhdf_root + "/FieldData/sector_copies";
  const std::vector<std::int64_t> copies = file.has(name) ? file.integers(name) : std::vector<std::int64_t>();
  return copies.size() == 1 ? static_cast<int>(std::clamp<std::int64_t>(copies[0], 1, Sector::max_copies)) : 1;
}

double read_points_time(const std::filesystem::path& path) {
  const hdf5::Reader file(path);
  std::vector<double> time = file.real_attribute(vtkhdf_root, "time");
  if (time.empty()) time = file.doubles(vtkhdf_root + "/FieldData/TimeValue");
  if (time.size() != 1) throw FileError(path.string(), "holds no single 'TimeValue'");
  return time[0];
}

// As an unstructured grid: VTK 9.1 and ParaView 5.11 read no PolyData.
void write_surface(const std::filesystem::path& path, const SurfaceSnapshot& snapshot) {
  hdf5::Writer file(path, hdf5::Storage::deflated);
  std::vector<std::int64_t> offsets{0}, connectivity;
  for (const auto& corners : snapshot.triangles) {
    connectivity.insert(connectivity.end(), corners.begin(), corners.end());
    offsets.push_back(static_cast<std::int64_t>(connectivity.size()));
  }
  const auto source = [](const std::vector<std::int64_t>& numbers) { return source_of({{}, {}, std::span(numbers)}); };
  write_cells(file, snapshot.points.size(), vtk_triangle, snapshot.triangles.size(), connectivity.size(),
              source(offsets), source(connectivity));
  file.write(vtkhdf_root + "/Points", snapshot.points, "m");
  file.group(vtkhdf_root + "/CellData");
  for (const GridSnapshot::Column& column : snapshot.columns)
    std::visit(
        [&](const auto& values) {
          if (values.size() != snapshot.triangles.size())
            throw std::invalid_argument(fmt::format("snapshot: column '{}' has {} entries for {} triangles",
                                                    column.name, values.size(), snapshot.triangles.size()));
          file.write(vtkhdf_root + "/CellData/" + column.name, std::span(values), column.unit);
        },
        column.values);
  write_time(file, snapshot.time, snapshot.step);
  file.save();
}

}  // namespace talus
