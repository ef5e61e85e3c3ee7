#include "imaging/ground_warp.h"

#include <cstddef>

namespace thermal {
namespace {

constexpr std::uint32_t kEast = 0x5EA57000;
constexpr std::uint32_t kNorth = 0x90127000;

}  // namespace

GroundWarp::GroundWarp(std::uint32_t seed) : east_(seed ^ kEast), north_(seed ^ kNorth) {}

void GroundWarp::move(std::span<const float> x_m, std::span<const float> y_m,
                      std::span<const float> footprint_m, std::span<float> moved_x_m,
                      std::span<float> moved_y_m) const noexcept {
  east_.sample(x_m, y_m, footprint_m, moved_x_m);  // its correlation length is 1 m
  north_.sample(x_m, y_m, footprint_m, moved_y_m);
  for (std::size_t i = 0; i < moved_x_m.size(); ++i) {
    moved_x_m[i] = x_m[i] + kMoveM * moved_x_m[i];
    moved_y_m[i] = y_m[i] + kMoveM * moved_y_m[i];
  }
}

}  // namespace thermal
