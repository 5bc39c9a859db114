// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "base/error.hpp"
#include "io/descriptor.hpp"
#include "io/hdf5_library.hpp"

namespace talus::hdf5 {

namespace {

/// Reads one string of fixed or variable length. \param read (type in memory, buffer) -> status
template <class Read>
bool read_string(hid_t file_type, Read&& read, std::string& text) {
  if (H5Tis_variable_str(file_type) > 0) {
    const Handle type(H5Tcopy(H5T_C_S1), H5Tclose);
    H5Tset_size(type.id(), H5T_VARIABLE);
    H5Tset_cset(type.id(), H5Tget_cset(file_type));
    char* value = nullptr;
    if (read(type.id(), &value) < 0) return false;
    if (value != nullptr) text = value;
    H5free_memory(value);
    return true;
  }
  text.assign(H5Tget_size(file_type), '\0');
  if (read(file_type, text.data()) < 0) return false;
  text.resize(std::min(text.find('\0'), text.size()));
  return true;
}

}  // namespace

Reader::Reader(std::filesystem::path path) : path_(std::move(path)) {
  silence();
  const Descriptor opened(path_.string(), 0);  // the system's reason is clearer than the library's
  file_ = Handle(H5Fopen(path_.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose);
  if (file_.id() < 0) fail(path_, "is not a whole HDF5 file");
}

Reader::Reader(std::string_view image, std::filesystem::path path) : path_(std::move(path)) {
  silence();
  const Handle access = file_access_in_memory();
  // The library takes a pointer to changeable bytes, and copies them.
  H5Pset_file_image(access.id(), const_cast<char*>(image.data()), image.size());
  file_ = Handle(H5Fopen(unique_name().c_str(), H5F_ACC_RDONLY, access.id()), H5Fclose);
  if (file_.id() < 0) fail(path_, "is not a whole HDF5 file");
}

bool Reader::has(const std::string& name) const {
  silence();
  // Each part of a path must be there before the next is asked for.
  for (std::size_t end = name.find('/', 1);; end = name.find('/', end + 1)) {
    if (H5Lexists(file_.id(), name.substr(0, end).c_str(), H5P_DEFAULT) <= 0) return false;
    if (end == std::string::npos) return true;
  }
}

std::vector<std::string> Reader::names(const std::string& group) const {
  silence();
  std::vector<std::string> names;
  const Handle opened(H5Gopen2(file_.id(), group.c_str(), H5P_DEFAULT), H5Gclose);
  hsize_t index = 0;
  if (opened.id() < 0 || H5Literate(
                             opened.id(), H5_INDEX_NAME, H5_ITER_INC, &index,
                             [](hid_t, const char* name, const H5L_info_t*, void* list) -> herr_t {
                               static_cast<std::vector<std::string>*>(list)->emplace_back(name);
                               return 0;
                             },
                             &names) < 0)
    fail(path_, "cannot list group '" + group + "'");
  return names;
}

Handle Reader::open(const std::string& name) const {
  silence();
  if (!has(name)) throw FileError(path_.string(), "holds no '" + name + "'");
  Handle data(H5Dopen2(file_.id(), name.c_str(), H5P_DEFAULT), H5Dclose);
  if (data.id() < 0) fail(path_, "cannot open '" + name + "'");
  return data;
}

Description Reader::describe(const std::string& name) const {
  const Handle data = open(name);
  const Handle type(H5Dget_type(data.id()), H5Tclose), space(H5Dget_space(data.id()), H5Sclose);
  const int rank = H5Sget_simple_extent_ndims(space.id());
  if (type.id() < 0 || rank < 0) fail(path_, "cannot describe '" + name + "'");
  std::vector<hsize_t> shape(static_cast<std::size_t>(rank));
  H5Sget_simple_extent_dims(space.id(), shape.data(), nullptr);
  const H5T_class_t kind = H5Tget_class(type.id());
  return {.kind = kind == H5T_FLOAT     ? Description::Kind::real
                  : kind == H5T_INTEGER ? Description::Kind::integer
                  : kind == H5T_STRING  ? Description::Kind::text
                                        : Description::Kind::other,
          .shape = std::vector<std::size_t>(shape.begin(), shape.end()),
          .element_bytes = H5Tget_size(type.id()),
          .is_signed = kind == H5T_INTEGER && H5Tget_sign(type.id()) == H5T_SGN_2};
}

void Reader::read_raw(const std::string& name, hid_t type, void* values) const {
  const Handle data = open(name);
  if (H5Dread(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0) fail(path_, "cannot read '" + name + "'");
}

namespace {

std::size_t count(const Description& description) {
  std::size_t product = 1;
  for (const std::size_t extent : description.shape) product *= extent;
  return product;
}

}  // namespace

std::vector<double> Reader::doubles(const std::string& name) const {
  std::vector<double> values(count(describe(name)));
  read_raw(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<Vector3> Reader::vectors(const std::string& name) const {
  const Description description = describe(name);
  if (description.shape.size() != 2 || description.shape[1] != 3)
    throw FileError(path_.string(), "'" + name + "' is not n x 3 numbers");
  std::vector<Vector3> values(description.shape[0]);
  read_raw(name, H5T_NATIVE_DOUBLE, values.data());
  return values;
}

std::vector<std::int64_t> Reader::integers(const std::string& name) const {
  std::vector<std::int64_t> values(count(describe(name)));
  read_raw(name, H5T_NATIVE_INT64, values.data());
  return values;
}

std::uint64_t Reader::number(const std::string& name) const {
  if (!describe(name).shape.empty()) throw FileError(path_.string(), "'" + name + "' is not a single number");
  std::uint64_t value = 0;
  read_raw(name, H5T_NATIVE_UINT64, &value);
  return value;
}

std::string Reader::text(const std::string& name) const {
  const Description description = describe(name);
  if (description.kind != Description::Kind::text || !description.shape.empty())
    throw FileError(path_.string(), "'" + name + "' is not a text");
  const Handle data = open(name), type(H5Dget_type(data.id()), H5Tclose);
  std::string text;
  const auto read = [&](hid_t memory_type, void* buffer) {
    return H5Dread(data.id(), memory_type, H5S_ALL, H5S_ALL, H5P_DEFAULT, buffer);
  };
  if (!read_string(type.id(), read, text)) fail(path_, "cannot read '" + name + "'");
  return text;
}

std::string Reader::text_attribute(const std::string& object, const char* name) const {
  silence();
  if (H5Aexists_by_name(file_.id(), object.c_str(), name, H5P_DEFAULT) <= 0) return {};
  const Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute.id()), H5Tclose), space(H5Aget_space(attribute.id()), H5Sclose);
  std::string text;
  const auto read = [&](hid_t memory_type, void* buffer) { return H5Aread(attribute.id(), memory_type, buffer); };
  if (H5Tget_class(type.id()) != H5T_STRING || H5Sget_simple_extent_npoints(space.id()) != 1 ||
      !read_string(type.id(), read, text))
    fail(path_, "cannot read attribute '" + std::string(name) + "' of '" + object + "'");
  return text;
}

template <class Number>
std::vector<Number> Reader::attribute(const std::string& object, const char* name, hid_t type) const {
  silence();
  if (H5Aexists_by_name(file_.id(), object.c_str(), name, H5P_DEFAULT) <= 0) return {};
  const Handle attribute(H5Aopen_by_name(file_.id(), object.c_str(), name, H5P_DEFAULT, H5P_DEFAULT), H5Aclose);
  const Handle space(H5Aget_space(attribute.id()), H5Sclose);
  std::vector<Number> values(static_cast<std::size_t>(std::max<hssize_t>(H5Sget_simple_extent_npoints(space.id()), 0)));
  if (H5Aread(attribute.id(), type, values.data()) < 0)
    fail(path_, "cannot read attribute '" + std::string(name) + "' of '" + object + "'");
  return values;
}

std::vector<std::int64_t> Reader::integer_attribute(const std::string& object, const char* name) const {
  return attribute<std::int64_t>(object, name, H5T_NATIVE_INT64);
}

std::vector<double> Reader::real_attribute(const std::string& object, const char* name) const {
  return attribute<double>(object, name, H5T_NATIVE_DOUBLE);
}

}  // namespace talus::hdf5
