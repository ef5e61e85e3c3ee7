#include "bench/optics_rows.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "bench/sensor_scene.h"
#include "imaging/resample.h"
#include "sensor/psf.h"

namespace thermal {
namespace {

constexpr int kFrequencies = 100;  // from 0 to Nyquist

double sinc(double cycles_per_px) {
  const double x = std::numbers::pi * cycles_per_px;
  return x == 0 ? 1 : std::sin(x) / x;
}

/// Transfer at a two-dimensional frequency. The lens is round and the pixel square; the Gaussian rest is separable
/// into rows and columns.
double true_mtf(const OpticsParameters& optics, const SpectralResponse& response, double across,
                double down) {
  const double radius = std::hypot(across, down);
  const double whole = optics_mtf(optics, response, radius);
  if (optics.psf == Psf::gaussian) return whole;
  return whole / sinc(radius) * sinc(across) * sinc(down);
}

double worst_mtf_error(const OpticsParameters& optics, const SpectralResponse& response,
                       const HalfKernel& kernel, bool in_plane) {
  double worst = 0;
  for (int i = 0; i <= kFrequencies; ++i) {
    for (int j = 0; j <= (in_plane ? kFrequencies : 0); ++j) {
      const double across = 0.5 * i / kFrequencies;
      const double down = 0.5 * j / kFrequencies;
      const double error =
          kernel_mtf(kernel, across) * kernel_mtf(kernel, down) - true_mtf(optics, response, across, down);
      worst = std::max(worst, std::abs(error));
    }
  }
  return worst;
}

double sum_of(const Plane<float>& plane) {
  double sum = 0;
  for (const float value : plane.pixels()) sum += static_cast<double>(value);
  return sum;
}

StageRow kernel_row(const std::string& name, const OpticsParameters& optics) {
  const SpectralResponse response = SensorParameters().response;
  const HalfKernel kernel = psf_kernel(optics, response, 1);
  Convolution convolution(kernel);
  Plane<float> picture = scene_radiance(response);
  const double before = sum_of(picture);
  convolution.apply(picture);
  const StageRow row = {.group = "optics",
                        .name = name,
                        .figures = {{"mtf_rows", worst_mtf_error(optics, response, kernel, false)},
                                    {"mtf_plane", worst_mtf_error(optics, response, kernel, true)},
                                    {"energy", std::abs(sum_of(picture) / before - 1)},
                                    {"taps", static_cast<double>(2 * kernel.size() - 1)}}};
  return timed(row, 2 * sizeof(float), [&] { convolution.apply(picture); });
}

/// Temperatures stand for radiances, so that the error of linear interpolation is in kelvin.
StageRow distortion_row() {
  constexpr double kFocalLengthPx = 0.013 / 17e-6;
  const CameraIntrinsics camera = {.width_px = kSceneWidthPx,
                                   .height_px = kSceneHeightPx,
                                   .fx_px = kFocalLengthPx,
                                   .fy_px = kFocalLengthPx,
                                   .cx_px = 320,
                                   .cy_px = 256};
  const LensDistortion lens = {.k1 = -0.2, .k2 = 0.05};
  const int margin_px = overscan_px(camera, lens);
  Plane<float> wide(kSceneWidthPx + 2 * margin_px, kSceneHeightPx + 2 * margin_px);
  for (int y = 0; y < wide.height_px(); ++y) {
    for (int x = 0; x < wide.width_px(); ++x) {
      wide.at(x, y) = static_cast<float>(ground_k(x + 0.5 - margin_px, y + 0.5 - margin_px));
    }
  }
  const ResampleMap map(camera, margin_px, lens);
  Plane<float> seen;
  map.resample_linear(wide, seen);
  double worst_k = 0;
  double squares_k2 = 0;
  for (int y = 0; y < kSceneHeightPx; ++y) {
    for (int x = 0; x < kSceneWidthPx; ++x) {
      const LensPoint point = undistort(
          lens, {(x + 0.5 - camera.cx_px) / kFocalLengthPx, (y + 0.5 - camera.cy_px) / kFocalLengthPx});
      const double exact_k =
          ground_k(kFocalLengthPx * point.x + camera.cx_px, kFocalLengthPx * point.y + camera.cy_px);
      const double error_k = std::abs(static_cast<double>(seen.at(x, y)) - exact_k);
      worst_k = std::max(worst_k, error_k);
      squares_k2 += error_k * error_k;
    }
  }
  const StageRow row = {
      .group = "lens distortion",
      .name = "bilinear",
      .figures = {{"worst_mk", 1e3 * worst_k},
                  {"rms_mk", 1e3 * std::sqrt(squares_k2 / static_cast<double>(kScenePixels))}}};
  return timed(row, 2 * sizeof(float), [&] { map.resample_linear(wide, seen); });
}

}  // namespace

std::vector<StageRow> optics_rows() {
  return {
      kernel_row("gaussian, 1 px", {.psf = Psf::gaussian, .blur_sigma_px = 1}),
      kernel_row("physical, f/1.0, 12 um", {.psf = Psf::physical, .f_number = 1, .pixel_pitch_um = 12}),
      kernel_row("physical, f/1.25, 17 um", {.psf = Psf::physical, .f_number = 1.25, .pixel_pitch_um = 17}),
      distortion_row()};
}

}  // namespace thermal
