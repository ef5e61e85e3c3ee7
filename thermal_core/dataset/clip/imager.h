#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <vector>

#include "dataset/clip/task.h"
#include "imaging/frame_converter.h"
#include "io/video/video_codec.h"
#include "labels/instances.h"
#include "scene/manifest.h"
#include "sensor/analogue_link.h"
#include "sensor/thermal_camera.h"

namespace thermal {

/// One task's clip in memory: its camera, its link and its codec, from frame to frame. Frames must come in order, one by one.
class ClipImager {
 public:
  /// A frame in flight. Its memory is reused.
  struct Frame {
    std::vector<Instance> instances;
    PassChecks checks;
    SensorFrame pictures;
    std::size_t encoded_bytes = 0;  ///< of ir8, by the task's codec
  };

  /// @param brightest_w_m2_sr  of the task's scene: FrameConverter::brightest_w_m2_sr()
  /// @param temperatures  for its camera; see ThermalCamera
  ClipImager(const ClipTask& task, const Manifest& manifest, float brightest_w_m2_sr,
             std::shared_ptr<const TemperatureTable> temperatures);

  /// `scene` may be shared with other tasks: this camera's properties of actors are written into the frame.
  void expose(const SceneFrame& scene, Frame& frame);

  /// Passes ir8 through the task's codec, if it has one. May work on a frame while expose() works on the next.
  void encode(Frame& frame);

  /// Replaces both for a frame that is unknown.
  void skip();

  [[nodiscard]] bool has_codec() const noexcept { return codec_.has_value(); }

 private:
  ThermalCamera camera_;
  std::optional<AnalogueLink> link_;
  std::optional<VideoCodec> codec_;
};

}  // namespace thermal
