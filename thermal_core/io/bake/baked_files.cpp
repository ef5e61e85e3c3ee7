#include "io/bake/baked_files.h"

#include <algorithm>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "base/error.h"
#include "io/assets.h"
#include "io/bake/array_file.h"
#include "io/json/camera.h"
#include "io/manifest_file.h"

namespace thermal {
namespace {

constexpr std::size_t kAny = ArrayFile::kAny;

template <typename Number, std::size_t Count>
std::span<const Number> flat(std::span<const std::array<Number, Count>> rows) {
  return {rows.empty() ? nullptr : rows.front().data(), Count * rows.size()};
}

/// DataError if a number of `what` is not below `count`.
void check_below(const ArrayFile& file, const std::string& where, std::size_t number, std::size_t count,
                 const char* what) {
  if (number >= count)
    throw file.fault_at(where, fmt::format("{}", number), fmt::format("one of the {} {}", count, what));
}

class SceneReader {
 public:
  SceneReader(const Path& file, const Assets& assets) : file_(file, assets.schema("scene")) {}

  BakedScene read() {
    const Json& json = file_.header();
    scene_.name = json.at("name");
    scene_.seed = json.at("seed");
    scene_.camera = intrinsics_of(json.at("camera"));
    scene_.view_margin_px = json.at("view_margin_px");
    scene_.depth_range_m = json.at("depth_range_m");
    for (const Json& object : json.at("objects")) scene_.objects.push_back(manifest_object_of(object));
    for (const Json& material : json.at("materials"))
      scene_.materials.push_back(manifest_material_of(material));
    scene_.mirrors = json.at("mirrors").get<std::set<std::string>>();
    check_header();
    for (const ManifestObject& object : scene_.objects) {
      objects_.insert(object.index);
      if (object.object_class == ObjectClass::actor) actor_objects_.insert(object.index);
    }
    for (const ManifestMaterial& material : scene_.materials) materials_.insert(material.index);
    for (const Json& mesh : json.at("meshes")) scene_.meshes.push_back(mesh_of(mesh));
    each("surfaces", [this](const Json& entry, const std::string& where) {
      scene_.surfaces.push_back({.object = object_of(entry, where), .mesh = mesh_number_of(entry, where)});
    });
    each("plants", [this](const Json& entry, const std::string& where) {
      scene_.plants.push_back(plants_of(entry, where));
    });
    each("actors", [this](const Json& entry, const std::string& where) {
      scene_.actors.push_back(actor_of(entry, where));
    });
    for (const Json& bed : json.value("beds", Json::array())) scene_.beds.push_back(warm_bed_of(bed));
    scene_.ground = ground_of(json.at("ground"));
    scene_.data = file_.take_data();
    return std::move(scene_);
  }

 private:
  /// Checks what manifests and ray casting rely on.
  void check_header() const {
    const auto [nearest, farthest] = scene_.depth_range_m;
    if (nearest >= farthest)
      throw file_.fault_at("depth_range_m", brief(file_.header().at("depth_range_m")),
                           "the nearest depth, then the farthest");
    Manifest manifest;
    manifest.objects = scene_.objects;
    manifest.materials = scene_.materials;
    try {
      manifest.validate();
    } catch (const DataError& error) {
      throw file_.fault_of(error.what());
    }
  }

  template <typename Take>
  void each(const char* list, const Take& take) {
    const Json& entries = file_.header().at(list);
    for (std::size_t k = 0; k < entries.size(); ++k) take(entries[k], fmt::format("{}[{}]", list, k));
  }

  [[nodiscard]] std::uint16_t object_of(const Json& entry, const std::string& where) const {
    const std::uint16_t index = entry.at("object");
    if (objects_.contains(index)) return index;
    throw file_.fault_at(where + ".object", fmt::format("{}", index), "an index of objects");
  }

