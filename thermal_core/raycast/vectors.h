#pragma once

#include <array>
#include <cmath>

namespace thermal {

/// Vectors of three doubles. Sums are taken in the order they are written: x, y, z.
struct Vector3 {
  double x = 0;
  double y = 0;
  double z = 0;

  friend constexpr Vector3 operator+(const Vector3& a, const Vector3& b) noexcept {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend constexpr Vector3 operator-(const Vector3& a, const Vector3& b) noexcept {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend constexpr Vector3 operator*(double factor, const Vector3& a) noexcept {
    return {factor * a.x, factor * a.y, factor * a.z};
  }
};

[[nodiscard]] constexpr double dot(const Vector3& a, const Vector3& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

[[nodiscard]] constexpr Vector3 cross(const Vector3& a, const Vector3& b) noexcept {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

[[nodiscard]] inline double length(const Vector3& a) noexcept { return std::sqrt(dot(a, a)); }

template <typename Number>
[[nodiscard]] constexpr Vector3 vector_of(const std::array<Number, 3>& a) noexcept {
  return {static_cast<double>(a[0]), static_cast<double>(a[1]), static_cast<double>(a[2])};
}

}  // namespace thermal
