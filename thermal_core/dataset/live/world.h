#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "dataset/live/live_clip.h"
#include "dataset/plan/plan_store.h"
#include "raycast/ray_caster.h"
#include "scene/baked_scene.h"

namespace thermal {

/// How a world is flown in.
struct WorldOptions {
  std::optional<double> frame_rate_hz = {};  ///< of the camera; empty: the clip's
  /// Whether the camera may fly anywhere in the place. If not, the ground beyond what the planned flight shows is as at
  /// its border.
  bool roam = true;
};

/// A planned clip's place to fly in: actors where they are planned to be, a camera wherever the caller puts it, whose
/// noise, lag, shutter and gain control go on from capture to capture.
///
/// At the poses and times of the planned flight, in order, captures are the frames of `generate`: without `roam` bit for
/// bit; with it, the ground is counted from another corner, so that single pixels round to the next count (0.2 %), and
/// places of more than 180 m a side have coarser texels (25 cm, from 360 m on 50 cm). Elsewhere the physical terms are still those that the
/// plan's flights need.
class World {
 public:
  /// A clip of a plan whose config has render.posed_actors "all" and the engine `embree`. ConfigError if it has not, for
  /// an unknown clip and for a frame rate that is not above 0; DataError and IoError as those of PlanStore.
  World(const Path& plan, const std::string& clip, const Assets& assets, const WorldOptions& options = {});
  ~World();
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  [[nodiscard]] const LiveClip& clip() const noexcept { return *clip_; }

  /// The planned flight: times [s] and poses, frame by frame.
  [[nodiscard]] std::span<const double> flight_s() const noexcept { return track_.time_s; }
  [[nodiscard]] std::span<const std::array<double, 16>> flight_poses() const noexcept {
    return track_.camera_to_world;
  }
  /// The pose of the planned flight at a time [s], which is clamped to flight_s(): a frame's own, and between two the
  /// place on a straight line and the axes turned evenly (to 1e-4 rad where they differ by 10 degrees).
  [[nodiscard]] std::array<double, 16> flight_pose_at(double time_s) const;
  [[nodiscard]] double frame_rate_hz() const noexcept { return clip_->manifest().frame_rate_hz; }

  /// The frame that the camera takes from a pose (row-major 4 x 4, OpenCV camera axes, east, north, up [m]) at a time
  /// [s]: on the clock of its frame rate from flight_s().front() on, after the capture before, and not after
  /// flight_s().back(). Frames in between pass unseen. Valid until the next capture. ConfigError for another time, and
  /// for a pose that is no rotation and place to within 1e-6; nothing has then changed.
  const ClipImager::Frame& capture(const std::array<double, 16>& camera_to_world, double time_s);

  /// Begins again at the first frame, with LiveClip::restart().
  void restart(std::uint32_t seed);

  /// The planes of the last capture: both indices, and those that the terms need.
  [[nodiscard]] const Passes& passes() const noexcept { return passes_; }

  /// Where the actors were in it, and the camera.
  [[nodiscard]] const ManifestFrame& frame() const noexcept { return frame_; }

 private:
  World(const PlannedDataset& planned, const PlanStore& store, const std::string& clip, const Assets& assets,
        const WorldOptions& options);
  [[nodiscard]] int number_at(double time_s) const;
  [[nodiscard]] double known_time(double time_s) const;

  BakedScene scene_;
  BakedTrack track_;
  RayCaster caster_;
  TrackMoments moments_;
  std::unique_ptr<LiveClip> clip_;
  std::unique_ptr<const CameraTracer> tracer_;
  PassNeeds needs_;
  Passes passes_;
  ManifestFrame frame_;
  int next_ = 0;
};

}  // namespace thermal
