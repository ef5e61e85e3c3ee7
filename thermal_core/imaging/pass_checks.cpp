#include "imaging/pass_checks.h"

#include <cstddef>
#include <limits>

#include "base/clones.h"
#include "base/plausible.h"

namespace thermal {
namespace {

/// 0 is the sky. Plain arrays and 32-bit sums, so that the loops vectorise.
VELDT_CLONES std::int32_t count_surfaces(const std::uint16_t* surface, std::size_t count) noexcept {
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) sum += surface[i] != 0 ? 1 : 0;
  return sum;
}

VELDT_CLONES std::int32_t count_unusable_depth(const std::uint16_t* surface, const float* depth_m,
                                               std::size_t count) noexcept {
  constexpr auto kNearest = static_cast<float>(kDistanceM.least);
  constexpr auto kFarthest = static_cast<float>(kDistanceM.most);
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const int usable =
        (depth_m[i] >= kNearest ? 1 : 0) & (depth_m[i] <= kFarthest ? 1 : 0);  // NaN is neither
    sum += (surface[i] != 0 ? 1 : 0) & (1 - usable);
  }
  return sum;
}

VELDT_CLONES std::int32_t count_unusable_normals(const std::uint16_t* surface, const float* x, const float* y,
                                                 const float* z, std::size_t count) noexcept {
  constexpr float kMost = std::numeric_limits<float>::max();
  std::int32_t sum = 0;
  for (std::size_t i = 0; i < count; ++i) {
    const float norm2 = x[i] * x[i] + y[i] * y[i] + z[i] * z[i];
    const int usable = (norm2 > 0 ? 1 : 0) & (norm2 <= kMost ? 1 : 0);
    sum += (surface[i] != 0 ? 1 : 0) & (1 - usable);
  }
  return sum;
}

}  // namespace

PlaneCheck& PlaneCheck::operator+=(const PlaneCheck& other) noexcept {
  pixels += other.pixels;
  unusable += other.unusable;
  return *this;
}

PassChecks& PassChecks::operator+=(const PassChecks& other) noexcept {
  depth += other.depth;
  normal += other.normal;
  return *this;
}

PassChecks check_row(const Row& row) noexcept {
  PassChecks checks;
  if (row.depth_m.empty() && row.normal[0].empty()) return checks;
  const std::uint16_t* surface = row.surface.data();
  const std::size_t count = row.surface.size();
  const std::int64_t surfaces = count_surfaces(surface, count);
  if (!row.depth_m.empty())
    checks.depth = {.pixels = surfaces, .unusable = count_unusable_depth(surface, row.depth_m.data(), count)};
  const auto& [x, y, z] = row.normal;
  if (!x.empty())
    checks.normal = {.pixels = surfaces,
                     .unusable = count_unusable_normals(surface, x.data(), y.data(), z.data(), count)};
  return checks;
}

}  // namespace thermal
