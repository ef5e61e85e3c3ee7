#pragma once

#include <vector>

#include "base/image.h"
#include "sensor/thermal_camera.h"

namespace thermal {

inline constexpr int kSceneWidthPx = 640;
inline constexpr int kSceneHeightPx = 512;
inline constexpr std::size_t kScenePixels = 640 * 512;
inline constexpr double kSceneRateHz = 30;

/// Smooth ground, 282 to 288 K, at a position in pixels: waves of 8 px and longer.
[[nodiscard]] double ground_k(double u_px, double v_px);

/// The same with squares on it, 10 K warmer and 10 px wide: edges for optics, two peaks for a histogram.
[[nodiscard]] double scene_k(double u_px, double v_px);

/// scene_k() at a frame's pixel centres, row by row; the frame is shifted `right_px` to the right.
[[nodiscard]] std::vector<double> scene_temperatures_k(double right_px = 0);

/// In-band radiance of scene_temperatures_k().
[[nodiscard]] Plane<float> scene_radiance(const SpectralResponse& response);

/// A camera with every stage enabled: physical optics f/1.0 12 um, 10 ms of lag, white and 1/f noise, every pattern, a warm housing,
/// bad pixels, plateau equalisation. Ratios are typical of presets, but not those of any camera.
[[nodiscard]] SensorParameters full_camera();

/// A clip of the scene's size and rate.
[[nodiscard]] ThermalCamera::Clip scene_clip();

}  // namespace thermal
