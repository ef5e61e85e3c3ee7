#pragma once

#include <span>
#include <string>
#include <vector>

namespace thermal {

/// The environment of every program that we start, as "NAME=value": the variables below where `ours` has them, and a
/// PATH of the system's own folders. Whatever else is set here, a Python's virtual environment above all, does not
/// reach those programs: Blender's Python would take its prefix from the first python3 on PATH.
/// A program that needs more, such as an LD_LIBRARY_PATH, is started by a script that sets it.
///
/// Handed down: HOME, TMPDIR; LANG, LANGUAGE, LC_*; OMP_NUM_THREADS, OPENBLAS_NUM_THREADS, MKL_NUM_THREADS, which
/// keep NumPy to a job's share of a machine.
[[nodiscard]] std::vector<std::string> child_environment(std::span<const std::string> ours);

/// The same of this process's environment.
[[nodiscard]] std::vector<std::string> child_environment();

}  // namespace thermal
