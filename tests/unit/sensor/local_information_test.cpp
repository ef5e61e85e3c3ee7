#include <algorithm>
#include <cmath>

#include "base/rng.h"
#include "sensor/agc.h"
#include "support/catch.h"

namespace local_information_test {

using namespace thermal;

namespace {

Plane<std::uint16_t> noise(int width_px, int height_px, float counts) {
  Plane<float> normals(width_px, height_px);
  fill_normal({.seed = 1, .stream = 1, .clip = 1, .frame = 1}, 0, normals.pixels());
  Plane<std::uint16_t> ir16(width_px, height_px);
  std::ranges::transform(normals.pixels(), ir16.pixels().begin(), [counts](float normal) {
    return static_cast<std::uint16_t>(std::lround(30000 + counts * normal));
  });
  return ir16;
}

bool has_information(const Plane<std::uint16_t>& ir16, int x, int y, double threshold_counts) {
  const auto at = [&](int dx, int dy) {
    return static_cast<double>(
        ir16.at(std::clamp(x + dx, 0, ir16.width_px() - 1), std::clamp(y + dy, 0, ir16.height_px() - 1)));
  };
  double across = 0;
  double along = 0;
  for (const int k : {-1, 0, 1}) {
    across += (at(1, k) - at(-1, k)) / 3;
    along += (at(k, 1) - at(k, -1)) / 3;
  }
  return std::max(std::abs(across), std::abs(along)) > threshold_counts + 1e-6;
}

}  // namespace

TEST_CASE("Information is a change across a pixel, along rows or columns, up to the border") {
  const auto [width_px, height_px] =
      GENERATE(std::pair(37, 23), std::pair(1, 9), std::pair(9, 1), std::pair(2, 2), std::pair(1, 1));
  const double threshold_counts = GENERATE(0.0, 4.5, 12.0, 1e9);
  CAPTURE(width_px, height_px, threshold_counts);
  const Plane<std::uint16_t> ir16 = noise(width_px, height_px, 10);
  Plane<std::uint8_t> marks;
  mark_information(ir16, threshold_counts, marks);
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      CHECK((marks.at(x, y) == 1) == has_information(ir16, x, y, threshold_counts));
}

TEST_CASE("Noise of one NETD seldom is information at the default threshold") {
  constexpr float kCountsPerNetd = 40;
  Plane<std::uint8_t> marks;
  mark_information(noise(640, 512, kCountsPerNetd), 3 * static_cast<double>(kCountsPerNetd), marks);
  const auto marked = std::ranges::count(marks.pixels(), 1);
  // Two directions beyond 3 / sqrt(2 / 3) = 3.67 sigma, 2.4e-4 each: 157 pixels; neighbours depend on each other.
  CHECK(marked > 80);
  CHECK(marked < 250);
}

}  // namespace local_information_test
