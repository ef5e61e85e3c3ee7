#pragma once

#include <array>
#include <cmath>

#include "base/clones.h"

namespace thermal {

/// Vectors of three doubles. Sums are taken in the order they are written: x, y, z.
struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend VELDT_INLINE constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend VELDT_INLINE constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend VELDT_INLINE constexpr Vector3 operator*(double factor, const Vector3& a) noexcept {
    return {factor * a.x, factor * a.y, factor * a.z};
  }
};

/// Scalar product.
[[nodiscard]] VELDT_INLINE constexpr double dot(const Vector3& a, const Vector3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Vector product.
[[nodiscard]] VELDT_INLINE constexpr Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// Euclidean length.
[[nodiscard]] VELDT_INLINE double length(const Vector3& a) noexcept { return std::sqrt(dot(a, a)); }

/// A vector of three numbers of any type.
template <typename Number>
[[nodiscard]] constexpr Vector3 vector_of(const std::array<Number, 3>& a) noexcept {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

/// Position of the camera in a frame, and its axes: columns of the pose.
struct View {
  Vector3 right;
  Vector3 down;
  Vector3 forward;
  Vector3 position_m;
};

}  // namespace thermal
