#include "imaging/row_kernels.h"

#include <bit>
#include <cmath>

#include "base/clones.h"

namespace thermal::kernels {
namespace {

/// Sum of coefficient * x^k, lowest power first.
inline float polynomial(const std::array<float, Absorption::kTerms>& coefficients, float x) noexcept {
  float sum = coefficients[Absorption::kTerms - 1];
  for (std::size_t k = Absorption::kTerms - 1; k-- > 0;) sum = sum * x + coefficients[k];
  return sum;
}

inline float along(const CameraAxis& axis, float ray_x, float ray_y) noexcept {
  return axis.down * ray_y + axis.forward + axis.right * ray_x;
}

/// Value of the absorption's polynomials at a range; constant beyond the farthest, and for NaN.
VELDT_INLINE float share_at(const Absorption& a, float range_m) noexcept {
  const float within_m = range_m < a.farthest_m ? range_m : a.farthest_m;
  const float clamped_m = within_m > 0 ? within_m : 0.0F;
  const float near = polynomial(a.near, clamped_m * (1 / a.near_end_m));
  const float far = polynomial(a.far, (std::sqrt(clamped_m) - a.far_middle) * (1 / a.far_half));
  return clamped_m < a.near_end_m ? near : far;
}

/// Component of a normal away from the camera, times the length of the ray.
VELDT_INLINE float inward(const CameraAxis& x, const CameraAxis& y, const CameraAxis& z, float nx, float ny,
                          float nz, float ray_x, float ray_y) noexcept {
  return nx * along(x, ray_x, ray_y) + ny * along(y, ray_x, ray_y) + nz * along(z, ray_x, ray_y);
}

}  // namespace

VELDT_CLONES void look_up(const std::uint16_t* __restrict surface, const float* __restrict by_surface,
                          float* __restrict out, std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) out[i] = by_surface[surface[i]];
}

VELDT_CLONES void find_points(const PointInput& in, float* __restrict x, float* __restrict y,
                              float* __restrict footprint, std::size_t count) noexcept {
  const PointInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const float scale = p.per_correlation_length[p.surface[i]];
    const float depth = p.depth_m[i] * scale;
    x[i] = p.origin_x_m * scale + depth * along(p.x, p.ray_x[i], p.ray_y[i]);
    y[i] = p.origin_y_m * scale + depth * along(p.y, p.ray_x[i], p.ray_y[i]);
    footprint[i] = depth > 0 ? depth * p.pixel_width : -1.0F;  // where the field gives its mean
  }
}

namespace {

VELDT_CLONES void find_all_metres(const MetresInput& in, float* __restrict x_m, float* __restrict y_m,
                                  float* __restrict footprint_m, std::size_t count,
                                  FootprintRange& range) noexcept {
  const MetresInput p = in;
  std::uint32_t smallest = range.smallest;
  std::int32_t largest = range.largest;
  for (std::size_t i = 0; i < count; ++i) {
    const float depth = p.depth_m[i];
    x_m[i] = p.origin_x_m + depth * along(p.x, p.ray_x[i], p.ray_y[i]);
    y_m[i] = p.origin_y_m + depth * along(p.y, p.ray_x[i], p.ray_y[i]);
    const float footprint = depth > 0 ? depth * p.pixel_width : -1.0F;
    footprint_m[i] = footprint;
    const auto bits = std::bit_cast<std::uint32_t>(footprint);
    const auto ordered = static_cast<std::int32_t>(bits);
    smallest = bits < smallest ? bits : smallest;  // the sign bit makes a negative one large
    largest = ordered > largest ? ordered : largest;
  }
  range = {.smallest = smallest, .largest = largest};
}

}  // namespace

FootprintRange find_metres(const MetresInput& in, float* x_m, float* y_m, float* footprint_m,
                           std::size_t count) noexcept {
  FootprintRange range;
  find_all_metres(in, x_m, y_m, footprint_m, count, range);
  return range;
}

VELDT_CLONES void emit_varied(const VariedInput& in, float* __restrict radiance, std::size_t count) noexcept {
  const VariedInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t surface = p.surface[i];
    const float wanted = p.position[surface] + p.spread[surface] * p.variation[i];
    const float positive = wanted > 0 ? wanted : 0.0F;
    const float position = positive < p.last_node ? positive : p.last_node;
    const auto node = static_cast<std::int32_t>(position);
    const std::int32_t at = p.table[surface] + 2 * node;
    radiance[i] = p.node_w_m2_sr[at] + (position - static_cast<float>(node)) * p.node_w_m2_sr[at + 1];
  }
}

namespace {

/// A smooth wave of period 1 and amplitude 1: parabolas instead of a sine.
VELDT_INLINE float wave(float x) noexcept {
  const auto whole = static_cast<std::int32_t>(x);
  const float part = 2 * (x - static_cast<float>(whole));  // -2 to 2
  const float centred = part > 1 ? part - 2 : (part < -1 ? part + 2 : part);
  return 4 * centred * (1 - std::abs(centred));
}

}  // namespace

VELDT_CLONES void unsettle(const UnsettledInput& in, float* __restrict x, float* __restrict y,
                           float* __restrict footprint, std::size_t count) noexcept {
  // In correlation lengths. The sum of two oblique waves stretches and shrinks by at most 22 %.
  constexpr float kLong = 127.3F;
  constexpr float kLonger = 171.7F;
  constexpr float kSlant = 0.7F;
  constexpr float kReach = 3;
  const UnsettledInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const float scale = p.per_correlation_length[p.surface[i]];
    const float east = p.x_m[i] * scale;
    const float north = p.y_m[i] * scale;
    x[i] = east + kReach * wave((north + kSlant * east) * (1 / kLong));
    y[i] = north + kReach * wave((east - kSlant * north) * (1 / kLonger) + 0.3F);
    footprint[i] = p.footprint_m[i] * scale;
  }
}

