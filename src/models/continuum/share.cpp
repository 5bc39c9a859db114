// SPDX-License-Identifier: Apache-2.0
#include "models/continuum/share.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <tuple>

#include "models/continuum/columns.hpp"

namespace talus::continuum {

namespace {

constexpr double uneven = 1.05;             // most work of a process over the mean, at which space is cut again
constexpr std::size_t asked_together = 32;  // particles

/// The kept columns of particles as rows of words of 8 bytes.
class Rows {
 public:
  /// \pre every column has an entry for each particle
  explicit Rows(State& state) {
    for_each_field(
        [&]<class Member>(const FieldInfo& field, Member& column) {
          if constexpr (!std::is_arithmetic_v<Member>)
            if (field.of_particles && field.role == FieldRole::kept) add(column);
        },
        state);
  }
  template <class T>
  void add(std::vector<T>& column) {
    columns_.push_back(Halo::column(std::span(column)));
    width_ += columns_.back().words;
  }
  std::size_t width() const { return width_; }

  /// The rows of particles, one after the other.
  std::vector<std::uint64_t> of(const std::vector<std::uint32_t>& particles) const {
    std::vector<std::uint64_t> rows(width_ * particles.size());
    for (std::size_t n = 0; n < particles.size(); ++n) {
      std::uint64_t* to = rows.data() + width_ * n;
      for (const Halo::Column& column : columns_) {
        std::memcpy(to, column.data + 8 * column.words * particles[n], 8 * column.words);
        to += column.words;
      }
    }
    return rows;
  }
  /// Writes row n of these to a particle.
  void put(const std::vector<std::uint64_t>& rows, std::size_t n, std::size_t particle) const {
    const std::uint64_t* from = rows.data() + width_ * n;
    for (const Halo::Column& column : columns_) {
      std::memcpy(column.data + 8 * column.words * particle, from, 8 * column.words);
      from += column.words;
    }
  }

  /// Gives every column the entries of these particles, as many as there are at most, in their order.
  void take(const std::vector<std::uint32_t>& order) const {
    std::vector<std::uint64_t> taken;
    for (const Halo::Column& column : columns_) {
      taken.resize(column.words * order.size());
      for (std::size_t n = 0; n < order.size(); ++n)
        std::memcpy(taken.data() + column.words * n, column.data + 8 * column.words * order[n], 8 * column.words);
      std::memcpy(column.data, taken.data(), 8 * taken.size());
    }
  }

