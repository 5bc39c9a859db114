// SPDX-License-Identifier: Apache-2.0
#include "io/checkpoint.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>

#include "base/error.hpp"
#include "io/file.hpp"

namespace talus {

namespace {

constexpr int checkpoint_format = 1;
constexpr std::size_t user_block = 512;  // HDF5 looks for its signature at 0, 512, 1024, ...

/// Of the lines before it and what stands behind the user block.
std::string checksum_line(std::uint32_t sum) {
  return fmt::format("crc32 {:08x}\n", sum);
}

/// The lines before the checksum.
std::string head_of(std::uint64_t sequence, std::size_t bytes) {
  return fmt::format("Talus checkpoint\nformat {}\nsequence {}\nbytes {}\n", checkpoint_format, sequence, bytes);
}

/// Takes `key` and a number off the front of `text`.
std::optional<std::uint64_t> take_number(std::string_view& text, std::string_view key) {
  std::uint64_t value = 0;
  if (!text.starts_with(key)) return {};
  text.remove_prefix(key.size());
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || stop == text.data() + text.size() || *stop != '\n') return {};
  text.remove_prefix(static_cast<std::size_t>(stop + 1 - text.data()));
  return value;
}

/// \returns the sequence number of a whole checkpoint; nothing if it is damaged, `damage` then says how
/// \throws FileError if it cannot be read
std::optional<std::uint64_t> verify(const std::filesystem::path& path, std::string& damage) {
  Descriptor file(path.string(), O_RDONLY);
  std::array<char, user_block> front{};
  std::size_t length = 0;
  while (const std::size_t got = file.read_some(front.data() + length, user_block - length)) length += got;
  std::string_view rest(front.data(), length);
  const auto damaged = [&](std::string what) {
    damage = std::move(what);
    return std::nullopt;
  };
  constexpr std::string_view title = "Talus checkpoint\n";
  if (!rest.starts_with(title)) return damaged("does not begin like a checkpoint");
  rest.remove_prefix(title.size());
  const auto found_format = take_number(rest, "format ");
  if (found_format && *found_format != checkpoint_format)
    return damaged(fmt::format("has format {}, this program reads {}", *found_format, checkpoint_format));
  const auto sequence = take_number(rest, "sequence ");
  const auto bytes = take_number(rest, "bytes ");
  if (!found_format || !sequence || !bytes) return damaged("its first lines are damaged");
  std::uint32_t sum = checksum(head_of(*sequence, *bytes));
  std::array<char, 1 << 16> buffer;
  while (const std::size_t got = file.read_some(buffer.data(), buffer.size()))
    sum = checksum({buffer.data(), got}, sum), length += got;
  if (length != user_block + *bytes)
    return damaged(fmt::format("is {} bytes long in place of {}", length, user_block + *bytes));
  if (!rest.starts_with(checksum_line(sum))) return damaged("does not have the checksum that was written with it");
  return sequence;
}

/// Which of the two is the newest whole one.
std::optional<std::size_t> newest(const std::array<std::optional<std::uint64_t>, 2>& sequences) {
  if (!sequences[0] && !sequences[1]) return {};
  return sequences[1] > sequences[0] ? 1 : 0;  // no sequence number is less than any
}

}  // namespace

CheckpointWriter::CheckpointWriter(std::string_view fingerprint) : file_("checkpoint") {
  file_.write("fingerprint", fingerprint);
}

void CheckpointWriter::column(std::size_t count, ColumnSource source) {
  const std::string name = "state/" + source.name;
  file_.write(name, count, std::move(source));
}

void CheckpointWriter::put(const std::string& name, const std::vector<double>& values, std::string_view unit) {
  file_.write(name, std::span(values), unit);
}
void CheckpointWriter::put(const std::string& name, const std::vector<Vector3>& values, std::string_view unit) {
  file_.write(name, std::span(values), unit);
}
void CheckpointWriter::put(const std::string& name, const std::vector<std::int64_t>& values, std::string_view unit) {
  file_.write(name, std::span(values), unit);
}
void CheckpointWriter::put(const std::string& name, double value, std::string_view unit) {
  file_.write(name, value, unit);
}
void CheckpointWriter::put(const std::string& name, std::uint64_t value, std::string_view unit) {
  file_.write(name, value, unit);
}
void CheckpointWriter::put(const std::string& name, const std::string& text) {
  file_.write(name, std::string_view(text));
}

