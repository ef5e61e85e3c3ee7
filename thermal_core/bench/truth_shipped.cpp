#include "bench/truth_shipped.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <utility>

#include "bench/measure.h"
#include "imaging/frame_converter.h"
#include "imaging/motion_finder.h"
#include "imaging/pixel_quarters.h"
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

}  // namespace thermal
