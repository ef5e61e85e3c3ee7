#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "dataset/clip/record.h"
#include "dataset/clip/task.h"
#include "imaging/frame_converter.h"
#include "imaging/motion_finder.h"
#include "radiometry/radiance_table.h"

namespace thermal {

/// What a clip's tasks need from its passes before their sensors. Tasks that differ only in the sensor share one
/// scene, which is converted once per frame; tables of temperatures are shared by response.
class ClipScenes {
 public:
  /// Both must outlive this object.
  ClipScenes(const Manifest& manifest, const MaterialLibrary& materials)
      : manifest_(manifest), materials_(materials) {}

  /// Number of a task's scene, a new one if no earlier task has the same. ConfigError as FrameConverter's.
  std::size_t add(const ClipTask& task);

  [[nodiscard]] std::size_t size() const noexcept { return scenes_.size(); }

  /// Planes that any of the scenes needs.
  [[nodiscard]] PassNeeds needs() const;

  /// FrameConverter::brightest_w_m2_sr() of a scene.
  [[nodiscard]] float brightest_w_m2_sr(std::size_t scene) const {
    return scenes_[scene].converter.brightest_w_m2_sr();
  }

  /// apparent_temperatures() of a response, made once.
  [[nodiscard]] std::shared_ptr<const TemperatureTable> temperatures(const SpectralResponse& response);

  /// Converts a frame for each scene; its memory is reused. DataError without the file's name. Safe to call from
  /// several threads.
  void convert(const Passes& passes, int number, std::vector<SceneFrame>& out) const;

  /// The same for a frame that is not the manifest's, of its camera and actors; `before`: the one that moved to it, null
  /// for a first one, which does not move.
  void convert(const Passes& passes, const ManifestFrame& frame, const ManifestFrame* before,
               std::vector<SceneFrame>& out) const;

 private:
  struct Scene {
    SceneSettings settings;
    FrameConverter converter;
    std::optional<MotionFinder> motion;  ///< with the term `smear`, if anything moves
  };
  struct Temperatures {
    SpectralResponse response;
    std::shared_ptr<const TemperatureTable> table;
  };

  const Manifest& manifest_;
  const MaterialLibrary& materials_;
  std::vector<Scene> scenes_;
  std::vector<Temperatures> temperatures_;
};

}  // namespace thermal
