#pragma once

#include <cstdint>
#include <vector>

#include "imaging/scene_radiance.h"
#include "labels/instances.h"
#include "sensor/airsim_sensor.h"

namespace thermal {

/// What a frame's passes hold, before the sensor.
struct SceneFrame {
  Plane<float> radiance_w_m2_sr;
  std::vector<Instance> instances;
};

/// The part of a frame's conversion that depends on that frame alone.
class FrameConverter {
 public:
  /// ConfigError if the manifest names an unknown material.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                 const SensorParameters& parameters);

  /// DataError if the passes hold an index the manifest lacks. Safe to call from several threads.
  [[nodiscard]] SceneFrame convert(const Passes& passes) const;

  /// Radiance of count 255 [W m^-2 sr^-1].
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  SceneRadiance scene_radiance_;
  float brightest_w_m2_sr_;
  std::vector<std::uint16_t> actor_indices_;
};

}  // namespace thermal
