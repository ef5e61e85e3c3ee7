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
/// Set, where the processor has AVX-512: NPY_DISABLE_CPU_FEATURES. NumPy's sin, arctan2, exp and power for AVX-512 differ
/// from the C library's in the last bit for 1 in 3 arguments, and which of the two are called depends on where an array
/// lies in memory: NumPy takes a strided array that ends where the result begins for one that overlaps it (1.24.2 and
/// 1.26.4). Without them the same config gives the same poses in every run and on every machine.
[[nodiscard]] std::vector<std::string> child_environment(std::span<const std::string> ours);

/// The same of this process's environment.
[[nodiscard]] std::vector<std::string> child_environment();

}  // namespace thermal
