#pragma once

#include <span>

namespace thermal {

/// out += scale * in, element by element; same size.
void add_scaled(std::span<const float> in, float scale, std::span<float> out) noexcept;

/// out *= in, element by element; same size.
void multiply(std::span<const float> in, std::span<float> out) noexcept;

}  // namespace thermal
