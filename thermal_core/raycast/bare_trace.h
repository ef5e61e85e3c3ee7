#pragma once

#include <array>
#include <cstddef>
#include <memory>

#include "scene/baked_scene.h"
#include "scene/camera_intrinsics.h"

namespace thermal {

class Place;

/// Lower bound of the time of ClipTracer::trace(), for benchmarks: the same packets of rays, computed before, find
/// their first hits among the surroundings, and nothing else is done. There are no actors.
class BareTracer {
 public:
  /// The scene must outlive this object.
  explicit BareTracer(const BakedScene& scene);
  ~BareTracer();
  BareTracer(const BareTracer&) = delete;
  BareTracer& operator=(const BareTracer&) = delete;

  /// Computes the rays of a frame.
  void aim(const std::array<double, 16>& camera_to_world, const CameraIntrinsics& camera);

  /// Traces these rays; returns how many hit something.
  [[nodiscard]] std::size_t hits() const;

 private:
  struct Aimed;
  std::unique_ptr<const Place> place_;
  std::unique_ptr<Aimed> aimed_;
};

}  // namespace thermal
