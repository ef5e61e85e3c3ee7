#pragma once

#include <chrono>
#include <thread>

namespace thermal {

/// Only ends the wait for what never comes: no test may depend on how fast the machine is.
constexpr int kPatienceMs = 600'000;

/// Waits for what other processes do; whether it came true.
template <typename Condition>
bool wait_until(Condition condition) {
  constexpr int kStepMs = 10;
  for (int waited_ms = 0; waited_ms < kPatienceMs; waited_ms += kStepMs) {
    if (condition()) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(kStepMs));
  }
  return condition();
}

}  // namespace thermal
