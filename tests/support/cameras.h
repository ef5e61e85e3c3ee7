#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "radiometry/band_radiance.h"
#include "sensor/thermal_camera.h"

/// Cameras and scenes that tests of the sensor share.
namespace cameras {

/// Shows the scene unchanged: sharp, without lag, without noise.
inline thermal::SensorParameters perfect_sensor() {
  thermal::SensorParameters parameters;
  parameters.optics.blur_sigma_px = 0;
  parameters.noise.amount = 0;
  return parameters;
}

/// Every effect of a camera at once.
inline thermal::SensorParameters full_sensor() {
  thermal::SensorParameters parameters;
  parameters.optics.psf = thermal::Psf::physical;
  parameters.time_constant_s = 0.012;
  parameters.noise = {.amount = 1,
                      .flicker_knee_hz = 1,
                      .fixed_pattern_ratio = 0.5,
                      .row_ratio = 0.3,
                      .column_ratio = 0.4,
                      .temporal_row_ratio = 0.2,
                      .temporal_column_ratio = 0.2,
                      .frame_ratio = 0.1,
                      .drift_ratio = 0.5,
                      .first_frame_ratio = 0.1,
                      .banding_ratio = 0.2,
                      .banding_period_px = 16,
                      .banding_hz = 1};
  parameters.shutter = {.interval_s = 1, .freeze_s = 0.3};
  parameters.bad_pixels.dead_share = 0.01;
  parameters.bad_pixels.blinking_share = 0.01;
  parameters.agc.mode = thermal::AgcMode::plateau;
  return parameters;
}

inline float radiance_at(double temperature_k) {
  static const thermal::BandRadiance band(thermal::SpectralResponse::flat(8, 14));
  return static_cast<float>(band.radiance(temperature_k));
}

inline thermal::Plane<float> uniform_scene(int width_px, int height_px, double temperature_k) {
  return {width_px, height_px, radiance_at(temperature_k)};
}

/// Radiance of level 255 in scene_max and table_max: a level is 0.25 W m^-2 sr^-1, exactly.
inline constexpr float kBrightest = 63.75F;
inline constexpr float kLevel = kBrightest / 255;

struct ClipOf {
  int width_px = 0;
  int height_px = 0;
  std::string id = "a";
  std::uint32_t seed = 1;
  double frame_rate_hz = 9;
  thermal::PixelSampling sampling = {};
};

inline thermal::ThermalCamera camera(const thermal::SensorParameters& parameters, const ClipOf& clip) {
  return {parameters,
          {.id = clip.id,
           .seed = clip.seed,
           .frame_rate_hz = clip.frame_rate_hz,
           .width_px = clip.width_px,
           .height_px = clip.height_px,
           .noise_gain = {},
           .sampling = clip.sampling},
          kBrightest};
}

inline bool same_pixels(const thermal::SensorFrame& a, const thermal::SensorFrame& b) {
  return a.ir8 == b.ir8 && a.ir16 == b.ir16;
}

}  // namespace cameras
