#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "dataset/clip_record.h"
#include "dataset/layout.h"
#include "imaging/scene_radiance.h"
#include "io/config.h"
#include "io/pass_reader.h"
#include "labels/label_parameters.h"
#include "scene/lens_distortion.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// What to do with a clip if a frame cannot be read or converted: reject the clip, or make it without that frame.
enum class BadFrames { fail, skip };

/// One rendered clip, and how to read it.
struct ClipPasses {
  Manifest manifest;
  Path folder;  ///< of the EXR files
  ReadLimits limits = {};
  BadFrames bad_frames = BadFrames::fail;
  std::string identity_sha256 = {};  ///< identity_of() them; empty if they are rendered for the dataset
};

/// What a dataset makes from a clip's passes: all settings for frames and labels.
struct ClipTask {
  std::string variant;  ///< start of messages about the request; empty if there is only one task
  ClipConfig clip;
  std::uint32_t seed = 1;
  SensorParameters sensor;
  LensDistortion distortion;
  LabelParameters labels;
  std::optional<PhysicsSettings> physics;  ///< empty: the published model
  Layout layout;                           ///< its folder
  std::string made_from_sha256 = {};       ///< for the clip's record
};

/// Callbacks while a clip is made. All may be empty.
struct ClipHooks {
  std::function<void(int frame)> wait_for_frame;  ///< returns when the frame's passes are complete; may throw
  std::function<void()> frame_done;               ///< over all tasks; also for skipped frames
  std::function<bool()> cancelled;
  std::function<void(const SkippedFrame&)> frame_skipped = {};  ///< for each frame before it is done
};

/// Makes clips/<clip> of one dataset per task, and reads the passes once for all of them. Each is made under a
/// temporary name and renamed when complete, so that a clip exists completely or not at all; after a failure, nothing
/// is left of it. Frames are read, labelled and written in parallel and pass the sensor in order; at most eight are
/// in memory. For 640 x 512 pixels a task uses 8 MB in those, and about 100 MB with its camera's state and its
/// preview encoder; a scene, which tasks that differ only in the sensor share, uses 10 MB. The planes of frames being
/// read are shared by all.
/// A bad frame is bad for all tasks, because they share its file and the manifest. The first one of a clip, by
/// number, is reported.
/// DataError or IoError with the file, and then no task has its clip: for the first bad frame or, if those are
/// skipped, if no frame is left; ConfigError; TryAgainError; Cancelled on request.
/// Pixels of a task depend only on the passes and that task. Returns one record per task, in their order.
std::vector<ClipRecord> make_clips(const ClipPasses& passes, const std::vector<ClipTask>& tasks,
                                   const MaterialLibrary& materials, const ClipHooks& hooks);

/// The same for one task.
ClipRecord make_clip(const ClipPasses& passes, const ClipTask& task, const MaterialLibrary& materials,
                     const ClipHooks& hooks);

}  // namespace thermal
