#include "sensor/vector_math.h"

#include <cassert>

#include "base/clones.h"

namespace thermal {
namespace {

VELDT_CLONES void add_scaled_floats(const float* in, std::size_t count, float scale, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * in[i];
}

VELDT_CLONES void multiply_floats(const float* in, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] *= in[i];
}

}  // namespace

void add_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept {
  assert(in.size() == out.size());
  add_scaled_floats(in.data(), in.size(), scale, out.data());
}

void multiply(std::span<const float> in, std::span<float> out) noexcept {
  assert(in.size() == out.size());
  multiply_floats(in.data(), in.size(), out.data());
}

}  // namespace thermal
