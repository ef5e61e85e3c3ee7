#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "scene/baked_scene.h"
#include "scene/camera_intrinsics.h"

namespace thermal {

class Place;

/// The limit of ClipTracer::trace() on this machine, for benchmarks: the same packets of rays, computed before, find what
/// they hit among the surroundings, and nothing is done with it. There are no actors.
class BareTracer {
 public:
  /// The scene must outlive this object.
  explicit BareTracer(const BakedScene& scene);
  ~BareTracer();
  BareTracer(const BareTracer&) = delete;
  BareTracer& operator=(const BareTracer&) = delete;

  /// Computes the rays of a frame.
  void aim(const std::array<double, 16>& camera_to_world, const CameraIntrinsics& camera);

  /// Traces these rays: how many do not end in the sky.
  [[nodiscard]] std::size_t hits() const;

 private:
  struct Aimed;
  std::unique_ptr<const Place> place_;
  std::unique_ptr<Aimed> aimed_;
};

}  // namespace thermal
