// SPDX-License-Identifier: Apache-2.0
/// Type erasure of models: `run` drives any model through these few virtual calls per step.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "io/checkpoint.hpp"
#include "numerics/field.hpp"
#include "numerics/run_record.hpp"
#include "numerics/snapshot.hpp"

namespace talus::run {

class AnyModel {
 public:
  virtual ~AnyModel() = default;
  virtual double time() const = 0;
  virtual std::uint64_t step() const = 0;
  virtual double time_origin() const = 0;    ///< from which run.end counts, s; infinite until it is known
  virtual double latest_origin() const = 0;  ///< its latest possible value, s
  /// Why the run is over before its end; nothing while there is something to compute.
  virtual std::optional<std::string> ended() const { return std::nullopt; }
  /// The condition that limits the last step, where, and what to try; the rest of the report is empty.
  virtual NumericalError::Report step_limit() const = 0;
  virtual void begin(ThreadTeam& team) = 0;
  virtual void advance(ThreadTeam& team) = 0;
  virtual Snapshot snapshot() const = 0;                     ///< valid until the next step
  virtual PointSource stored() const = 0;                    ///< the same as files hold it: a sector once
  virtual std::optional<GridSnapshot> grid() const = 0;      ///< of the air; nothing where there is none
  virtual std::optional<SurfaceSnapshot> walls() const = 0;  ///< of a vessel; nothing where there is none
  virtual std::vector<NamedValue> totals() const = 0;
  virtual std::vector<RegimeLine> regime(const RunRecord& record) const = 0;
  virtual void save(CheckpointWriter& checkpoint) const = 0;
  virtual void read(const CheckpointReader& checkpoint) = 0;  ///< the kept fields
  virtual void resume(ThreadTeam& team) = 0;                  ///< completes what was read
  /// The particles of snapshot(), piece by piece. \param columns that are asked for, positions among them
  virtual void visit(std::span<const std::string> /*columns*/, const std::function<void(const Snapshot&)>& take) const {
    take(snapshot());
  }
  // Several processes: see Continuum.
  virtual bool has_parts() const { return false; }  ///< each has a part of the particles, and not all
  virtual void gather() {}
  virtual void gather_fields() {}
  virtual void lead(const std::function<void(const ColumnPiece&)>& /*announce*/) {}
  virtual void send(const ColumnPiece& /*piece*/) {}
  /// What each of them had to do, as gathered, in words for the log; empty of one process.
  virtual std::string sharing() const { return {}; }
  void resume(ThreadTeam& team, const CheckpointReader& checkpoint) {
    read(checkpoint);
    resume(team);
  }
};

/// Joins a model (see models/model.hpp for what that is) to AnyModel.
template <class M>
class ModelAdapter final : public AnyModel {
 public:
  explicit ModelAdapter(M model) : model_(std::move(model)) {}

  double time() const override { return model_.state().time; }
  std::uint64_t step() const override { return model_.state().step; }
  double time_origin() const override { return model_.time_origin(); }
  double latest_origin() const override { return model_.latest_origin(); }
  std::optional<std::string> ended() const override {
    if constexpr (requires { model_.ended(); }) return model_.ended();
    return std::nullopt;
  }
  NumericalError::Report step_limit() const override { return model_.step_limit(); }
  void begin(ThreadTeam& team) override { model_.begin(team); }
  void advance(ThreadTeam& team) override { model_.advance(team); }
  Snapshot snapshot() const override {
    if constexpr (requires { model_.snapshot(); })
      return model_.snapshot();
    else
      return snapshot_of(model_.state());
  }
  PointSource stored() const override {
    if constexpr (requires { model_.stored(); })
      return model_.stored();
    else
      return source_of(snapshot());
  }
  std::optional<GridSnapshot> grid() const override {
    if constexpr (requires { model_.grid(); }) return model_.grid();
    return std::nullopt;
  }
  std::optional<SurfaceSnapshot> walls() const override {
    if constexpr (requires { model_.walls(); }) return model_.walls();
    return std::nullopt;
  }
  std::vector<NamedValue> totals() const override { return model_.totals(); }
  std::vector<RegimeLine> regime(const RunRecord& record) const override { return model_.regime(record); }
  void save(CheckpointWriter& checkpoint) const override {
    std::uint64_t number = 0;
    const auto save = [&]<class Member>(const FieldInfo& field, const Member& member) {
      if constexpr (!std::is_arithmetic_v<Member> && has_columns<M>)
        if (field.of_particles && save_column(model_, field, kind_of<typename Member::value_type>, number, checkpoint))
          return;
      checkpoint(field, member);
    };
    for_each_field(save, model_.state());
  }
  void read(const CheckpointReader& checkpoint) override { for_each_field(checkpoint, model_.mutable_state()); }
  using AnyModel::resume;
  void resume(ThreadTeam& team) override { model_.resume(team); }
  void visit(std::span<const std::string> columns, const std::function<void(const Snapshot&)>& take) const override {
    if constexpr (requires { model_.visit(columns, take); })
      model_.visit(columns, take);
    else
      AnyModel::visit(columns, take);
  }
  void lead(const std::function<void(const ColumnPiece&)>& announce) override {
    if constexpr (requires { model_.lead(announce); }) model_.lead(announce);
  }
  void send(const ColumnPiece& piece) override {
    if constexpr (requires { model_.send(piece); }) model_.send(piece);
  }
  bool has_parts() const override { return has_columns<M>; }
  void gather() override {
    if constexpr (requires { model_.gather(); }) model_.gather();
  }
  void gather_fields() override {
    if constexpr (requires { model_.gather_fields(); }) model_.gather_fields();
  }
  std::string sharing() const override {
    if constexpr (requires { model_.sharing(); }) return model_.sharing();
    return {};
  }

 private:
  /// Whether a model hands out columns of all particles.
  template <class Any>
  static constexpr bool has_columns = requires(const Any& model, const FieldInfo& field) {
    model.column_of_all(field, ColumnSource::Kind{}, std::uint64_t{});
  };
  /// \returns whether a model has this column of all particles, which then is in the checkpoint if it is kept
  template <class Any>
  static bool save_column(const Any& model, const FieldInfo& field, ColumnSource::Kind kind, std::uint64_t& number,
                          CheckpointWriter& checkpoint) {
    auto column = model.column_of_all(field, kind, number++);
    if (column && field.role == FieldRole::kept) checkpoint.column(model.particles(), std::move(*column));
    return column.has_value();
  }

  M model_;
};

template <class M>
std::unique_ptr<AnyModel> any_model(M model) {
  return std::make_unique<ModelAdapter<M>>(std::move(model));
}

}  // namespace talus::run
