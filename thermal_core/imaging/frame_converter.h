#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "imaging/actor_labeller.h"
#include "imaging/resample.h"
#include "imaging/scene_radiance.h"
#include "labels/instances.h"
#include "scene/lens_distortion.h"
#include "sensor/sensor_parameters.h"

namespace thermal {

/// What a frame's passes hold, before the sensor.
struct SceneFrame {
  Plane<float> radiance_w_m2_sr;
  std::vector<Instance> instances;
};

/// What a FrameConverter depends on beside a clip's manifest and materials: where these are equal, so is every frame.
struct SceneSettings {
  Season season = Season::winter;
  SpectralResponse response = SpectralResponse::flat(8, 14);
  RadianceModel radiance = RadianceModel::exact;
  bool table_is_brightest = false;  ///< level 255 is the most radiant row of Table 1: AgcMode::table_max
  std::optional<PhysicsSettings> physics;  ///< empty: the published model with the season's temperatures
  LensDistortion lens;  ///< what the camera's lens does to the pinhole's picture that the passes are

  [[nodiscard]] bool operator==(const SceneSettings&) const = default;
};

/// What a sensor has to do with the scene, and the rest.
[[nodiscard]] SceneSettings scene_settings(Season season, const SensorParameters& parameters,
                                           const std::optional<PhysicsSettings>& physics = {},
                                           const LensDistortion& lens = {});

/// The part of a frame's conversion that depends on that frame alone.
class FrameConverter {
 public:
  /// ConfigError if the manifest names an unknown material, or its passes reach less far than the lens needs.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, const SceneSettings& settings);

  /// With scene_settings() of these.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                 const SensorParameters& parameters, const std::optional<PhysicsSettings>& physics = {},
                 const LensDistortion& lens = {});

  /// Planes that convert() wants beside the object index.
  [[nodiscard]] PassNeeds needs() const noexcept;

  /// Passes of one frame, `supersample` times finer than the camera and with overscan where the manifest says so:
  /// physics first, then means of radiance, then the lens. Labels go through the lens with the radiance.
  /// Where the passes have ranks, radiance is that of all of them (coverage_radiance()), and labels go by object_index.
  /// Actors are labelled as ActorLabeller does.
  /// DataError if the passes hold an index the manifest lacks. Safe to call from several threads.
  [[nodiscard]] SceneFrame convert(const Passes& passes, const ManifestFrame& frame = {}) const;

  /// The same into a frame whose memory is used again.
  void convert(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const;

  /// Radiance of count 255 [W m^-2 sr^-1].
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  void radiance(const Passes& passes, const ManifestFrame& frame, Plane<float>& out) const;
  void reshape(Plane<float> fine, Plane<float>& out) const;

  int supersample_;
  std::shared_ptr<const ResampleMap> map_;  ///< null: the passes show the camera's picture as it is
  SceneRadiance scene_radiance_;
  float brightest_w_m2_sr_;
  ActorLabeller labeller_;
  bool has_actor_layer_;
};

}  // namespace thermal
