#pragma once

#include <string>

#include "io/files.h"

namespace thermal {

/// The folder that holds assets/, blender_scripts/ and configs/: $VELDT_HOME, or the nearest one at or above
/// the running program, or ../share/veldt beside it. IoError saying where it looked if there is none.
[[nodiscard]] Path find_home();

/// Full path of a program: a path as given, or the first of that name on $PATH. Empty if there is none that
/// can be run.
[[nodiscard]] Path find_program(const std::string& name);

}  // namespace thermal
