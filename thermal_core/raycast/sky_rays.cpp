#include "raycast/sky_rays.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstdlib>

#include "base/clones.h"

namespace thermal {
namespace {

constexpr std::size_t kAzimuths = 2048;

/// The preceding Fibonacci number.
std::size_t one_before(std::size_t number) noexcept {
  std::size_t before = 1;
  std::size_t last = 2;
  while (last < number) {
    before += last;
    std::swap(before, last);
  }
  assert(last == number);
  return before;
}

/// Unit vectors at kAzimuths angles, by repeated halving.
std::vector<std::array<float, 2>> circle() {
  std::vector<std::array<double, 2>> corners = {{1, 0}, {0, 1}, {-1, 0}, {0, -1}};
  while (corners.size() < kAzimuths) {
    std::vector<std::array<double, 2>> finer;
    for (std::size_t k = 0; k < corners.size(); ++k) {
      const auto& next = corners[(k + 1) % corners.size()];
      const double x = corners[k][0] + next[0];
      const double y = corners[k][1] + next[1];
      const double size = std::sqrt(x * x + y * y);
      finer.push_back(corners[k]);
      finer.push_back({x / size, y / size});
    }
    corners = std::move(finer);
  }
  std::vector<std::array<float, 2>> rounded;
  for (const auto& [x, y] : corners) rounded.push_back({static_cast<float>(x), static_cast<float>(y)});
  return rounded;
}

/// A vector between points of the lattice, in parts of its length.
struct Step {
  int u = 0;
  int v = 0;

  [[nodiscard]] int square() const noexcept { return u * u + v * v; }
};

/// The two shortest vectors of a lattice, which span its cell.
std::array<Step, 2> shortest_steps(int count, int step) {
  const auto nearest = [count](int one) { return 2 * one > count ? one - count : one; };
  std::vector<Step> steps;
  for (int k = 1; k < count; ++k) steps.push_back({.u = nearest(k), .v = nearest(k * step % count)});
  std::ranges::stable_sort(steps, {}, &Step::square);
  const Step first = steps.front();
  const auto second = std::ranges::find_if(steps, [count, first](const Step& other) {
    return std::abs(first.u * other.v - first.v * other.u) == count;
  });
  return {first, *second};
}

/// Fractional part, from 0 to less than 1.
VELDT_INLINE float wrapped(float number) noexcept {
  const float rest = number - std::floor(number);
  return rest < 1 ? rest : 0;  // a small negative number would be rounded up to 1
}

}  // namespace

SkyRays::SkyRays(std::size_t count) : circle_(circle()) {
  const std::size_t step = one_before(count);
  const auto share = [count](auto number) {
    return static_cast<float>(static_cast<double>(number) / static_cast<double>(count));
  };
  for (std::size_t k = 0; k < count; ++k) points_.push_back({.u = share(k), .v = share(k * step % count)});
  const auto sides = shortest_steps(static_cast<int>(count), static_cast<int>(step));
  for (std::size_t k = 0; k < sides.size(); ++k) sides_[k] = {.u = share(sides[k].u), .v = share(sides[k].v)};
}

VectorLanes<float> SkyRays::at(std::size_t k, const Shift& shift) const noexcept {
  VectorLanes<float> out;  // NOLINT(cppcoreguidelines-pro-type-member-init): all lanes are filled in
  for (std::size_t lane = 0; lane < kLanes; ++lane) {
    const float a = shift[0][lane];
    const float b = shift[1][lane];
    const float u = wrapped(points_[k].u + a * sides_[0].u + b * sides_[1].u);
    const float v = wrapped(points_[k].v + a * sides_[0].v + b * sides_[1].v);
    const auto& [x, y] = circle_[static_cast<std::size_t>(v * static_cast<float>(kAzimuths))];
    const float sine = std::sqrt(u);
    out[0][lane] = sine * x;
    out[1][lane] = sine * y;
    out[2][lane] = std::sqrt(1 - u);
  }
  return out;
}

}  // namespace thermal