namespace {

using Kind = hdf5::Description::Kind;

/// \throws FileError if an entry is not of this kind and shape
void expect(const hdf5::Reader& file, const std::string& name, Kind kind, std::size_t rank, std::size_t components) {
  const hdf5::Description found = file.describe(name);
  if (found.kind != kind || found.shape.size() != rank || found.components() != components)
    throw FileError(file.path().string(), "'" + name + "' is of another kind than this program keeps");
}

}  // namespace

CheckpointReader::CheckpointReader(hdf5::Reader file, std::uint64_t sequence)
    : file_(std::move(file)), sequence_(sequence), fingerprint_(file_.text("fingerprint")) {}

void CheckpointReader::get(const std::string& name, std::vector<double>& values,
                           std::optional<hdf5::Entries> some) const {
  expect(file_, name, Kind::real, 1, 1);
  values = file_.doubles(name, some);
}
void CheckpointReader::get(const std::string& name, std::vector<Vector3>& values,
                           std::optional<hdf5::Entries> some) const {
  expect(file_, name, Kind::real, 2, 3);
  values = file_.vectors(name, some);
}
void CheckpointReader::get(const std::string& name, std::vector<std::int64_t>& values,
                           std::optional<hdf5::Entries> some) const {
  expect(file_, name, Kind::integer, 1, 1);
  values = file_.integers(name, some);
}
void CheckpointReader::get(const std::string& name, double& value) const {
  expect(file_, name, Kind::real, 0, 1);
  value = file_.doubles(name)[0];
}
void CheckpointReader::get(const std::string& name, std::uint64_t& value) const {
  expect(file_, name, Kind::integer, 0, 1);
  value = file_.number(name);
}
void CheckpointReader::get(const std::string& name, std::string& text) const {
  text = file_.text(name);
}

CheckpointFiles::CheckpointFiles(std::filesystem::path folder) : folder_(std::move(folder)) {
  for (std::size_t i = 0; i < names.size(); ++i) {
    const std::filesystem::path path = folder_ / names[i];
    std::error_code error;
    const bool exists = std::filesystem::exists(path, error);
    if (error) throw FileError(path.string(), "cannot look for it: " + error.message());
    if (!exists) continue;
    std::string damage;
    sequences_[i] = verify(path, damage);
    if (!damage.empty()) damages_.push_back(path.string() + ": " + damage);
  }
}

void CheckpointFiles::save(const CheckpointWriter& checkpoint) {
  const std::optional<std::size_t> latest = newest(sequences_);
  const std::size_t target = latest ? 1 - *latest : 0;
  const std::uint64_t sequence = latest ? *sequences_[*latest] + 1 : 1;
  const std::string head = head_of(sequence, checkpoint.file_.bytes());
  write_atomically(folder_ / names[target], [&](Descriptor& file) {
    file.write(std::string(user_block, '\0'));
    std::uint32_t sum = checksum(head);
    checkpoint.file_.each_piece([&](std::string_view piece) {
      sum = checksum(piece, sum);
      file.write(piece);
    });
    file.write_at(0, head + checksum_line(sum));
  });
  sequences_[target] = sequence;
}

std::optional<CheckpointReader> CheckpointFiles::load() const {
  const std::optional<std::size_t> latest = newest(sequences_);
  if (!latest) {
    if (damages_.empty()) return {};
    throw FileError(folder_.string(), fmt::format("holds no whole checkpoint: {}", fmt::join(damages_, "; ")));
  }
  return CheckpointReader(hdf5::Reader(folder_ / names[*latest]), *sequences_[*latest]);
}

}  // namespace talus
