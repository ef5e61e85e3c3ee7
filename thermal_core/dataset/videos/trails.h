#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <vector>

#include "dataset/videos/clip_film.h"

namespace thermal {

inline constexpr double kTrailSeconds = 5;  ///< of the trails in videos and on pages

/// An earlier position of a target.
struct TrailPoint {
  double x_px = 0;  ///< in the frame that is shown
  double y_px = 0;
  double age_s = 0;  ///< 0: now
};

/// Earlier positions of one target, oldest first.
struct Trail {
  std::int64_t track = 0;
  std::size_t category = 0;  ///< place in LabelSet::categories
  std::vector<TrailPoint> points;
};

/// Trails of a clip's targets over the last seconds.
///
/// Where a frame's pose and a label's range are known, the centre of its box is a point of the scene, which is
/// projected into later frames: the trail stays on the ground as the camera moves. Without a range, the ground is taken
/// as level, agl_m below the camera. Without poses, points keep their position in the picture. Boxes cut by the edge of
/// the picture are left out, because their centres are not those of targets.
class Trails {
 public:
  /// `film`, with labels, must outlive this.
  Trails(const ClipFilm& film, double seconds);

  /// Trails in one of the film's frames, in the order of tracks; those with two points or more.
  [[nodiscard]] std::vector<Trail> at(std::size_t frame) const;

 private:
  struct Mark {
    std::size_t frame = 0;
    double x_px = 0;  ///< centre of the box in its own frame
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
