#include "io/manifest_file.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/assets.h"
#include "io/json/camera.h"
#include "io/json/file.h"
#include "io/json/schema.h"
#include "io/system/sha256.h"

namespace thermal {
namespace {

PassChannels read_channels(const Json& json) {
  return {.object_index = json["object_index"],
          .material_index = json["material_index"],
          .depth = json["depth"],
          .normal = json["normal"]};
}

ObjectClass read_class(const std::string& name) {
  if (name == "actor") return ObjectClass::actor;
  if (name == "plant") return ObjectClass::plant;
  return name == "water" ? ObjectClass::water : ObjectClass::ground;
}

ActorPose read_pose(const Json& json) {
  return {.index = json["index"],
          .position_m = json["position_m"].get<std::array<double, 3>>(),
          .heading_rad = json["heading_rad"]};
}

ManifestFrame read_frame(const Json& json) {
  ManifestFrame frame;
  frame.file = json["file"];
  frame.time_s = json["time_s"];
  if (json.contains("agl_m")) frame.agl_m = json["agl_m"];
  if (json.contains("look_angle_deg")) frame.look_angle_deg = json["look_angle_deg"];
  if (json.contains("camera_to_world"))
    frame.camera_to_world = json["camera_to_world"].get<std::array<double, 16>>();
  for (const Json& actor : json["actors"]) frame.actors.push_back(read_pose(actor));
  return frame;
}

Manifest read_document(const Json& json) {
  Manifest manifest;
  manifest.clip = json["clip"];
  manifest.of_flight = json["of_flight"];
  manifest.scene = json["scene"];
  manifest.seed = json["seed"];
  manifest.frame_rate_hz = json["frame_rate_hz"];
  manifest.layer = json["layer"];
  manifest.actor_layer = json["actor_layer"];
  manifest.mirror_layer = json["mirror_layer"];
  manifest.channels = read_channels(json["channels"]);
  manifest.cryptomatte = json["cryptomatte"];
  manifest.sky_colour = json["sky_colour"].get<Colour>();
  manifest.sequence = json["sequence"];
  manifest.supersample = json["supersample"];
  manifest.overscan_px = json["overscan_px"];
  manifest.camera = intrinsics_of(json["camera"]);
  if (json["camera"].contains("distortion")) manifest.lens = distortion_of(json["camera"]["distortion"]);
  for (const Json& object : json["objects"]) manifest.objects.push_back(manifest_object_of(object));
  for (const Json& material : json["materials"]) manifest.materials.push_back(manifest_material_of(material));
  for (const Json& bed : json["beds"]) manifest.beds.push_back(warm_bed_of(bed));
  for (const Json& frame : json["frames"]) manifest.frames.push_back(read_frame(frame));
  return manifest;
}

constexpr std::array<std::string_view, 3> kEngineNames = {"driving", "idling", "parked"};  // of EngineState

VehicleState read_engine(const Json& json) {
  const auto found = std::ranges::find(kEngineNames, json.at("state").get<std::string>());
  return {.engine = static_cast<EngineState>(found - kEngineNames.begin()), .since_s = json.at("since_s")};
}

FirePlace read_fire(const Json& json) {
  return {.place_m = json.at("place_m").get<std::array<double, 2>>(),
          .diameter_m = json.at("diameter_m"),
          .burning = json.at("state") == "burning",
          .since_s = json.at("since_s")};
}

constexpr std::array kClassNames = {"ground", "water", "plant", "actor"};  // of ObjectClass

Json to_json(const ManifestObject& object) {
  Json json = {{"index", object.index},
               {"name", object.name},
               {"class", kClassNames.at(static_cast<std::size_t>(object.object_class))},
               {"material", object.material}};
  if (object.fire)
    json["fire"] = {{"place_m", object.fire->place_m},
                    {"diameter_m", object.fire->diameter_m},
                    {"state", object.fire->burning ? "burning" : "embers"},
                    {"since_s", object.fire->since_s}};
  if (object.object_class != ObjectClass::actor) return json;
  json["category"] = object.category;
  json["species"] = object.species;
  json["track_id"] = object.track_id;
  if (object.bounds_m) json["bounds_m"] = *object.bounds_m;
  if (object.engine)
    json["engine"] = {{"state", kEngineNames.at(static_cast<std::size_t>(object.engine->engine))},
                      {"since_s", object.engine->since_s}};
  if (object.wet_s) json["wet_s"] = *object.wet_s;
  return json;
}

Json to_json(const ManifestMaterial& material) {
  Json json = {{"index", material.index}, {"material", material.material}};
  if (!material.part.empty()) json["part"] = material.part;
  return json;
}

Json to_json(const WarmBed& bed) {
  return {{"place_m", bed.place_m},
          {"heading_rad", bed.heading_rad},
          {"half_m", bed.half_m},
          {"left_s", bed.left_s},
          {"lain_s", bed.lain_s}};
}

Json to_json(const ManifestFrame& frame) {
  Json json = {{"file", frame.file}, {"time_s", frame.time_s}};
  if (frame.agl_m) json["agl_m"] = *frame.agl_m;
  if (frame.look_angle_deg) json["look_angle_deg"] = *frame.look_angle_deg;
  if (frame.camera_to_world) json["camera_to_world"] = *frame.camera_to_world;
  json["actors"] = Json::array();
  for (const ActorPose& actor : frame.actors) {
    json["actors"].push_back(
        {{"index", actor.index}, {"position_m", actor.position_m}, {"heading_rad", actor.heading_rad}});
  }
  return json;
}

template <typename Entry>
Json list_of(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (const Entry& entry : entries) list.push_back(to_json(entry));
  return list;
}

/// Without its frames.
Json head_of(const Manifest& manifest) {
  Json json = {{"format", "veldt-passes"}, {"version", 1}, {"clip", manifest.clip}};
  if (!manifest.of_flight.empty()) json["of_flight"] = manifest.of_flight;
  json["scene"] = manifest.scene;
  json["seed"] = manifest.seed;
  json["frame_rate_hz"] = manifest.frame_rate_hz;
  json["layer"] = manifest.layer;
  if (!manifest.actor_layer.empty()) json["actor_layer"] = manifest.actor_layer;
  if (!manifest.mirror_layer.empty()) json["mirror_layer"] = manifest.mirror_layer;
  json["supersample"] = manifest.supersample;
  json["overscan_px"] = manifest.overscan_px;
  json["camera"] = to_json(manifest.camera);
  if (!manifest.lens.is_none()) json["camera"]["distortion"] = to_json(manifest.lens);
  json["objects"] = list_of(manifest.objects);
  json["materials"] = list_of(manifest.materials);
  if (!manifest.beds.empty()) json["beds"] = list_of(manifest.beds);
  return json;
}

}  // namespace

std::string to_text(const Manifest& manifest) {
  std::string frames;  // one a line
  for (const ManifestFrame& frame : manifest.frames)
    frames += (frames.empty() ? "\n  " : ",\n  ") + to_json(frame).dump();
  std::string text = head_of(manifest).dump(1);
  text.erase(text.rfind('\n'));
  return fmt::format("{},\n \"frames\": [{}\n ]\n}}\n", text, frames);
}

ManifestObject manifest_object_of(const Json& json) {
  ManifestObject object;
  object.index = json.at("index");
  object.name = json.at("name");
  object.object_class = read_class(json.at("class"));
  object.material = json.at("material");
  object.category = json.value("category", "");
  object.species = json.value("species", "");
  object.track_id = json.value("track_id", 0);
  if (json.contains("colour")) object.colour = json["colour"].get<Colour>();
  if (json.contains("mattes")) object.mattes = json["mattes"].get<std::vector<std::string>>();
  if (json.contains("engine")) object.engine = read_engine(json["engine"]);
  if (json.contains("fire")) object.fire = read_fire(json["fire"]);
  if (json.contains("wet_s")) object.wet_s = json["wet_s"].get<double>();
  if (json.contains("bounds_m"))
    object.bounds_m = json["bounds_m"].get<std::array<ManifestObject::Corner, 2>>();
  return object;
}

ManifestMaterial manifest_material_of(const Json& json) {
  return {.index = json.at("index"), .material = json.at("material"), .part = json.value("part", "")};
}

WarmBed warm_bed_of(const Json& json) {
  return {.place_m = json.at("place_m").get<std::array<double, 2>>(),
          .heading_rad = json.at("heading_rad"),
          .half_m = json.at("half_m").get<std::array<double, 2>>(),
          .left_s = json.at("left_s"),
          .lain_s = json.at("lain_s")};
}

Manifest parse_manifest(Json document, const std::string& name, const Assets& assets) {
  const std::string sum = sha256_of(document.dump());
  throw_faults<DataError>(check_and_fill(document, assets.schema("manifest")), name);
  Manifest manifest = read_document(document);
  manifest.document_sha256 = sum;
  try {
    manifest.validate();
  } catch (const DataError& error) {
    throw DataError(name + ": " + error.what());
  }
  return manifest;
}

Manifest read_manifest(const Path& file, const Assets& assets) {
  Json document;
  try {
    document = read_json(file);
  } catch (const ConfigError& error) {  // not JSON: the file's fault, not the config's
    throw DataError(error.what());
  }
  return parse_manifest(std::move(document), file.string(), assets);
}

}  // namespace thermal
