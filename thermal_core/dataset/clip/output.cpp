#include "dataset/clip/output.h"

#include <span>
#include <string_view>
#include <utility>

#include "dataset/clip/tone_record.h"
#include "dataset/layout.h"
#include "io/system/files.h"

namespace thermal {
namespace {

Path fresh_folder(const Path& folder) {
  make_fresh_folder(folder);
  make_folder(folder / "ir8");
  make_folder(folder / "ir16");
  return folder;
}

/// Whether thresholds turn a task's 8-bit frames back into kelvin: nothing filters, sharpens, sends or encodes them.
bool is_invertible(const ClipTask& task) {
  const AgcParameters& agc = task.sensor.agc;
  const ProcessingParameters& processing = task.sensor.processing;
  return agc.mode != AgcMode::clahe && agc.mode != AgcMode::table_max && agc.detail.gain_dn_per_netd == 0 &&
         processing.noise_filter_sigma_px == 0 && processing.unsharp_amount == 0 && !task.link && !task.codec;
}

template <typename T>
ClipOutput::WrittenPicture write_picture(const Plane<T>& picture, const Path& file,
                                         std::vector<std::byte>& png) {
  encode_png(picture, png);
  write_file(file, png);
  return {.pixels_sha256 = sha256_of(std::as_bytes(picture.pixels())), .file_sha256 = sha256_of(png)};
}

}  // namespace

ClipOutput::ClipOutput(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
                       std::shared_ptr<const TemperatureTable> temperatures)
    : task_(task),
      manifest_(manifest),
      folder_(fresh_folder(task.folder)),
      brightest_w_m2_sr_(brightest_w_m2_sr),
      imager_(task, manifest, brightest_w_m2_sr, std::move(temperatures)),
      video_(folder_ / "preview.mp4", manifest.frame_rate_hz, manifest.camera.width_px,
             manifest.camera.height_px),
      annotations_(manifest, task.distortion, task.labels, folder_ / "labels.spool"),
      frames_jsonl_(folder_ / "frames.jsonl") {}

void ClipOutput::write(int number, Frame& frame) const {
  const std::string name = frame_name(number);
  frame.ir8 = write_picture(frame.pictures.ir8, folder_ / "ir8" / name, frame.png);
  frame.ir16 = write_picture(frame.pictures.ir16, folder_ / "ir16" / name, frame.png);
}

void ClipOutput::collect(int number, const Frame& frame) {
  video_.add(frame.pictures.ir8);
  annotations_.add_frame(number, frame.instances, frame.pictures.shutter_closed);
  pixels_.add(frame.ir8.pixels_sha256);
  pixels_.add(frame.ir16.pixels_sha256);
  record_.files["ir8/" + frame_name(number)] = frame.ir8.file_sha256;
  record_.files["ir16/" + frame_name(number)] = frame.ir16.file_sha256;
  frames_jsonl_.add(frame_line(number, frame).dump() + "\n");
  checks_ += frame.checks;
  ++record_.frames;
}

void ClipOutput::skip(int number, const std::string& reason) {
  imager_.skip();
  record_.skipped.push_back({.frame_index = number, .file = frame_of(number).file, .reason = reason});
}

ClipRecord ClipOutput::finish() {
  video_.close();
  write_labels();
  record_.files["frames.jsonl"] = frames_jsonl_.close();
  record_.files["preview.mp4"] = sha256_of_file(folder_ / "preview.mp4");
  record_.clip = task_.clip.id;
  record_.season = season_name(task_.clip.season);
  record_.seed = task_.seed;
  record_.made_from_sha256 = task_.made_from_sha256;
  record_.annotations = annotations_.count();
  record_.frame_rate_hz = manifest_.frame_rate_hz;
  record_.pixels_sha256 = pixels_.hex();
  if (checks_.depth.pixels > 0) record_.unusable_depth_share = checks_.depth.share();
  if (checks_.normal.pixels > 0) record_.unusable_normal_share = checks_.normal.share();
  write_file_atomically(folder_ / "clip.json", to_text(to_json(record_)));
  return record_;
}

const ManifestFrame& ClipOutput::frame_of(int number) const {
  return manifest_.frames[static_cast<std::size_t>(number)];
}

Json ClipOutput::frame_line(int number, const Frame& frame) const {
  const ManifestFrame& pose = frame_of(number);
  Json line = {{"frame_index", number}, {"time_s", pose.time_s}};
  if (pose.agl_m) line["agl_m"] = *pose.agl_m;
  if (pose.look_angle_deg) line["look_angle_deg"] = *pose.look_angle_deg;
  if (pose.camera_to_world) line["camera_to_world"] = *pose.camera_to_world;
  line["ffc"] = frame.pictures.shutter_closed;
  line["agc"] = tone_record(frame.pictures.curve, task_.sensor.agc, brightest_w_m2_sr_);
  line["agc"]["invertible"] = is_invertible(task_);
  if (imager_.has_codec()) line["encoded_bytes"] = frame.encoded_bytes;
  line["ir8_sha256"] = frame.ir8.pixels_sha256;
  line["ir16_sha256"] = frame.ir16.pixels_sha256;
  return line;
}

void ClipOutput::write_labels() {
  OutputFile labels(folder_ / "labels.json");
  annotations_.write([&labels](std::string_view text) { labels.add(text); });
  record_.files["labels.json"] = labels.close();
}

}  // namespace thermal
