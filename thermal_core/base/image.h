#pragma once

#include <cassert>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace thermal {

/// One image plane that owns its pixels: row-major, top row first, no padding.
template <typename T>
class Plane {
 public:
  Plane() = default;
  Plane(int width_px, int height_px, T value = T())
      : width_px_(width_px),
        height_px_(height_px),
        pixels_(static_cast<std::size_t>(width_px) * static_cast<std::size_t>(height_px), value) {
    assert(width_px >= 0 && height_px >= 0);
  }

  /// Changes the size. Keeps the pixels if it has that size already; otherwise all pixels are new.
  void resize(int width_px, int height_px) {
    if (width_px != width_px_ || height_px != height_px_) *this = Plane(width_px, height_px);
  }

  [[nodiscard]] int width_px() const noexcept { return width_px_; }
  [[nodiscard]] int height_px() const noexcept { return height_px_; }
  [[nodiscard]] std::size_t size() const noexcept { return pixels_.size(); }
  [[nodiscard]] bool empty() const noexcept { return pixels_.empty(); }

  [[nodiscard]] std::span<T> pixels() noexcept { return pixels_; }
  [[nodiscard]] std::span<const T> pixels() const noexcept { return pixels_; }

  [[nodiscard]] std::span<T> row(int y) noexcept { return {&pixels_[offset(0, y)], stride()}; }
  [[nodiscard]] std::span<const T> row(int y) const noexcept { return {&pixels_[offset(0, y)], stride()}; }

  [[nodiscard]] T& at(int x, int y) noexcept { return pixels_[offset(x, y)]; }
  [[nodiscard]] const T& at(int x, int y) const noexcept { return pixels_[offset(x, y)]; }

  [[nodiscard]] bool operator==(const Plane&) const = default;

 private:
  [[nodiscard]] std::size_t stride() const noexcept { return static_cast<std::size_t>(width_px_); }
  [[nodiscard]] std::size_t offset(int x, int y) const noexcept {
    assert(x >= 0 && x < width_px_ && y >= 0 && y < height_px_);
    return static_cast<std::size_t>(y) * stride() + static_cast<std::size_t>(x);
  }

  int width_px_ = 0;
  int height_px_ = 0;
  std::vector<T> pixels_;
};

/// Of objects, materials and actors: Blender's limit of pass_index.
inline constexpr int kLargestIndex = 32767;

/// Values that a pixel of an index plane can hold: a table of this size is never read or written beyond its end.
inline constexpr std::size_t kIndexValues = 65536;

/// Converts the numbers of a plane, row by row, to indices in `out`, of the same size: the only way from other number
/// types to an index plane. Number: float, double, std::uint16_t, uint32_t, uint64_t or int64_t.
/// DataError "WHAT at pixel (X, Y) = VALUE; expected a whole number from 0 to LARGEST", and `why`, for the first number
/// that is not an index; `out` is then unspecified.
template <typename Number>
void to_indices(std::span<const Number> in, int width_px, std::string_view what, std::span<std::uint16_t> out,
                int largest = kLargestIndex, std::string_view why = "");

}  // namespace thermal
