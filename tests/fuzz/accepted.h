#pragma once

#include <cstddef>
#include <vector>

#include "fuzz/target.h"

/// Inputs that a target's reader accepted: the first ones, which are seeds, and some of the latest. The mutator often
/// starts from one of these, because what it makes from a rejected input is seldom accepted.
class AcceptedInputs {
 public:
  static AcceptedInputs& instance() {
    static AcceptedInputs inputs;
    return inputs;
  }

  void add(Bytes bytes) {
    if (inputs_.size() < 2 * kKept) return void(inputs_.emplace_back(bytes.begin(), bytes.end()));
    inputs_[kKept + next_].assign(bytes.begin(), bytes.end());
    next_ = (next_ + 1) % kKept;
  }

  [[nodiscard]] const std::vector<std::vector<std::uint8_t>>& all() const noexcept { return inputs_; }

 private:
  static constexpr std::size_t kKept = 8;

  std::vector<std::vector<std::uint8_t>> inputs_;
  std::size_t next_ = 0;
};
