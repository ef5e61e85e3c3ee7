#include "dataset/clip/maker.h"

#include <algorithm>
#include <array>
#include <exception>
#include <functional>
#include <optional>
#include <utility>

#include <oneapi/tbb/enumerable_thread_specific.h>

#include "base/error.h"
#include "base/parallel.h"
#include "base/pipeline.h"
#include "dataset/clip/frame_faults.h"
#include "dataset/clip/output.h"
#include "dataset/clip/pass_source.h"
#include "dataset/clip/scenes.h"
#include "io/system/naming.h"

namespace thermal {
namespace {

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
                             scenes.temperatures(task.sensor.response))};
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
