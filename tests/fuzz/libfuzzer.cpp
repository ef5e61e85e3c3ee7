// The entry point of libFuzzer, built once per target: VELDT_FUZZ_TARGET is its name.
#include <cstddef>

#include "fuzz/targets.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  fuzz::VELDT_FUZZ_TARGET({data, size});
  return 0;
}
