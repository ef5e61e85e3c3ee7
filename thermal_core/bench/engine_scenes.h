#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "dataset/plan/plan_store.h"
#include "io/assets.h"
#include "io/system/files.h"
#include "raycast/ray_caster.h"
#include "scene/baked_scene.h"

namespace thermal {

/// Frames of each clip. The first is not counted, because it includes building shared structures.
inline constexpr int kEngineFrames = 4;

struct EngineClip {
  std::string id;
  std::string name;  ///< of its rows
};

/// A planned config, of which all engines render the same frames.
struct EngineScene {
  std::string name;
  Path plan;  ///< folder
  PlannedDataset planned;
  std::vector<EngineClip> clips;
};

struct EngineScenesTask {
  Assets assets;
  Path folder;      ///< for the plans
  int threads = 0;  ///< 0: thread_count(0)
  std::function<void(const std::string&)> announce = {};
};

/// Plans the demo, the savanna from three views, and the savanna with up to ten times the plants, without overlaps. The
/// views follow the group of the config's last clip, so that actors are in the picture.
[[nodiscard]] std::vector<EngineScene> plan_engine_scenes(const EngineScenesTask& task);

/// Time of the engine `embree` for a frame of passes in memory.
struct EmbreeTimes {
  double full_s = 0;
  double adaptive_s = 0;      ///< that of `full_s` with one ray per pixel
  double all_rays_share = 1;  ///< of the pixels, with adaptive sampling
};

/// Pixels that differ from Blender's passes, at one ray per pixel.
struct DifferingPixels {
  double mean = 0;
  double most = 0;
};
struct Differing {
  double pixels = 0;  ///< of a frame
  DifferingPixels object;
  DifferingPixels material;
};

/// A planned config, prepared for the engine `embree`.
class EmbreeScene {
 public:
  /// `of` must outlive this object.
  EmbreeScene(const EngineScene& of, const Assets& assets);
  ~EmbreeScene() = default;
  EmbreeScene(const EmbreeScene&) = delete;
  EmbreeScene& operator=(const EmbreeScene&) = delete;

  [[nodiscard]] EmbreeTimes times(const std::string& clip, int supersample) const;
  /// Compares all frames with the files in this folder.
  [[nodiscard]] Differing differing(const std::string& clip, const Path& blenders) const;

  [[nodiscard]] std::size_t plants() const noexcept;
  [[nodiscard]] double pixels() const noexcept;

 private:
  [[nodiscard]] BakedTrack track(const std::string& clip) const;

  const DatasetSpec& spec_;
  PlanStore store_;
  BakedScene scene_;
  RayCaster caster_;
  CameraIntrinsics camera_;
};

/// Seconds per frame after the first: mean over the frames of the median of three runs each. Leaves the last frame in
/// `out`.
[[nodiscard]] double frame_time_s(const ClipTracer& tracer, std::size_t frames, Passes& out);

}  // namespace thermal
