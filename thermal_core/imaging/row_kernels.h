#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace thermal::kernels {

// The inner loops of the terms, over plain arrays that do not overlap: branch-free, so that they vectorise, and
// compiled for AVX2 as well. See row_terms.h for their meaning.

/// out[i] = by_surface[surface[i]].
void look_up(const std::uint16_t* surface, const float* by_surface, float* out, std::size_t count) noexcept;

/// One world coordinate of the camera's axes: that of a ray is right * ray_x + down * ray_y + forward.
struct CameraAxis {
  float right, down, forward;
};

/// Intersections of pixels' rays with their surfaces, and the pixels' size there, in correlation lengths.
struct PointInput {
  const std::uint16_t* surface;
  const float* per_correlation_length;  ///< by surface
  const float* depth_m;
  const float* ray_x;
  const float* ray_y;
  float origin_x_m, origin_y_m;
  CameraAxis x, y;
  float pixel_width;
};
void find_points(const PointInput& in, float* x, float* y, float* footprint, std::size_t count) noexcept;

/// Smallest and largest footprint of pixels that have one, 0 or more, as IEEE-754 bits, which are monotonic for
/// non-negative floats. NaN and infinity count as large. Without any, the largest is negative.
struct FootprintRange {
  std::uint32_t smallest = 0xFFFFFFFF;
  std::int32_t largest = -1;
};

/// The same as find_points() in metres.
struct MetresInput {
  const float* depth_m;
  const float* ray_x;
  const float* ray_y;
  float origin_x_m, origin_y_m;
  CameraAxis x, y;
  float pixel_width;
};
[[nodiscard]] FootprintRange find_metres(const MetresInput& in, float* x_m, float* y_m, float* footprint_m,
                                         std::size_t count) noexcept;

/// Radiance of temperatures that vary about each surface's mean, interpolated linearly in its table. A surface with
/// constant temperature has a single node, a position of 0 and a spread of 0.
struct VariedInput {
  const std::uint16_t* surface;
  const float* position;      ///< by surface: position of its mean temperature among its nodes
  const float* spread;        ///< by surface: nodes per unit of variation
  const std::int32_t* table;  ///< by surface: index of its first node
  const float* node_w_m2_sr;  ///< of all surfaces: radiance and step to the next node's, alternating
  const float* variation;
  float last_node;  ///< of a table
};
void emit_varied(const VariedInput& in, float* radiance, std::size_t count) noexcept;

/// Converts positions and sizes from metres to correlation lengths, and warps them slowly and invisibly, so that a
/// periodic field does not repeat at the same distance everywhere.
struct UnsettledInput {
  const std::uint16_t* surface;
  const float* per_correlation_length;  ///< by surface [1/m]
  const float* x_m;
  const float* y_m;
  const float* footprint_m;  ///< negative where there is no surface
};
void unsettle(const UnsettledInput& in, float* x, float* y, float* footprint, std::size_t count) noexcept;

/// Temperatures of one surface from its normals, see Orientation. Normals that face away from the camera are flipped;
/// those far from unit length count as facing up, those steeper than `steepest` are clamped to it.
struct FacingInput {
  const float* nx;
  const float* ny;
  const float* nz;
  const float* ray_x;
  const float* ray_y;
  CameraAxis x, y, z;
  float steepest;  ///< largest horizontal part
  std::array<float, 3> sun;
  std::array<float, 10> coefficients;
};
void warm_by_normal(const FacingInput& in, float* temperature_k, std::size_t count) noexcept;

/// Radiance of each pixel's temperature: as emit_varied(), for surfaces that all have a table.
struct HeatedInput {
  const std::uint16_t* surface;
  const float* temperature_k;
  const float* stddev_k;      ///< by surface: of the variation
  const std::int32_t* table;  ///< by surface: index of its first node
  const float* node_w_m2_sr;  ///< of all surfaces: radiance and step to the next node's, alternating
  const float* variation;
  float coldest_k;    ///< of a table
  float nodes_per_k;  ///< the same
  float last_node;    ///< the same
};
void emit_heated(const HeatedInput& in, float* radiance, std::size_t count) noexcept;

/// Sky view and cosine of the viewing angle from normals.
struct OrientationInput {
  const float* nx;
  const float* ny;
  const float* nz;
  const float* ray_x;
  const float* ray_y;
  const float* ray_length;
  CameraAxis x, y, z;
};
void orient(const OrientationInput& in, float* sky_view, float* cosine, std::size_t count) noexcept;

/// Replaces the sky view where the maps have one; -1: they have none.
void map_sky_view(const float* mapped, float* sky_view, std::size_t count) noexcept;

/// Multiplies radiance by the fall-off of soil, 1 - loss (1 - cosine)^2, and moves the rest to `reflected`.
struct AngularInput {
  const std::uint16_t* surface;
  const float* loss;                    ///< by surface, 0 if none
  const float* emitted_as_air_w_m2_sr;  ///< by surface
  const float* cosine;
};
void fall_off(const AngularInput& in, float* radiance, float* reflected, std::size_t count) noexcept;

/// Adds the reflection of sky and surroundings by diffuse surfaces.
struct ReflectionInput {
  const float* reflected_w_m2_sr;
  const float* sky_view;
  float sky_deficit;
};
void reflect(const ReflectionInput& in, float* radiance, std::size_t count) noexcept;

/// Absorption by the air along the path, as polynomials: in range up to `near_end_m`, beyond in the root of the
/// range.
struct Absorption {
  static constexpr std::size_t kTerms = 8;
  std::array<float, kTerms> near{};  ///< lowest power first, in range / near_end_m
  std::array<float, kTerms> far{};   ///< in the root of the range, mapped to [-1, 1]
  float near_end_m = 0;
  float farthest_m = 0;
  float far_middle = 0;  ///< in roots of metres
  float far_half = 1;
};

/// Adds the air between surfaces and camera. Surface 0 is the sky.
struct PathInput {
  const std::uint16_t* surface;
  const float* depth_m;
  const float* ray_length;
  float air_w_m2_sr;
};
void pass_air(const PathInput& in, const Absorption& absorption, float* radiance, std::size_t count) noexcept;

/// Adds `more_w_m2_sr` times the path's share from an absorption, to pixels that show a surface.
struct WarmAirInput {
  const std::uint16_t* surface;
  const float* depth_m;
  const float* ray_length;
  float more_w_m2_sr;
};
void warm_air(const WarmAirInput& in, const Absorption& share, float* radiance, std::size_t count) noexcept;

}  // namespace thermal::kernels
