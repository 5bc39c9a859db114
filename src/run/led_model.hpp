// SPDX-License-Identifier: Apache-2.0
/// A run on several processes. The first one runs the loop, writes the files and decides what is done next; the others
/// follow its orders, each with its part of the same model.
#pragma once

#include <cstdint>
#include <memory>

#include "base/parallel.hpp"
#include "ranks/ranks.hpp"
#include "run/any_model.hpp"

namespace talus::run {

enum class Order : std::uint64_t { begin, read, resume, advance, gather, gather_fields, send, limit, leave };

/// The other processes, at the first one. They are in follow() as long as this lives, or until a step has failed.
class Followers {
 public:
  /// \param ranks more than one; outlive the followers
  explicit Followers(const Ranks& ranks) : ranks_(ranks) {}
  ~Followers();
  Followers(const Followers&) = delete;
  Followers& operator=(const Followers&) = delete;

 private:
  friend class LedModel;
  const Ranks& ranks_;
  bool have_left_ = false;
};

/// The model of the first process, which has the others do what it does. What goes wrong here alone within that, where
/// the others could not know, is said on stderr and ends all processes. \param followers outlive the model
std::unique_ptr<AnyModel> led_model(std::unique_ptr<AnyModel> model, Followers& followers);

/// Does what the first process orders until it has them leave. \throws NumericalError that it throws too
void follow(AnyModel& model, ThreadTeam& team, const Ranks& ranks);

}  // namespace talus::run
