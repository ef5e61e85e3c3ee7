#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace thermal {

inline constexpr int kLargestIndex = 32767;  ///< Blender's pass_index ends here
inline constexpr int kSkyIndex = 0;

/// A pinhole camera in pixels. Continuous pixel coordinates: the top left pixel's centre is (0.5, 0.5).
struct CameraIntrinsics {
  int width_px = 0;
  int height_px = 0;
  double fx_px = 0;
  double fy_px = 0;
  double cx_px = 0;
  double cy_px = 0;
};

enum class ObjectClass { ground, water, plant, actor };

using Colour = std::array<std::uint8_t, 3>;

/// Names of channels that carry no usual name; empty: found by the spellings in use.
struct PassChannels {
  std::string object_index;
  std::string material_index;
  std::string depth;
  std::string normal;  ///< what comes before .X, .Y and .Z
};

/// What one object index stands for.
struct ManifestObject {
  using Corner = std::array<double, 3>;
  std::uint16_t index = 0;
  std::string name;
  ObjectClass object_class = ObjectClass::ground;
  std::string material;  ///< where the material plane says nothing
  std::string category;  ///< actors: what is labelled
  std::string species;   ///< actors
  int track_id = 0;      ///< actors
  std::optional<std::array<Corner, 2>>
      bounds_m;                     ///< actors: box in actor axes, x forward, z up from the ground
  std::optional<Colour> colour;     ///< in pictures whose colours tell objects apart
  std::vector<std::string> mattes;  ///< names in a cryptomatte, * for any letters; empty: `name`
};

/// What one material index stands for.
struct ManifestMaterial {
  std::uint16_t index = 0;
  std::string material;
  std::string part;
};

/// Where an actor stands in one frame.
struct ActorPose {
  std::uint16_t index = 0;
  std::array<double, 3> position_m{};
  double heading_rad = 0;
};

struct ManifestFrame {
  std::string file;
  double time_s = 0;
  std::optional<double> agl_m;
  std::optional<double> look_angle_deg;
  std::optional<std::array<double, 16>> camera_to_world;  ///< row-major, OpenCV camera axes
  std::vector<ActorPose> actors;
};

/// What the passes of one clip mean.
struct Manifest {
  std::string clip;
  std::string scene;
  std::uint32_t seed = 1;
  double frame_rate_hz = 9;
  std::string layer;        ///< EXR layer; empty: the only one
  std::string actor_layer;  ///< EXR layer with the index of actors alone; empty: there is none
  PassChannels channels;    ///< of `layer`
  std::string
      cryptomatte;  ///< that tells objects apart instead of an index plane, such as "CryptoObject"; or empty
  Colour sky_colour{};   ///< in pictures whose colours tell objects apart
  std::string sequence;  ///< pattern of the frames' names where `frames` does not list them
  CameraIntrinsics camera;
  int supersample = 1;  ///< the passes have this many pixels for each of the camera's, each way
  int overscan_px = 0;  ///< and so many of the camera's pixels more on every side
  std::vector<ManifestObject> objects;
  std::vector<ManifestMaterial> materials;
  std::vector<ManifestFrame> frames;

  /// DataError if indices or track ids come twice, an actor has no category or track, or an actor in a frame
  /// is not among the objects; if frames and a sequence are both there; if two objects have one colour, or one the
  /// sky's.
  void validate() const;
};

}  // namespace thermal
