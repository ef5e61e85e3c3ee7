#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "dataset/clip/imager.h"
#include "dataset/clip/scenes.h"
#include "dataset/clip/task.h"
#include "dataset/run/convert_requests.h"
#include "io/json/file.h"
#include "scene/manifest.h"
#include "scene/material.h"
#include "scene/passes.h"

namespace thermal {

/// A clip that is made in memory, frame by frame, from planes that the caller has; without files. Its frames are those
/// of a dataset, bit for bit.
class LiveClip {
 public:
  /// `task`: of the manifest's clip; nothing is made in its folder.
  LiveClip(Manifest manifest, std::shared_ptr<const MaterialLibrary> materials, ClipTask task);
  LiveClip(const LiveClip&) = delete;
  LiveClip& operator=(const LiveClip&) = delete;

  [[nodiscard]] const Manifest& manifest() const noexcept { return manifest_; }
  [[nodiscard]] const ClipTask& task() const noexcept { return task_; }

  /// Planes that make() needs besides the object index.
  [[nodiscard]] PassNeeds needs() const { return scenes_.needs(); }

  /// Makes a frame from its passes: a number of the manifest's frames, in order; those left out pass unseen. Valid until
  /// the next call. DataError as FrameConverter::convert(), or if a plane that is needed is empty or the planes have
  /// another size than the manifest says; the camera has then not moved on. ConfigError for a number that is not the
  /// manifest's or has passed.
  const ClipImager::Frame& make(const Passes& passes, int number);

  /// The same for a frame that is not the manifest's, but of its camera and actors. `number` counts frames of the camera's
  /// clock from the clip's begin; there is no last one. It smears by what moved since the frame before; a first one does
  /// not.
  const ClipImager::Frame& make(const Passes& passes, const ManifestFrame& frame, int number);

  /// The labels of the last frame that was made: label_entry() of each, and its category's name first.
  [[nodiscard]] Json labels() const;

  /// Begins the clip again, as if nothing had been made of it; with another camera of the same kind if `seed` is another:
  /// its noise, and its errors from pixel to pixel.
  void restart(std::uint32_t seed);

 private:
  void check(const Passes& passes) const;
  const ClipImager::Frame& expose(int number, const ManifestFrame& frame);

  Manifest manifest_;
  std::shared_ptr<const MaterialLibrary> materials_;
  ClipTask task_;
  ClipScenes scenes_;
  std::unique_ptr<ClipImager> imager_;
  std::vector<SceneFrame> converted_;
  ClipImager::Frame frame_;
  std::optional<ManifestFrame> last_;
  int next_ = 0;
};

/// A clip as convert() makes it, of passes whose planes the caller has. `first`: those of the first frame, by which
/// automatic terms are chosen. `options`: config and settings, as of convert(); folders are not looked at. ConfigError
/// as convert().
[[nodiscard]] std::unique_ptr<LiveClip> live_clip_of(Manifest manifest, const Passes& first,
                                                     const ConvertOptions& options);

}  // namespace thermal