 private:
  std::vector<Halo::Column> columns_;
  std::size_t width_ = 0;
};

/// Gives every column room for so many particles. \returns their rows
Rows rows_for(State& s, std::vector<std::int64_t>& place, std::span<std::vector<double>* const> carried,
              std::size_t count) {
  resize_columns(s, count);
  place.resize(count);
  for (std::vector<double>* const column : carried) column->resize(count);
  Rows rows(s);
  rows.add(place);
  for (std::vector<double>* const column : carried) rows.add(*column);
  return rows;
}

}  // namespace

void Share::begin(State& s) {
  if (is_all()) return;
  const auto tell = [&]<class Member>(const FieldInfo& field, Member& member) {
    if constexpr (std::is_arithmetic_v<Member>)
      member = ranks_.value_from_first(member);
    else if (!field.of_particles)
      ranks_.from_first(std::as_writable_bytes(std::span(member)));
  };
  for_each_field(tell, s);
  const std::vector<std::uint64_t> counts = ranks_.gather_values(std::vector{std::uint64_t{s.position.size()}});
  count_ = std::accumulate(counts.begin(), counts.end(), std::size_t{0});
  const auto before = std::accumulate(counts.begin(), counts.begin() + ranks_.rank(), std::int64_t{0});
  if (!ranks_.is_first()) s.wall_loads.window_push.clear(), s.wall_loads.window_received.clear();
  place_.resize(s.position.size());
  std::iota(place_.begin(), place_.end(), before);
}

void Share::weigh(std::size_t pairs) {
  constexpr std::size_t besides = 50;  // pairs, as which the rest of a particle's step counts: about half of it
  if (own_ > 0) work_ = 1000 * (pairs + besides * own_) / own_;
}

void Share::cut(std::span<const Vector3> points) {
  if (!partition_) partition_ = ranks_.partition();
  partition_->cut(points, std::vector<double>(points.size(), static_cast<double>(work_)));
}

/// Whose the particles will be.
std::vector<int> Share::owners(const State& s) {
  const auto size = static_cast<std::size_t>(ranks_.size());
  const std::size_t here = s.list_position.size();
  std::vector<int> owner(here, ranks_.rank());
  if (count_ == 0) return owner;
  std::uint64_t least = 0, most = 0;  // particles of a process
  const bool are_at_start = least_owned_ > most_owned_;
  const auto note = [&] {
    least_owned_ = std::min(least_owned_, least), most_owned_ = std::max(most_owned_, most);
    if (!are_at_start) moved_ += here - static_cast<std::size_t>(std::count(owner.begin(), owner.end(), ranks_.rank()));
  };
  // Finds the owners. The particles of each process, then their work. Returns the largest work over the mean.
  const auto assign = [&] {
    Votes votes{.least = {}, .largest = {}, .sum = std::vector<std::uint64_t>(2 * size, 0)};
    for (std::size_t i = 0; i < here; ++i)
      ++votes.sum[static_cast<std::size_t>(owner[i] = partition_->rank_of(s.list_position[i]))];
    for (std::size_t r = 0; r < size; ++r) votes.sum[size + r] = work_ * votes.sum[r];
    ranks_.join(votes);
    const auto works = votes.sum.begin() + static_cast<std::ptrdiff_t>(size);
    least = *std::min_element(votes.sum.begin(), works), most = *std::max_element(votes.sum.begin(), works);
    return static_cast<double>(*std::max_element(works, votes.sum.end()) * size) /
           static_cast<double>(std::accumulate(works, votes.sum.end(), std::uint64_t{0}));
  };
  if (partition_ && assign() <= uneven) return note(), owner;
  cut(s.list_position);
  assign();
  note();
  return owner;
}

/// Sends rows of particles, and puts what comes behind those that are here. \param stay who is; null: all
std::unique_ptr<Plan> Share::send(State& s, std::span<std::vector<double>* const> carried, const ByRank& to,
                                  const std::vector<std::uint32_t>* stay) {
  Rows rows = rows_for(s, place_, carried, place_.size());
  std::unique_ptr<Plan> plan = ranks_.plan(to.counts());
  std::vector<std::uint64_t> got(rows.width() * plan->received());
  {
    const std::vector<std::uint64_t> going = rows.of(to.all());
    if (stay && stay->size() < place_.size()) rows.take(*stay), rows_for(s, place_, carried, stay->size());
    plan->exchange(going.data(), rows.width(), got.data());
  }
  const std::size_t before = place_.size();
  rows = rows_for(s, place_, carried, before + plan->received());
  for (std::size_t n = 0; n < plan->received(); ++n) rows.put(got, n, before + n);
  return plan;
}

void Share::bring(State& s, const std::function<std::optional<Vector3>(std::size_t)>& where) {
  if (is_all() || count_ == 0) return;
  const Stopwatch watch(time_.sharing);
  if (!partition_) cut(s.position);
  ByRank leaving(ranks_);
  std::vector<std::uint32_t> stay;
  for (std::size_t i = 0; i < place_.size(); ++i) {
    const std::optional<Vector3> x = where(i);
    const int rank = x ? partition_->rank_of(*x) : ranks_.rank();
    rank == ranks_.rank() ? stay.push_back(static_cast<std::uint32_t>(i)) : leaving.add(rank, i);
  }
  if (sum_of(ranks_, place_.size() - stay.size()) == 0) return;
  send(s, {}, leaving, &stay);
  rows_for(s, place_, {}, place_.size()).take(by_place(stay.size()));
}

void Share::distribute(State& s, const Domain& domain, std::span<std::vector<double>* const> carried) {
  if (is_all()) return;
  const Stopwatch watch(time_.sharing);
  resize_columns(s, place_.size());
  Votes votes{.least = {}, .largest = {0, 0}, .sum = {}};
  for (std::size_t i = 0; i < place_.size(); ++i) {
    votes.largest[0] = std::max(votes.largest[0], 2 * (s.list_smoothing_length[i] + s.list_margin[i]));
    votes.largest[1] = std::max(votes.largest[1], s.list_margin[i]);
  }
  ranks_.join(votes);
  reach_ = votes.largest[0], margin_ = votes.largest[1];

  ByRank leaving(ranks_);
  std::vector<std::uint32_t> stay;
  const std::vector<int> owner = owners(s);
  for (std::size_t i = 0; i < owner.size(); ++i)
    owner[i] == ranks_.rank() ? stay.push_back(static_cast<std::uint32_t>(i)) : leaving.add(owner[i], i);
  send(s, carried, leaving, &stay);
  own_ = place_.size();

  const ByRank copied = halo_of_others(s, domain);
  std::unique_ptr<Plan> plan = send(s, carried, copied, nullptr);
  const std::vector<std::uint32_t> order = by_place(own_);
  rows_for(s, place_, carried, place_.size()).take(order);
  std::vector<std::uint32_t> number(order.size()), sent = copied.all(), received;
  for (std::size_t n = 0; n < order.size(); ++n) number[order[n]] = static_cast<std::uint32_t>(n);
  for (std::uint32_t& n : sent) n = number[n];
  received.assign(number.begin() + static_cast<std::ptrdiff_t>(own_), number.end());
  is_halo_.assign(number.size(), 0);
  for (const std::uint32_t n : received) is_halo_[n] = 1;
  halo_ = Halo(std::move(plan), std::move(sent), std::move(received));
}

/// Which of the particles others may list: those whose parts of space meet the box that a particle reaches, or the box
/// of one of its images. Particles whose numbers follow each other are mostly near each other too: where the box around
/// all that some of them reach meets no other part, none of them is asked for.
ByRank Share::halo_of_others(const State& s, const Domain& domain) const {
  ByRank copied(ranks_);
  const std::vector<Image> images = domain.images(reach_);
  std::vector<int> near;
  constexpr double rounding = 1 + 1e-9;
  const auto ranks_around = [&](const Vector3& low, const Vector3& high, double reach) -> const std::vector<int>& {
    const Vector3 half{rounding * reach, rounding * reach, rounding * reach};
    partition_->ranks_of(low - half, high + half, near);
    return near;
  };
  const auto ask = [&](std::size_t i, const Vector3& x) {
    for (const int rank : ranks_around(x, x, s.list_smoothing_length[i] + s.list_margin[i] + 0.5 * reach_))
      if (rank != ranks_.rank()) copied.add(rank, i);
  };
  for (std::size_t begin = 0, end = 0; begin < place_.size(); begin = end) {
    end = std::min(place_.size(), begin + asked_together);
    Vector3 low = s.list_position[begin], high = low;
    for (std::size_t i = begin; i < end; ++i)
      for (int axis = 0; axis < 3; ++axis)
        low[axis] = std::min(low[axis], s.list_position[i][axis]),
        high[axis] = std::max(high[axis], s.list_position[i][axis]);
    const Vector3 centre = 0.5 * (low + high);
    const double radius = 0.5 * norm(high - low);
    if (ranks_around(low, high, reach_).size() > 1)
      for (std::size_t i = begin; i < end; ++i) ask(i, s.list_position[i]);
    for (const Image& image : images) {
      if (!domain.is_near(image, image.position(centre), rounding * (reach_ + radius))) continue;
      for (std::size_t i = begin; i < end; ++i) {
        const Vector3 x = image.position(s.list_position[i]);
        if (domain.is_near(image, x, 0.5 * reach_ + s.list_smoothing_length[i] + s.list_margin[i])) ask(i, x);
      }
    }
  }
  for (auto& particles : copied.of) {  // once each, whichever of its images asked too
    std::sort(particles.begin(), particles.end());
    particles.erase(std::unique(particles.begin(), particles.end()), particles.end());
  }
  return copied;
}

void Share::keep_owned(std::vector<double>& column) const {
  if (is_halo_.empty()) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < column.size(); ++i)
    if (owns(i)) column[kept++] = column[i];
  column.resize(kept);
}

