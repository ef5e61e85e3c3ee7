#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "radiometry/radiance_table.h"
#include "radiometry/spectral_air.h"
#include "scene/camera_geometry.h"
#include "scene/passes.h"
#include "scene/variation_field.h"

namespace thermal {

/// Properties of one surface that the terms read.
struct SurfaceOptics {
  float emitted_w_m2_sr = 0;         ///< at its mean temperature
  float emitted_as_air_w_m2_sr = 0;  ///< at air temperature
  float reflected_air_w_m2_sr = 0;   ///< of surroundings that radiate as a blackbody at air temperature
  float temperature_k = 0;
  float variation_stddev_k = 0;
  float per_correlation_length = 0;  ///< [1/m]
  AngularLaw angular = AngularLaw::none;
  const RadianceTable* table = nullptr;  ///< where the temperature varies
};

/// Some samples on one line of a frame, the input of the terms, with buffers for intermediate results. Surface 0 is the
/// sky.
struct Row {
  std::span<const std::uint16_t> surface;
  std::span<const float> ray_x;       ///< of the ray through each sample, z being 1, in camera axes
  std::span<const float> ray_y;       ///< the same
  std::span<const float> ray_length;  ///< of that ray
  float sample_width = 0;             ///< side of a sample at depth 1
  std::span<const float> depth_m;     ///< empty if no term needs it
  std::array<std::span<const float>, 3> normal;  ///< the same
  /// Surfaces mirrored by water, see Mirrored; 0: sky. Empty: only sky is mirrored.
  std::span<const std::uint16_t> mirrored_surface;
  std::span<const float> mirrored_depth_m;
  std::array<std::span<const float>, 3> mirrored_normal;
  const CameraPose* pose = nullptr;
  std::span<const float> origin_z_m;  ///< of the ray through each sample; empty: the pose's
  float later_h = 0;                  ///< offset of the frame from its clip's midpoint [h]
  std::span<float> radiance_w_m2_sr;
  std::vector<float> sky_view;           ///< fraction of the sky that a surface faces
  std::vector<float> cosine;             ///< of the viewing angle
  std::vector<float> reflected_w_m2_sr;  ///< of blackbody surroundings at air temperature
  std::vector<std::size_t> water;        ///< indices of water pixels
  std::vector<float> point_x;            ///< on the ground [correlation lengths]
  std::vector<float> point_y;
  std::vector<float> footprint;
  std::array<std::vector<float>, 3> metres;  ///< the same three in metres, of heated_emission()
  std::vector<float> variation;
  std::vector<float> even_k;           ///< by surface: of those with a uniform temperature
  std::vector<float> temperature_k;    ///< of heated_emission()
  std::vector<float> ground_sky_view;  ///< by maps of the ground; -1 where they have none
};

/// Adds one term to a row. A scene's chain is a list of these; dropped terms are not in it.
using RowTerm = std::function<void(Row&)>;

/// Properties of each surface of a scene.
using SurfaceOpticsList = std::vector<SurfaceOptics>;

/// Emission of every surface at its mean temperature.
[[nodiscard]] RowTerm emission(const SurfaceOpticsList& surfaces);

/// Emission of the sky by viewing angle, for pixels without a surface; others are unchanged. See
/// BandAir::sky_emissivity(); rays below the horizon get the value at the horizon.
[[nodiscard]] RowTerm sky_emission(const BandAir& air, float air_radiance_w_m2_sr);

/// Emission with the fractal temperature field on the surfaces that have one. Where depth is not a positive finite
/// number below 1e9, the mean is used; temperatures are clamped to the tables' 180 to 436 K.
[[nodiscard]] RowTerm varied_emission(const SurfaceOpticsList& surfaces, const VariationField& field);

/// Computes sky_view and cosine from the normals. Normals that face away from the camera are flipped; those that are
/// zero, NaN or far from unit length count as facing both sky and camera.
[[nodiscard]] RowTerm orientation();

/// Lists the row's water pixels, whose reflection and fall-off differ.
[[nodiscard]] RowTerm water_pixels(const SurfaceOpticsList& surfaces);

/// Applies the fall-off of emissivity with angle; the loss is added to `reflected`.
[[nodiscard]] RowTerm angular_emissivity(const SurfaceOpticsList& surfaces);

/// Fills `reflected` with each surface's reflectivity at normal incidence. Must precede angular_emissivity.
[[nodiscard]] RowTerm reflectivity(const SurfaceOpticsList& surfaces);

/// Adds the reflection of surfaces in water: the radiance of these surfaces by `terms`, and `path`, which may be empty,
/// for the air between them and the water. It is then removed from `reflected`. Must precede sky_reflection().
[[nodiscard]] RowTerm mirrored_surfaces(std::vector<RowTerm> terms, RowTerm path, float air_radiance_w_m2_sr);

/// Adds the reflection of sky and surroundings: diffuse surfaces see a fraction sky_view of sky, water the mirror
/// direction.
[[nodiscard]] RowTerm sky_reflection(const BandAir& air);

/// Transmission and emission of the air over the true range. Depth that is NaN, infinite or beyond the path model
/// counts as 1000 m; the sky is unaffected.
[[nodiscard]] RowTerm path(const BandAir& air, float air_radiance_w_m2_sr);

/// Additional radiance of a path whose air is warmer towards the camera, where its radiance is `more_w_m2_sr` higher
/// than at the ground; see BandAir::mean_path_absorption(). Must follow path().
[[nodiscard]] RowTerm path_inversion(const BandAir& air, float more_w_m2_sr);

}  // namespace thermal
