#include "fuzz/accepted.h"
#include "fuzz/baked_files.h"
#include "fuzz/targets.h"
#include "io/bake/baked_files.h"
#include "raycast/ray_caster.h"
#include "support/assets.h"
#include "support/small_scene.h"

namespace {

using thermal::BakedScene;

/// Whether one object, and no other, has this index.
bool has_object(const BakedScene& scene, std::uint16_t index, bool is_actor) {
  const auto found = std::ranges::find(scene.objects, index, &thermal::ManifestObject::index);
  return std::ranges::count(scene.objects, index, &thermal::ManifestObject::index) == 1 &&
         (!is_actor || found->object_class == thermal::ObjectClass::actor);
}

void demand_mesh(const thermal::BakedMesh& mesh, const BakedScene& scene) {
  demand(all_finite(mesh.points_m), "points are finite");
  demand(mesh.material_index.size() == mesh.triangles.size(), "a triangle has a material");
  for (const auto& triangle : mesh.triangles)
    for (const std::uint32_t corner : triangle)
      demand(corner < mesh.points_m.size(), "a triangle has corners among the points");
  for (const std::uint16_t index : mesh.material_index)
    demand(std::ranges::count(scene.materials, index, &thermal::ManifestMaterial::index) == 1,
           "a material index stands for one material");
}

void demand_pieces(const BakedScene& scene) {
  const std::size_t meshes = scene.meshes.size();
  for (const auto& surface : scene.surfaces)
    demand(surface.mesh < meshes && has_object(scene, surface.object, false),
           "a surface has mesh and object");
  for (const auto& plants : scene.plants) {
    demand(has_object(scene, plants.object, false), "plants have an object");
    demand(all_finite(plants.transform), "plants are in finite places");
    demand(plants.mesh.size() == plants.transform.size(), "a plant has a mesh and a transform");
    demand(std::ranges::all_of(plants.mesh, [&](auto mesh) { return mesh < meshes; }), "plants have meshes");
  }
  for (const auto& actor : scene.actors) {
    demand(has_object(scene, actor.object, true), "an actor has an actor's object");
    for (const auto& bone : actor.bones) demand(bone.mesh < meshes, "a bone has a mesh");
  }
}

void demand_ground(const thermal::BakedGround& ground) {
  const std::size_t corners = (ground.cells + 1) * (ground.cells + 1);
  demand(ground.height_m.size() == corners, "heights are given where grid lines cross");
  demand(ground.shore_m.empty() || ground.shore_m.size() == corners, "so are distances to the shore");
  demand(ground.canopy.size() == ground.cells * ground.cells, "a cell has a canopy");
  demand(ground.cover.size() == ground.covers.size() * ground.canopy.size(), "a cell has shares of covers");
  const std::size_t fine = ground.fine_cells * ground.fine_cells;
  for (const auto& shares : {ground.kind, ground.grass, ground.trodden, ground.ash, ground.border})
    demand(shares.size() == fine, "a fine cell has all shares");
  demand(std::ranges::all_of(ground.kind, [&](auto one) { return one < ground.covers.size(); }), "kinds");
  demand(std::ranges::all_of(ground.height_m, [](float one) { return std::isfinite(one); }), "heights");
}

void demand_sound(const BakedScene& scene) {
  for (const auto& mesh : scene.meshes) demand_mesh(mesh, scene);
  demand_pieces(scene);
  demand_ground(scene.ground);
  demand(scene.depth_range_m[0] < scene.depth_range_m[1], "the nearest depth is less than the farthest");
}

/// A few rays straight down, and from the side: all structures are built and searched.
void look_at(const BakedScene& scene) {
  const thermal::RayCaster caster(scene);
  small_scene::Clip clip = {
      .camera_to_world = {small_scene::looking_down(0, 0, 50), small_scene::looking({-6, 0, 3}, {0, 0, 0})},
      .poses = std::vector(scene.actors.size(), std::vector(2, std::vector<small_scene::Matrix>()))};
  const thermal::BakedTrack track = clip.baked();
  const thermal::ClipTracer tracer(caster, track, small_scene::pinhole(4, 4, 4));
  thermal::Passes passes;
  for (std::size_t frame = 0; frame < track.frames; ++frame)
    tracer.trace(frame, {.depth = true, .normals = true, .actors = true, .mirrored = true}, passes);
}

}  // namespace

void fuzz::baked_scene(Bytes bytes) {
  const auto folder = as_baked(bytes, "scene");
  tolerate([&folder, bytes] {
    const BakedScene scene = thermal::read_baked_scene(folder, kAssets);
    demand_sound(scene);
    AcceptedInputs::instance().add(bytes);
    look_at(scene);
  });
}