bool Share::drop_halo(State& s) {
  if (is_halo_.empty()) return false;
  const Stopwatch watch(time_.sharing);
  std::vector<std::uint32_t> owned;
  for (std::size_t i = 0; i < place_.size(); ++i)
    if (owns(i)) owned.push_back(static_cast<std::uint32_t>(i));
  select(s, owned);
  for (std::size_t n = 0; n < owned.size(); ++n) place_[n] = place_[owned[n]];
  place_.resize(owned.size());
  is_halo_.clear();
  halo_ = {};
  return true;
}

void Share::read(const State& s, const ColumnPiece& piece, std::byte* to) const {
  const std::byte* data = nullptr;
  std::size_t bytes = 0, number = 0;
  const auto find = [&]<class Member>(const FieldInfo& field, const Member& column) {
    if constexpr (!std::is_arithmetic_v<Member>)
      if (field.of_particles && number++ == piece.column)
        data = reinterpret_cast<const std::byte*>(column.data()), bytes = sizeof(column[0]);
  };
  for_each_field(find, s);
  const auto from = static_cast<std::int64_t>(piece.first), until = from + static_cast<std::int64_t>(piece.count);
  std::string own;
  for (auto at = std::lower_bound(place_.begin(), place_.end(), from); at != place_.end() && *at < until; ++at) {
    const auto i = static_cast<std::size_t>(at - place_.begin());
    if (!owns(i)) continue;
    own.append(reinterpret_cast<const char*>(&*at), sizeof *at);
    own.append(reinterpret_cast<const char*>(data + bytes * i), bytes);
  }
  const std::string all = ranks_.gather_at_first(own);
  for (std::size_t at = 0; at < all.size(); at += sizeof(std::int64_t) + bytes) {
    std::int64_t place = 0;
    std::memcpy(&place, all.data() + at, sizeof place);
    std::memcpy(to + bytes * static_cast<std::size_t>(place - from), all.data() + at + sizeof place, bytes);
  }
}

