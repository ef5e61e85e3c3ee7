#include "scene/camera_model.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

/// Derivative of distort(); symmetric.
struct Jacobian {
  double xx = 1;
  double xy = 0;
  double yy = 1;

  [[nodiscard]] double determinant() const noexcept { return xx * yy - xy * xy; }
};

Jacobian jacobian(const LensDistortion& lens, const LensPoint& point) noexcept {
  const auto [x, y] = point;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  const double slope =
      2 * (lens.k1 + r2 * (2 * lens.k2 + r2 * (3 * lens.k3)));  // of radial by x, divided by x
  return {.xx = radial + slope * x * x + 2 * lens.p1 * y + 6 * lens.p2 * x,
          .xy = slope * x * y + 2 * lens.p1 * x + 2 * lens.p2 * y,
          .yy = radial + slope * y * y + 6 * lens.p1 * y + 2 * lens.p2 * x};
}

/// Whether the distortion is one-to-one from the axis to a point of the pinhole's picture.
bool is_unfolded(const LensDistortion& lens, const LensPoint& point) noexcept {
  constexpr int kSteps = 32;  // the determinant is a polynomial of degree 12 along the way
  for (int i = 1; i <= kSteps; ++i) {
    const double share = static_cast<double>(i) / kSteps;
    if (!(jacobian(lens, {share * point.x, share * point.y}).determinant() > 0)) return false;
  }
  return true;
}

/// How far outside the camera's picture a pinhole shows what the lens shows at this pixel position [px]; negative
/// inside. ConfigError if no such point exists.
double excess_px(const CameraIntrinsics& camera, const LensDistortion& lens, double u_px, double v_px) {
  const LensPoint seen = unproject(camera, lens, {u_px, v_px});
  if (!is_unfolded(lens, seen)) {
    throw ConfigError(fault("camera.distortion", name_of(lens), "",
                            "a distortion that is one to one as far as the corners of the picture"));
  }
  const double u_seen_px = camera.cx_px + camera.fx_px * seen.x;
  const double v_seen_px = camera.cy_px + camera.fy_px * seen.y;
  return 0.5 + std::max({-u_seen_px, u_seen_px - camera.width_px, -v_seen_px, v_seen_px - camera.height_px});
}

}  // namespace

std::string name_of(const LensDistortion& lens) {
  return fmt::format("k1 {}, k2 {}, p1 {}, p2 {}, k3 {}", lens.k1, lens.k2, lens.p1, lens.p2, lens.k3);
}

LensPoint distort(const LensDistortion& lens, const LensPoint& point) noexcept {
  const auto [x, y] = point;
  const double r2 = x * x + y * y;
  const double radial = 1 + r2 * (lens.k1 + r2 * (lens.k2 + r2 * lens.k3));
  return {.x = x * radial + 2 * lens.p1 * x * y + lens.p2 * (r2 + 2 * x * x),
          .y = y * radial + lens.p1 * (r2 + 2 * y * y) + 2 * lens.p2 * x * y};
}

LensPoint undistort(const LensDistortion& lens, const LensPoint& point) noexcept {
  constexpr int kMostSteps = 50;
  constexpr double kLastStep = 1e-9;  // convergence is quadratic: the error is about the square of this step
  LensPoint seen = point;
  for (int i = 0; i < kMostSteps; ++i) {
    const LensPoint shown = distort(lens, seen);
    const Jacobian slope = jacobian(lens, seen);
    const double x_error = shown.x - point.x;
    const double y_error = shown.y - point.y;
    const double x_step = (slope.yy * x_error - slope.xy * y_error) / slope.determinant();
    const double y_step = (slope.xx * y_error - slope.xy * x_error) / slope.determinant();
    seen.x -= x_step;
    seen.y -= y_step;
    if (std::abs(x_step) + std::abs(y_step) < kLastStep) return seen;
  }
  constexpr double kNowhere = std::numeric_limits<double>::quiet_NaN();
  return {.x = kNowhere, .y = kNowhere};
}

PicturePoint project(const CameraIntrinsics& camera, const LensDistortion& lens,
                     const LensPoint& point) noexcept {
  const LensPoint shown = distort(lens, point);
  return {.u_px = camera.fx_px * shown.x + camera.cx_px, .v_px = camera.fy_px * shown.y + camera.cy_px};
}

LensPoint unproject(const CameraIntrinsics& camera, const LensDistortion& lens,
                    const PicturePoint& place) noexcept {
  return undistort(lens,
                   {(place.u_px - camera.cx_px) / camera.fx_px, (place.v_px - camera.cy_px) / camera.fy_px});
}

// A distortion that is one-to-one inside the border maps the inside of the picture into the inside of the border's
// source, so checking the border is enough.
int overscan_px(const CameraIntrinsics& camera, const LensDistortion& lens) {
  if (lens.is_none()) return 0;
  double most_px = 0;
  const auto check = [&](int x, int y) {
    most_px = std::max(most_px, excess_px(camera, lens, x + 0.5, y + 0.5));
  };
  for (int x = 0; x < camera.width_px; ++x) {
    check(x, 0);
    check(x, camera.height_px - 1);
  }
  for (int y = 0; y < camera.height_px; ++y) {
    check(0, y);
    check(camera.width_px - 1, y);
  }
  if (most_px > kMostOverscanPx) {
    throw ConfigError(
        fault("camera.distortion", name_of(lens), "",
              fmt::format("a distortion that reaches at most {} px beyond the picture, not {:.0f} px",
                          kMostOverscanPx, most_px)));
  }
  constexpr double kRoundingPx = 1e-6;
  return static_cast<int>(std::ceil(most_px - kRoundingPx));
}

}  // namespace thermal
