#pragma once

#include <cstdint>
#include <random>

#include "base/image.h"

/// Planes of random numbers, and what they are like.
namespace planes {

/// Each of `values` counts from `lowest` up is as likely.
inline thermal::Plane<std::uint16_t> random_counts(int width_px, int height_px, unsigned lowest,
                                                   unsigned values) {
  std::mt19937 random(7);
  thermal::Plane<std::uint16_t> counts(width_px, height_px);
  for (std::uint16_t& count : counts.pixels()) count = static_cast<std::uint16_t>(lowest + random() % values);
  return counts;
}

template <typename T>
double mean(const thermal::Plane<T>& plane) {
  double sum = 0;
  for (const T value : plane.pixels()) sum += static_cast<double>(value);
  return sum / static_cast<double>(plane.size());
}

/// Of pixels with those so far to the right and below; with 0 and 0, their variance.
template <typename T>
double covariance(const thermal::Plane<T>& plane, int right_px, int down_px) {
  const double middle = mean(plane);
  const int width_px = plane.width_px() - right_px;
  const int height_px = plane.height_px() - down_px;
  double sum = 0;
  for (int y = 0; y < height_px; ++y)
    for (int x = 0; x < width_px; ++x)
      sum += (static_cast<double>(plane.at(x, y)) - middle) *
             (static_cast<double>(plane.at(x + right_px, y + down_px)) - middle);
  return sum / (static_cast<double>(width_px) * height_px);
}

template <typename T>
double correlation(const thermal::Plane<T>& plane, int right_px, int down_px) {
  return covariance(plane, right_px, down_px) / covariance(plane, 0, 0);
}

}  // namespace planes
