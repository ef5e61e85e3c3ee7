#include "sensor/vector_math.h"

#include <cassert>

#include "base/clones.h"

namespace thermal {
namespace {

VELDT_CLONES void add_scaled_floats(const float* in, std::size_t count, float scale, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * in[i];
}

VELDT_CLONES void scale_floats(float factor, std::size_t count, float* values) {
  for (std::size_t i = 0; i < count; ++i) values[i] *= factor;
}

VELDT_CLONES void multiply_floats(const float* in, std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] *= in[i];
}

VELDT_CLONES void set_scaled_floats(const float* in, std::size_t count, float scale, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = scale * in[i];
}

VELDT_CLONES void set_sum_of_floats(const float* one, float one_scale, const float* other, float other_scale,
                                    std::size_t count, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] = one_scale * one[i] + other_scale * other[i];
}

VELDT_CLONES void add_sum_of_floats(const float* one, const float* other, std::size_t count, float scale,
                                    float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * (one[i] + other[i]);
}

VELDT_CLONES void add_difference_of_floats(const float* one, const float* other, std::size_t count,
                                           float scale, float* out) {
  for (std::size_t i = 0; i < count; ++i) out[i] += scale * (one[i] - other[i]);
}

}  // namespace

void add_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept {
  assert(in.size() == out.size());
  add_scaled_floats(in.data(), in.size(), scale, out.data());
}

void scale(float factor, std::span<float> values) noexcept {
  scale_floats(factor, values.size(), values.data());
}

void multiply(std::span<const float> in, std::span<float> out) noexcept {
  assert(in.size() == out.size());
  multiply_floats(in.data(), in.size(), out.data());
}

void set_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept {
  assert(in.size() == out.size());
  set_scaled_floats(in.data(), in.size(), scale, out.data());
}

void set_sum(std::span<const float> one, float one_scale, std::span<const float> other, float other_scale,
             std::span<float> out) noexcept {
  assert(one.size() == out.size() && other.size() == out.size());
  set_sum_of_floats(one.data(), one_scale, other.data(), other_scale, out.size(), out.data());
}

void add_sum(std::span<const float> one, std::span<const float> other, float scale,
             std::span<float> out) noexcept {
  assert(one.size() == out.size() && other.size() == out.size());
  add_sum_of_floats(one.data(), other.data(), out.size(), scale, out.data());
}

void add_difference(std::span<const float> one, std::span<const float> other, float scale,
                    std::span<float> out) noexcept {
  assert(one.size() == out.size() && other.size() == out.size());
  add_difference_of_floats(one.data(), other.data(), out.size(), scale, out.data());
}

}  // namespace thermal
