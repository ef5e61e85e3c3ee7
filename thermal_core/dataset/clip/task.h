#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>

#include "imaging/scene_radiance.h"
#include "io/config/spec.h"
#include "io/pass_buffer.h"
#include "io/system/files.h"
#include "scene/manifest.h"
#include "scene/passes.h"

namespace thermal {

/// Where the planes of a clip's frames come from, if not from files. Safe to call from several threads.
class PassSource {
 public:
  PassSource() = default;
  virtual ~PassSource() = default;
  PassSource(const PassSource&) = delete;
  PassSource& operator=(const PassSource&) = delete;

  /// Fills the planes of a frame that are needed; may fill others.
  virtual void read(int frame, const PassNeeds& needs, Passes& out) const = 0;
};

/// What to do with a clip if a frame cannot be read or converted: reject the clip, or make it without that frame.
enum class BadFrames { fail, skip };

/// One clip's passes, and how to read them.
struct ClipPasses {
  Manifest manifest;
  Path folder;                                    ///< of the files
  std::shared_ptr<const PassSource> source = {};  ///< of the planes; empty: the files
  ReadLimits limits = {};
  BadFrames bad_frames = BadFrames::fail;
  std::string identity_sha256 = {};  ///< identity_of() them; empty if they are rendered for the dataset
};

/// What a dataset makes from a clip's passes.
struct ClipTask {
  std::string variant;  ///< start of messages about the request; empty if there is only one task
  ClipSpec clip;
  std::uint32_t seed = 1;
  std::optional<PhysicsSettings> physics;  ///< empty: the published model
  Path folder;                             ///< to make the clip in; emptied first
  std::string made_from_sha256 = {};       ///< for the clip's record

  [[nodiscard]] const ClipSettings& settings() const { return *clip.settings; }
};

}  // namespace thermal