  [[nodiscard]] std::uint16_t actor_object_of(const Json& entry, const std::string& where) const {
    const std::uint16_t index = object_of(entry, where);
    if (actor_objects_.contains(index)) return index;
    throw file_.fault_at(where + ".object", fmt::format("{}", index), "the index of an actor in objects");
  }

  [[nodiscard]] std::size_t mesh_number_of(const Json& entry, const std::string& where) const {
    const std::size_t mesh = entry.at("mesh");
    check_below(file_, where + ".mesh", mesh, scene_.meshes.size(), "meshes");
    return mesh;
  }

  [[nodiscard]] BakedMesh mesh_of(const Json& json) const {
    const std::string points = json.at("points_m");
    const std::string triangles = json.at("triangles");
    const std::string indices = json.at("material_index");
    BakedMesh mesh{.name = json.at("name"),
                   .smooth = json.at("smooth"),
                   .points_m = file_.array<std::array<float, 3>>(points, "<f4", {kAny, 3}),
                   .triangles = file_.array<std::array<std::uint32_t, 3>>(triangles, "<u4", {kAny, 3}),
                   .material_index = {}};
    mesh.material_index = file_.array<std::uint16_t>(indices, "<u2", {mesh.triangles.size()});
    file_.check_finite(points, flat(mesh.points_m));
    for (const std::uint32_t corner : flat(mesh.triangles))
      if (corner >= mesh.points_m.size())
        check_below(file_, triangles, corner, mesh.points_m.size(), "points");
    check_materials(indices, mesh.material_index);
    return mesh;
  }

  void check_materials(const std::string& name, std::span<const std::uint16_t> indices) const {
    std::vector<bool> known(std::size_t{1} << 16);
    for (const std::uint16_t index : materials_) known[index] = true;
    const auto wrong = std::ranges::find_if(indices, [&known](std::uint16_t index) { return !known[index]; });
    if (wrong == indices.end()) return;
    throw file_.fault_at(fmt::format("{}[{}]", name, wrong - indices.begin()), fmt::format("{}", *wrong),
                         "an index of materials");
  }

  [[nodiscard]] BakedPlants plants_of(const Json& json, const std::string& where) const {
    const std::string transform = json.at("transform");
    const std::string mesh = json.at("mesh");
    BakedPlants plants{.name = json.at("name"),
                       .object = object_of(json, where),
                       .transform = file_.array<Transform<double>>(transform, "<f8", {kAny, 3, 4}),
                       .mesh = {}};
    plants.mesh = file_.array<std::uint32_t>(mesh, "<u4", {plants.transform.size()});
    file_.check_finite(transform, flat(plants.transform));
    for (const std::uint32_t number : plants.mesh)
      check_below(file_, mesh, number, scene_.meshes.size(), "meshes");
    return plants;
  }

  [[nodiscard]] BakedActor actor_of(const Json& json, const std::string& where) const {
    BakedActor actor{.object = actor_object_of(json, where),
                     .name = json.at("name"),
                     .group = json.at("group"),
                     .bones = {}};
    const Json& bones = json.at("bones");
    for (std::size_t k = 0; k < bones.size(); ++k) {
      actor.bones.push_back({.name = bones[k].at("name"),
                             .mesh = mesh_number_of(bones[k], fmt::format("{}.bones[{}]", where, k))});
    }
    return actor;
  }

