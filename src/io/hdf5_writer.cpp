// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>

#include "io/hdf5_library.hpp"

namespace talus::hdf5 {

static_assert(sizeof(Vector3) == 3 * sizeof(double), "columns of vectors are written as n x 3 doubles");

namespace {

Handle string_type(std::string_view text) {
  Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
  H5Tset_size(type.id(), std::max<std::size_t>(text.size(), 1));
  H5Tset_strpad(type.id(), H5T_STR_NULLPAD);
  const bool ascii = std::all_of(text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x80; });
  if (!ascii) H5Tset_cset(type.id(), H5T_CSET_UTF8);
  return type;
}

Handle dataspace(std::span<const hsize_t> shape) {
  return shape.empty() ? Handle(H5Screate(H5S_SCALAR), H5Sclose)
                       : Handle(H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose);
}

}  // namespace

Writer::Writer(std::filesystem::path path) : path_(std::move(path)) {
  silence();
  file_ = Handle(H5Fcreate(unique_name().c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, file_access_in_memory().id()), H5Fclose);
  if (file_.id() < 0) fail(path_, "cannot be built in memory");
}

void Writer::group(const std::string& name) {
  silence();
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.id(), 1);
  const Handle group(H5Gcreate2(file_.id(), name.c_str(), link.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (group.id() < 0) fail(path_, "cannot make group '" + name + "'");
}

void Writer::write_raw(const std::string& name, hid_t type, std::span<const hsize_t> shape, const void* values,
                       std::string_view unit) {
  silence();
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.id(), 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  const Handle space = dataspace(shape);
  {
    const Handle data(H5Dcreate2(file_.id(), name.c_str(), type, space.id(), link.id(), creation.id(), H5P_DEFAULT),
                      H5Dclose);
    const bool empty = std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
    if (data.id() < 0 || (!empty && H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
      fail(path_, "cannot write '" + name + "'");
  }
  if (!unit.empty()) attribute(name, "units", unit);
}

void Writer::write(const std::string& name, std::span<const double> values, std::string_view unit) {
  write_raw(name, H5T_NATIVE_DOUBLE, std::array<hsize_t, 1>{values.size()}, values.data(), unit);
}
void Writer::write(const std::string& name, std::span<const Vector3> values, std::string_view unit) {
  write_raw(name, H5T_NATIVE_DOUBLE, std::array<hsize_t, 2>{values.size(), 3}, values.data(), unit);
}
void Writer::write(const std::string& name, std::span<const std::int64_t> values, std::string_view unit) {
  write_raw(name, H5T_NATIVE_INT64, std::array<hsize_t, 1>{values.size()}, values.data(), unit);
}
void Writer::write(const std::string& name, std::span<const std::uint8_t> values) {
  write_raw(name, H5T_NATIVE_UINT8, std::array<hsize_t, 1>{values.size()}, values.data(), {});
}
void Writer::write_grid(const std::string& name, const std::array<std::size_t, 3>& shape,
                        std::span<const double> values, std::string_view unit) {
  const std::vector<float> single(values.begin(), values.end());
  write_raw(name, H5T_NATIVE_FLOAT, std::array<hsize_t, 3>{shape[0], shape[1], shape[2]}, single.data(), unit);
}
void Writer::write_grid(const std::string& name, const std::array<std::size_t, 3>& shape,
                        std::span<const Vector3> values, std::string_view unit) {
  std::vector<float> single;
  for (const Vector3& v : values)
    for (int axis = 0; axis < 3; ++axis) single.push_back(static_cast<float>(v[axis]));
  write_raw(name, H5T_NATIVE_FLOAT, std::array<hsize_t, 4>{shape[0], shape[1], shape[2], 3}, single.data(), unit);
}
void Writer::write(const std::string& name, double value, std::string_view unit) {
  write_raw(name, H5T_NATIVE_DOUBLE, {}, &value, unit);
}
void Writer::write(const std::string& name, std::uint64_t value, std::string_view unit) {
  write_raw(name, H5T_NATIVE_UINT64, {}, &value, unit);
}
void Writer::write(const std::string& name, std::string_view text) {
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  write_raw(name, string_type(text).id(), {}, padded.data(), {});
}

void Writer::attribute(const std::string& object, const char* name, std::string_view text) {
  silence();
  const Handle type = string_type(text), space = dataspace({});
  const Handle attribute(
      H5Acreate_by_name(file_.id(), object.c_str(), name, type.id(), space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  const std::string padded = text.empty() ? std::string(1, '\0') : std::string(text);
  if (attribute.id() < 0 || H5Awrite(attribute.id(), type.id(), padded.data()) < 0)
    fail(path_, "cannot write attribute '" + std::string(name) + "' of '" + object + "'");
}

void Writer::attribute_raw(const std::string& object, const char* name, hid_t type, std::size_t count,
                           const void* values) {
  silence();
  const Handle space = dataspace(std::array<hsize_t, 1>{count});
  const Handle attribute(
      H5Acreate_by_name(file_.id(), object.c_str(), name, type, space.id(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT),
      H5Aclose);
  if (attribute.id() < 0 || H5Awrite(attribute.id(), type, values) < 0)
    fail(path_, "cannot write attribute '" + std::string(name) + "' of '" + object + "'");
}
void Writer::attribute(const std::string& object, const char* name, std::span<const std::int64_t> values) {
  attribute_raw(object, name, H5T_NATIVE_INT64, values.size(), values.data());
}
void Writer::attribute(const std::string& object, const char* name, std::span<const double> values) {
  attribute_raw(object, name, H5T_NATIVE_DOUBLE, values.size(), values.data());
}

std::string Writer::image(std::size_t front) const {
  silence();
  if (H5Fflush(file_.id(), H5F_SCOPE_LOCAL) < 0) fail(path_, "cannot be built in memory");
  const ssize_t size = H5Fget_file_image(file_.id(), nullptr, 0);
  if (size <= 0) fail(path_, "cannot be built in memory");
  std::string image(front + static_cast<std::size_t>(size), '\0');
  if (H5Fget_file_image(file_.id(), image.data() + front, static_cast<std::size_t>(size)) != size)
    fail(path_, "cannot be built in memory");
  return image;
}

}  // namespace talus::hdf5
