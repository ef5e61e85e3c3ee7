#pragma once

#include <functional>
#include <string>
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

/// A figure of a stage: its error or composition; the name includes the unit.
struct Figure {
  std::string name;
  double value = 0;
};

/// Cost of one sensor stage for a 640 x 512 frame, and its deviation from its specification.
struct StageRow {
  std::string group;  ///< rows of one group do the same work
  std::string name;
  std::vector<Figure> figures;
  double ms_per_frame = 0;  ///< one thread
  double times_memcpy = 0;  ///< against copying the bytes that a frame reads and writes; 0: not compared
};

/// Times `frame`, the stage's work on one frame. The row's figures were measured before.
/// @param bytes_per_pixel  read and written per frame; 0: not compared with memcpy
[[nodiscard]] StageRow timed(StageRow row, std::size_t bytes_per_pixel, const std::function<void()>& frame);

/// Difference of a mean square of `count` independent normal values from the specified variance, in standard errors
/// of variance sqrt(2 / count).
[[nodiscard]] double variance_sigma(double mean_square, double variance, double count);

/// Power spectral density of a process [1/Hz], one-sided, at a frequency [Hz].
using Density = std::function<double(double frequency_hz)>;

/// Mean of the periodograms of many series, Hann window, one-sided [1/Hz]: value k belongs to k rate /
/// length. Every series has the same length, a power of two.
[[nodiscard]] std::vector<double> mean_periodogram(const std::vector<std::vector<float>>& series,
                                                   double rate_hz);

}  // namespace thermal
