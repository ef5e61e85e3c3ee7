#include "dataset/clip/maker.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <exception>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip/annotations.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/clip/imager.h"
#include "dataset/clip/scenes.h"
#include "dataset/dataset_file.h"
#include "io/image/png.h"
#include "io/system/files.h"
#include "io/system/sha256.h"
#include "io/video/h264_file.h"

namespace thermal {
namespace {

/// One task's clip while it is made: its camera and its files, in the task's folder. A frame of its scene
/// goes through expose, encode, write and collect; different frames may be written at the same time, the others must be
/// called one by one and in order.
class ClipOutput {
 public:
  /// Checksums of one written picture: of its pixels and of its file.
  struct WrittenPicture {
    std::string pixels_sha256;
    std::string file_sha256;
  };
  /// A frame in flight. Its memory is reused.
  struct Frame : ClipImager::Frame {
    WrittenPicture ir8;
    WrittenPicture ir16;
    std::vector<std::byte> png;
  };

  /// Creates the task's folder, or empties it. `task` and `manifest` must outlive this object.
  /// @param brightest_w_m2_sr  of the task's scene: FrameConverter::brightest_w_m2_sr()
  /// @param temperatures  for its camera; see ThermalCamera
  ClipOutput(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
             std::shared_ptr<const TemperatureTable> temperatures);

  /// As ClipImager's.
  void expose(const SceneFrame& scene, Frame& frame) { imager_.expose(scene, frame); }
  void encode(Frame& frame) { imager_.encode(frame); }
  void write(int number, Frame& frame) const;
  void collect(int number, const Frame& frame);

  /// Replaces expose() for a frame that could not be read or converted: the clip continues without it. Its number
  /// stays unused in file names, labels and frames.jsonl; clip.json lists it.
  void skip(int number, const std::string& reason);

  /// Writes the files of the clip as a whole.
  ClipRecord finish();

 private:
  [[nodiscard]] const ManifestFrame& frame_of(int number) const;
  [[nodiscard]] Json frame_line(int number, const Frame& frame) const;
  void write_labels();

