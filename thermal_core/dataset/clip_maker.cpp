#include "dataset/clip_maker.h"

#include <array>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include "base/error.h"
#include "dataset/annotations.h"
#include "imaging/frame_converter.h"
#include "io/exr_passes.h"
#include "io/png.h"
#include "io/preview_video.h"
#include "io/sha256.h"
#include "scene/camera_geometry.h"
#include "sensor/airsim_sensor.h"

namespace thermal {
namespace {

constexpr std::size_t kFramesInFlight = 8;

/// One picture as it was written: sums of its pixels and of its file.
struct WrittenPicture {
  std::string pixels_sha256;
  std::string file_sha256;
};

/// A frame on its way through the pipeline.
struct FrameWork {
  int frame = 0;
  SceneFrame scene;
  SensorFrame pictures;
  WrittenPicture ir8;
  WrittenPicture ir16;
};

template <typename T>
WrittenPicture write_picture(const Plane<T>& picture, const Path& file) {
  const std::vector<std::byte> png = encode_png(picture);
  write_file(file, png);
  return {.pixels_sha256 = sha256_of(std::as_bytes(picture.pixels())), .file_sha256 = sha256_of(png)};
}

/// Makes one clip: the stages of the pipeline, and what they share.
class ClipMaker {
 public:
  ClipMaker(const ClipTask& task, const MaterialLibrary& materials, Path folder, const ClipHooks& hooks)
      : task_(task),
        folder_(std::move(folder)),
        hooks_(hooks),
        converter_(task.manifest, materials, task.clip.season, task.sensor, task.physics),
        sensor_(task.sensor, sensor_clip(task), converter_.brightest_w_m2_sr()),
        video_(folder_ / "preview.mp4", task.manifest.frame_rate_hz, task.manifest.camera.width_px,
               task.manifest.camera.height_px),
        annotations_(task.manifest) {}

  ClipRecord make() {
    using tbb::filter_mode;
    const auto enter = tbb::make_filter<void, FrameWork*>(
        filter_mode::serial_in_order, [this](tbb::flow_control& control) { return next(control); });
    const auto reading = tbb::make_filter<FrameWork*, FrameWork*>(
        filter_mode::parallel, [this](FrameWork* work) { return read(work); });
    const auto exposing = tbb::make_filter<FrameWork*, FrameWork*>(
        filter_mode::serial_in_order, [this](FrameWork* work) { return expose(work); });
    const auto writing = tbb::make_filter<FrameWork*, FrameWork*>(
        filter_mode::parallel, [this](FrameWork* work) { return write(work); });
    const auto leave = tbb::make_filter<FrameWork*, void>(filter_mode::serial_in_order,
                                                          [this](FrameWork* work) { collect(*work); });
    tbb::parallel_pipeline(kFramesInFlight, enter & reading & exposing & writing & leave);
    return finish();
  }

 private:
  static AirsimSensor::Clip sensor_clip(const ClipTask& task) {
    const bool falloff = task.physics && task.physics->terms.falloff;
    return {.id = task.clip.id,
            .seed = task.seed,
            .frame_rate_hz = task.manifest.frame_rate_hz,
            .width_px = task.manifest.camera.width_px,
            .height_px = task.manifest.camera.height_px,
            .noise_gain = falloff ? falloff_noise_gain(task.manifest.camera) : Plane<float>()};
  }

  FrameWork* next(tbb::flow_control& control) {
    if (hooks_.cancelled && hooks_.cancelled()) throw Cancelled();
    if (next_frame_ == static_cast<int>(task_.manifest.frames.size())) {
      control.stop();
      return nullptr;
    }
    if (hooks_.wait_for_frame) hooks_.wait_for_frame(next_frame_);
    FrameWork& work = in_flight_[static_cast<std::size_t>(next_frame_) % kFramesInFlight];
    work.frame = next_frame_++;
    return &work;
  }

  FrameWork* read(FrameWork* work) const {
    const Path file = task_.passes / record_of(*work).file;
    const CameraIntrinsics& camera = task_.manifest.camera;
    const int finer = task_.manifest.supersample;
    const Passes passes = read_passes(file, task_.manifest.layer, camera.width_px * finer,
                                      camera.height_px * finer, converter_.needs());
    try {
      converter_.convert(passes, record_of(*work), work->scene);
    } catch (const DataError& error) {
      throw DataError(fmt::format("{}: {}", file.string(), error.what()));
    }
    return work;
  }