VELDT_CLONES void warm_by_normal(const FacingInput& in, float* __restrict temperature_k,
                                 std::size_t count) noexcept {
  const FacingInput p = in;
  const std::array<float, 10> c = in.coefficients;
  const std::array<float, 3> sun = in.sun;
  for (std::size_t i = 0; i < count; ++i) {
    const float nx = p.nx[i];
    const float ny = p.ny[i];
    const float nz = p.nz[i];
    const float away = inward(p.x, p.y, p.z, nx, ny, nz, p.ray_x[i], p.ray_y[i]);
    const float norm2 = nx * nx + ny * ny + nz * nz;
    const bool usable = (norm2 > 0.81F) & (norm2 < 1.21F);  // false for NaN
    const float level2 = usable ? nx * nx + ny * ny : 0.0F;
    const float reach = level2 > p.steepest * p.steepest ? p.steepest / std::sqrt(level2) : 1.0F;
    const float side = away > 0 ? -1.0F : 1.0F;
    const float x = usable ? nx * side * reach : 0.0F;
    const float y = usable ? ny * side * reach : 0.0F;
    const float z = usable ? nz * side : 1.0F;
    const float cosine = x * sun[0] + y * sun[1] + z * sun[2];
    const float lit = cosine > 0 ? cosine : 0.0F;
    temperature_k[i] = c[0] + c[1] * x + c[2] * y + c[3] * z + c[4] * x * x + c[5] * y * y + c[6] * x * y +
                       c[7] * x * z + c[8] * y * z + c[9] * lit;
  }
}

VELDT_CLONES void emit_heated(const HeatedInput& in, float* __restrict radiance, std::size_t count) noexcept {
  const HeatedInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const std::uint16_t surface = p.surface[i];
    const float temperature_k = p.temperature_k[i] + p.stddev_k[surface] * p.variation[i];
    const float wanted = (temperature_k - p.coldest_k) * p.nodes_per_k;
    const float positive = wanted > 0 ? wanted : 0.0F;
    const float position = positive < p.last_node ? positive : p.last_node;
    const auto node = static_cast<std::int32_t>(position);
    const std::int32_t at = p.table[surface] + 2 * node;
    radiance[i] = p.node_w_m2_sr[at] + (position - static_cast<float>(node)) * p.node_w_m2_sr[at + 1];
  }
}

VELDT_CLONES void orient(const OrientationInput& in, float* __restrict sky_view, float* __restrict cosine,
                         std::size_t count) noexcept {
  const OrientationInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const float nx = p.nx[i];
    const float ny = p.ny[i];
    const float nz = p.nz[i];
    const float away = inward(p.x, p.y, p.z, nx, ny, nz, p.ray_x[i], p.ray_y[i]);
    const float norm2 = nx * nx + ny * ny + nz * nz;
    const bool usable = (norm2 > 0.81F) & (norm2 < 1.21F);  // false for NaN
    const float up = 0.5F + 0.5F * (away > 0 ? -nz : nz);
    const float clamped = up > 0 ? (up < 1 ? up : 1.0F) : 0.0F;
    const float seen = std::abs(away) / p.ray_length[i];
    sky_view[i] = usable ? clamped : 1.0F;
    cosine[i] = usable ? (seen < 1 ? seen : 1.0F) : 1.0F;
  }
}

VELDT_CLONES void map_sky_view(const float* __restrict mapped, float* __restrict sky_view,
                               std::size_t count) noexcept {
  for (std::size_t i = 0; i < count; ++i) sky_view[i] = mapped[i] >= 0 ? mapped[i] : sky_view[i];
}

VELDT_CLONES void fall_off(const AngularInput& in, float* __restrict radiance, float* __restrict reflected,
                           std::size_t count) noexcept {
  const AngularInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    const float tilt = 1 - p.cosine[i];
    const float lost = p.loss[p.surface[i]] * tilt * tilt;
    radiance[i] -= lost * radiance[i];
    reflected[i] += lost * p.emitted_as_air_w_m2_sr[p.surface[i]];
  }
}

VELDT_CLONES void reflect(const ReflectionInput& in, float* __restrict radiance, std::size_t count) noexcept {
  const ReflectionInput p = in;
  for (std::size_t i = 0; i < count; ++i) {
    radiance[i] += p.reflected_w_m2_sr[i] * (1 - p.sky_view[i] * p.sky_deficit);
  }
}

VELDT_CLONES void pass_air(const PathInput& in, const Absorption& absorption, float* __restrict radiance,
                           std::size_t count) noexcept {
  const PathInput p = in;
  const Absorption a = absorption;
  for (std::size_t i = 0; i < count; ++i) {
    const float absorbed = share_at(a, p.depth_m[i] * p.ray_length[i]);
    const float share = p.surface[i] != 0 ? absorbed : 0.0F;
    radiance[i] += share * (p.air_w_m2_sr - radiance[i]);
  }
}

VELDT_CLONES void warm_air(const WarmAirInput& in, const Absorption& share, float* __restrict radiance,
                           std::size_t count) noexcept {
  const WarmAirInput p = in;
  const Absorption a = share;
  for (std::size_t i = 0; i < count; ++i) {
    const float mean = share_at(a, p.depth_m[i] * p.ray_length[i]);
    radiance[i] += (p.surface[i] != 0 ? mean : 0.0F) * p.more_w_m2_sr;
  }
}

}  // namespace thermal::kernels
