#include "bench/measure.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstring>
#include <limits>

#include <sys/resource.h>

namespace thermal {
namespace {

double seconds_since(std::chrono::steady_clock::time_point begin) {
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
}

}  // namespace

void ErrorStatistics::add(double relative, double k_per_relative) {
  const double k = std::abs(relative) * k_per_relative;
  worst_relative_ = std::max(worst_relative_, std::abs(relative));
  worst_k_ = std::max(worst_k_, k);
  sum2_relative_ += relative * relative;
  sum2_k_ += k * k;
  ++count_;
}

void ErrorStatistics::write_to(BenchRow& row) const {
  const auto count = static_cast<double>(std::max<std::size_t>(count_, 1));
  row.worst_relative = worst_relative_;
  row.rms_relative = std::sqrt(sum2_relative_ / count);
  row.worst_mk = 1e3 * worst_k_;
  row.rms_mk = 1e3 * std::sqrt(sum2_k_ / count);
}

double shortest_run_s(const std::function<void()>& work, double budget_s) {
  constexpr int kLeastRuns = 3;
  work();
  double shortest = std::numeric_limits<double>::infinity();
  const auto begin = std::chrono::steady_clock::now();
  for (int run = 0; run < kLeastRuns || seconds_since(begin) < budget_s; ++run) {
    const auto start = std::chrono::steady_clock::now();
    work();
    shortest = std::min(shortest, seconds_since(start));
  }
  return shortest;
}

double middle_run_s(const std::function<void()>& work) {
  std::array<double, 3> runs_s{};
  for (double& run_s : runs_s) {
    const auto start = std::chrono::steady_clock::now();
    work();
    run_s = seconds_since(start);
  }
  std::ranges::sort(runs_s);
  return runs_s[1];
}

double processor_s() noexcept {
  rusage used{};
  ::getrusage(RUSAGE_SELF, &used);
  const auto seconds = [](const timeval& time) {
    return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  };
  return seconds(used.ru_utime) + seconds(used.ru_stime);
}

double memcpy_s(std::size_t bytes, double budget_s) {
  const std::vector<char> from(bytes, 1);
  std::vector<char> to(bytes);
  return shortest_run_s(
      [&] {
        std::memcpy(to.data(), from.data(), bytes);
        // Hides from the compiler that the copy is never read.
        asm volatile("" : : "r"(to.data()) : "memory");
      },
      budget_s);
}

void mark_dominated(std::vector<BenchRow>& rows) {
  for (BenchRow& row : rows) {
    row.dominated = std::any_of(rows.begin(), rows.end(), [&row](const BenchRow& other) {
      const bool no_worse = other.ns_per_pixel <= row.ns_per_pixel && other.worst_mk <= row.worst_mk;
      const bool better = other.ns_per_pixel < row.ns_per_pixel || other.worst_mk < row.worst_mk;
      return other.group == row.group && no_worse && better;
    });
  }
}

}  // namespace thermal
