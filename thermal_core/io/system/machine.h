#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "io/system/files.h"

namespace thermal {

/// Number of cores that a control group may use, from "QUOTA PERIOD" [us], as in cpu.max of version 2. Empty if it is
/// not limited ("max", or a quota of -1 as in version 1) or the text has another form.
[[nodiscard]] std::optional<double> cpu_limit(std::string_view quota_and_period);

/// A control group that may limit the cores of a process.
struct CpuGroup {
  int version = 2;
  Path path;  ///< from the root of its hierarchy, without "..": "" or "a/b"
};

/// The groups of a process, from the content of /proc/PID/cgroup; unknown lines are left out.
[[nodiscard]] std::vector<CpuGroup> cpu_groups(std::string_view content);

/// The smallest cpu_limit() of the groups that this process is in and of those around them. Empty if no file under
/// `root`/sys/fs/cgroup states a limit; missing or unreadable files are no error.
[[nodiscard]] std::optional<double> smallest_cpu_limit(const Path& root = "/");

/// The cores of this machine, and those that this process may use.
struct Cores {
  int machine = 1;
  int affinity = 1;                  ///< cores that its threads may run on
  std::optional<double> limit = {};  ///< smallest_cpu_limit()

  /// How many threads can work at the same time: at least one.
  [[nodiscard]] int usable() const noexcept;
};

/// Those of this machine, for this process.
[[nodiscard]] Cores find_cores();

/// Names and versions of the libraries that the program uses.
[[nodiscard]] std::vector<std::pair<std::string, std::string>> library_versions();

}  // namespace thermal
