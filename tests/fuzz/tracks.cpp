#include "dataset/run/tracing.h"
#include "fuzz/accepted.h"
#include "fuzz/baked_files.h"
#include "fuzz/targets.h"
#include "io/bake/baked_files.h"
#include "support/assets.h"
#include "support/small_scene.h"

namespace {

using thermal::BakedScene;
using thermal::BakedTrack;

constexpr const char* kClip = "one";

/// A ground, and two actors of one bone and of two (plan_seeds.py has tracks for them).
small_scene::Scenery two_actors() {
  small_scene::Scenery place;
  place.surface(small_scene::kGround, shapes::level(50, 4, 1, -2));
  place.actor({shapes::cube(1, 1)});
  place.actor({shapes::cube(1, 1), shapes::smoothed(shapes::ball(1, 5, 1))});
  return place;
}

thermal::ManifestObject actor_object(std::uint16_t index) {
  thermal::ManifestObject object;
  object.index = index;
  object.name = "walker";
  object.object_class = thermal::ObjectClass::actor;
  object.material = "human";
  object.category = "human";
  object.species = "human";
  object.track_id = index;
  return object;
}

BakedScene scene_of(const small_scene::Scenery& place) {
  BakedScene scene = place.baked();
  scene.camera = small_scene::pinhole(4, 4, 4);
  for (const thermal::BakedActor& actor : scene.actors) scene.objects.push_back(actor_object(actor.object));
  return scene;
}

void demand_sound(const BakedTrack& track, const BakedScene& scene) {
  const std::size_t frames = track.frames;
  const std::size_t moments = frames * scene.actors.size();
  demand(frames > 0 && track.time_s.size() == frames && track.camera_to_world.size() == frames &&
             track.agl_m.size() == frames && track.look_angle_deg.size() == frames,
         "a frame has its time and its camera");
  demand(track.posed.size() == moments && track.actor_position_m.size() == moments &&
             track.actor_heading_rad.size() == moments,
         "an actor has a place in each frame");
  demand(all_finite(track.camera_to_world) && all_finite(track.actor_position_m) && all_finite(track.bones),
         "places are finite");
  std::size_t bones = 0;
  for (std::size_t k = 0; k < moments; ++k)
    if (track.posed[k] != 0) bones += scene.actors[k / frames].bones.size();
  demand(track.bones.size() == bones, "a posed actor has all of its bones");
}

/// The first frames as the engine renders them, and the manifest of the clip.
void use(const BakedTrack& track, const BakedScene& scene, const thermal::RayCaster& caster) {
  constexpr std::size_t kMostFrames = 3;
  const thermal::ClipTracer tracer(caster, track, scene.camera);
  thermal::Passes passes;
  for (std::size_t frame = 0; frame < std::min(track.frames, kMostFrames); ++frame)
    tracer.trace(frame, {.depth = true, .normals = true, .actors = true, .mirrored = true}, passes);
  thermal::manifest_of(scene, track, thermal::DatasetSpec(), thermal::ClipSpec()).validate();
}

}  // namespace

void fuzz::tracks(Bytes bytes) {
  static const small_scene::Scenery kPlace = two_actors();
  static const BakedScene kScene = scene_of(kPlace);
  static const thermal::RayCaster kCaster(kScene);
  static const bool kHasFolder = std::filesystem::create_directory(as_file({}, "x").parent_path() / "tracks");
  demand(kHasFolder, "there is a folder for tracks");
  const auto folder = as_baked(bytes, std::string("tracks/") + kClip).parent_path();
  tolerate([&folder, bytes] {
    const BakedTrack track = thermal::read_baked_track(folder, kClip, kScene, kAssets);
    demand_sound(track, kScene);
    AcceptedInputs::instance().add(bytes);
    use(track, kScene, kCaster);
  });
}
