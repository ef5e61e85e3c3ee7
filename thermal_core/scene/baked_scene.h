#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <set>
#include <span>
#include <string>
#include <vector>

#include "scene/manifest.h"

namespace thermal {

/// Row-major 3 x 4: the first three columns rotate and scale, the last one moves; in m.
template <typename Number>
using Transform = std::array<Number, 12>;

/// Triangles that several parts of a scene share.
struct BakedMesh {
  std::string name;
  bool smooth = false;                                      ///< normals are interpolated between vertices
  std::span<const std::array<float, 3>> points_m;           ///< single precision, as Blender keeps them
  std::span<const std::array<std::uint32_t, 3>> triangles;  ///< counter-clockwise from outside
  std::span<const std::uint16_t> material_index;            ///< of each triangle
};

/// A mesh with its position: the ground, a water surface.
struct BakedSurface {
  std::uint16_t object = 0;
  std::size_t mesh = 0;
};

/// The plants of one species. Every transform turns about z and scales evenly.
struct BakedPlants {
  std::string name;
  std::uint16_t object = 0;
  std::span<const Transform<double>> transform;
  std::span<const std::uint32_t> mesh;
};

/// A part of an actor's body that moves as a whole.
struct BakedBone {
  std::string name;
  std::size_t mesh = 0;
};

/// An actor; tracks say where its bones are.
struct BakedActor {
  std::uint16_t object = 0;
  std::string name;
  std::string group;
  std::vector<BakedBone> bones;  ///< those with a mesh
};

/// Maps of the ground [row of y, column of x], from south and west, of cells x cells squares.
struct BakedGround {
  double size_m = 0;
  std::size_t cells = 0;
  std::vector<std::string> covers;  ///< materials
  std::span<const float> height_m;  ///< (cells + 1)^2, where grid lines cross
  std::span<const float>
      shore_m;  ///< (cells + 1)^2, to the nearest shoreline, negative in water; empty: no water
  std::span<const std::uint8_t> cover;   ///< covers x cells^2: share of each cell, of which 255 is all
  std::span<const std::uint8_t> canopy;  ///< cells^2: share of each cell below crowns
  // On fine_cells^2 squares, as in GroundCovers:
  std::size_t fine_cells = 0;
  std::span<const std::uint8_t> kind = {};
  std::span<const std::uint8_t> grass = {};
  std::span<const std::uint8_t> trodden = {};
  std::span<const std::uint8_t> ash = {};
  std::span<const std::uint8_t> border = {};
};

/// A complete scene, as every engine draws it (configs/schema/scene.schema.json).
struct BakedScene {
  std::string name;
  std::uint32_t seed = 0;
  CameraIntrinsics camera;
  int view_margin_px = 0;                 ///< by which the view exceeds each side of a pinhole's picture
  std::array<double, 2> depth_range_m{};  ///< along the axis: clipped nearer and farther
  std::vector<ManifestObject> objects;
  std::vector<ManifestMaterial> materials;
  std::set<std::string> mirrors = {};  ///< materials in which the scene is seen
  std::vector<BakedMesh> meshes;
  std::vector<BakedSurface> surfaces;
  std::vector<BakedPlants> plants;
  std::vector<BakedActor> actors;
  std::vector<WarmBed> beds = {};
  BakedGround ground;
  std::vector<std::byte> data;  ///< what the spans refer to
};

/// Which surfaces of a scene mirror.
class MirrorIndices {
 public:
  explicit MirrorIndices(const BakedScene& scene)
      : objects_(among(scene.objects, scene.mirrors)),
        materials_(among(scene.materials, scene.mirrors)),
        any_(std::ranges::count(objects_, true) + std::ranges::count(materials_, true) > 0) {}

  /// Whether any may.
  [[nodiscard]] bool any() const noexcept { return any_; }

  /// Whether those of this object and material do.
  [[nodiscard]] bool has(std::uint16_t object, std::uint16_t material) const {
    return material != 0 ? materials_[material] : objects_[object];
  }

 private:
  template <typename Entry>
  static std::vector<bool> among(const std::vector<Entry>& entries, const std::set<std::string>& mirrors) {
    std::vector<bool> found(std::numeric_limits<std::uint16_t>::max() + std::size_t{1});
    for (const Entry& entry : entries) found[entry.index] = mirrors.contains(entry.material);
    return found;
  }

  std::vector<bool> objects_;  ///< by index
  std::vector<bool> materials_;
  bool any_;
};

/// A clip's camera and actors, frame by frame (configs/schema/track.schema.json).
struct BakedTrack {
  std::string clip;
  std::optional<CameraIntrinsics> camera = {};  ///< empty: the scene's
  std::size_t frames = 0;
  std::span<const double> time_s;
  std::span<const std::array<double, 16>> camera_to_world;  ///< row-major 4 x 4, OpenCV camera axes
  std::span<const double> agl_m;
  std::span<const double> look_angle_deg;
  std::span<const std::array<double, 3>> actor_position_m;  ///< [actor, frame], on the ground
  std::span<const double> actor_heading_rad;                ///< [actor, frame]
  std::span<const std::uint8_t> posed;                      ///< whether the picture may show it
  std::span<const Transform<float>> bones;  ///< of posed actors: actor by actor, frame by frame, bone by bone
  std::vector<std::byte> data;              ///< what the spans refer to
};

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
