#pragma once

#include <string>

#include "io/system/files.h"

namespace thermal {

/// The folder with assets/, blender_scripts/ and configs/: $VELDT_HOME, or the nearest one at or above the running
/// program, or ../share/veldt beside it. IoError with the places searched if there is none.
[[nodiscard]] Path find_home();

/// Full path of a program: a path as given, or the first of that name on $PATH. Empty if no executable is found.
[[nodiscard]] Path find_program(const std::string& name);

}  // namespace thermal
