#pragma once

#include <functional>
#include <optional>

#include "dataset/clip_record.h"
#include "dataset/layout.h"
#include "imaging/scene_radiance.h"
#include "io/config.h"
#include "scene/manifest.h"
#include "scene/material.h"

namespace thermal {

/// All it takes to turn one clip's passes into frames and labels.
struct ClipTask {
  ClipConfig clip;
  std::uint32_t seed = 1;
  SensorParameters sensor;
  std::optional<PhysicsSettings> physics;  ///< empty: the published model
  Manifest manifest;
  Path passes;  ///< folder of the EXR files
};

/// How the making of a clip talks to whoever asked for it. All may be empty.
struct ClipHooks {
  std::function<void(int frame)> wait_for_frame;  ///< returns when the frame's passes are whole; may throw
  std::function<void()> frame_done;
  std::function<bool()> cancelled;
};

/// Makes clips/<clip> of a dataset: under a temporary name, renamed when whole, so that a clip is there
/// completely or not at all. Frames are read, labelled and written in parallel and pass the sensor in order;
/// at most eight are in memory.
/// DataError or IoError naming the file; Cancelled if asked to stop. Pixels depend on the task alone.
ClipRecord make_clip(const ClipTask& task, const MaterialLibrary& materials, const Layout& layout,
                     const ClipHooks& hooks);

}  // namespace thermal
