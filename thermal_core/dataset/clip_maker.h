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

/// What becomes of a clip with a frame that cannot be read or converted: it is not made, or made without that frame.
enum class BadFrames { fail, skip };

/// One clip as it was rendered, and how it is read.
struct ClipPasses {
  Manifest manifest;
  Path folder;  ///< of the EXR files
  ReadLimits limits = {};
  BadFrames bad_frames = BadFrames::fail;
};

/// What a dataset makes of a clip's passes: all it takes for frames and labels.
struct ClipTask {
  std::string variant;  ///< begins faults of what is asked for; empty where only one thing is
  ClipConfig clip;
  std::uint32_t seed = 1;
  SensorParameters sensor;
  LensDistortion distortion;
  LabelParameters labels;
  std::optional<PhysicsSettings> physics;  ///< empty: the published model
  Layout layout;                           ///< where it goes
};

/// How the making of a clip talks to whoever asked for it. All may be empty.
struct ClipHooks {
  std::function<void(int frame)> wait_for_frame;  ///< returns when the frame's passes are whole; may throw
  std::function<void()> frame_done;               ///< of all tasks; of frames that are skipped, too
  std::function<bool()> cancelled;
  std::function<void(const SkippedFrame&)> frame_skipped = {};  ///< before it is done
};

/// Makes clips/<clip> of one dataset a task, and reads the passes once for all of them. Each is made under a
/// temporary name and renamed when whole, so that a clip is there completely or not at all; where none is made, nothing
/// is left of it. Frames are read,
/// labelled and written in parallel and pass the sensor in order; at most eight are in memory. Of 640 x 512 pixels a
/// task has 8 MB in those, and with its camera's memory and the encoder of its preview about 100 MB; a scene, which
/// tasks that differ in the sensor alone have in common, has 10 MB. The planes of frames that are being read come once
/// for all.
/// A bad frame is one for all tasks: they share its file and the manifest. Told is the first of a clip, by its number.
/// DataError or IoError naming the file, and then no task has its clip: of the first bad frame, or, where those are
/// skipped, if no frame is left; ConfigError; TryAgainError; Cancelled if asked to stop.
/// Pixels of a task depend on the passes and that task alone. Returns a record a task, in their order.
std::vector<ClipRecord> make_clips(const ClipPasses& passes, const std::vector<ClipTask>& tasks,
                                   const MaterialLibrary& materials, const ClipHooks& hooks);

/// The same for one task.
ClipRecord make_clip(const ClipPasses& passes, const ClipTask& task, const MaterialLibrary& materials,
                     const ClipHooks& hooks);

}  // namespace thermal
