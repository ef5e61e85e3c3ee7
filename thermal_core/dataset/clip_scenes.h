#pragma once

#include <cstddef>
#include <memory>
#include <vector>

#include "dataset/clip_maker.h"
#include "imaging/frame_converter.h"
#include "radiometry/temperature_table.h"

namespace thermal {

/// What a clip's tasks make of its passes before their sensors: tasks that differ in the sensor alone have one scene,
/// which is converted once a frame for all of them. Likewise tables of temperatures, one a response.
class ClipScenes {
 public:
  /// Both must outlive this.
  ClipScenes(const Manifest& manifest, const MaterialLibrary& materials)
      : manifest_(manifest), materials_(materials) {}

  /// Number of a task's scene, which is a new one if no task before had it. ConfigError as FrameConverter's.
  std::size_t add(const ClipTask& task);

  [[nodiscard]] std::size_t size() const noexcept { return scenes_.size(); }

  /// Planes that any of the scenes wants.
  [[nodiscard]] PassNeeds needs() const;

  /// FrameConverter::brightest_w_m2_sr() of a scene.
  [[nodiscard]] float brightest_w_m2_sr(std::size_t scene) const {
    return scenes_[scene].converter.brightest_w_m2_sr();
  }

  /// apparent_temperatures() of a response, made once.
  [[nodiscard]] std::shared_ptr<const TemperatureTable> temperatures(const SpectralResponse& response);

  /// A frame of each scene, whose memory is used again. DataError without the name of a file. Safe to call from several
  /// threads.
  void convert(const Passes& passes, int number, std::vector<SceneFrame>& out) const;

 private:
  struct Scene {
    SceneSettings settings;
    FrameConverter converter;
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