  FrameWork* expose(FrameWork* work) {
    work->pictures = sensor_.expose(work->scene.radiance_w_m2_sr);
    return work;
  }

  FrameWork* write(FrameWork* work) const {
    const std::string name = frame_name(work->frame);
    work->ir8 = write_picture(work->pictures.ir8, folder_ / "ir8" / name);
    work->ir16 = write_picture(work->pictures.ir16, folder_ / "ir16" / name);
    return work;
  }

  void collect(const FrameWork& work) {
    video_.add(work.pictures.ir8);
    annotations_.add_frame(work.frame, work.scene.instances);
    pixels_.add(work.ir8.pixels_sha256);
    pixels_.add(work.ir16.pixels_sha256);
    record_.files["ir8/" + frame_name(work.frame)] = work.ir8.file_sha256;
    record_.files["ir16/" + frame_name(work.frame)] = work.ir16.file_sha256;
    frames_jsonl_ += frame_line(work).dump() + "\n";
    if (hooks_.frame_done) hooks_.frame_done();
  }

  Json frame_line(const FrameWork& work) const {
    const ManifestFrame& frame = record_of(work);
    Json line = {{"frame_index", work.frame}, {"time_s", frame.time_s}};
    if (frame.agl_m) line["agl_m"] = *frame.agl_m;
    if (frame.look_angle_deg) line["look_angle_deg"] = *frame.look_angle_deg;
    if (frame.camera_to_world) line["camera_to_world"] = *frame.camera_to_world;
    line["ffc"] = false;
    line["agc"] = {
        {"mode", task_.sensor.normalisation == Normalisation::table_max ? "table_max" : "scene_max"},
        {"brightest_w_m2_sr", converter_.brightest_w_m2_sr()}};
    line["ir8_sha256"] = work.ir8.pixels_sha256;
    line["ir16_sha256"] = work.ir16.pixels_sha256;
    return line;
  }

  /// Writes what is about the clip as a whole.
  ClipRecord finish() {
    { const PreviewVideo closed = std::move(video_); }
    add_text("labels.json", to_text(annotations_.document()));
    add_text("frames.jsonl", frames_jsonl_);
    record_.files["preview.mp4"] = sha256_of(read_file(folder_ / "preview.mp4"));
    record_.clip = task_.clip.id;
    record_.season = season_name(task_.clip.season);
    record_.seed = task_.seed;
    record_.frames = next_frame_;
    record_.annotations = annotations_.count();
    record_.frame_rate_hz = task_.manifest.frame_rate_hz;
    record_.pixels_sha256 = pixels_.hex();
    write_file_atomically(folder_ / "clip.json", to_text(to_json(record_)));
    return record_;
  }

  void add_text(const std::string& name, const std::string& text) {
    write_file(folder_ / name, std::as_bytes(std::span(text)));
    record_.files[name] = sha256_of(text);
  }

  const ManifestFrame& record_of(const FrameWork& work) const {
    return task_.manifest.frames[static_cast<std::size_t>(work.frame)];
  }

  const ClipTask& task_;
  Path folder_;
  const ClipHooks& hooks_;
  FrameConverter converter_;
  AirsimSensor sensor_;
  PreviewVideo video_;
  ClipAnnotations annotations_;
  Sha256 pixels_;
  ClipRecord record_;
  std::string frames_jsonl_;
  /// Frame k is in place k modulo their number. That one is free again when k enters: frames leave in order.
  /// Pointers, because what TBB allocates to pass on larger things, it loses when a stage throws.
  std::array<FrameWork, kFramesInFlight> in_flight_;
  int next_frame_ = 0;
};

}  // namespace

ClipRecord make_clip(const ClipTask& task, const MaterialLibrary& materials, const Layout& layout,
                     const ClipHooks& hooks) {
  const Path unfinished = layout.unfinished_clip(task.clip.id);
  std::filesystem::remove_all(unfinished);
  make_folder(unfinished / "ir8");
  make_folder(unfinished / "ir16");
  ClipRecord record = ClipMaker(task, materials, unfinished, hooks).make();
  const Path finished = layout.clip(task.clip.id);
  std::filesystem::remove_all(finished);
  std::filesystem::rename(unfinished, finished);
  sync_folder(finished.parent_path());
  return record;
}

}  // namespace thermal
