#pragma once

#include <functional>
#include <string>
#include <vector>

#include "io/assets.h"
#include "io/system/files.h"

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

}  // namespace thermal
