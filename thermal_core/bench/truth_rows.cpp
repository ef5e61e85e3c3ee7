#include "bench/truth_rows.h"

#include <cmath>
#include <functional>
#include <utility>

#include "sensor/smear.h"

namespace thermal {
namespace {

double soil_radiance(const TruthCase& measured) {
  const TruthCamera& camera = measured.preset.truth;
  return kTruthSoil.emissivity *
         truth_band_radiance(camera.begin_um, camera.end_um, kTruthSoil.temperature_k);
}

/// Image at a subpixel position.
using TruthImage = std::function<Plane<double>(const TruthView& view)>;

RenderRow row_of(const std::string& group, const std::string& name, const TruthCase& measured,
                 const TruthImage& image_k, const TruthImage& truth_k, double kelvin_per_count = 0) {
  ErrorSum sum(kelvin_per_count);
  for (int position = 0; position < measured.places; ++position) {
    const TruthView view = view_at(measured, position);
    sum.add(measured, bounds_of(view.shapes), image_k(view), truth_k(view));
  }
  const TruthErrors errors = sum.errors();
  return {.group = group,
          .name = name,
          .figures = {{"rms mK", errors.rms_mk},
                      {"worst mK", errors.worst_mk},
                      {"signal %", errors.signal_percent},
                      {"scatter %", errors.scatter_percent}}};
}

TruthImage image_by(const TruthCase& measured, const ContrastKernel& kernel, int samples = 0) {
  return [&measured, &kernel, samples](const TruthView& view) {
    return apparent_k(measured, true_radiance(kernel, view.shapes, soil_radiance(measured), view.width_px,
                                              view.height_px, samples));
  };
}

/// Mean additional delay of the truth's image of a moving target against mixed frames [px].
double delay_px(const TruthCase& measured) {
  const double tau_s = measured.preset.truth.time_constant_s;
  return px_per_s(measured) *
         (tau_s - 1 / (measured.frame_rate_hz * std::expm1(1 / (measured.frame_rate_hz * tau_s))));
}

/// A still image, smeared as in the shipped camera.
Plane<double> smeared(const TruthCase& measured, const Plane<double>& radiance, double step_px) {
  Plane<float> picture(radiance.width_px(), radiance.height_px());
  for (std::size_t i = 0; i < picture.size(); ++i)
    picture.pixels()[i] = static_cast<float>(radiance.pixels()[i]);
  const ImageMotion motion = {
      .x_px = Plane<float>(picture.width_px(), picture.height_px(), static_cast<float>(-step_px)),
      .y_px = Plane<float>(picture.width_px(), picture.height_px())};
  Smear(1 / measured.frame_rate_hz, measured.preset.truth.time_constant_s).apply(motion, picture);
  Plane<double> out(picture.width_px(), picture.height_px());
  for (std::size_t i = 0; i < out.size(); ++i) out.pixels()[i] = static_cast<double>(picture.pixels()[i]);
  return out;
}

/// The still image of each frame, mixed as in the shipped camera, and moved; with or without its smear.
TruthImage image_with_lag(const TruthCase& measured, const ContrastKernel& still, double moved_px,
                          bool with_smear = false) {
  return [&measured, &still, moved_px, with_smear](const TruthView& view) {
    const double kept = std::exp(-1 / (measured.frame_rate_hz * measured.preset.truth.time_constant_s));
    const double step_px = px_per_s(measured) / measured.frame_rate_hz;
    Plane<double> mixed(view.width_px, view.height_px);
    std::vector<TruthShape> shapes = view.shapes;
    for (TruthShape& shape : shapes) shape.x += moved_px;
    double weight = 1 - kept;
    double rest = 1;
    while (rest > 1e-6) {
      Plane<double> frame =
          true_radiance(still, shapes, soil_radiance(measured), view.width_px, view.height_px);
      if (with_smear) frame = smeared(measured, frame, step_px);
      rest -= weight;
      if (rest <= 1e-6) weight += rest;
      for (std::size_t i = 0; i < mixed.size(); ++i) mixed.pixels()[i] += weight * frame.pixels()[i];
      for (TruthShape& shape : shapes) shape.x += step_px;
      weight *= kept;
    }
    return apparent_k(measured, mixed);
  };
}

TruthCase at_rest(TruthCase measured) {
  measured.speed_m_s = 0;
  measured.walks = false;
  return measured;
}

}  // namespace

std::vector<RenderRow> share_rows(const std::string& group, const TruthCase& usual,
                                  const ContrastKernel& still) {
  const TruthCase resting = at_rest(usual);
  const ContrastKernel moving = still.smeared(smear_px(usual));
  const ContrastKernel grey(usual.preset.truth, usual.target.surface, kTruthSoil, {}, 300);
  TruthCase fine = resting;
  fine.sampling = {"32 x 32", ShippedSampling::Kind::full, 32};
  const TruthImage shipped = [&fine](const TruthView& view) { return shipped_image_k(fine, view); };
  std::vector<RenderRow> rows;
  for (const int factor : {1, 2, 4, 8}) {
    rows.push_back(row_of(group, "sampling, " + std::to_string(factor) + " x " + std::to_string(factor),
                          resting, image_by(resting, still, factor), image_by(resting, still)));
  }
  rows.push_back(row_of(group, "optics", resting, shipped, image_by(resting, still),
                        fine.preset.sensor.kelvin_per_count));
  rows.push_back(row_of(group, "band", resting, image_by(resting, grey), image_by(resting, still)));
  for (const auto& [name, moved_px] :
       {std::pair{"lag by frames", 0.0}, std::pair{"lag without its delay", delay_px(usual)}}) {
    rows.push_back(
        row_of(group, name, usual, image_with_lag(usual, still, moved_px), image_by(usual, moving)));
  }
  rows.push_back(
      row_of(group, "smear and lag", usual, image_with_lag(usual, still, 0, true), image_by(usual, moving)));
  TruthCase bars = usual;
  bars.target = truth_target(truth_targets(), "bars");
  bars.walks = false;
  const ContrastKernel at_speed = still.smeared(smear_px(bars));
  for (const bool with_smear : {false, true}) {
    rows.push_back(row_of(group, with_smear ? "bars, smear and lag" : "bars, lag by frames", bars,
                          image_with_lag(bars, still, 0, with_smear), image_by(bars, at_speed)));
  }
  return rows;
}

std::vector<RenderRow> convergence_rows(const std::string& group, const TruthCase& usual,
                                        const ContrastKernel& still) {
  const TruthSteps steps = still.steps();
  const TruthSteps lines = {.lines_per_px = 2 * steps.lines_per_px};
  const TruthSteps cells = {.cells_per_px = 2 * steps.cells_per_px};
  const TruthSteps times = {.times_per_cell = 2 * steps.times_per_cell};
  const TruthSteps wavelengths = {.wavelengths = 2 * steps.wavelengths};
  const TruthSteps radius = {.radius_px = 2 * steps.radius_px};
  const TruthSteps all = {.lines_per_px = lines.lines_per_px,
                          .cells_per_px = cells.cells_per_px,
                          .wavelengths = wavelengths.wavelengths,
                          .times_per_cell = times.times_per_cell};
  TruthCase fewer = usual;
  fewer.places = 4;
  const ContrastKernel moving = still.smeared(smear_px(fewer));
  std::vector<RenderRow> rows;
  for (const auto& [name, finer] :
       {std::pair{"64 x 64 rays", lines}, std::pair{"cells of 1/32 px", cells},
        std::pair{"half the time step", times}, std::pair{"twice the wavelengths", wavelengths},
        std::pair{"twice the radius", radius}, std::pair{"all but the radius", all}}) {
    const ContrastKernel kernel =
        ContrastKernel(fewer.preset.truth, fewer.target.surface, kTruthSoil, finer).smeared(smear_px(fewer));
    rows.push_back(row_of(group, name, fewer, image_by(fewer, kernel), image_by(fewer, moving)));
  }
  return rows;
}

}  // namespace thermal
