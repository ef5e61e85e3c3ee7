#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "imaging/heated_surfaces.h"
#include "imaging/pass_checks.h"
#include "imaging/row_terms.h"
#include "imaging/scene_heat.h"
#include "imaging/surfaces.h"
#include "radiometry/spectral_response.h"
#include "scene/terms.h"
#include "scene/weather.h"
#include "sensor/optics/round_kernel.h"

namespace thermal {

/// Inputs of the physical model of a scene.
struct PhysicsSettings {
  Terms terms;
  Weather weather;
  SpectralResponse response = SpectralResponse::flat(8, 14);
  std::uint32_t seed = 1;                 ///< of the temperature field
  std::optional<HeatSettings> heat = {};  ///< empty: temperatures of Table 1

  [[nodiscard]] bool operator==(const PhysicsSettings&) const = default;
};

/// The weather of a clip. If inversion_by_balance is set and there is a heat balance, the inversion is that of
/// StableAir at the mean height of the frames above the ground, or at 61 m if unknown; otherwise as given.
[[nodiscard]] Weather with_inversion(const PhysicsSettings& settings, const Manifest& manifest);

/// Radiance at the camera of all surfaces of a clip's manifest.
class SceneRadiance {
 public:
  /// In-band radiance [W m^-2 sr^-1] of a blackbody.
  using RadianceOf = std::function<double(double temperature_k)>;

  /// The published model: emissivity * L(temperature of Table 1). ConfigError if a material of the manifest is not in
  /// the library.
  SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, Season season,
                const RadianceOf& radiance_of);

  /// The physical model with the kept terms. ConfigError in the same case, and if the manifest lacks the camera poses
  /// that the terms need.
  SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, const PhysicsSettings& settings);

  [[nodiscard]] const SurfaceMap& surfaces() const noexcept { return map_; }

  /// Planes that the chain reads besides the object index.
  [[nodiscard]] PassNeeds needs() const noexcept { return needs_; }

  /// Converts planes to a radiance plane [W m^-2 sr^-1]. All indices must be known; check them first. `frame` is the
  /// manifest's. Safe to call from several threads; the result does not depend on their number.
  [[nodiscard]] Plane<float> radiance(const Passes& passes, const ManifestFrame& frame = {}) const;

  /// The same into a plane whose memory is reused if it has the right size. Returns the usability of the planes.
  PassChecks radiance(const Passes& passes, const ManifestFrame& frame, Plane<float>& out) const;

  /// Radiance of adaptively sampled passes (Passes::fine): the mean over each pixel's samples replaces the pixel's
  /// radiance, and their quarters its detail if `detail` is given, a cleared one of the same size. Returns the
  /// usability of the samples. Otherwise as radiance().
  PassChecks refine(const FineSamples& fine, const ManifestFrame& frame, Plane<float>& out,
                    SubpixelDetail* detail = nullptr) const;

  /// Radiance of the most radiant surface of the manifest; of the sky if there is none.
  [[nodiscard]] float brightest_w_m2_sr() const noexcept { return brightest_w_m2_sr_; }

 private:
  void add_optics(const Material& material, float surface_k, const PhysicsSettings& settings);
  SceneRadiance(const Manifest& manifest, const MaterialLibrary& materials, const PhysicsSettings& settings,
                const ActorStates& actors);
  void add_heat(const Manifest& manifest, const MaterialLibrary& materials, const PhysicsSettings& settings,
                const std::vector<ActorState>& states);
  [[nodiscard]] const Material& drawn_as(std::size_t surface, const MaterialLibrary& materials,
                                         const PhysicsSettings& settings) const;
  void compose(const PhysicsSettings& settings, bool has_poses);
  void find_brightest();
  [[nodiscard]] float later_h(const ManifestFrame& frame) const noexcept;
  struct FineLine;
  PassChecks radiance_of(const FineSamples& fine, int y, int number, FineLine& line) const;
  void begin_row(const Passes& passes, const CameraRays* rays, int y, Row& row) const;
  void begin_mirrored(const Mirrored<Plane>& mirrored, int y, std::span<std::uint16_t> numbers,
                      Row& row) const;
  [[nodiscard]] bool mirrors(bool is_sky) const noexcept { return needs_.mirrored && !is_sky; }

  // The chain's terms point to these members, so they must not move.
  struct Held {
    SurfaceOpticsList optics;
    std::vector<std::unique_ptr<RadianceTable>> tables;
    std::unique_ptr<VariationField> field;
    SceneHeat heat;                          ///< empty with temperatures of Table 1
    std::unique_ptr<CameraRays> rays;        ///< of the passes
    std::unique_ptr<CameraRays> pixel_rays;  ///< of passes with one sample per pixel; null: the same
  };

  SurfaceMap map_;
  std::shared_ptr<Held> held_ = std::make_shared<Held>();
  std::vector<RowTerm> chain_;
  PassNeeds needs_;
  float brightest_w_m2_sr_ = 0;
  double middle_s_ = 0;  ///< time of the clip's middle frame
};

/// Radiance of the most radiant of the rows of Table 1.
[[nodiscard]] float brightest_of_table_1(const MaterialLibrary& materials, Season season,
                                         const SceneRadiance::RadianceOf& radiance_of);

}  // namespace thermal
