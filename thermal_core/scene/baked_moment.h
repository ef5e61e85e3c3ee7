#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "scene/baked_scene.h"

namespace thermal {

/// Camera and actors of a scene at one moment.
struct BakedMoment {
  std::array<double, 16> camera_to_world{};             ///< row-major 4 x 4, OpenCV camera axes
  std::vector<std::array<double, 3>> actor_position_m;  ///< [actor], on the ground
  std::vector<double> actor_heading_rad;                ///< [actor]
  std::vector<std::uint8_t> posed;                      ///< whether the picture may show it
  std::vector<Transform<float>> bones;                  ///< of posed actors: actor by actor, bone by bone
};

/// Moments of a track. Scene and track must outlive this object. Safe to use from several threads.
class TrackMoments {
 public:
  TrackMoments(const BakedScene& scene, const BakedTrack& track);

  /// A frame as it is baked.
  [[nodiscard]] BakedMoment at_frame(std::size_t frame) const;

  /// A moment between two frames, or a frame's own: positions and bones are interpolated linearly, headings along the
  /// shorter arc; the camera is that of the earlier frame. Actors that are not posed in both frames are not posed.
  /// Requires first <= time_s <= last of BakedTrack::time_s.
  [[nodiscard]] BakedMoment at_time(double time_s) const;

 private:
  [[nodiscard]] std::size_t moment(std::size_t actor, std::size_t frame) const noexcept {
    return actor * track_.frames + frame;
  }

  const BakedScene& scene_;
  const BakedTrack& track_;
  std::vector<std::size_t> first_bone_;  ///< [actor, frame]: position of its bones in the track
};

}  // namespace thermal
