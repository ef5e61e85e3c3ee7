// The entry point of libFuzzer, built once per target: VELDT_FUZZ_TARGET is its name.
#include <cstddef>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::VELDT_FUZZ_TARGET({data, size});
  return 0;
}

/// OpenImageIO 2.4 keeps a thread's last error until the process ends, which counts as a leak.
extern "C" const char* __lsan_default_suppressions() { return "leak:OpenImageIO"; }
extern "C" const char* __lsan_default_options() { return "print_suppressions=0"; }

/// With it, LeakSanitizer crashes in programs that have loaded a module, such as the one that writes JPEG.
extern "C" const char* __asan_default_options() { return "intercept_tls_get_addr=0"; }
