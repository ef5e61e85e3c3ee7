#include "bench/truth/case.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bench/measure.h"
#include "imaging/frame_converter.h"
#include "imaging/motion_finder.h"
#include "imaging/sampling.h"
#include "scene/camera_geometry.h"
#include "sensor/thermal_camera.h"

namespace thermal {
namespace {

enum TruthIndex : std::uint16_t { kTruthGround = 1, kTruthTarget = 2 };

MaterialLibrary truth_materials(const ShippedClip& clip) {
  MaterialLibrary library;
  const auto add = [&library](const std::string& name, const GreySurface& surface) {
    Material material;
    material.name = name;
    material.emissivity = material.measured_emissivity = surface.emissivity;
    material.winter_k = material.summer_k = surface.temperature_k;
    library.add(material);
  };
  add("ground", clip.ground);
  add("target", clip.target);
  add("sky", {250, 1});
  return library;
}

constexpr double kTruthDepthM = 100;

/// A camera that looks straight down on level ground, and flies to the right of its picture; the target walks to the
/// left.
ManifestFrame truth_frame(const ShippedClip& clip, const CameraIntrinsics& camera, int number) {
  const double m_per_px = kTruthDepthM / camera.fx_px;
  const double flown_m = number * clip.camera_px * m_per_px;
  const double walked_m = -number * clip.walk_px * m_per_px;
  ManifestFrame frame;
  frame.time_s = number / clip.frame_rate_hz;
  frame.camera_to_world = {1, 0, 0, flown_m, 0, -1, 0, 0, 0, 0, -1, kTruthDepthM, 0, 0, 0, 1};
  frame.actors = {{.index = kTruthTarget, .position_m = {walked_m, 0, 0}}};
  return frame;
}

Manifest truth_manifest(const ShippedClip& clip) {
  Manifest manifest;
  manifest.clip = "truth";
  manifest.frame_rate_hz = clip.frame_rate_hz;
  manifest.camera = {.width_px = clip.width_px,
                     .height_px = clip.height_px,
                     .fx_px = 800,
                     .fy_px = 800,
                     .cx_px = clip.width_px / 2.0,
                     .cy_px = clip.height_px / 2.0};
  const bool is_coverage = clip.sampling.kind == ShippedSampling::Kind::coverage;
  manifest.supersample = is_coverage ? 1 : clip.sampling.factor;
  if (is_coverage) manifest.cryptomatte = "CryptoObject";
  ManifestObject ground;
  ground.index = kTruthGround;
  ground.name = ground.material = "ground";
  ManifestObject target;
  target.index = kTruthTarget;
  target.name = target.material = "target";
  target.object_class = ObjectClass::actor;
  target.category = "target";
  target.track_id = 1;
  manifest.objects = {ground, target};
  for (int n = 0; n < clip.frames; ++n) manifest.frames.push_back(truth_frame(clip, manifest.camera, n));
  return manifest;
}

std::uint16_t index_seen(const std::vector<TruthShape>& shapes, int x, int y, int factor) {
  return is_inside(shapes, (x + 0.5) / factor, (y + 0.5) / factor) ? kTruthTarget : kTruthGround;
}

Plane<std::uint16_t> index_plane(const ShippedClip& clip, const std::vector<TruthShape>& shapes, int factor) {
  Plane<std::uint16_t> plane(factor * clip.width_px, factor * clip.height_px, kTruthGround);
  const TruthShape box = bounds_of(shapes);
  const auto clipped = [&](double px, int end) {
    return std::clamp(static_cast<int>(std::floor(px * factor)), 0, end);
  };
  const int right = clipped(box.x + box.half_x + 1, plane.width_px());
  const int bottom = clipped(box.y + box.half_y + 1, plane.height_px());
  for (int y = clipped(box.y - box.half_y, plane.height_px()); y < bottom; ++y) {
    for (int x = clipped(box.x - box.half_x, plane.width_px()); x < right; ++x)
      plane.at(x, y) = index_seen(shapes, x, y, factor);
  }
  return plane;
}

/// All samples of the pixels within a pixel of the target's box, as near actors in the engine.
FineSamples samples_near(const ShippedClip& clip, const std::vector<TruthShape>& shapes) {
  const TruthShape box = bounds_of(shapes);
  FineSamples fine;
  fine.factor = clip.sampling.factor;
  fine.row_begin.push_back(0);
  for (int y = 0; y < clip.height_px; ++y) {
    if (std::abs(y + 0.5 - box.y) < box.half_y + 1.5) {
      for (int x = 0; x < clip.width_px; ++x)
        if (std::abs(x + 0.5 - box.x) < box.half_x + 1.5) fine.x_px.push_back(static_cast<std::uint16_t>(x));
    }
    fine.row_begin.push_back(fine.x_px.size());
  }
  for (int y = 0; y < clip.height_px; ++y) {
    for (int line = 0; line < fine.factor; ++line) {
      for (std::size_t i = 0; i < fine.pixels_in(y); ++i) {
        const int x = fine.x_px[fine.row_begin[static_cast<std::size_t>(y)] + i];
        for (int k = 0; k < fine.factor; ++k)
          fine.object_index.push_back(
              index_seen(shapes, x * fine.factor + k, y * fine.factor + line, fine.factor));
      }
    }
  }
  return fine;
}

/// Ground and target, each with its coverage of every pixel.
std::vector<CoverageRank> shares_of(const ShippedClip& clip, const std::vector<TruthShape>& shapes) {
  const int factor = clip.sampling.factor;
  const Plane<std::uint16_t> fine = index_plane(clip, shapes, factor);
  CoverageRank target = {Plane<std::uint16_t>(clip.width_px, clip.height_px, kTruthTarget),
                         Plane<float>(clip.width_px, clip.height_px)};
  CoverageRank ground = {Plane<std::uint16_t>(clip.width_px, clip.height_px, kTruthGround),
                         Plane<float>(clip.width_px, clip.height_px)};
  const float share = 1.0F / static_cast<float>(factor * factor);
  for (int y = 0; y < fine.height_px(); ++y) {
    for (int x = 0; x < fine.width_px(); ++x)
      if (fine.at(x, y) == kTruthTarget) target.coverage.at(x / factor, y / factor) += share;
  }
  for (std::size_t i = 0; i < target.coverage.size(); ++i)
    ground.coverage.pixels()[i] = 1 - target.coverage.pixels()[i];
  return {ground, target};
}

Passes passes_of(const ShippedClip& clip, const std::vector<TruthShape>& shapes) {
  Passes passes;
  const bool is_full = clip.sampling.kind == ShippedSampling::Kind::full;
  passes.object_index = index_plane(clip, shapes, is_full ? clip.sampling.factor : 1);
  if (clip.sampling.kind == ShippedSampling::Kind::adaptive) passes.fine = samples_near(clip, shapes);
  passes.depth_m = Plane<float>(passes.object_index.width_px(), passes.object_index.height_px(),
                                static_cast<float>(kTruthDepthM));
  if (clip.sampling.kind == ShippedSampling::Kind::coverage) passes.ranks = shares_of(clip, shapes);
  return passes;
}

/// The product's objects of a clip.
class ShippedChain {
 public:
  explicit ShippedChain(const ShippedClip& clip)
      : manifest_(truth_manifest(clip)),
        materials_(truth_materials(clip)),
        converter_(manifest_, materials_, Season::winter, clip.sensor),
        motion_(manifest_, {}),
        camera_(clip.sensor,
                {.id = "truth",
                 .frame_rate_hz = clip.frame_rate_hz,
                 .width_px = clip.width_px,
                 .height_px = clip.height_px,
                 .noise_gain = {},
                 .sampling = pixel_sampling(manifest_, {})},
                converter_.brightest_w_m2_sr()) {}