  const ClipTask& task_;
  const Manifest& manifest_;
  Path folder_;
  float brightest_w_m2_sr_;
  ClipImager imager_;
  PreviewVideo video_;
  ClipAnnotations annotations_;
  Sha256 pixels_;
  ClipRecord record_;
  PassChecks checks_;  ///< of all frames made
  OutputFile frames_jsonl_;
};

Path fresh_folder(const Path& folder) {
  make_fresh_folder(folder);
  make_folder(folder / "ir8");
  make_folder(folder / "ir16");
  return folder;
}

/// Whether thresholds turn a task's 8-bit frames back into kelvin: nothing filters, sharpens, sends or encodes them.
bool is_invertible(const ClipTask& task) {
  const ClipSettings& settings = task.settings();
  const AgcParameters& agc = settings.sensor.agc;
  const ProcessingParameters& processing = settings.sensor.processing;
  return agc.mode != AgcMode::clahe && agc.mode != AgcMode::table_max && agc.detail.gain_dn_per_netd == 0 &&
         processing.noise_filter_sigma_px == 0 && processing.unsharp_amount == 0 && !settings.link &&
         !settings.codec;
}

template <typename T>
ClipOutput::WrittenPicture write_picture(const Plane<T>& picture, const Path& file,
                                         std::vector<std::byte>& png) {
  encode_png(picture, png);
  write_file(file, png);
  return {.pixels_sha256 = sha256_of(std::as_bytes(picture.pixels())), .file_sha256 = sha256_of(png)};
}

ClipOutput::ClipOutput(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
                       std::shared_ptr<const TemperatureTable> temperatures)
    : task_(task),
      manifest_(manifest),
      folder_(fresh_folder(task.folder)),
      brightest_w_m2_sr_(brightest_w_m2_sr),
      imager_(task, manifest, brightest_w_m2_sr, std::move(temperatures)),
      video_(folder_ / "preview.mp4", manifest.frame_rate_hz, manifest.camera.width_px,
             manifest.camera.height_px),
      annotations_(manifest, task.settings().distortion, task.settings().labels, folder_ / "labels.spool"),
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
  line["agc"] = tone_record(frame.pictures.curve, task_.settings().sensor.agc, brightest_w_m2_sr_);
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

constexpr std::size_t kFramesInFlight = 8;

/// Limits the number of large pictures, so that the memory of frames in flight stays under half a gigabyte.
std::size_t frames_in_flight(const CameraIntrinsics& camera) {
  constexpr std::size_t kPixelsInFlight = 24'000'000;
  const auto pixels = static_cast<std::size_t>(camera.width_px) * static_cast<std::size_t>(camera.height_px);
  return std::clamp<std::size_t>(kPixelsInFlight / pixels, 2, kFramesInFlight);
}

/// A frame in the pipeline: the results of each scene and each output.
struct FrameWork {
  int number = 0;
  std::exception_ptr fault;             ///< the fault of its file or contents
  std::optional<SkippedFrame> skipped;  ///< for that fault
  std::vector<SceneFrame> scenes;
  std::vector<ClipOutput::Frame> frames;
};

/// The output of a scene's frames for one task.
struct ClipResult {
  std::size_t scene;
  ClipOutput clip;
};

using Outputs = std::vector<ClipResult>;

ClipResult open_output(const ClipTask& task, const Manifest& manifest, ClipScenes& scenes) {
  const std::size_t scene = scenes.add(task);
  return {.scene = scene,
          .clip = ClipOutput(task, manifest, scenes.brightest_w_m2_sr(scene),
                             scenes.temperatures(task.settings().sensor.response))};
}

Outputs open_outputs(const std::vector<ClipTask>& tasks, const Manifest& manifest, ClipScenes& scenes) {
  Outputs outputs;
  outputs.reserve(tasks.size());
  for (const ClipTask& task : tasks) {
    try {
      outputs.push_back(open_output(task, manifest, scenes));
    } catch (const ConfigError& error) {
      throw ConfigError(task.variant.empty() ? error.what() : task.variant + ": " + error.what());
    }
  }
  return outputs;
}

/// Makes one clip for all its tasks: the stages of the pipeline, and their shared state.
class ClipMaker {
 public:
  ClipMaker(const ClipPasses& passes, const std::vector<ClipTask>& tasks, const MaterialLibrary& materials,
            const ClipHooks& hooks)
      : passes_(passes),
        hooks_(hooks),
        reader_(reader_for(passes)),
        scenes_(passes.manifest, materials),
        outputs_(open_outputs(tasks, passes.manifest, scenes_)),
        needs_(scenes_.needs()) {
    for (FrameWork& work : in_flight_) work.frames.resize(outputs_.size());
  }

  std::vector<ClipRecord> make() {
    const PipelineStage reading = {.in_order = false,
                                   .work = [this](std::size_t frame) { read(slot(frame)); }};
    const PipelineStage exposing = {.in_order = true,
                                    .work = [this](std::size_t frame) { expose(slot(frame)); }};
    const PipelineStage encoding = {.in_order = true,
                                    .work = [this](std::size_t frame) { encode(slot(frame)); }};
    const PipelineStage writing = {.in_order = false,
                                   .work = [this](std::size_t frame) { write(slot(frame)); }};
    const PipelineStage leaving = {.in_order = true,
                                   .work = [this](std::size_t frame) { collect(slot(frame)); }};
    run_pipeline(frames_in_flight(passes_.manifest.camera),
                 [this](std::size_t frame) { return enter(frame); },
                 {reading, exposing, encoding, writing, leaving});
    if (frames_skipped_ == frame_count()) throw DataError(no_frame_left(first_fault_, frames_skipped_));
    std::vector<ClipRecord> records;
    for (ClipResult& output : outputs_) records.push_back(output.clip.finish());
    return records;
  }

 private:
  /// That of a frame in the pipeline. It is free again when the frame enters whose number modulo their number is the
  /// same, because frames leave in order.
  FrameWork& slot(std::size_t frame) { return in_flight_[frame % kFramesInFlight]; }

