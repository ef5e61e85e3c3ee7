#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "scene/camera_geometry.h"
#include "scene/camera_model.h"
#include "scene/manifest.h"
#include "scene/passes.h"
#include "sensor/smear.h"

namespace thermal {

/// Motion of the picture of each frame, from depth, the camera's poses and those of the actors.
///
/// A pixel's motion is that of its surface since the frame before; in a clip's first frame, until the next one. Frames
/// are taken to be 1 / frame_rate_hz apart; if their times grow by more, motion is scaled in proportion. Actors move
/// rigidly with their poses; limbs and plants do not move. Sky moves with the camera's rotation. Pixels that a moving
/// actor has just left move with it, so that they still show it. Pixels without a usable depth, and frames without a
/// usable pose here or before, do not move.
class MotionFinder {
 public:
  /// @param lens  as FrameConverter's, which has checked it
  MotionFinder(const Manifest& manifest, const LensDistortion& lens);

  /// Whether anything moves in a frame.
  [[nodiscard]] bool moves(int frame) const { return steps_[static_cast<std::size_t>(frame)].moves; }

  /// Motion of the camera's pixels in a frame; empty if nothing moves, or without depth. The memory of `out` is reused.
  void find(const Passes& passes, int frame, ImageMotion& out) const;

  /// The same in a frame after another one, of the manifest's camera and actors but not of its frames.
  void find(const Passes& passes, const ManifestFrame& before, const ManifestFrame& now,
            ImageMotion& out) const;

  /// Transform of a point from a camera's axes to those of the other frame: p' = turn p + shift [m].
  struct Transform {
    std::array<float, 9> turn{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< row-major
    std::array<float, 3> shift_m{};
  };

 private:
  struct Moved {
    std::uint16_t index = 0;
    Transform transform;
  };
  /// From a frame to the one before, or from the first frame to the next.
  struct Step {
    bool moves = false;  ///< anything
    bool camera_moves = false;
    float scale = 0;            ///< of the motion; negative: the other frame is the next
    Transform camera;           ///< of static surfaces
    std::vector<Moved> actors;  ///< those whose transform differs
  };
  struct Sources;

  [[nodiscard]] Step step_of(const ManifestFrame& now, const ManifestFrame& other, bool other_is_next) const;
  void find(const Passes& passes, const Step& step, ImageMotion& out) const;
  void find_row(const Plane<float>& depth_m, const Step& step, int y, ImageMotion& out) const;
  void move_actors(const Passes& passes, const Step& step, ImageMotion& out) const;
  [[nodiscard]] std::size_t source(const Plane<float>& depth_m, int x, int y) const;

  CameraIntrinsics camera_;
  LensDistortion lens_;
  double frame_rate_hz_;
  CameraIntrinsics passes_;  ///< one pixel of the camera's size each, with overscan
  CameraRays rays_;          ///< through the camera's pixels
  std::vector<std::int32_t>
      shown_;  ///< by pixel of the camera: that of `passes_` which it shows; empty: the same
  std::vector<Step> steps_;
};

}  // namespace thermal