  void expose(const Passes& passes, SensorFrame& out) {
    converter_.convert(passes, {}, scene_);
    motion_.find(passes, frame_, scene_.motion);
    if (frame_ + 1 < static_cast<int>(manifest_.frames.size())) ++frame_;
    camera_.expose(scene_.radiance_w_m2_sr, scene_.detail, scene_.motion, out);
  }

 private:
  Manifest manifest_;
  MaterialLibrary materials_;
  FrameConverter converter_;
  MotionFinder motion_;
  ThermalCamera camera_;
  SceneFrame scene_;
  int frame_ = 0;
};

}  // namespace

Plane<double> shipped_temperature_k(const ShippedClip& clip, const ShapesBefore& shapes) {
  ShippedChain chain(clip);
  SensorFrame frame;
  for (int n = clip.frames - 1; n >= 0; --n) chain.expose(passes_of(clip, shapes(n)), frame);
  Plane<double> out(clip.width_px, clip.height_px);
  for (std::size_t i = 0; i < out.size(); ++i)
    out.pixels()[i] = frame.ir16.pixels()[i] * clip.sensor.kelvin_per_count;
  return out;
}

double shipped_frame_s(ShippedClip clip, const std::vector<TruthShape>& shapes) {
  constexpr double kMeasuredS = 0.2;
  clip.width_px = 640;
  clip.height_px = 512;
  clip.frames = 2;
  const Passes passes = passes_of(clip, shapes);
  ShippedChain chain(clip);
  SensorFrame frame;
  return shortest_run_s([&] { chain.expose(passes, frame); }, kMeasuredS);
}

namespace {

// By which a target's box grows: half a pixel and the first dark ring, 1.22 wavelengths x f-number / pitch = 0.95 px at f/1.25.
constexpr double kPsfReachPx = 1.5;
constexpr double kTrail = 3;             // time constants of motion that count as part of a moving target
constexpr double kSignalReachPx = 6;     // of the sum over a target's signal
constexpr double kSaturationK = 655.35;  // of 16-bit frames

SensorParameters noiseless(double begin_um, double end_um, const OpticsParameters& optics, double tau_s) {
  SensorParameters sensor;
  sensor.response = SpectralResponse::flat(begin_um, end_um);
  sensor.optics = optics;
  sensor.time_constant_s = tau_s;
  sensor.noise.amount = 0;
  sensor.agc.mode = AgcMode::plateau;
  return sensor;
}

TruthPreset preset_of(const std::string& name, const SensorParameters& sensor, double focal_length_mm) {
  const OpticsParameters& optics = sensor.optics;
  return {.name = name,
          .sensor = sensor,
          .truth = {.begin_um = sensor.response.begin_um(),
                    .end_um = sensor.response.end_um(),
                    .f_number = optics.f_number,
                    .pitch_um = optics.pixel_pitch_um,
                    .aberration_sigma_px = optics.aberration_sigma_px,
                    .gaussian_sigma_px = optics.psf == Psf::gaussian ? optics.blur_sigma_px : 0,
                    .focal_length_px = 1e3 * focal_length_mm / optics.pixel_pitch_um,
                    .time_constant_s = sensor.time_constant_s}};
}

double lateral(double middle, double half, double pixel) { return std::abs(pixel - middle) - half; }

/// A target's box, with the trail that it leaves to the right.
TruthShape with_trail(const TruthCase& measured, TruthShape box) {
  const double trail_px = kTrail * smear_px(measured);
  box.x += trail_px / 2;
  box.half_x += trail_px / 2;
  return box;
}

}  // namespace

std::vector<TruthPreset> truth_presets() {
  return {preset_of(
              "vue_pro 13 mm",
              noiseless(7.5, 13.5, {.psf = Psf::physical, .f_number = 1.25, .pixel_pitch_um = 17}, 0.01), 13),
          preset_of("boson 14 mm",
                    noiseless(8, 14, {.psf = Psf::physical, .f_number = 1, .pixel_pitch_um = 12}, 0.01), 14),
          preset_of("airsim_w", noiseless(8, 14, {.psf = Psf::gaussian, .blur_sigma_px = 1}, 0), 13)};
}

double px_per_m(const TruthCase& measured) {
  return measured.preset.truth.focal_length_px / measured.distance_m;
}

double px_per_s(const TruthCase& measured) {
  return px_per_m(measured) * (measured.speed_m_s + (measured.walks ? measured.target.walks_m_s : 0));
}

double smear_px(const TruthCase& measured) {
  return px_per_s(measured) * measured.preset.truth.time_constant_s;
}

TruthView view_at(const TruthCase& measured, int position) {
  constexpr double kGolden = 0.6180339887498949;
  constexpr double kPlastic = 0.7548776662466927;
  constexpr double kMarginPx = kSignalReachPx + 3;
  const TruthShape box = bounds_of(placed(measured.target, px_per_m(measured), 0, 0));
  const double left = std::ceil(box.half_x - box.x + kMarginPx);
  const double top = std::ceil(box.half_y - box.y + kMarginPx);
  const double right = box.x + box.half_x + kMarginPx + kTrail * smear_px(measured);
  TruthView view;
  view.width_px = static_cast<int>(left + std::ceil(right)) + 1;
  view.height_px = static_cast<int>(top + std::ceil(box.y + box.half_y + kMarginPx)) + 1;
  view.shapes = placed(measured.target, px_per_m(measured), left + std::fmod(kGolden * (position + 0.5), 1.0),
                       top + std::fmod(kPlastic * (position + 0.5), 1.0));
  return view;
}

Plane<double> apparent_k(const TruthCase& measured, const Plane<double>& radiance) {
  Plane<double> out(radiance.width_px(), radiance.height_px());
  for (std::size_t i = 0; i < out.size(); ++i) {
    const double kelvin = truth_temperature_k(measured.preset.truth, radiance.pixels()[i]);
    out.pixels()[i] = std::min(kelvin, kSaturationK);
  }
  return out;
}

Plane<double> shipped_image_k(const TruthCase& measured, const TruthView& view) {
  constexpr double kSettled = 14;  // time constants after which a pixel's first frame has no effect
  ShippedClip clip = {.sensor = measured.preset.sensor,
                      .sampling = measured.sampling,
                      .target = measured.target.surface,
                      .ground = kTruthSoil,
                      .width_px = view.width_px,
                      .height_px = view.height_px,
                      .frame_rate_hz = measured.frame_rate_hz,
                      .camera_px = px_per_m(measured) * measured.speed_m_s / measured.frame_rate_hz};
  clip.walk_px = px_per_s(measured) / measured.frame_rate_hz - clip.camera_px;
  if (smear_px(measured) > 0) {
    clip.frames +=
        static_cast<int>(kSettled * measured.preset.truth.time_constant_s * measured.frame_rate_hz) + 1;
  }
  const double step_px = px_per_s(measured) / measured.frame_rate_hz;
  return shipped_temperature_k(clip, [&](int frames) {
    std::vector<TruthShape> shapes = view.shapes;
    for (TruthShape& shape : shapes) shape.x += frames * step_px;  // motion to the left
    return shapes;
  });
}

void ErrorSum::add(const TruthCase& measured, const TruthShape& box, const Plane<double>& image_k,
                   const Plane<double>& truth_k) {
  const TruthCamera& camera = measured.preset.truth;
  const auto radiance = [&camera](double kelvin) {
    return truth_band_radiance(camera.begin_um, camera.end_um, kelvin);
  };
  const TruthShape whole = with_trail(measured, box);
  const double ground = kTruthSoil.emissivity * radiance(kTruthSoil.temperature_k);
  const double counts = kelvin_per_count_ > 0 ? truth_temperature_k(camera, ground) / kelvin_per_count_ : 0;
  const double image_ground = counts > 0 ? radiance(kelvin_per_count_ * std::round(counts)) : ground;
  double shipped = 0;
  double exact = 0;
  for (int y = 0; y < truth_k.height_px(); ++y) {
    for (int x = 0; x < truth_k.width_px(); ++x) {
      const double outside =
          std::max(lateral(whole.x, whole.half_x, x + 0.5), lateral(whole.y, whole.half_y, y + 0.5));
      if (outside > kSignalReachPx) continue;
      shipped += radiance(image_k.at(x, y)) - image_ground;
      exact += radiance(truth_k.at(x, y)) - ground;
      if (outside > kPsfReachPx) continue;
      const double error_k = image_k.at(x, y) - truth_k.at(x, y);
      sum2_k2_ += error_k * error_k;
      worst_k_ = std::max(worst_k_, std::abs(error_k));
      ++pixels_;
    }
  }
  signal_.push_back(100 * (shipped / exact - 1));
}

TruthErrors ErrorSum::errors() const {
  const auto count = static_cast<double>(signal_.size());
  double mean = 0;
  for (const double value : signal_) mean += value / count;
  double variance = 0;
  for (const double value : signal_) variance += (value - mean) * (value - mean) / count;
  return {.rms_mk = 1e3 * std::sqrt(sum2_k2_ / static_cast<double>(pixels_)),
          .worst_mk = 1e3 * worst_k_,
          .signal_percent = mean,
          .scatter_percent = std::sqrt(variance)};
}

TruthErrors shipped_errors(const TruthCase& measured, const ContrastKernel& still) {
  const TruthCamera& camera = measured.preset.truth;
  const ContrastKernel kernel = still.smeared(smear_px(measured));
  const double ground =
      kTruthSoil.emissivity * truth_band_radiance(camera.begin_um, camera.end_um, kTruthSoil.temperature_k);
  ErrorSum sum(measured.preset.sensor.kelvin_per_count);
  for (int position = 0; position < measured.places; ++position) {
    const TruthView view = view_at(measured, position);
    const Plane<double> truth = true_radiance(kernel, view.shapes, ground, view.width_px, view.height_px);
    sum.add(measured, bounds_of(view.shapes), shipped_image_k(measured, view), apparent_k(measured, truth));
  }
  return sum.errors();
}

double shipped_ms(const TruthCase& measured) {
  const ShippedClip clip = {.sensor = measured.preset.sensor,
                            .sampling = measured.sampling,
                            .target = measured.target.surface,
                            .ground = kTruthSoil,
                            .frame_rate_hz = measured.frame_rate_hz,
                            .camera_px = px_per_s(measured) / measured.frame_rate_hz};
  return 1e3 * shipped_frame_s(clip, placed(measured.target, px_per_m(measured), 320, 256));
}

}  // namespace thermal
