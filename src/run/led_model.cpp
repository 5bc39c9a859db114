// SPDX-License-Identifier: Apache-2.0
#include "run/led_model.hpp"

#include <utility>

#include "base/text.hpp"

namespace talus::run {

Followers::~Followers() {
  if (!have_left_) ranks_.value_from_first(Order::leave);
}

namespace {

/// Reads the share of this process in the particles of a checkpoint: all of them in a model without parts.
void read_part(AnyModel& model, const std::filesystem::path& path, const Ranks& ranks) {
  CheckpointReader checkpoint(path);
  const auto border = [&](int n) {
    return checkpoint.entries("state/position") * static_cast<std::size_t>(n) / static_cast<std::size_t>(ranks.size());
  };
  if (model.has_parts()) checkpoint.take_part({border(ranks.rank()), border(ranks.rank() + 1) - border(ranks.rank())});
  model.read(checkpoint);
}

}  // namespace

class LedModel final : public AnyModel {
 public:
  LedModel(std::unique_ptr<AnyModel> model, Followers& followers) : model_(std::move(model)), followers_(followers) {
    model_->lead([&ranks = followers.ranks_](const ColumnPiece& piece) {
      ranks.value_from_first(Order::send);
      ranks.value_from_first(piece);
    });
  }

  double time() const override { return model_->time(); }
  std::uint64_t step() const override { return model_->step(); }
  double time_origin() const override { return model_->time_origin(); }
  double latest_origin() const override { return model_->latest_origin(); }
  std::optional<std::string> ended() const override { return model_->ended(); }
  NumericalError::Report step_limit() const override {
    NumericalError::Report report{};
    together(Order::limit, [&] { report = model_->step_limit(); });
    return report;
  }
  void begin(ThreadTeam& team) override {
    together(Order::begin, [&] { model_->begin(team); });
  }
  void advance(ThreadTeam& team) override {
    together(Order::advance, [&] { model_->advance(team); });
  }
  Snapshot snapshot() const override { return whole().snapshot(); }
  PointSource stored() const override { return whole().stored(); }
  std::optional<GridSnapshot> grid() const override { return with_fields().grid(); }
  std::optional<SurfaceSnapshot> walls() const override { return whole().walls(); }
  std::vector<NamedValue> totals() const override { return whole().totals(); }
  std::vector<RegimeLine> regime(const RunRecord& record) const override { return whole().regime(record); }
  void save(CheckpointWriter& checkpoint) const override { with_fields().save(checkpoint); }
  void read(const CheckpointReader& checkpoint) override {
    together(Order::read, [&] {
      followers_.ranks_.gather(checkpoint.path().string());
      read_part(*model_, checkpoint.path(), followers_.ranks_);
    });
  }
  void visit(std::span<const std::string> columns, const std::function<void(const Snapshot&)>& take) const override {
    whole().visit(columns, take);
  }
  void resume(ThreadTeam& team) override {
    together(Order::resume, [&] { model_->resume(team); });
  }
  void gather() override { whole(); }
  std::string sharing() const override { return whole().sharing(); }

 private:
  template <class Do>
  void together(Order order, Do&& act) const {
    followers_.ranks_.value_from_first(order);
    try {
      act();
    } catch (const NumericalError&) {  // of all processes
      followers_.have_left_ = true;
      throw;
    } catch (const std::exception& error) {
      print_error("talus: {}\n", error.what());
      followers_.ranks_.abort(static_cast<int>(ExitStatus::numerical));
    }
    is_whole_ = order == Order::gather || (order == Order::gather_fields && is_whole_);
    has_fields_ = order == Order::gather_fields || (order == Order::gather && has_fields_);
  }

  /// The model that knows of all particles, for which it is gathered once in a step.
  const AnyModel& whole() const {
    if (!is_whole_ && !followers_.have_left_) together(Order::gather, [&] { model_->gather(); });
    return *model_;
  }

  /// The same with the fields of all processes.
  const AnyModel& with_fields() const {
    if (!has_fields_ && !followers_.have_left_) together(Order::gather_fields, [&] { model_->gather_fields(); });
    return whole();
  }

  std::unique_ptr<AnyModel> model_;
  Followers& followers_;
  mutable bool is_whole_ = false, has_fields_ = false;
};

std::unique_ptr<AnyModel> led_model(std::unique_ptr<AnyModel> model, Followers& followers) {
  return std::make_unique<LedModel>(std::move(model), followers);
}

void follow(AnyModel& model, ThreadTeam& team, const Ranks& ranks) {
  for (;;) {
    switch (ranks.value_from_first(Order::leave)) {
      case Order::begin:
        model.begin(team);
        break;
      case Order::resume:
        model.resume(team);
        break;
      case Order::advance:
        model.advance(team);
        break;
      case Order::read:
        read_part(model, ranks.gather({}), ranks);
        break;
      case Order::send:
        model.send(ranks.value_from_first(ColumnPiece{}));
        break;
      case Order::limit:
        model.step_limit();
        break;
      case Order::gather:
        model.gather();
        break;
      case Order::gather_fields:
        model.gather_fields();
        break;
      case Order::leave:
        return;
    }
  }
}

}  // namespace talus::run
