#include "dataset/clip_maker.h"

#include <array>
#include <utility>

#include <fmt/format.h>
#include <oneapi/tbb/parallel_pipeline.h>

#include "base/error.h"
#include "base/parallel.h"
#include "dataset/clip_output.h"
#include "io/exr_passes.h"
#include "scene/camera_geometry.h"

namespace thermal {
namespace {

constexpr std::size_t kFramesInFlight = 8;

/// A frame on its way through the pipeline: what each output makes of it.
struct FrameWork {
  int number = 0;
  std::vector<ClipOutput::Frame> frames;
};

using Outputs = std::vector<ClipOutput>;

Outputs open_outputs(const std::vector<ClipTask>& tasks, const Manifest& manifest,
                     const MaterialLibrary& materials) {
  Outputs outputs;
  outputs.reserve(tasks.size());
  for (const ClipTask& task : tasks) {
    try {
      outputs.emplace_back(task, manifest, materials);
    } catch (const ConfigError& error) {
      throw ConfigError(task.variant.empty() ? error.what() : task.variant + ": " + error.what());
    }
  }
  return outputs;
}

PassNeeds needs_of(const Outputs& outputs) {
  PassNeeds all;
  for (const ClipOutput& output : outputs) {
    const PassNeeds needs = output.needs();
    all = {.depth = all.depth || needs.depth,
           .normals = all.normals || needs.normals,
           .actors = all.actors || needs.actors};
  }
  return all;
}

/// Makes one clip for all its tasks: the stages of the pipeline, and what they share.
class ClipMaker {
 public:
  ClipMaker(const ClipPasses& passes, const std::vector<ClipTask>& tasks, const MaterialLibrary& materials,
            const ClipHooks& hooks)
      : passes_(passes),
        hooks_(hooks),
        camera_(passes_camera(passes.manifest)),
        outputs_(open_outputs(tasks, passes.manifest, materials)),
        needs_(needs_of(outputs_)) {
    for (FrameWork& work : in_flight_) work.frames.resize(outputs_.size());
  }

  std::vector<ClipRecord> make() {
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
    std::vector<ClipRecord> records;
    for (ClipOutput& output : outputs_) records.push_back(output.finish());
    for (const ClipOutput& output : outputs_) output.move_into_place();
    return records;
  }

 private:
  FrameWork* next(tbb::flow_control& control) {
    if (hooks_.cancelled && hooks_.cancelled()) throw Cancelled();
    if (next_frame_ == static_cast<int>(passes_.manifest.frames.size())) {
      control.stop();
      return nullptr;
    }
    if (hooks_.wait_for_frame) hooks_.wait_for_frame(next_frame_);
    FrameWork& work = in_flight_[static_cast<std::size_t>(next_frame_) % kFramesInFlight];
    work.number = next_frame_++;
    return &work;
  }

  FrameWork* read(FrameWork* work) const {
    const Manifest& manifest = passes_.manifest;
    const Path file = passes_.folder / manifest.frames[static_cast<std::size_t>(work->number)].file;
    const Passes passes =
        read_passes(file, manifest.layer, camera_.width_px, camera_.height_px, needs_, manifest.actor_layer);
    try {
      for (std::size_t i = 0; i < outputs_.size(); ++i)
        outputs_[i].convert(passes, work->number, work->frames[i]);
    } catch (const DataError& error) {
      throw DataError(fmt::format("{}: {}", file.string(), error.what()));
    }
    return work;
  }

  /// Frames come one by one here: with several outputs, those are what there is to share between cores.
  FrameWork* expose(FrameWork* work) {
    parallel_for(outputs_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) outputs_[i].expose(work->frames[i]);
    });
    return work;
  }

  FrameWork* write(FrameWork* work) const {
    for (std::size_t i = 0; i < outputs_.size(); ++i) outputs_[i].write(work->number, work->frames[i]);
    return work;
  }

  void collect(const FrameWork& work) {
    parallel_for(outputs_.size(), 1, [&](std::size_t begin, std::size_t end) {
      for (std::size_t i = begin; i < end; ++i) outputs_[i].collect(work.number, work.frames[i]);
    });
    if (hooks_.frame_done) hooks_.frame_done();
  }

  const ClipPasses& passes_;
  const ClipHooks& hooks_;
  CameraIntrinsics camera_;  ///< of the passes
  Outputs outputs_;
  PassNeeds needs_;  ///< of all outputs
  /// Frame k is in place k modulo their number. That one is free again when k enters: frames leave in order.
  /// Pointers, because what TBB allocates to pass on larger things, it loses when a stage throws.
  std::array<FrameWork, kFramesInFlight> in_flight_;
  int next_frame_ = 0;
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
