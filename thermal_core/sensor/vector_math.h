#pragma once

#include <span>

namespace thermal {

/// out += scale * in, element by element; same size.
void add_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept;

/// values *= factor; the same bits as adding `factor` times them to 0.
void scale(float factor, std::span<float> values) noexcept;

/// out *= in, element by element; same size.
void multiply(std::span<const float> in, std::span<float> out) noexcept;

/// out = scale * in, element by element; same size.
void set_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept;

/// out = one_scale * one + other_scale * other, element by element; same size.
void set_sum(std::span<const float> one, float one_scale, std::span<const float> other, float other_scale,
             std::span<float> out) noexcept;

/// out += scale * (one + other), element by element; same size.
void add_sum(std::span<const float> one, std::span<const float> other, float scale,
             std::span<float> out) noexcept;

/// out += scale * (one - other), element by element; same size.
void add_difference(std::span<const float> one, std::span<const float> other, float scale,
                    std::span<float> out) noexcept;

}  // namespace thermal
