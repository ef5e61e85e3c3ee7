#include "bench/peak_memory.h"

#include <cmath>
#include <fstream>
#include <limits>
#include <string>

#include <malloc.h>

namespace thermal {
namespace {

/// A line of /proc/self/status, such as "VmHWM:" [MB].
double status_mb(const std::string& name) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kib = 0;
  while (status >> word) {
    if (word == name && status >> kib) return 1024e-6 * kib;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

/// Resets the peak to the present use: proc(5).
bool reset_peak() {
  std::ofstream file("/proc/self/clear_refs");
  file << "5" << std::flush;
  return file.good();
}

}  // namespace

PeakMemory::PeakMemory() {
  ::malloc_trim(0);
  before_mb_ = reset_peak() ? status_mb("VmHWM:") : std::numeric_limits<double>::quiet_NaN();
}

double PeakMemory::grown_mb() const { return std::round(10 * (status_mb("VmHWM:") - before_mb_)) / 10; }

}  // namespace thermal
