// Reads the baked scene and the tracks of a plan with the library, and writes what it has read again:
//   plan_echo HOME PLAN OUT [CLIP …]
// For the contract between the Python that writes plans and the C++ that reads them.

#include <cstdio>
#include <fstream>
#include <iostream>

#include "base/error.h"
#include "io/bake/baked_files.h"
#include "io/json/file.h"

namespace {

using thermal::Json;

constexpr std::size_t kAlignmentBytes = 64;

/// NAME.json and NAME.bin.
class Writer {
 public:
  explicit Writer(const thermal::Path& name) : name_(name), binary_(with(".bin"), std::ios::binary) {}

  template <typename Element>
  std::string add(const std::string& key, const char* type, std::vector<std::size_t> shape,
                  std::span<const Element> values) {
    arrays_[key] = {{"type", type}, {"shape", std::move(shape)}, {"offset", bytes_}};
    const auto bytes = std::as_bytes(values);
    binary_.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
    bytes_ += bytes.size();
    for (; bytes_ % kAlignmentBytes != 0; ++bytes_) binary_.put('\0');
    return key;
  }

  void close(Json header) {
    header["bytes"] = bytes_;
    header["arrays"] = arrays_;
    thermal::write_file_atomically(with(".json"), thermal::to_text(header));
  }

 private:
  [[nodiscard]] thermal::Path with(const char* suffix) const { return thermal::Path(name_) += suffix; }

