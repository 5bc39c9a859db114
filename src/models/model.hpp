// SPDX-License-Identifier: Apache-2.0
/// What a model is: a concept, not a base class. Any type that satisfies it can be run, resumed and observed.
#pragma once

#include <concepts>
#include <vector>

#include "base/error.hpp"
#include "base/parallel.hpp"
#include "numerics/run_record.hpp"

namespace talus {

/// \tparam M a type with the members below. A for_each_field(visit, state) and a for_each_parameter(visit, parameters)
///           are in the namespace of its State and Parameters.
template <class M>
concept Model = requires(M model, const M constant, ThreadTeam& team, const RunRecord& record) {
  typename M::Parameters;
  typename M::State;
  { constant.state() } -> std::same_as<const typename M::State&>;
  { model.mutable_state() } -> std::same_as<typename M::State&>;
  model.begin(team);    // completes the initial state
  model.resume(team);   // completes a state whose kept fields were read into mutable_state()
  model.advance(team);  // one step; throws NumericalError
  { constant.time_origin() } -> std::same_as<double>;    // from which run.end counts; infinite until it is known
  { constant.latest_origin() } -> std::same_as<double>;  // its latest possible value
  { constant.step_limit() } -> std::same_as<NumericalError::Report>;     // what holds the last step, where, what to try
  { constant.totals() } -> std::same_as<std::vector<NamedValue>>;        // the same names every time
  { constant.regime(record) } -> std::same_as<std::vector<RegimeLine>>;  // at the end of a run
};

}  // namespace talus
