#include "dataset/clip_output.h"

#include <cstddef>
#include <span>
#include <utility>
#include <vector>

#include "dataset/tone_record.h"
#include "imaging/target_contrast.h"
#include "io/png.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

Path fresh_folder(const Path& folder) {
  std::filesystem::remove_all(folder);
  make_folder(folder / "ir8");
  make_folder(folder / "ir16");
  return folder;
}

ThermalCamera::Clip sensor_clip(const ClipTask& task, const Manifest& manifest) {
  const bool falloff = task.physics && task.physics->terms.falloff;
  return {.id = task.clip.id,
          .seed = task.seed,
          .frame_rate_hz = manifest.frame_rate_hz,
          .width_px = manifest.camera.width_px,
          .height_px = manifest.camera.height_px,
          .noise_gain = falloff ? falloff_noise_gain(manifest.camera) : Plane<float>(),
          .supersample = manifest.supersample};
}

template <typename T>
ClipOutput::WrittenPicture write_picture(const Plane<T>& picture, const Path& file) {
  const std::vector<std::byte> png = encode_png(picture);
  write_file(file, png);
  return {.pixels_sha256 = sha256_of(std::as_bytes(picture.pixels())), .file_sha256 = sha256_of(png)};
}

}  // namespace

ClipOutput::ClipOutput(const ClipTask& task, const Manifest& manifest, const MaterialLibrary& materials)
    : task_(task),
      manifest_(manifest),
      folder_(fresh_folder(task.layout.unfinished_clip(task.clip.id))),
      converter_(manifest, materials, task.clip.season, task.sensor, task.physics, task.distortion),
      camera_(task.sensor, sensor_clip(task, manifest), converter_.brightest_w_m2_sr()),
      video_(folder_ / "preview.mp4", manifest.frame_rate_hz, manifest.camera.width_px,
             manifest.camera.height_px),
      annotations_(manifest, task.distortion, task.labels) {}

void ClipOutput::convert(const Passes& passes, int number, Frame& frame) const {
  converter_.convert(passes, told_of(number), frame.scene);
}

void ClipOutput::expose(Frame& frame) {
  camera_.expose(frame.scene.radiance_w_m2_sr, frame.pictures, [&](const Plane<float>& radiance_w_m2_sr) {
    tell_contrast(camera_, radiance_w_m2_sr, frame.scene.instances);
  });
}

void ClipOutput::write(int number, Frame& frame) const {
  const std::string name = frame_name(number);
  frame.ir8 = write_picture(frame.pictures.ir8, folder_ / "ir8" / name);
  frame.ir16 = write_picture(frame.pictures.ir16, folder_ / "ir16" / name);
}

void ClipOutput::collect(int number, const Frame& frame) {
  video_.add(frame.pictures.ir8);
  annotations_.add_frame(number, frame.scene.instances, frame.pictures.shutter_closed);
  pixels_.add(frame.ir8.pixels_sha256);
  pixels_.add(frame.ir16.pixels_sha256);
  record_.files["ir8/" + frame_name(number)] = frame.ir8.file_sha256;
  record_.files["ir16/" + frame_name(number)] = frame.ir16.file_sha256;
  frames_jsonl_ += frame_line(number, frame).dump() + "\n";
  ++record_.frames;
}

ClipRecord ClipOutput::finish() {
  { const PreviewVideo closed = std::move(video_); }
  add_text("labels.json", to_text(annotations_.document()));
  add_text("frames.jsonl", frames_jsonl_);
  record_.files["preview.mp4"] = sha256_of(read_file(folder_ / "preview.mp4"));
  record_.clip = task_.clip.id;
  record_.season = season_name(task_.clip.season);
  record_.seed = task_.seed;
  record_.annotations = annotations_.count();
  record_.frame_rate_hz = manifest_.frame_rate_hz;
  record_.pixels_sha256 = pixels_.hex();
  write_file_atomically(folder_ / "clip.json", to_text(to_json(record_)));
  return record_;
}

void ClipOutput::move_into_place() const {
  const Path finished = task_.layout.clip(task_.clip.id);
  std::filesystem::remove_all(finished);
  std::filesystem::rename(folder_, finished);
  sync_folder(finished.parent_path());
}

const ManifestFrame& ClipOutput::told_of(int number) const {
  return manifest_.frames[static_cast<std::size_t>(number)];
}

Json ClipOutput::frame_line(int number, const Frame& frame) const {
  const ManifestFrame& told = told_of(number);
  Json line = {{"frame_index", number}, {"time_s", told.time_s}};
  if (told.agl_m) line["agl_m"] = *told.agl_m;
  if (told.look_angle_deg) line["look_angle_deg"] = *told.look_angle_deg;
  if (told.camera_to_world) line["camera_to_world"] = *told.camera_to_world;
  line["ffc"] = frame.pictures.shutter_closed;
  line["agc"] = tone_record(frame.pictures.curve, task_.sensor.agc, converter_.brightest_w_m2_sr());
  line["ir8_sha256"] = frame.ir8.pixels_sha256;
  line["ir16_sha256"] = frame.ir16.pixels_sha256;
  return line;
}

void ClipOutput::add_text(const std::string& name, const std::string& text) {
  write_file(folder_ / name, std::as_bytes(std::span(text)));
  record_.files[name] = sha256_of(text);
}

}  // namespace thermal
