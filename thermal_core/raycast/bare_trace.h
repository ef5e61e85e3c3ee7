#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "scene/baked_scene.h"
#include "scene/manifest.h"

namespace thermal {

class Place;

/// What Embree alone takes for the rays of a frame.
struct BareTrace {
  std::size_t rays = 0;
  std::size_t hits = 0;  ///< rays that do not end in the sky
  double seconds = 0;    ///< the middle one of three runs
};

/// The limit of ClipTracer::trace() on this machine, for benchmarks: the same packets of rays, computed before, find what
/// they hit among the surroundings, and nothing is done with it. There are no actors.
class BareTracer {
 public:
  /// The scene must outlive this object.
  explicit BareTracer(const BakedScene& scene);
  ~BareTracer();
  BareTracer(const BareTracer&) = delete;
  BareTracer& operator=(const BareTracer&) = delete;

  [[nodiscard]] BareTrace trace(const std::array<double, 16>& camera_to_world,
                                const CameraIntrinsics& camera) const;

 private:
  std::unique_ptr<const Place> place_;
};

}  // namespace thermal
