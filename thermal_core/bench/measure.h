#pragma once

#include <functional>
#include <string>
#include <vector>

namespace thermal {

/// Cost of one method of computing something, and its error against the reference.
struct BenchRow {
  std::string group;  ///< rows of one group do the same work and are interchangeable
  std::string name;
  double ns_per_pixel = 0;    ///< one thread
  double worst_relative = 0;  ///< against the reference of the group
  double rms_relative = 0;
  double worst_mk = 0;  ///< the same as a difference in temperature
  double rms_mk = 0;
  double times_memcpy = 0;  ///< against copying the bytes it reads and writes; 0 where not meaningful
  bool dominated = false;   ///< another row of the group is no slower and no less accurate
};

/// Collects errors of pixels.
class ErrorStatistics {
 public:
  /// @param relative  (value - exact) / exact
  /// @param k_per_relative  temperature difference of a relative difference of 1: L / L'
  void add(double relative, double k_per_relative);
  void write_to(BenchRow& row) const;

 private:
  double worst_relative_ = 0;
  double worst_k_ = 0;
  double sum2_relative_ = 0;
  double sum2_k_ = 0;
  std::size_t count_ = 0;
};

/// Shortest of several runs [s], after one warm-up run. Runs until the budget is spent, at least three times.
[[nodiscard]] double shortest_run_s(const std::function<void()>& work, double budget_s = 0.5);

/// The middle one of three runs [s].
[[nodiscard]] double middle_run_s(const std::function<void()>& work);

/// Processor time of this process so far [s], over all its threads.
[[nodiscard]] double processor_s() noexcept;

/// Time [s] to copy this many bytes with memcpy, measured in this run.
[[nodiscard]] double memcpy_s(std::size_t bytes, double budget_s = 0.5);

/// Marks rows that another row of their group beats in both time and worst temperature error.
void mark_dominated(std::vector<BenchRow>& rows);

}  // namespace thermal
