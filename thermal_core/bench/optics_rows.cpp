#include "bench/optics_rows.h"

#include <algorithm>
#include <cmath>

#include "bench/sensor_scene.h"
#include "imaging/resample.h"
#include "sensor/optics.h"
#include "sensor/psf.h"

namespace thermal {
namespace {

constexpr int kFrequencies = 100;  // from 0 to Nyquist

/// Largest difference of two transfers along rows, or over all directions.
template <typename Transfer>
double worst_mtf_error(const OpticsTransfer& wanted, const Transfer& transfer, bool in_plane) {
  double worst = 0;
  for (int i = 0; i <= kFrequencies; ++i) {
    for (int j = 0; j <= (in_plane ? kFrequencies : 0); ++j) {
      const double across = 0.5 * i / kFrequencies;
      const double down = 0.5 * j / kFrequencies;
      worst = std::max(worst, std::abs(transfer(across, down) - wanted.at(across, down)));
    }
  }
  return worst;
}

double sum_of(const Plane<float>& plane) {
  double sum = 0;
  for (const float value : plane.pixels()) sum += static_cast<double>(value);
  return sum;
}

/// A row of a point spread.
template <typename Transfer>
StageRow psf_row(const std::string& name, const OpticsParameters& parameters, const PixelSampling& sampling,
                 const Transfer& transfer) {
  const SpectralResponse response = SensorParameters().response;
  const OpticsTransfer wanted(parameters, response);
  Optics optics(parameters, response, sampling);
  Plane<float> picture = scene_radiance(response);
  SubpixelDetail detail;
  if (sampling.quarters) detail = {.across = picture, .down = picture, .crossed = picture};
  const double before = sum_of(picture);
  optics.apply({}, picture);
  const StageRow row = {.group = "optics",
                        .name = name,
                        .figures = {{"mtf_rows", worst_mtf_error(wanted, transfer, false)},
                                    {"mtf_plane", worst_mtf_error(wanted, transfer, true)},
                                    {"energy", std::abs(sum_of(picture) / before - 1)}}};
  return timed(row, 2 * sizeof(float), [&] { optics.apply(detail, picture); });
}

StageRow gaussian_row() {
  const OpticsParameters optics = {.psf = Psf::gaussian, .blur_sigma_px = 1};
  return psf_row("gaussian, 1 px", optics, {}, [kernel = gaussian_psf(1)](double across, double down) {
    return kernel_mtf(kernel, across) * kernel_mtf(kernel, down);
  });
}

StageRow round_row(const std::string& name, const OpticsParameters& optics, const PixelSampling& sampling) {
  const RoundKernel kernel = round_kernel(optics, SensorParameters().response, sampling);
  return psf_row(name, optics, sampling,
                 [&](double across, double down) { return sampled_mtf(kernel, sampling, across, down); });
}

/// Temperatures are used as radiances, so that the error of linear interpolation is in kelvin.
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
  const OpticsParameters boson = {.psf = Psf::physical, .f_number = 1, .pixel_pitch_um = 12};
  const OpticsParameters vue_pro = {.psf = Psf::physical, .f_number = 1.25, .pixel_pitch_um = 17};
  OpticsParameters blurred = vue_pro;
  blurred.defocus_um = 40;
  const PixelSampling quarters = {.across = 4, .quarters = true};
  return {gaussian_row(),
          round_row("f/1.0, 12 um, 1 ray", boson, {}),
          round_row("f/1.25, 17 um, 1 ray", vue_pro, {}),
          round_row("f/1.0, 12 um, 4 x 4", boson, quarters),
          round_row("f/1.25, 17 um, 4 x 4", vue_pro, quarters),
          round_row("the same, 40 um out of focus", blurred, quarters),
          distortion_row()};
}

}  // namespace thermal