  thermal::Path name_;
  std::ofstream binary_;
  std::size_t bytes_ = 0;
  Json arrays_ = Json::object();
};

const char* class_name(thermal::ObjectClass object) {
  constexpr std::array kNames = {"ground", "water", "plant", "actor"};
  return kNames.at(static_cast<std::size_t>(object));
}

Json object_json(const thermal::ManifestObject& object) {
  Json json = {{"index", object.index},
               {"name", object.name},
               {"class", class_name(object.object_class)},
               {"material", object.material}};
  if (object.object_class != thermal::ObjectClass::actor) return json;
  json["category"] = object.category;
  json["species"] = object.species;
  json["track_id"] = object.track_id;
  json["bounds_m"] = object.bounds_m.value();
  return json;
}

Json material_json(const thermal::ManifestMaterial& material) {
  Json json = {{"index", material.index}, {"material", material.material}};
  if (!material.part.empty()) json["part"] = material.part;
  return json;
}

Json camera_json(const thermal::CameraIntrinsics& camera) {
  return {{"width_px", camera.width_px}, {"height_px", camera.height_px}, {"fx_px", camera.fx_px},
          {"fy_px", camera.fy_px},       {"cx_px", camera.cx_px},         {"cy_px", camera.cy_px}};
}

Json mesh_json(const thermal::BakedMesh& mesh, std::size_t number, Writer& out) {
  const std::string key = "meshes/" + std::to_string(number) + "/";
  return {{"name", mesh.name},
          {"smooth", mesh.smooth},
          {"points_m", out.add(key + "points_m", "<f4", {mesh.points_m.size(), 3}, mesh.points_m)},
          {"triangles", out.add(key + "triangles", "<u4", {mesh.triangles.size(), 3}, mesh.triangles)},
          {"material_index",
           out.add(key + "material_index", "<u2", {mesh.material_index.size()}, mesh.material_index)}};
}

Json ground_json(const thermal::BakedGround& ground, Writer& out) {
  const std::size_t cells = ground.cells;
  const std::size_t fine = ground.fine_cells;
  Json json = {{"size_m", ground.size_m},
               {"cells", cells},
               {"covers", ground.covers},
               {"height_m", out.add("ground/height_m", "<f4", {cells + 1, cells + 1}, ground.height_m)},
               {"cover", out.add("ground/cover", "|u1", {ground.covers.size(), cells, cells}, ground.cover)},
               {"canopy", out.add("ground/canopy", "|u1", {cells, cells}, ground.canopy)},
               {"fine_cells", fine},
               {"kind", out.add("ground/kind", "|u1", {fine, fine}, ground.kind)},
               {"grass", out.add("ground/grass", "|u1", {fine, fine}, ground.grass)},
               {"trodden", out.add("ground/trodden", "|u1", {fine, fine}, ground.trodden)},
               {"ash", out.add("ground/ash", "|u1", {fine, fine}, ground.ash)},
               {"border", out.add("ground/border", "|u1", {fine, fine}, ground.border)}};
  if (!ground.shore_m.empty())
    json["shore_m"] = out.add("ground/shore_m", "<f4", {cells + 1, cells + 1}, ground.shore_m);
  return json;
}

Json actor_json(const thermal::BakedActor& actor) {
  Json bones = Json::array();
  for (const thermal::BakedBone& bone : actor.bones)
    bones.push_back({{"name", bone.name}, {"mesh", bone.mesh}});
  return {{"object", actor.object}, {"name", actor.name}, {"group", actor.group}, {"bones", bones}};
}

void write_scene(const thermal::BakedScene& scene, const thermal::Path& folder) {
  Writer out(folder / "scene");
  Json header = {{"format", "veldt-scene"},
                 {"version", 1},
                 {"name", scene.name},
                 {"seed", scene.seed},
                 {"camera", camera_json(scene.camera)},
                 {"view_margin_px", scene.view_margin_px},
                 {"depth_range_m", scene.depth_range_m},
                 {"mirrors", scene.mirrors}};
  for (const char* list : {"materials", "objects", "meshes", "surfaces", "plants", "actors"})
    header[list] = Json::array();
  for (const auto& material : scene.materials) header["materials"].push_back(material_json(material));
  for (const auto& object : scene.objects) header["objects"].push_back(object_json(object));
  for (const auto& mesh : scene.meshes)
    header["meshes"].push_back(mesh_json(mesh, header["meshes"].size(), out));
  for (const auto& surface : scene.surfaces)
    header["surfaces"].push_back({{"object", surface.object}, {"mesh", surface.mesh}});
  for (const auto& plants : scene.plants) {
    const std::string key = "plants/" + plants.name + "/";
    header["plants"].push_back(
        {{"name", plants.name},
         {"object", plants.object},
         {"transform", out.add(key + "transform", "<f8", {plants.transform.size(), 3, 4}, plants.transform)},
         {"mesh", out.add(key + "mesh", "<u4", {plants.mesh.size()}, plants.mesh)}});
  }
  for (const auto& actor : scene.actors) header["actors"].push_back(actor_json(actor));
  header["ground"] = ground_json(scene.ground, out);
  out.close(std::move(header));
}

void write_track(const thermal::BakedTrack& track, std::size_t actors, const thermal::Path& folder) {
  Writer out(folder / "tracks" / track.clip);
  const std::size_t frames = track.frames;
  out.add("time_s", "<f8", {frames}, track.time_s);
  out.add("camera_to_world", "<f8", {frames, 4, 4}, track.camera_to_world);
  out.add("agl_m", "<f8", {frames}, track.agl_m);
  out.add("look_angle_deg", "<f8", {frames}, track.look_angle_deg);
  out.add("actor_position_m", "<f8", {actors, frames, 3}, track.actor_position_m);
  out.add("actor_heading_rad", "<f8", {actors, frames}, track.actor_heading_rad);
  out.add("posed", "|u1", {actors, frames}, track.posed);
  out.add("bones", "<f4", {track.bones.size(), 3, 4}, track.bones);
  out.close({{"format", "veldt-track"}, {"version", 1}, {"clip", track.clip}, {"frames", frames}});
}

}  // namespace

int main(int argc, char** argv) {
  const std::vector<std::string> words(argv + 1, argv + argc);
  try {
    const thermal::Assets assets(words.at(0));
    const thermal::Path plan = words.at(1);
    const thermal::Path out = words.at(2);
    const thermal::BakedScene scene = thermal::read_baked_scene(plan, assets);
    std::filesystem::create_directories(out / "tracks");
    write_scene(scene, out);
    for (std::size_t k = 3; k < words.size(); ++k)
      write_track(thermal::read_baked_track(plan, words[k], scene, assets), scene.actors.size(), out);
    return 0;
  } catch (const thermal::Error& error) {
    std::cerr << error.what() << "\n";
    return 1;
  }
}
