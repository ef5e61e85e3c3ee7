#include "bench/truth/suite.h"

#include <cmath>
#include <map>
#include <utility>

#include "base/parallel.h"
#include "bench/truth/case.h"
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

/// Error of each term of the shipped chain: the truth with that term as shipped, against the truth. Sampling: rays as
/// shipped through exact optics. Band: wavelengths weighted as for 300 K. Lag: whole frames mixed instead of exposure;
/// again with the image moved by a pixel's mean delay, which leaves the smear's shape. Optics: the shipped chain with
/// 32 x 32 rays, without motion.
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

/// Convergence of the truth: changes with steps twice as fine, one by one and together.
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

using Kind = ShippedSampling::Kind;

const std::string kMoving = "sampling, moving";
const std::string kStill = "sampling, still";
const std::string kSpeed = "speed of the camera";
const std::string kFrameRate = "frame rate";
const std::string kOptics = "optics, still";
const std::string kShares = "share of the error";
const std::string kConvergence = "convergence of the truth";

const std::vector<ShippedSampling>& samplings() {
  static const std::vector<ShippedSampling> kAll = {{"1 ray", Kind::full, 1},
                                                    {"2 x 2", Kind::full, 2},
                                                    {"4 x 4", Kind::full, 4},
                                                    {"8 x 8", Kind::full, 8},
                                                    {"adaptive 2 x 2", Kind::adaptive, 2},
                                                    {"adaptive 4 x 4", Kind::adaptive, 4},
                                                    {"coverage", Kind::coverage, 32}};
  return kAll;
}

/// Kernels without motion, each computed once.
class Kernels {
 public:
  const ContrastKernel& of(const TruthCase& measured) {
    const GreySurface& surface = measured.target.surface;
    const std::string name = measured.preset.name + std::to_string(surface.temperature_k);
    const auto found = kernels_.find(name);
    if (found != kernels_.end()) return found->second;
    return kernels_.emplace(name, ContrastKernel(measured.preset.truth, surface, kTruthSoil, {}))
        .first->second;
  }

 private:
  std::map<std::string, ContrastKernel> kernels_;
};

class TruthTable {
 public:
  TruthTable(std::function<void(const std::string&)> announce, std::string only)
      : announce_(std::move(announce)), only_(std::move(only)) {}

  [[nodiscard]] bool wants(const std::string& group) const { return only_.empty() || only_ == group; }

  void add(const std::string& group, const std::string& name, const TruthCase& measured) {
    if (!wants(group)) return;
    announce_(group + ", " + name);
    const TruthErrors errors = shipped_errors(measured, kernels_.of(measured));
    rows_.push_back({.group = group,
                     .name = name,
                     .figures = {{"rms mK", errors.rms_mk},
                                 {"worst mK", errors.worst_mk},
                                 {"signal %", errors.signal_percent},
                                 {"scatter %", errors.scatter_percent},
                                 {"ms/frame", frame_ms(measured)}}});
  }

  void add(const std::vector<RenderRow>& rows) { rows_.insert(rows_.end(), rows.begin(), rows.end()); }
  [[nodiscard]] const ContrastKernel& kernel(const TruthCase& measured) { return kernels_.of(measured); }
  [[nodiscard]] const std::vector<RenderRow>& rows() const noexcept { return rows_; }

 private:
  /// Time depends on sampling and optics, and hardly on the target.
  double frame_ms(const TruthCase& measured) {
    const std::string name = measured.sampling.name + measured.preset.name;
    if (!ms_.contains(name)) ms_[name] = shipped_ms(measured);
    return ms_[name];
  }

  std::function<void(const std::string&)> announce_;
  std::string only_;
  std::vector<RenderRow> rows_;
  Kernels kernels_;
  std::map<std::string, double> ms_;
};

std::string number(double value) {
  return value == static_cast<int>(value) ? std::to_string(static_cast<int>(value)) : std::to_string(value);
}

void add_axes(TruthTable& table, const TruthCase& usual) {
  const std::vector<TruthTarget> targets = truth_targets();
  for (const ShippedSampling& sampling : samplings()) {
    TruthCase one = usual;
    one.sampling = sampling;
    table.add(kMoving, sampling.name, one);
    one.speed_m_s = 0;
    one.walks = false;
    table.add(kStill, sampling.name, one);
  }
  for (const TruthTarget& target : targets) {
    TruthCase one = usual;
    one.target = target;
    if (target.name == "elephant" || target.name == "truck") one.places = 8;  // they cover many pixels
    table.add("target", target.name, one);
  }
  for (const double distance_m : {61.0, 122.0, 300.0, 1000.0}) {
    TruthCase one = usual;
    one.distance_m = distance_m;
    table.add("distance", number(distance_m) + " m", one);
  }
  TruthCase stands = usual;
  stands.walks = false;
  for (const double speed_m_s : {0.0, 6.0, 12.0, 20.0}) {
    TruthCase one = stands;
    one.speed_m_s = speed_m_s;
    table.add(kSpeed, number(speed_m_s) + " m/s", one);
  }
  TruthCase walks = usual;
  walks.speed_m_s = 0;
  table.add(kSpeed, "0, target walks", walks);
  for (const double rate_hz : {9.0, 30.0, 60.0}) {
    TruthCase one = usual;
    one.frame_rate_hz = rate_hz;
    table.add(kFrameRate, number(rate_hz) + " Hz", one);
  }
  for (const TruthPreset& preset : truth_presets()) {
    TruthCase one = stands;
    one.preset = preset;
    one.speed_m_s = 0;
    for (const int factor : {1, 4}) {
      one.sampling = {number(factor) + " x " + number(factor), Kind::full, factor};
      table.add(kOptics, preset.name + ", " + one.sampling.name, one);
    }
  }
}

/// In the order of truth_groups().
std::vector<RenderRow> grouped(const std::vector<RenderRow>& rows) {
  std::vector<RenderRow> out;
  for (const std::string& group : truth_groups()) {
    for (const RenderRow& row : rows)
      if (row.group == group) out.push_back(row);
  }
  return out;
}

}  // namespace

const std::vector<std::string>& truth_groups() {
  static const std::vector<std::string> kGroups = {kMoving,    kStill,  "target", "distance",  kSpeed,
                                                   kFrameRate, kOptics, kShares,  kConvergence};
  return kGroups;
}

std::vector<RenderRow> run_truth_suite(const std::function<void(const std::string&)>& announce,
                                       const std::string& only) {
  return with_threads(1, [&] {
    TruthTable table(announce, only);
    const TruthCase usual = {.target = truth_target(truth_targets(), "person")};
    add_axes(table, usual);
    if (table.wants(kShares)) {
      announce(kShares);
      table.add(share_rows(kShares, usual, table.kernel(usual)));
    }
    if (table.wants(kConvergence)) {
      announce(kConvergence);
      table.add(convergence_rows(kConvergence, usual, table.kernel(usual)));
    }
    return grouped(table.rows());
  });
}

}  // namespace thermal
