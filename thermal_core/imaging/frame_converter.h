#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "imaging/actor_labeller.h"
#include "imaging/sampling.h"
#include "imaging/scene_radiance.h"
#include "labels/instances.h"
#include "scene/camera_model.h"
#include "scene/manifest.h"
#include "scene/passes.h"
#include "sensor/optics/round_kernel.h"
#include "sensor/sensor_parameters.h"
#include "sensor/smear.h"

namespace thermal {

/// Radiance [W m^-2 sr^-1] of pixels that several objects share: the mean of each object's radiance as if it were
/// alone, at the pixel's depth and normal, weighted by coverage; the uncovered rest is sky. The material plane
/// describes one surface per pixel and applies to rank 0 only; other objects have their own material. `passes.ranks`
/// must not be empty, its coverages not negative and at most 1 in total. The chain runs once for each rank and, where
/// anything is uncovered, for the sky. Radiance of completely covered pixels is exact. Rounding: with n ranks, (n + 1)
/// 2^-24 of the sum, and n 2^-25 of the sky's radiance for the rest. NaN propagates. Returns the usability of depth and
/// normals where rank 0 is a surface. `out` is reused if it has the right size. Safe to call from several threads.
PassChecks coverage_radiance(const SceneRadiance& scene, const Passes& passes, const ManifestFrame& frame,
                             Plane<float>& out);

/// Contents of a frame's passes, before the sensor.
struct SceneFrame {
  Plane<float> radiance_w_m2_sr;
  std::vector<Instance> instances;
  SubpixelDetail detail = {};  ///< empty if pixel_sampling() has no quarters
  PassChecks checks = {};      ///< usability of the planes that the terms read
  ImageMotion motion = {};     ///< as MotionFinder finds it; empty without the term `smear`
};

/// Settings of a FrameConverter besides a clip's manifest and materials; equal settings give equal frames.
struct SceneSettings {
  Season season = Season::winter;
  SpectralResponse response = SpectralResponse::flat(8, 14);
  RadianceModel radiance = RadianceModel::exact;
  bool table_is_brightest = false;  ///< level 255 is the most radiant row of Table 1: AgcMode::table_max
  std::optional<PhysicsSettings> physics;  ///< empty: the published model with the season's temperatures
  LensDistortion lens;  ///< the camera's, applied to the passes unless their rays already follow it

  [[nodiscard]] bool operator==(const SceneSettings&) const = default;
};

/// Splits sensor parameters into those that affect the scene, and the rest.
[[nodiscard]] SceneSettings scene_settings(Season season, const SensorParameters& parameters,
                                           const std::optional<PhysicsSettings>& physics = {},
                                           const LensDistortion& lens = {});

/// The part of a frame's conversion that depends on that frame alone.
class FrameConverter {
 public:
  /// ConfigError if the manifest names an unknown material, its passes have too little overscan for the lens, or
  /// their rays follow another lens.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, const SceneSettings& settings);

  /// With scene_settings() of these.
  FrameConverter(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                 const SensorParameters& parameters, const std::optional<PhysicsSettings>& physics = {},
                 const LensDistortion& lens = {});

  /// Planes that convert() needs besides the object index.
  [[nodiscard]] PassNeeds needs() const noexcept;

  /// Converts the passes of one frame, with the manifest's supersampling and overscan: physics first, then means of
  /// radiance, then the lens. Labels are resampled for the lens like radiance. If the passes have ranks, radiance
  /// combines all of them (coverage_radiance()), and labels use object_index. Adaptively sampled passes (Passes::fine)
  /// give the result of fully sampled ones whose other pixels are uniform. Actors are labelled by ActorLabeller.
  /// DataError if the passes hold an index missing from the manifest. Safe to call from several threads.
  [[nodiscard]] SceneFrame convert(const Passes& passes, const ManifestFrame& frame = {}) const;

  /// The same into a frame whose memory is reused.
  void convert(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const;

  /// Radiance of level 255 [W m^-2 sr^-1].
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  void convert_samples(const Passes& passes, const ManifestFrame& frame, SceneFrame& out) const;
  PassChecks radiance(const Passes& passes, const ManifestFrame& frame, Plane<float>& out) const;
  void reshape(Plane<float> fine, SceneFrame& out) const;

  int supersample_;
  bool has_quarters_;                       ///< frames have detail
  std::shared_ptr<const ResampleMap> map_;  ///< null: the passes show the camera's picture unchanged
  SceneRadiance scene_radiance_;
  float brightest_w_m2_sr_;
  ActorLabeller labeller_;
  bool has_actor_layer_;
};

}  // namespace thermal
