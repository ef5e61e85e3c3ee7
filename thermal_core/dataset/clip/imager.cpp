#include "dataset/clip/imager.h"

#include <utility>

#include "imaging/sampling.h"
#include "imaging/target_contrast.h"

namespace thermal {
namespace {

double air_at_camera_k(const Air& air) { return air.temperature_k + air.inversion_k; }

ThermalCamera::Clip sensor_clip(const ClipTask& task, const Manifest& manifest) {
  const bool falloff = task.physics && task.physics->terms.falloff;
  return {.id = task.clip.id,
          .seed = task.seed,
          .frame_rate_hz = manifest.frame_rate_hz,
          .width_px = manifest.camera.width_px,
          .height_px = manifest.camera.height_px,
          .noise_gain = falloff ? falloff_noise_gain(manifest.camera) : Plane<float>(),
          .sampling = pixel_sampling(manifest, task.settings().distortion),
          .air_k = task.physics ? air_at_camera_k(with_inversion(*task.physics, manifest).air)
                                : ThermalCamera::Clip().air_k};
}

std::optional<AnalogueLink> link_of(const ClipTask& task, const Manifest& manifest) {
  const std::optional<AnalogueLinkParameters>& link = task.settings().link;
  if (!link) return std::nullopt;
  return AnalogueLink(*link, {.seed = task.seed,
                              .id = task.clip.id,
                              .frame_rate_hz = manifest.frame_rate_hz,
                              .width_px = manifest.camera.width_px,
                              .height_px = manifest.camera.height_px});
}

std::optional<VideoCodec> codec_of(const ClipTask& task, const Manifest& manifest) {
  const std::optional<VideoCodecSettings>& codec = task.settings().codec;
  if (!codec) return std::nullopt;
  return VideoCodec(*codec, manifest.frame_rate_hz, manifest.camera.width_px, manifest.camera.height_px);
}

}  // namespace

ClipImager::ClipImager(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
                       std::shared_ptr<const TemperatureTable> temperatures)
    : camera_(task.settings().sensor, sensor_clip(task, manifest), brightest_w_m2_sr,
              std::move(temperatures)),
      link_(link_of(task, manifest)),
      codec_(codec_of(task, manifest)) {}

void ClipImager::expose(const SceneFrame& scene, Frame& frame) {
  frame.instances = scene.instances;
  frame.checks = scene.checks;
  camera_.expose(scene.radiance_w_m2_sr, scene.detail, scene.motion, frame.pictures,
                 [&](const Plane<float>& radiance_w_m2_sr) {
                   set_contrast(camera_, radiance_w_m2_sr, frame.instances);
                 });
  const ImageMotion frozen;
  if (link_) link_->pass(frame.pictures.shutter_closed ? frozen : scene.motion, frame.pictures.ir8);
}

void ClipImager::skip() {
  camera_.skip();
  if (link_) link_->skip();
}

void ClipImager::encode(Frame& frame) {
  if (codec_) frame.encoded_bytes = codec_->pass(frame.pictures.ir8);
}

}  // namespace thermal
