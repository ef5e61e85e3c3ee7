#pragma once

#include <cstddef>
#include <list>

#include "raycast/first_hit.h"
#include "raycast/scene_accelerator.h"
#include "raycast/sight.h"
#include "scene/passes.h"

namespace thermal {

/// Sets planes to this size, mirroring sky alone. Memory is reused.
void set_to_sky(Mirrored<Plane>& mirrored, int width_px, int height_px);

/// The same for lists of samples.
void set_to_sky(Mirrored<SampleList>& mirrored, std::size_t samples);

/// The view mirrored in level water at a height: as far below the water as the view is above it.
[[nodiscard]] View mirrored(const View& view, double height_m) noexcept;

/// A shot from the mirrored camera below water of one height.
class Mirror {
 public:
  Mirror(const Shot& shot, double height_m)
      : height_m_(height_m),
        shot_{.accelerator = shot.accelerator, .actors = shot.actors, .view = mirrored(shot.view, height_m)},
        triangles_(shot_) {}
  Mirror(const Mirror&) = delete;
  Mirror& operator=(const Mirror&) = delete;

  [[nodiscard]] double height_m() const noexcept { return height_m_; }
  [[nodiscard]] const Shot& shot() const noexcept { return shot_; }
  [[nodiscard]] SeenTriangles& triangles() noexcept { return triangles_; }

  /// Depths at which rays leave the water: a millimetre above it, so that none hits the water itself.
  [[nodiscard]] Lanes<double> depths_m(const VectorLanes<double>& direction) const noexcept;

 private:
  double height_m_;
  Shot shot_;
  SeenTriangles triangles_;
};

/// The mirrors of a shot, made when they are first needed. For one thread.
class Mirrors {
 public:
  explicit Mirrors(const Shot& shot) : shot_(shot) {}

  [[nodiscard]] Mirror& at(double height_m);

 private:
  const Shot& shot_;
  std::list<Mirror> made_;  ///< a scene has few heights of water
};

}  // namespace thermal
