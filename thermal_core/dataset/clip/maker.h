#pragma once

#include <functional>
#include <vector>

#include "dataset/clip/record.h"
#include "dataset/clip/task.h"
#include "scene/material.h"

namespace thermal {

/// Callbacks while a clip is made. All may be empty.
struct ClipHooks {
  std::function<void(int frame)> wait_for_frame;  ///< returns when the frame's passes are complete; may throw
  std::function<void()> frame_done;               ///< over all tasks; also for skipped frames
  std::function<bool()> cancelled;
  std::function<void(const SkippedFrame&)> frame_skipped = {};  ///< for each frame before it is done
};

/// Makes one clip of one dataset per task, each in the task's folder, and reads the passes once for all of them. All
/// are complete on return; after a failure all are useless (DatasetTransaction removes them). Frames are read, labelled and written in parallel and pass the sensor in order; at most eight are
/// in memory. For 640 x 512 pixels a task uses 8 MB in those, and about 100 MB with its camera's state and its
/// preview encoder; a scene, which tasks that differ only in the sensor share, uses 10 MB. The planes of frames being
/// read are shared by all.
/// A bad frame is bad for all tasks, because they share its file and the manifest. The first one of a clip, by
/// number, is reported.
/// DataError or IoError with the file: for the first bad frame or, if those are
/// skipped, if no frame is left; ConfigError; TryAgainError; Cancelled on request.
/// Pixels of a task depend only on the passes and that task. Returns one record per task, in their order.
std::vector<ClipRecord> make_clips(const ClipPasses& passes, const std::vector<ClipTask>& tasks,
                                   const MaterialLibrary& materials, const ClipHooks& hooks);

/// The same for one task.
ClipRecord make_clip(const ClipPasses& passes, const ClipTask& task, const MaterialLibrary& materials,
                     const ClipHooks& hooks);

}  // namespace thermal
