// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/gas/cell_exchange.hpp"

#include <algorithm>
#include <array>

namespace talus::continuum {

namespace {

// Planes of cells around those of the particles, so that they may move without new plans, and the most that are kept.
constexpr std::size_t room = 2, most_room = 8;

std::vector<RowRange> two(std::vector<RowRange> slabs) {
  slabs.resize(2);
  return slabs;
}

}  // namespace

CellExchange::CellExchange(const Grid& grid, const air::Part& part)
    : grid_(grid), part_(part), known_(part.ranks.gather_values(two(part.known))) {
  plan();
}

void CellExchange::find_rows(const coupling::Deposition& deposition) {
  const std::array<std::size_t, 2> cells = deposition.rows();
  const auto row_of = [&](std::size_t cell) {
    const std::size_t row = cell / grid_.length(0), m = Grid::margin;
    return row % grid_.length(1) - m + static_cast<std::size_t>(grid_.count[1]) * (row / grid_.length(1) - m);
  };
  const RowRange now = cells[0] > cells[1] ? RowRange{} : RowRange{row_of(cells[0]), row_of(cells[1]) + 1};
  const std::size_t plane = static_cast<std::size_t>(grid_.count[1]);
  const bool fits = now.size() == 0 || (touched_.begin <= now.begin && now.end <= touched_.end &&
                                        touched_.size() <= now.size() + 2 * most_room * plane);
  if (all_of(part_.ranks, fits)) return;
  touched_ = now;
  if (now.size() > 0)
    touched_ = {now.begin - std::min(now.begin, room * plane), std::min(part_.all.front().end, now.end + room * plane)};
  plan();
}

void CellExchange::plan() {
  const Ranks& ranks = part_.ranks;
  const std::vector<RowRange> touched = ranks.gather_values(std::vector{touched_});
  const auto add = [&](const RowRange& of_particles, int owner, std::vector<std::uint32_t>& rows) {
    for (const RowRange& known : std::span(known_).subspan(2 * static_cast<std::size_t>(owner), 2))
      for (std::size_t row = std::max(known.begin, of_particles.begin); row < std::min(known.end, of_particles.end);
           ++row)
        rows.push_back(static_cast<std::uint32_t>(
            grid_.row(static_cast<int>(row) % grid_.count[1], static_cast<int>(row) / grid_.count[1])));
  };
  sent_.clear(), received_.clear();
  std::vector<std::size_t> counts;
  for (int rank = 0; rank < ranks.size(); ++rank) {
    const std::size_t before = sent_.size();
    if (rank != ranks.rank()) {
      add(touched_, rank, sent_);
      add(touched[static_cast<std::size_t>(rank)], ranks.rank(), received_);
    }
    counts.push_back(sent_.size() - before);
  }
  deposits_ = ranks.plan(counts);
  fields_ = part_.halo(std::span(&touched_, 1));
}

void CellExchange::add_up(air::Solids& solids) {
  const std::array<CellField*, 4> fields{&solids.fraction, &solids.flux[0], &solids.flux[1], &solids.flux[2]};
  const std::size_t length = grid_.length(0), words = fields.size() * length;
  going_.resize(words * sent_.size());
  coming_.resize(words * received_.size());
  for (std::size_t n = 0; n < sent_.size(); ++n)
    for (std::size_t f = 0; f < fields.size(); ++f)
      std::copy_n(fields[f]->data() + length * sent_[n], length, going_.data() + words * n + length * f);
  deposits_->exchange(going_.data(), words, coming_.data());
  for (std::size_t n = 0; n < received_.size(); ++n)
    for (std::size_t f = 0; f < fields.size(); ++f) {
      const double* from = coming_.data() + words * n + length * f;
      double* to = fields[f]->data() + length * received_[n];
      for (std::size_t i = 0; i < length; ++i) to[i] += from[i];
    }
}

void CellExchange::bring(std::span<CellField* const> fields) {
  std::vector<Halo::Column> columns;
  for (CellField* const field : fields) columns.push_back(air::rows_of(grid_, *field));
  fields_.refresh(columns);
}

}  // namespace talus::continuum
