#pragma once

#include <cstdint>
#include <string>

#include "io/json/file.h"
#include "io/system/child_process.h"

namespace thermal {

/// A failure that a script in Blender reported with an event "error".
struct ReportedFailure {
  std::string message;  ///< "ModuleNotFoundError: No module named 'numpy'"
  std::string where;    ///< "blender_scripts/planner/noise.py:8"; may be empty
  std::string hint;     ///< what to do about it; may be empty
  bool config = false;  ///< the config is at fault, and not Blender

  /// "message (where); hint".
  [[nodiscard]] std::string in_words() const;
};

/// The failure of an event, as one line each whatever it holds. Json::exception if a field has the wrong type.
[[nodiscard]] ReportedFailure reported_failure(const Json& event);

/// What a Blender printed last, in its own words: up to three lines of `log` from byte `from` on, joined by " / ".
/// Empty lines and "Blender quit" are left out, a line past 200 bytes is cut, and only the last 64 KiB are read.
/// Empty if there is nothing, or no log.
[[nodiscard]] std::string last_error_line_in(const Path& log, std::uintmax_t from);

/// Why a Blender ended that reported no failure, with its last words unless it was killed: "Blender ended with exit
/// code 1 while building the scene: Error: no memory". `doing` is "building the scene" or the like.
[[nodiscard]] std::string unreported_end(const ExitStatus& status, const std::string& doing,
                                         const std::string& last_error_line);

}  // namespace thermal