  [[nodiscard]] BakedGround ground_of(const Json& json) const {
    BakedGround ground;
    ground.size_m = json.at("size_m");
    ground.cells = json.at("cells");
    ground.covers = json.at("covers").get<std::vector<std::string>>();
    const std::size_t cells = ground.cells;
    const std::string height = json.at("height_m");
    ground.height_m = file_.array<float>(height, "<f4", {cells + 1, cells + 1});
    ground.cover = file_.array<std::uint8_t>(json.at("cover"), "|u1", {ground.covers.size(), cells, cells});
    ground.canopy = file_.array<std::uint8_t>(json.at("canopy"), "|u1", {cells, cells});
    file_.check_finite(height, ground.height_m);
    ground.fine_cells = json.at("fine_cells");
    const auto fine = [&](const char* name) {
      return file_.array<std::uint8_t>(json.at(name), "|u1", {ground.fine_cells, ground.fine_cells});
    };
    ground.kind = fine("kind");
    ground.grass = fine("grass");
    ground.trodden = fine("trodden");
    ground.ash = fine("ash");
    ground.border = fine("border");
    file_.check_below(json.at("kind"), ground.kind, ground.covers.size());
    if (!json.contains("shore_m")) return ground;
    const std::string shore = json.at("shore_m");
    ground.shore_m = file_.array<float>(shore, "<f4", {cells + 1, cells + 1});
    file_.check_finite(shore, ground.shore_m);
    return ground;
  }

  ArrayFile file_;
  BakedScene scene_;
  std::set<std::uint16_t> objects_;
  std::set<std::uint16_t> actor_objects_;
  std::set<std::uint16_t> materials_;
};

/// Transforms in a track: one for each bone of each actor in each frame in which it is posed.
std::size_t count_bones(const BakedScene& scene, std::size_t frames, std::span<const std::uint8_t> posed) {
  std::size_t count = 0;
  for (std::size_t actor = 0; actor < scene.actors.size(); ++actor) {
    const auto row = posed.subspan(actor * frames, frames);
    const auto shown = std::ranges::count_if(row, [](std::uint8_t one) { return one != 0; });
    count += static_cast<std::size_t>(shown) * scene.actors[actor].bones.size();
  }
  return count;
}

/// The camera of a track, if it differs from the scene's.
std::optional<CameraIntrinsics> camera_of(const Json& header) {
  if (!header.contains("camera")) return std::nullopt;
  return intrinsics_of(header.at("camera"));
}

}  // namespace

BakedScene read_baked_scene(const Path& folder, const Assets& assets) {
  return SceneReader(folder / "scene.json", assets).read();
}

BakedTrack read_baked_track(const Path& folder, const std::string& clip, const BakedScene& scene,
                            const Assets& assets) {
  ArrayFile file(folder / "tracks" / (clip + ".json"), assets.schema("track"));
  if (file.header().at("clip") != clip)
    throw file.fault_at("clip", brief(file.header().at("clip")), fmt::format("\"{}\"", clip));
  const std::size_t frames = file.header().at("frames");
  const std::size_t actors = scene.actors.size();
  BakedTrack track{
      .clip = clip,
      .camera = camera_of(file.header()),
      .frames = frames,
      .time_s = file.array<double>("time_s", "<f8", {frames}),
      .camera_to_world = file.array<std::array<double, 16>>("camera_to_world", "<f8", {frames, 4, 4}),
      .agl_m = file.array<double>("agl_m", "<f8", {frames}),
      .look_angle_deg = file.array<double>("look_angle_deg", "<f8", {frames}),
      .actor_position_m = file.array<std::array<double, 3>>("actor_position_m", "<f8", {actors, frames, 3}),
      .actor_heading_rad = file.array<double>("actor_heading_rad", "<f8", {actors, frames}),
      .posed = file.array<std::uint8_t>("posed", "|u1", {actors, frames}),
      .bones = {},
      .data = {}};
  track.bones = file.array<Transform<float>>("bones", "<f4", {count_bones(scene, frames, track.posed), 3, 4});
  file.check_finite("time_s", track.time_s);
  file.check_finite("camera_to_world", flat(track.camera_to_world));
  file.check_finite("agl_m", track.agl_m);
  file.check_finite("look_angle_deg", track.look_angle_deg);
  file.check_finite("actor_position_m", flat(track.actor_position_m));
  file.check_finite("actor_heading_rad", track.actor_heading_rad);
  file.check_finite("bones", flat(track.bones));
  track.data = file.take_data();
  return track;
}

}  // namespace thermal
