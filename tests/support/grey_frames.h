#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "base/image.h"
#include "base/rng.h"

/// Frames of grey levels whose measures are known in closed form.
namespace grey_frames {

/// White noise of the standard normal distribution; `draw` numbers independent fields.
inline std::vector<float> normal(std::size_t count, std::uint32_t draw) {
  std::vector<float> values(count);
  thermal::fill_normal({.seed = 5, .stream = 1, .clip = thermal::hash_name("grey_frames"), .frame = draw}, 0,
                       values);
  return values;
}

/// A frame of `level(x, y)`.
inline thermal::Plane<float> frame_of(int width_px, int height_px,
                                      const std::function<double(int, int)>& level) {
  thermal::Plane<float> frame(width_px, height_px);
  for (int y = 0; y < height_px; ++y) {
    for (int x = 0; x < width_px; ++x) frame.at(x, y) = static_cast<float>(level(x, y));
  }
  return frame;
}

/// A frame of one level with white noise.
inline thermal::Plane<float> white(int width_px, int height_px, double level, double deviation,
                                   std::uint32_t draw = 0) {
  thermal::Plane<float> frame(width_px, height_px);
  const std::vector<float> noise = normal(frame.size(), draw);
  for (std::size_t k = 0; k < noise.size(); ++k)
    frame.pixels()[k] = static_cast<float>(level + deviation * static_cast<double>(noise[k]));
  return frame;
}

}  // namespace grey_frames
