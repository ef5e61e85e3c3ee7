#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "dataset/videos/clip_film.h"

namespace thermal {

inline constexpr double kTrailSeconds = 5;  ///< of the trails in videos and on pages

/// Where a target was.
struct TrailPoint {
  double x_px = 0;  ///< in the frame that is shown
  double y_px = 0;
  double age_s = 0;  ///< 0: now
};

/// The way of one target, oldest first.
struct Trail {
  std::int64_t track = 0;
  std::size_t category = 0;  ///< place in LabelSet::categories
  std::vector<TrailPoint> points;
};

/// The ways of a clip's targets over the last seconds.
///
/// Where a frame's pose and a label's range are known, the middle of its box is a point of the place, which is shown
/// where the camera of a later frame sees it: the trail lies on the ground as the camera moves on. Without a range the
/// ground counts as level, agl_m below the camera. Without poses points stay where they were in the picture.
/// Boxes that the edge of the picture cuts are left out: their middles are not those of targets.
class Trails {
 public:
  /// `film`, with labels, must outlive this.
  Trails(const ClipFilm& film, double seconds);

  /// Of one of the film's frames, in the order of tracks; those with two points or more.
  [[nodiscard]] std::vector<Trail> at(std::size_t frame) const;

 private:
  struct Mark {
    std::size_t frame = 0;
    double x_px = 0;  ///< the middle of the box in its own frame
    double y_px = 0;
    std::array<double, 3> world_m{};
    bool anchored = false;  ///< world_m is known
  };
  struct Track {
    std::size_t category = 0;
    std::vector<Mark> marks;
  };

  [[nodiscard]] Mark mark_of(std::size_t frame, const Label& label) const;
  [[nodiscard]] std::vector<TrailPoint> points_of(const Track& track, std::size_t frame) const;

  const ClipFilm& film_;
  double seconds_;
  std::map<std::int64_t, Track> tracks_;
};

}  // namespace thermal