void Share::collect_window(WallLoads& loads) const {
  join_window(loads);
  if (ranks_.is_first()) return;
  loads.window_push.clear();
  loads.window_received.clear();
}

void Share::add_later(std::vector<FixedVector> sums, std::function<void(std::span<const FixedVector>)> add) {
  if (is_all())
    add(sums);
  else
    waiting_.push_back({std::move(sums), std::move(add)});
}

double Share::place_of(std::optional<std::size_t> here) const {
  return !here ? std::numeric_limits<double>::infinity() : is_all() ? 0 : static_cast<double>(place_[*here]);
}

NumericalError::Report Share::told_by(double first, std::optional<std::size_t> here,
                                      const std::function<NumericalError::Report(std::size_t)>& report) const {
  return report_of_one(ranks_, here && place_of(here) == first ? report(*here) : NumericalError::Report{});
}

NumericalError::Report Share::report_of_first(std::optional<std::size_t> here,
                                              const std::function<NumericalError::Report(std::size_t)>& report) const {
  Votes votes{.least = {place_of(here)}, .largest = {}, .sum = {}};
  vote(votes);
  return told_by(votes.least[0], here, report);
}

void Share::join(const State& s, Votes& votes, std::optional<std::size_t> here,
                 const std::function<NumericalError::Report(std::size_t)>& report) {
  votes.least.push_back(place_of(here));
  std::vector<FixedVector> sums;
  for (const Waiting& some : waiting_) sums.insert(sums.end(), some.sums.begin(), some.sums.end());
  {
    const Stopwatch watch(time_.messages);
    talus::join(ranks_, votes, sums);
  }
  std::span<const FixedVector> rest = sums;
  for (const Waiting& some : waiting_) {
    some.add(rest.first(some.sums.size()));
    rest = rest.subspan(some.sums.size());
  }
  waiting_.clear();
  const double first = votes.least.back();
  votes.least.pop_back();
  if (std::isinf(first)) return;
  NumericalError::Report of_first = told_by(first, here, report);
  of_first.step = s.step;
  of_first.time = s.time;
  throw NumericalError(of_first);
}

std::string Share::account(std::size_t pairs) const {
  const double owned = static_cast<double>(place_.size() - halo_.received());
  const double copies = static_cast<double>(halo_.received()), size = ranks_.size();
  Votes votes{.least = {},
              .largest = {copies / std::max(1.0, owned), static_cast<double>(pairs)},
              .sum = {halo_.received(), pairs, moved_}};
  for (const double part : {time_.messages, time_.sharing, time_.air})
    votes.sum.push_back(static_cast<std::uint64_t>(std::lround(1e6 * part / std::max(1e-9, time_.steps))));
  ranks_.join(votes);
  const auto sum = [&](std::size_t n) { return static_cast<double>(votes.sum[n]); };
  const double count = static_cast<double>(std::max<std::size_t>(count_, 1));
  const auto percent = [&](std::size_t n) { return 1e-4 * sum(n) / size; };
  return fmt::format(
      "{} processes: each owned {:.1f} to {:.1f} % of the particles, copies of others are {:.1f} % of them (of one "
      "{:.1f} %), {} changed their process; of a step messages take {:.1f} %, migration and halos {:.1f} %, the "
      "air {:.1f} %; the longest lists are {:.2f} of the mean",
      size, 100 * static_cast<double>(std::min(least_owned_, most_owned_)) / count,
      100 * static_cast<double>(most_owned_) / count, 100 * sum(0) / count, 100 * votes.largest[0], votes.sum[2],
      percent(3), percent(4), percent(5), votes.largest[1] * size / std::max(1.0, sum(1)));
}

void Share::join_window(WallLoads& loads) const {
  sum_up(ranks_, loads.window_push);
  sum_up(ranks_, loads.window_received);
}

}  // namespace talus::continuum