  bool enter(std::size_t frame) {
    if (hooks_.cancelled && hooks_.cancelled()) throw Cancelled();
    const int number = static_cast<int>(frame);
    if (number == frame_count()) return false;
    if (hooks_.wait_for_frame) hooks_.wait_for_frame(number);
    slot(frame).number = number;
    return true;
  }

  [[nodiscard]] int frame_count() const { return static_cast<int>(passes_.manifest.frames.size()); }

  void read(FrameWork& work) {
    work.fault = nullptr;
    work.skipped.reset();
    try {
      convert(work);
    } catch (const DataError&) {
      work.fault = std::current_exception();
    } catch (const IoError&) {
      work.fault = std::current_exception();
    }
  }

  /// A thread that waits in here takes on no other frame (parallel_for()): the buffer belongs to this one.
  void convert(FrameWork& work) {
    PassBuffer& buffer = buffers_.local();
    if (passes_.source) {
      passes_.source->read(work.number, needs_, buffer.passes);
      scenes_.convert(buffer.passes, work.number, work.scenes);
      return;
    }
    const Path file = file_of(passes_, work.number);
    reader_.read(file, needs_, buffer);
    naming(file, [&] { scenes_.convert(buffer.passes, work.number, work.scenes); });
  }

  /// Frames arrive here one by one; with several outputs, these are what can be shared between cores. Faults are
  /// reported in frame order, so that the reported one does not depend on which was found first.
  void expose(FrameWork& work) {
    if (work.fault) {
      skip(work);
      return;
    }
    for_each_output(
        [&](std::size_t i) { outputs_[i].clip.expose(work.scenes[outputs_[i].scene], work.frames[i]); });
  }

  void skip(FrameWork& work) {
    if (passes_.bad_frames == BadFrames::fail) std::rethrow_exception(work.fault);
    work.skipped = skipped_frame(passes_, work.number, work.fault);
    for (ClipResult& output : outputs_) output.clip.skip(work.number, work.skipped->reason);
    if (frames_skipped_++ == 0) first_fault_ = message_of(work.fault);
  }

  /// Apart from exposing, so that the codec works on one frame while the camera works on the next.
  void encode(FrameWork& work) {
    if (work.skipped) return;
    for_each_output([&](std::size_t i) { outputs_[i].clip.encode(work.frames[i]); });
  }

  void for_each_output(const std::function<void(std::size_t output)>& work) const {
    parallel_for(outputs_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) work(i);
    });
  }

  void write(FrameWork& work) const {
    if (work.skipped) return;
    for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i].clip.write(work.number, work.frames[i]);
  }

  void collect(const FrameWork& work) {
    if (work.skipped) {
      if (hooks_.frame_skipped) hooks_.frame_skipped(*work.skipped);
    } else {
      for_each_output([&](std::size_t i) { outputs_[i].clip.collect(work.number, work.frames[i]); });
    }
    if (hooks_.frame_done) hooks_.frame_done();
  }

  const ClipPasses& passes_;
  const ClipHooks& hooks_;
  PassReader reader_;
  ClipScenes scenes_;
  Outputs outputs_;
  PassNeeds needs_;  ///< of all scenes
  tbb::enumerable_thread_specific<PassBuffer> buffers_;
  std::array<FrameWork, kFramesInFlight> in_flight_;
  int frames_skipped_ = 0;
  std::string first_fault_;  ///< of those
};

}  // namespace

std::vector<ClipRecord> make_clips(const ClipPasses& passes, const std::vector<ClipTask>& tasks,
                                   const MaterialLibrary& materials, const ClipHooks& hooks) {
  return ClipMaker(passes, tasks, materials, hooks).make();
}

ClipRecord make_clip(const ClipPasses& passes, const ClipTask& task, const MaterialLibrary& materials,
                     const ClipHooks& hooks) {
  return make_clips(passes, {task}, materials, hooks).front();
}

}  // namespace thermal
