#include "sensor/noise.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numbers>

#include "base/parallel.h"

namespace thermal {
namespace {

/// What random numbers are for: one stream each. Never reuse a number.
enum Stream : std::uint32_t { kWhiteStream = 1, kFixedPatternStream = 2, kFlickerStream = 16 };

constexpr std::array<double, 5> kCornersHz = {1e-3, 1e-2, 1e-1, 1, 10};
constexpr std::size_t kPixelsAChunk = 8192;
constexpr std::size_t kPixelsABlock = 256;

/// Calls use(pixel, value) for every pixel with its normal number of a field.
template <typename Use>
void for_each_normal(const RandomField& field, std::size_t pixels, const Use& use) {
  parallel_for(pixels, kPixelsAChunk, [&](std::size_t begin, std::size_t end) {
    std::array<float, kPixelsABlock> normals{};
    for (std::size_t first = begin; first < end; first += kPixelsABlock) {
      const std::size_t count = std::min(kPixelsABlock, end - first);
      fill_normal(field, first, std::span(normals).first(count));
      for (std::size_t i = 0; i < count; ++i) use(first + i, normals[i]);
    }
  });
}

}  // namespace

FlickerNoise::FlickerNoise(std::uint32_t seed, std::string_view clip, double frame_rate_hz, int width_px,
                           int height_px)
    : field_{.seed = seed, .stream = kFlickerStream, .clip = hash_name(clip), .frame = 0},
      frame_interval_s_(1 / frame_rate_hz),
      processes_(kCornersHz.size(), Plane<float>(width_px, height_px)) {
  assert(frame_rate_hz > 0);
}

void FlickerNoise::add_next(float stddev, Plane<float>& picture) {
  assert(picture.size() == processes_.front().size());
  const float share = stddev / std::sqrt(static_cast<float>(processes_.size()));
  const auto out = picture.pixels();
  for (std::size_t k = 0; k < processes_.size(); ++k) {
    const double decay =
        field_.frame == 0 ? 0 : std::exp(-2 * std::numbers::pi * kCornersHz[k] * frame_interval_s_);
    const auto keep = static_cast<float>(decay);
    const auto renew = static_cast<float>(std::sqrt(1 - decay * decay));
    RandomField field = field_;
    field.stream += static_cast<std::uint32_t>(k);
    const auto state = processes_[k].pixels();
    for_each_normal(field, state.size(), [&](std::size_t pixel, float normal) {
      state[pixel] = keep * state[pixel] + renew * normal;
      out[pixel] += share * state[pixel];
    });
  }
  ++field_.frame;
}

void add_white_noise(std::uint32_t seed, std::string_view clip, std::uint32_t frame, float stddev,
                     Plane<float>& picture) {
  const RandomField field = {.seed = seed, .stream = kWhiteStream, .clip = hash_name(clip), .frame = frame};
  const auto out = picture.pixels();
  for_each_normal(field, out.size(), [&](std::size_t pixel, float normal) { out[pixel] += stddev * normal; });
}

Plane<float> fixed_pattern(std::uint32_t seed, std::string_view clip, int width_px, int height_px) {
  Plane<float> pattern(width_px, height_px);
  const RandomField field = {
      .seed = seed, .stream = kFixedPatternStream, .clip = hash_name(clip), .frame = 0};
  fill_uniform(field, 0, pattern.pixels());
  for (float& value : pattern.pixels()) value = 2 * value - 1;
  return pattern;
}

}  // namespace thermal
