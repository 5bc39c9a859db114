// SPDX-License-Identifier: Apache-2.0
/// Elements of which a process holds copies: their owners send what is new of them.
#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <utility>
#include <vector>

#include "ranks/ranks.hpp"

namespace talus {

class Halo {
 public:
  Halo() = default;  ///< nothing is copied
  /// \param sent, received numbers of the elements on this process, in the order of the plan
  Halo(std::unique_ptr<Plan> plan, std::vector<std::uint32_t> sent, std::vector<std::uint32_t> received)
      : plan_(std::move(plan)), sent_(std::move(sent)), received_(std::move(received)) {}

  /// A column with one entry for each element, those of the copies among them.
  struct Column {
    std::byte* data;
    std::size_t words;  ///< of 8 bytes, of an entry
  };
  template <class T>
  static Column column(std::span<T> values) {
    static_assert(std::is_trivially_copyable_v<T> && sizeof(T) % 8 == 0);
    return {reinterpret_cast<std::byte*>(values.data()), sizeof(T) / 8};
  }

  /// Gives the copies the values of their owners, in one message. Together, with the same columns.
  void refresh(std::span<const Column> columns);

  std::size_t sent() const { return sent_.size(); }
  std::size_t received() const { return received_.size(); }  ///< how many copies there are

 private:
  std::unique_ptr<Plan> plan_;
  std::vector<std::uint32_t> sent_, received_;
  std::vector<std::uint64_t> going_, coming_;  // kept for their memory
};

}  // namespace talus
