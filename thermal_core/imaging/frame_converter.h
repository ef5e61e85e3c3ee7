#pragma once

#include <cstdint>
#include <optional>
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
  /// `physics` empty: the published model with the season's temperatures.
  /// ConfigError if the manifest names an unknown material.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                 const SensorParameters& parameters, const std::optional<PhysicsSettings>& physics = {});

  /// Planes that convert() wants beside the object index.
  [[nodiscard]] PassNeeds needs() const noexcept { return scene_radiance_.needs(); }

  /// Passes of one frame, `supersample` times finer than the camera where the manifest says so: physics first,
  /// means of radiance after. DataError if they hold an index the manifest lacks. Safe to call from several
  /// threads.
  [[nodiscard]] SceneFrame convert(const Passes& passes, const ManifestFrame& frame = {}) const;

  /// The same into a frame whose memory is used again.
  void convert(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const;

  /// Radiance of count 255 [W m^-2 sr^-1].
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  int supersample_;
  SceneRadiance scene_radiance_;
  float brightest_w_m2_sr_;
  std::vector<std::uint16_t> actor_indices_;
};

}  // namespace thermal
