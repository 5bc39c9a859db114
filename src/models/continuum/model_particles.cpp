// SPDX-License-Identifier: Apache-2.0
/// The particles of the model as observers and files get them: of one process as they are, of several piece by piece.
#include <algorithm>
#include <cstring>

#include "models/continuum/model.hpp"
#include "models/continuum/sector.hpp"
#include "numerics/field.hpp"
#include "numerics/snapshot.hpp"

namespace talus::continuum {

namespace {

constexpr std::size_t piece = std::size_t{1} << 16;  // particles that the first process reads at a time

}  // namespace

std::optional<ColumnSource> Continuum::column_of_all(const FieldInfo& field, ColumnSource::Kind kind,
                                                     std::uint64_t number) const {
  if (ranks_.is_alone()) return std::nullopt;
  return ColumnSource{std::string(field.name), std::string(field.unit), kind,
                      [this, number](std::size_t first, std::size_t count, std::byte* to) {
                        const ColumnPiece wanted{number, first, count};
                        announce_(wanted);
                        workspace_->share.read(state_, wanted, to);
                      }};
}

Snapshot Continuum::snapshot() const {
  Snapshot snapshot;
  if (domain().sector()) {
    if (!whole_) whole_ = whole_of(part());
    snapshot = whole_->view();
    snapshot.domain = &*around_whole_;
  } else {
    snapshot = ranks_.is_alone() ? snapshot_of(state_) : part();
    snapshot.domain = &domain();
  }
  return snapshot;
}

Snapshot Continuum::part() const {
  if (!part_ && ranks_.is_alone()) part_ = part_of(state_, *domain().sector());
  if (!part_) {
    const PointSource all = stored();
    part_ = points_of(all, 0, all.count);
  }
  return part_->view();
}

PointSource Continuum::stored() const {
  const std::optional<Sector>& sector = domain().sector();
  if (ranks_.is_alone()) return source_of(sector ? part() : snapshot());
  PointSource all{state_.time, state_.step, workspace_->share.of_all(state_.position.size()), {}, {}};
  std::uint64_t number = 0;
  std::optional<ColumnSource> turns;
  const auto collect = [&]<class Member>(const FieldInfo& field, const Member&) {
    if constexpr (!std::is_arithmetic_v<Member>) {
      if (!field.of_particles) return;
      ColumnSource column = *column_of_all(field, kind_of<typename Member::value_type>, number++);
      if (field.name == "sector_turns") turns = column;
      if (field.in_snapshots) all.columns.push_back(std::move(column));
    }
  };
  for_each_field(collect, state_);
  if (!sector) return all;
  all.copies = copies_of(state_, *sector);
  for (ColumnSource& column : all.columns)
    if (column.name == "identity")
      column.read = [own = column.read, turns = turns->read, copies = *all.copies](std::size_t first, std::size_t count,
                                                                                   std::byte* to) {
        std::vector<std::int64_t> turned(count), identity(count);
        turns(first, count, reinterpret_cast<std::byte*>(turned.data()));
        own(first, count, reinterpret_cast<std::byte*>(identity.data()));
        for (std::size_t i = 0; i < count; ++i) identity[i] = identity_in_whole(copies, identity[i], turned[i]);
        std::memcpy(to, identity.data(), count * sizeof identity[0]);
      };
  return all;
}

void Continuum::visit(std::span<const std::string> columns, const std::function<void(const Snapshot&)>& take) const {
  if (domain().sector() && !whole_) {
    const PointSet points = whole_of(part(), columns);
    Snapshot some = points.view();
    some.domain = &*around_whole_;
    return take(some);
  }
  if (ranks_.is_alone() || domain().sector()) return take(snapshot());
  const PointSource all = stored();
  std::size_t first = 0;
  do {
    const PointSet points = points_of(all, first, std::min(piece, all.count - first), columns);
    Snapshot some = points.view();
    some.domain = &domain();
    take(some);
    first += piece;
  } while (first < all.count);
}

}  // namespace talus::continuum
