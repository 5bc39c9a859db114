// SPDX-License-Identifier: Apache-2.0
#include "ranks/halo.hpp"

#include <cstring>

namespace talus {

void Halo::refresh(std::span<const Column> columns) {
  if (!plan_) return;
  std::size_t words = 0;
  for (const Column& column : columns) words += column.words;
  going_.resize(words * sent_.size());
  coming_.resize(words * received_.size());
  std::size_t first = 0;
  for (const Column& column : columns) {
    for (std::size_t n = 0; n < sent_.size(); ++n)
      std::memcpy(going_.data() + words * n + first, column.data + 8 * column.words * sent_[n], 8 * column.words);
    first += column.words;
  }
  plan_->exchange(going_.data(), words, coming_.data());
  first = 0;
  for (const Column& column : columns) {
    for (std::size_t n = 0; n < received_.size(); ++n)
      std::memcpy(column.data + 8 * column.words * received_[n], coming_.data() + words * n + first, 8 * column.words);
    first += column.words;
  }
}

}  // namespace talus
