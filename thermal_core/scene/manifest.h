#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "base/image.h"
#include "heat/body/vehicle_heat.h"
#include "scene/camera_model.h"

namespace thermal {

/// Object index of pixels that show the sky.
inline constexpr int kSkyIndex = 0;

/// What kind of thing an object index stands for.
enum class ObjectClass { ground, water, plant, actor };

/// Red, green and blue, 0 to 255.
using Colour = std::array<std::uint8_t, 3>;

/// Names of channels with unusual names; empty: found by the known spellings.
struct PassChannels {
  std::string object_index;
  std::string material_index;
  std::string depth;
  std::string normal;  ///< prefix of .X, .Y and .Z
};

/// A camp fire at time 0 of the scene.
struct FirePlace {
  std::array<double, 2> place_m{};  ///< middle of its bed
  double diameter_m = 0.6;
  bool burning = true;  ///< has flames
  double since_s = 0;   ///< since it was lit, or since its flames went out
};

/// Ground on which an animal lay until some time before time 0 of the scene: an ellipse.
struct WarmBed {
  std::array<double, 2> place_m{};  ///< its middle
  double heading_rad = 0;           ///< of its length, counter-clockwise from +x
  std::array<double, 2> half_m{};   ///< half of its length and of its width
  double left_s = 0;                ///< since it got up
  double lain_s = 3600;             ///< duration of lying
};

/// What one object index stands for.
struct ManifestObject {
  using Corner = std::array<double, 3>;
  std::uint16_t index = 0;
  std::string name;
  ObjectClass object_class = ObjectClass::ground;
  std::string material;  ///< where there is no material index
  std::string category;  ///< actors: what is labelled
  std::string species;   ///< actors
  int track_id = 0;      ///< actors
  std::optional<std::array<Corner, 2>>
      bounds_m;                        ///< actors: box in actor axes, x forward, z up from the ground
  std::optional<VehicleState> engine;  ///< actors: at time 0 of the scene; none: unknown
  std::optional<double> wet_s;         ///< actors: time since a bath, at time 0 of the scene; none: dry
  std::optional<FirePlace> fire;       ///< camp fires
  std::optional<Colour> colour;        ///< in pictures that identify objects by colour
  std::vector<std::string> mattes;     ///< names in a cryptomatte, * matches any letters; empty: `name`
};

/// What one material index stands for.
struct ManifestMaterial {
  std::uint16_t index = 0;
  std::string material;
  std::string part;
};

/// Pose of an actor in one frame.
struct ActorPose {
  std::uint16_t index = 0;
  std::array<double, 3> position_m{};
  double heading_rad = 0;
};

/// A frame's file, time and poses.
struct ManifestFrame {
  std::string file;
  double time_s = 0;
  std::optional<double> agl_m;
  std::optional<double> look_angle_deg;
  std::optional<std::array<double, 16>> camera_to_world;  ///< row-major, OpenCV camera axes
  std::vector<ActorPose> actors;
};

/// Meaning of the passes of one clip.
struct Manifest {
  std::string clip;
  std::string of_flight;  ///< the flight that the clip is cut from; empty if there is none
  std::string scene;
  std::uint32_t seed = 1;
  double frame_rate_hz = 9;
  std::string layer;         ///< EXR layer; empty: the only one
  std::string actor_layer;   ///< EXR layer with the index of actors alone; empty: none
  std::string mirror_layer;  ///< EXR layer of what water mirrors; empty: unknown
  PassChannels channels;     ///< of `layer`
  std::string
      cryptomatte;  ///< cryptomatte that identifies objects in place of an index plane, such as "CryptoObject"; or empty
  Colour sky_colour{};   ///< in pictures that identify objects by colour
  std::string sequence;  ///< pattern of the frames' names, used if `frames` does not list them
  CameraIntrinsics camera;
  LensDistortion lens;  ///< distortion of the passes' rays; none: a pinhole's picture
  int supersample = 1;  ///< pixels of the passes per pixel of the camera, along each axis
  int overscan_px = 0;  ///< additional camera pixels on every side
  std::vector<ManifestObject> objects;
  std::vector<ManifestMaterial> materials;
  std::vector<WarmBed> beds = {};
  std::vector<ManifestFrame> frames;
  std::string document_sha256 =
      {};  ///< of the JSON it was read from, without whitespace; empty if there is none

  /// DataError if indices or track ids are repeated; an actor has no category or track; an actor in a frame is not
  /// among the objects; frames and a sequence are both given; or two objects have one colour, or an object the sky's.
  void validate() const;
};

}  // namespace thermal
