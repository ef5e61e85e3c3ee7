#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/image.h"
#include "bench/truth_targets.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// Sampling of the passes: s x s rays, in all pixels or in those that show the target; or the target's coverage, as in
/// a cryptomatte.
struct ShippedSampling {
  enum class Kind { full, adaptive, coverage };
  std::string name;
  Kind kind = Kind::full;
  int factor = 1;
};

/// A clip of the product: a target in front of ground.
struct ShippedClip {
  SensorParameters sensor;  ///< without noise, shutter and bad pixels
  ShippedSampling sampling;
  GreySurface target;
  GreySurface ground;
  int width_px = 0;
  int height_px = 0;
  double frame_rate_hz = 30;
  int frames = 1;        ///< the last one is compared
  double camera_px = 0;  ///< motion of the picture to the left by the camera, per frame
  double walk_px = 0;    ///< additional motion of the target
};

/// The target's shapes in the n-th frame before the last.
using ShapesBefore = std::function<std::vector<TruthShape>(int frames)>;

/// Apparent temperature [K] of the clip's last frame: planes of indices -> FrameConverter -> ThermalCamera -> ir16.
[[nodiscard]] Plane<double> shipped_temperature_k(const ShippedClip& clip, const ShapesBefore& shapes);

/// Time [s] of a full-size frame through the same steps, from planes to both images, without noise.
[[nodiscard]] double shipped_frame_s(ShippedClip clip, const std::vector<TruthShape>& shapes);

}  // namespace thermal
