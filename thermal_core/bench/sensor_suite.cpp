#include "bench/sensor_suite.h"

#include <algorithm>
#include <cmath>

#include "base/parallel.h"
#include "base/rng.h"
#include "bench/detector_rows.h"
#include "bench/flicker_rows.h"
#include "bench/picture_rows.h"
#include "bench/video_rows.h"
#include "imaging/sampling.h"
#include "sensor/optics/optics.h"
#include "sensor/optics/psf.h"
#include "sensor/processing.h"

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

/// Point spreads of the optics, and the lens's distortion. mtf_rows: worst difference between the kernel's transfer and
/// the physics along rows up to Nyquist; mtf_plane: the same in two dimensions, each up to Nyquist, against a round lens,
/// a square pixel and a Gaussian; energy: relative change of the sum of all pixels. Where quarters of pixels are known,
/// time is with detail in all pixels. Distortion: bilinear interpolation against the scene at the true position.
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

constexpr double kShare = 0.5;

Plane<float> noise_frame(std::uint32_t number) {
  Plane<float> signal(kSceneWidthPx, kSceneHeightPx);
  fill_normal({.seed = 1, .stream = 1, .clip = 1, .frame = number}, 0, signal.pixels());
  for (float& value : signal.pixels()) value += 100;
  return signal;
}

double kept_variance(TemporalFilter& filter) {
  constexpr std::uint32_t kFrames = 40;  // the first frame's weight is 2^-39 by then
  Plane<float> signal;
  for (std::uint32_t number = 0; number < kFrames; ++number) {
    signal = noise_frame(number);
    filter.apply(signal);
  }
  double sum = 0;
  for (const float value : signal.pixels())
    sum += (static_cast<double>(value) - 100) * (static_cast<double>(value) - 100);
  return sum / static_cast<double>(signal.size());
}

StageRow denoise_row() {
  TemporalFilter filter({.share_of_new = kShare}, 1);
  const double wanted = kShare / (2 - kShare);
  const StageRow row = {.group = "noise reduction",
                        .name = "recursive mean, share 0.5",
                        .figures = {{"variance_off_percent", 100 * (kept_variance(filter) / wanted - 1)}}};
  Plane<float> signal = noise_frame(0);
  return timed(row, 3 * sizeof(float), [&] { filter.apply(signal); });
}

/// The scene in counts of 10 mK.
Plane<std::uint16_t> scene_counts() {
  Plane<std::uint16_t> ir16(kSceneWidthPx, kSceneHeightPx);
  std::ranges::transform(scene_temperatures_k(), ir16.pixels().begin(),
                         [](double kelvin) { return static_cast<std::uint16_t>(std::lround(100 * kelvin)); });
  return ir16;
}

/// The guided filter's model of one window, in double precision.
struct Model {
  double gain;
  double offset;
};

Model model_at(const Plane<std::uint16_t>& ir16, int x, int y, int radius, double edge_counts) {
  const int pixels = (2 * radius + 1) * (2 * radius + 1);
  double mean = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) mean += ir16.at(x + dx, y + dy);
  mean /= pixels;
  double variance = 0;
  for (int dy = -radius; dy <= radius; ++dy)
    for (int dx = -radius; dx <= radius; ++dx) variance += std::pow(ir16.at(x + dx, y + dy) - mean, 2);
  variance /= pixels;
  const double gain = variance / (variance + edge_counts * edge_counts);
  return {.gain = gain, .offset = mean * (1 - gain)};
}

double worst_detail_counts(const Plane<std::uint16_t>& ir16, int radius, double edge_counts) {
  Plane<float> detail;
  find_detail(ir16, radius, edge_counts, detail);
  const int pixels = (2 * radius + 1) * (2 * radius + 1);
  double worst = 0;
  for (int y = 2 * radius; y < kSceneHeightPx - 2 * radius; y += 23) {
    for (int x = 2 * radius; x < kSceneWidthPx - 2 * radius; x += 23) {
      double base = 0;
      for (int dy = -radius; dy <= radius; ++dy)
        for (int dx = -radius; dx <= radius; ++dx) {
          const Model model = model_at(ir16, x + dx, y + dy, radius, edge_counts);
          base += (model.gain * ir16.at(x, y) + model.offset) / pixels;
        }
      worst = std::max(worst, std::abs(ir16.at(x, y) - base - static_cast<double>(detail.at(x, y))));
    }
  }
  return worst;
}

StageRow detail_row() {
  constexpr double kCountsPerNetd = 4;
  const DetailParameters parameters = {.gain_dn_per_netd = 4};
  const Plane<std::uint16_t> ir16 = scene_counts();
  const double worst = worst_detail_counts(ir16, parameters.radius_px, parameters.edge_netd * kCountsPerNetd);
  const StageRow row = {
      .group = "sharpening", .name = "detail, radius 3 px", .figures = {{"worst_counts", worst}}};
  DetailEnhancer enhancer({.detail = parameters}, kCountsPerNetd);
  Plane<std::uint8_t> ir8(kSceneWidthPx, kSceneHeightPx, 128);
  return timed(row, sizeof(std::uint16_t) + 2 * sizeof(std::uint8_t), [&] { enhancer.sharpen(ir16, ir8); });
}

/// Noise reduction and sharpening, the parts of a camera's processing besides gain control.
std::vector<StageRow> tone_rows() { return {denoise_row(), detail_row()}; }

}  // namespace

std::vector<StageRow> run_sensor_suite() {
  return with_threads(1, [&] {
    std::vector<StageRow> rows = optics_rows();
    for (const auto& part : {detector_rows(), flicker_rows(), picture_rows(), tone_rows(), video_rows()}) {
      rows.insert(rows.end(), part.begin(), part.end());
    }
    return rows;
  });
}

}  // namespace thermal
