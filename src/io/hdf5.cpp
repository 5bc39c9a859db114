// SPDX-License-Identifier: Apache-2.0
#include <algorithm>
#include <array>
#include <cstdio>

#include "base/error.hpp"
#include "io/file.hpp"
#include "io/hdf5.hpp"

namespace talus::hdf5 {

namespace {

constexpr std::size_t piece = std::size_t{1} << 20;  // bytes at a time, of a file's way to the disk

/// Handles close what they opened. A file for which the memory had no room the library would try to close once more at
/// the end of the program, and crash.
[[maybe_unused]] const herr_t without_cleanup = H5dont_atexit();

/// Keeps the library from printing its stack of errors. The setting is each thread's own, so every member of Reader and
/// Writer begins with it.
void silence() {
  H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
}

/// \throws FileError with the library's own account of what failed, from the call in which it began
[[noreturn]] void fail(const std::filesystem::path& path, const std::string& what) {
  std::string reason = "HDF5 gives no reason";
  H5Ewalk2(
      H5E_DEFAULT, H5E_WALK_UPWARD,
      [](unsigned depth, const H5E_error2_t* error, void* text) -> herr_t {
        if (depth == 0) *static_cast<std::string*>(text) = error->desc;
        return 0;
      },
      &reason);
  throw FileError(path.string(), what + ": " + reason);
}

constexpr hsize_t deflated_piece = 1 << 14;  // entries

static_assert(sizeof(Vector3) == 3 * sizeof(double), "columns of vectors are written as n x 3 doubles");

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

Writer::Writer(std::filesystem::path path, Storage storage) : path_(std::move(path)), storage_(storage) {
  silence();
  std::string name;
  memory_ = Descriptor::in_memory(name, path_.string());
  file_ = Handle(H5Fcreate(name.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT), H5Fclose);
  std::remove(name.c_str());
  if (file_.id() < 0) fail(path_, "cannot be built in memory");
}

void Writer::group(const std::string& name) {
  silence();
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.id(), 1);
  const Handle group(H5Gcreate2(file_.id(), name.c_str(), link.id(), H5P_DEFAULT, H5P_DEFAULT), H5Gclose);
  if (group.id() < 0) fail(path_, "cannot make group '" + name + "'");
}

Handle Writer::write_raw(const std::string& name, hid_t type, std::span<const hsize_t> shape, const void* values,
                         std::string_view unit) {
  silence();
  const Handle link(H5Pcreate(H5P_LINK_CREATE), H5Pclose);
  H5Pset_create_intermediate_group(link.id(), 1);
  const Handle creation(H5Pcreate(H5P_DATASET_CREATE), H5Pclose);
  H5Pset_obj_track_times(creation.id(), false);
  if (storage_ == Storage::deflated && !shape.empty() && shape[0] > deflated_piece) {
    std::vector<hsize_t> chunk(shape.begin(), shape.end());
    chunk[0] = deflated_piece;
    H5Pset_chunk(creation.id(), static_cast<int>(chunk.size()), chunk.data());
    H5Pset_shuffle(creation.id());
    H5Pset_deflate(creation.id(), 1);
  } else {
    // Room for what comes later.
    H5Pset_alloc_time(creation.id(), H5D_ALLOC_TIME_EARLY);
    H5Pset_fill_time(creation.id(), H5D_FILL_TIME_NEVER);
  }
  const Handle space = dataspace(shape);
  Handle data(H5Dcreate2(file_.id(), name.c_str(), type, space.id(), link.id(), creation.id(), H5P_DEFAULT), H5Dclose);
  const bool none = values == nullptr || std::find(shape.begin(), shape.end(), hsize_t{0}) != shape.end();
  if (data.id() < 0 || (!none && H5Dwrite(data.id(), type, H5S_ALL, H5S_ALL, H5P_DEFAULT, values) < 0))
    fail(path_, "cannot write '" + name + "'");
  if (!unit.empty()) attribute(name, "units", unit);
  return data;
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

void Writer::write(const std::string& name, std::size_t count, ColumnSource source) {
  using Kind = ColumnSource::Kind;
  const hid_t type = source.kind == Kind::integer ? H5T_NATIVE_INT64
                     : source.kind == Kind::byte  ? H5T_NATIVE_UINT8
                                                  : H5T_NATIVE_DOUBLE;
  const std::array<hsize_t, 2> both{count, 3};
  const std::span shape = std::span(both).first(source.kind == Kind::vector ? 2 : 1);
  if (storage_ == Storage::deflated) {
    std::vector<std::byte> values(count * source.entry_bytes());
    source.read(0, count, values.data());
    write_raw(name, type, shape, values.data(), source.unit);
    return;
  }
  const Handle data = write_raw(name, type, shape, nullptr, source.unit);
  if (count == 0) return;
  const haddr_t at = H5Dget_offset(data.id());
  if (at == HADDR_UNDEF) fail(path_, "has no room for '" + name + "'");
  later_.push_back({static_cast<std::size_t>(at), count, std::move(source)});
}

std::size_t Writer::bytes() const {
  silence();
  hsize_t size = 0;
  if (H5Fflush(file_.id(), H5F_SCOPE_LOCAL) < 0 || H5Fget_filesize(file_.id(), &size) < 0 || size == 0)
    fail(path_, "cannot be built in memory");
  return size;
}

void Writer::each_piece(const std::function<void(std::string_view)>& take) const {
  const std::size_t end = bytes();
  std::string buffer(piece, '\0');
  std::size_t at = 0;
  const auto built_until = [&](std::size_t until) {
    for (std::size_t count; at < until; at += count) {
      count = std::min(piece, until - at);
      memory_.read_at(at, buffer.data(), count);
      take(std::string_view(buffer).substr(0, count));
    }
  };
  std::vector<const Later*> in_order;
  for (const Later& later : later_) in_order.push_back(&later);
  std::sort(in_order.begin(), in_order.end(), [](const Later* a, const Later* b) { return a->at < b->at; });
  for (const Later* const later : in_order) {
    built_until(later->at);
    const std::size_t each = later->source.entry_bytes(), most = piece / each;
    for (std::size_t first = 0; first < later->count; first += most) {
      const std::size_t count = std::min(most, later->count - first);
      later->source.read(first, count, reinterpret_cast<std::byte*>(buffer.data()));
      take(std::string_view(buffer).substr(0, count * each));
    }
    at = later->at + later->count * each;
  }
  built_until(end);
}

void Writer::save() const {
  write_atomically(path_, [&](Descriptor& file) { each_piece([&](std::string_view bytes) { file.write(bytes); }); });
}

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

void Reader::read_raw(const std::string& name, hid_t type, void* values, std::optional<Entries> some) const {
  const Handle data = open(name), space(H5Dget_space(data.id()), H5Sclose);
  Handle memory;
  if (some) {
    const Description description = describe(name);
    std::vector<hsize_t> first(description.shape.size(), 0), count(description.shape.begin(), description.shape.end());
    first.at(0) = some->first, count.at(0) = some->count;
    memory = dataspace(count);
    if (H5Sselect_hyperslab(space.id(), H5S_SELECT_SET, first.data(), nullptr, count.data(), nullptr) < 0)
      fail(path_, "cannot read '" + name + "'");
  }
  if (H5Dread(data.id(), type, some ? memory.id() : H5S_ALL, some ? space.id() : H5S_ALL, H5P_DEFAULT, values) < 0)
    fail(path_, "cannot read '" + name + "'");
}

template <class Entry>
std::vector<Entry> Reader::read(const std::string& name, hid_t type, std::optional<Entries> some) const {
  std::size_t count = sizeof(double);
  for (const std::size_t extent : describe(name).shape) count *= extent;
  std::vector<Entry> values(some ? some->count : count / sizeof(Entry));
  if (!some || some->count > 0) read_raw(name, type, values.data(), some);
  return values;
}

std::vector<double> Reader::doubles(const std::string& name, std::optional<Entries> some) const {
  return read<double>(name, H5T_NATIVE_DOUBLE, some);
}

std::vector<Vector3> Reader::vectors(const std::string& name, std::optional<Entries> some) const {
  const Description description = describe(name);
  if (description.shape.size() != 2 || description.shape[1] != 3)
    throw FileError(path_.string(), "'" + name + "' is not n x 3 numbers");
  return read<Vector3>(name, H5T_NATIVE_DOUBLE, some);
}

std::vector<std::int64_t> Reader::integers(const std::string& name, std::optional<Entries> some) const {
  return read<std::int64_t>(name, H5T_NATIVE_INT64, some);
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
