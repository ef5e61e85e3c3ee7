#include "io/child_environment.h"

#include <algorithm>
#include <array>
#include <iterator>
#include <string_view>

#include <unistd.h>

namespace thermal {
namespace {

constexpr const char* kPath = "PATH=/usr/local/sbin:/usr/local/bin:/usr/sbin:/usr/bin:/sbin:/bin";

constexpr const char* kReproducibleNumpy = "NPY_DISABLE_CPU_FEATURES=AVX512F AVX512_SKX";

constexpr std::array<std::string_view, 7> kHandedDown = {
    "HOME", "TMPDIR", "LANG", "LANGUAGE", "OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"};

/// Whether NumPy may choose its functions for AVX-512. Telling it to leave out what a processor lacks makes it warn.
bool has_avx512() {
#ifdef __x86_64__
  return __builtin_cpu_supports("avx512dq") != 0;  // implies AVX512F
#else
  return false;
#endif
}

bool is_handed_down(std::string_view variable) {
  const std::string_view name = variable.substr(0, variable.find('='));
  return name.starts_with("LC_") || std::ranges::find(kHandedDown, name) != kHandedDown.end();
}

}  // namespace

std::vector<std::string> child_environment(std::span<const std::string> ours) {
  std::vector<std::string> theirs = {kPath};
  if (has_avx512()) theirs.emplace_back(kReproducibleNumpy);
  std::ranges::copy_if(ours, std::back_inserter(theirs), is_handed_down);
  return theirs;
}

std::vector<std::string> child_environment() {
  std::vector<std::string> ours;
  for (char** variable = environ; variable != nullptr && *variable != nullptr; ++variable)
    ours.emplace_back(*variable);
  return child_environment(ours);
}

}  // namespace thermal
