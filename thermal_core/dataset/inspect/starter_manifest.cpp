#include "dataset/inspect/starter_manifest.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"
#include "dataset/inspect/filled_in.h"

namespace thermal {
namespace {

constexpr std::size_t kMostCopies = 20;

std::vector<StarterObject> objects_by_index(const PassSurvey& survey) {
  std::vector<StarterObject> objects;
  for (const auto& [index, pixels] : survey.objects)
    if (index != kSkyIndex)
      objects.push_back({.index = index, .name = fmt::format("object_{}", index), .pixels = pixels});
  return objects;
}

std::vector<StarterObject> objects_by_colour(const PassSurvey& survey) {
  std::vector<StarterObject> objects;
  for (const auto& [colour, pixels] : survey.colours) {
    if (colour == Colour{}) continue;  // the sky's default
    StarterObject object{.index = 0, .name = "", .pixels = pixels};
    object.name = fmt::format("colour_{:02x}{:02x}{:02x}", colour[0], colour[1], colour[2]);
    object.colour = colour;
    objects.push_back(std::move(object));
  }
  return objects;
}

/// A name without the number that Blender adds to copies: "Tree" of "Tree.001".
std::string original(const std::string& name) {
  const std::size_t dot = name.rfind('.');
  const bool copy = dot != std::string::npos && dot + 1 < name.size() &&
                    name.find_first_not_of("0123456789", dot + 1) == std::string::npos;
  return copy ? name.substr(0, dot) : name;
}

/// Mattes of one object, by the object's name.
using Groups = std::map<std::string, std::map<std::string, std::int64_t>>;

/// Groups `mattes` into objects: all of one kind of ground or plant; otherwise by name, with copies together if there
/// are many.
Groups group_mattes(const std::map<std::uint32_t, PassSurvey::Matte>& mattes, const NameGuesser& known) {
  std::map<std::string, std::size_t> copies;
  for (const auto& [hash, matte] : mattes) ++copies[original(matte.name)];
  Groups groups;
  for (const auto& [hash, matte] : mattes) {
    if (hash == 0 || matte.name.empty()) continue;
    const std::string first = original(matte.name);
    const auto thing = known.find(matte.name);
    const bool many = copies[first] > kMostCopies;
    const bool kind = thing && thing->object_class != ObjectClass::actor;
    groups[kind   ? thing->material
           : many ? first
                  : matte.name][many ? first + ".*" : matte.name] += matte.pixels;
    if (many) groups[kind ? thing->material : first][first] += 0;
  }
  return groups;
}

std::vector<StarterObject> objects_by_matte(const std::map<std::uint32_t, PassSurvey::Matte>& mattes,
                                            const NameGuesser& known) {
  std::vector<StarterObject> objects;
  for (const auto& [name, members] : group_mattes(mattes, known)) {
    StarterObject object{.index = 0, .name = name, .pixels = 0};
    for (const auto& [matte, pixels] : members) {
      object.pixels += pixels;
      object.mattes.push_back(matte);
    }
    object.known = known.find(object.mattes.front());
    if (object.known) object.reason = fmt::format("by the name {}", object.mattes.front());
    if (object.mattes == std::vector<std::string>{name}) object.mattes.clear();
    objects.push_back(std::move(object));
  }
  return objects;
}

/// Numbers objects from 1, most pixels first.
void number(std::vector<StarterObject>& objects) {
  std::sort(objects.begin(), objects.end(), [](const StarterObject& a, const StarterObject& b) {
    return std::tuple(-a.pixels, a.name) < std::tuple(-b.pixels, b.name);
  });
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i].index = static_cast<int>(i) + 1;
}

/// If no object is known as ground, takes the largest as ground.
void guess_ground(std::vector<StarterObject>& objects) {
  const auto is_ground = [](const StarterObject& object) {
    return object.known && object.known->object_class == ObjectClass::ground;
  };
  if (objects.size() < 2 || std::any_of(objects.begin(), objects.end(), is_ground)) return;
  const auto most =
      std::max_element(objects.begin(), objects.end(),
                       [](const StarterObject& a, const StarterObject& b) { return a.pixels < b.pixels; });
  if (most->known) return;
  most->known = {.object_class = ObjectClass::ground, .material = "soil", .category = "", .species = ""};
  most->reason = "it covers most";
}

}  // namespace

std::vector<StarterObject> starter_objects(const Inspection& inspection, const NameGuesser& known) {
  const PassSurvey& survey = inspection.survey;
  std::vector<StarterObject> objects;
  if (!inspection.cryptomatte.empty()) {
    const auto mattes = survey.cryptomattes.find(inspection.cryptomatte);
    if (mattes != survey.cryptomattes.end()) objects = objects_by_matte(mattes->second, known);
    number(objects);
  } else if (!survey.colours.empty()) {
    objects = objects_by_colour(survey);
    number(objects);
  } else {
    objects = objects_by_index(survey);
  }
  guess_ground(objects);
  return objects;
}

namespace {

// Defaults of Blender's cameras and scenes.
constexpr double kLensMm = 50;
constexpr double kSensorMm = 36;  // of the picture's longer side
constexpr double kFrameRateHz = 24;

/// A clip name from a folder's name.
std::string clip_name(const Path& folder) {
  const Path whole = std::filesystem::absolute(folder).lexically_normal();
  std::string name = (whole.has_filename() ? whole : whole.parent_path()).filename().string();
  for (char& letter : name) {
    const bool fine = (letter >= 'a' && letter <= 'z') || (letter >= 'A' && letter <= 'Z') ||
                      (letter >= '0' && letter <= '9') || letter == '-';
    if (!fine) letter = '_';
  }
  return name.empty() ? "clip" : name;
}

std::string_view class_name(ObjectClass object_class) {
  switch (object_class) {
    case ObjectClass::ground:
      return "ground";
    case ObjectClass::water:
      return "water";
    case ObjectClass::plant:
      return "plant";
    case ObjectClass::actor:
      return "actor";
  }
  return "";
}

/// Fills a starter manifest, entry by entry.
class Writer {
 public:
  Writer(const Inspection& inspection, const NameGuesser& known) : inspection_(inspection), known_(known) {}

  StarterManifest write() {
    Json& json = made_.document;
    json = {{"format", "veldt-passes"}, {"version", 1}, {"clip", clip_name(inspection_.group.folder)}};
    add_channels();
    add_camera();
    json["frame_rate_hz"] = kFrameRateHz;
    made_.guesses.push_back(fmt::format("frame_rate_hz = {} (Blender's default)", kFrameRateHz));
    add_files();
    json["objects"] = Json::array();
    for (const StarterObject& object : starter_objects(inspection_, known_)) add_object(object);
    check_names();
    check_objects();
    add_materials();
    return std::move(made_);
  }

 private:
  void add_channels() {
    Json& json = made_.document;
    if (!inspection_.layout.layer.empty()) json["layer"] = inspection_.layout.layer;
    const std::string& objects = inspection_.layout.channels.object_index;
    if (!inspection_.cryptomatte.empty()) json["cryptomatte"] = inspection_.cryptomatte;
    if (objects.empty()) return;
    json["channels"] = {{"object_index", objects}};
    made_.guesses.push_back(fmt::format("channels.object_index = \"{}\" (it holds whole numbers)", objects));
  }

  void add_camera() {
    const int width_px = inspection_.header.width_px;
    const int height_px = inspection_.header.height_px;
    const double exact_px = kLensMm / kSensorMm * std::max(width_px, height_px);
    const double focal_px = std::round(exact_px * 1000) / 1000;
    const double high_px = focal_px * inspection_.header.pixel_aspect;
    made_.document["camera"] = {{"width_px", width_px},    {"height_px", height_px},
                                {"fx_px", focal_px},       {"fy_px", high_px},
                                {"cx_px", width_px / 2.0}, {"cy_px", height_px / 2.0}};
    made_.guesses.push_back(fmt::format("camera.fx_px = {}{} ({} mm before {} mm, Blender's usual lens)",
                                        high_px == focal_px ? "camera.fy_px = " : "", focal_px, kLensMm,
                                        kSensorMm));
    if (high_px != focal_px)
      made_.guesses.push_back(fmt::format("camera.fy_px = {} (its pixelAspectRatio is {:.6g})", high_px,
                                          inspection_.header.pixel_aspect));
  }

  void add_files() {
    const std::string pattern = pattern_of(inspection_.sequence);
    if (!pattern.empty()) {
      made_.document["sequence"] = pattern;
      return;
    }
    Json frames = Json::array();
    for (const auto& [name, is_gap] : inspection_.sequence.frames)
      frames.push_back({{"file", name.name}, {"time_s", static_cast<double>(frames.size()) / kFrameRateHz}});
    made_.document["frames"] = std::move(frames);
  }

  void add_object(const StarterObject& object) {
    Json& objects = made_.document["objects"];
    const std::string where = fmt::format("objects[{}]", objects.size());
    const ObjectClass object_class = object.known ? object.known->object_class : ObjectClass::actor;
    Json entry = {{"index", object.index},
                  {"name", object.name},
                  {"class", class_name(object_class)},
                  {"material", object.known ? object.known->material : kFillIn}};
    if (object.colour) entry["colour"] = *object.colour;
    if (!object.mattes.empty()) entry["mattes"] = object.mattes;
    if (object_class == ObjectClass::actor) add_actor(entry, object);
    if (object.known) {
      made_.guesses.push_back(fmt::format("{}: {} is {}, {} ({})", where, object.name,
                                          class_name(object_class), object.known->material, object.reason));
    } else {
      made_.to_fill_in.push_back(
          fmt::format("{}: material and category of {} ({} px)", where, object.name, object.pixels));
    }
    objects.push_back(std::move(entry));
  }

  void add_actor(Json& entry, const StarterObject& object) {
    entry["category"] = object.known ? object.known->category : kFillIn;
    if (object.known) entry["species"] = object.known->species;
    entry["track_id"] = ++tracks_;
  }

  void add_materials() {
    Json& materials = made_.document["materials"] = Json::array();
    for (const auto& [index, pixels] : inspection_.survey.materials) {
      if (index == 0) continue;  // 0: the object's material
      made_.to_fill_in.push_back(fmt::format("materials[{}]: material of material index {} ({} px)",
                                             materials.size(), index, pixels));
      materials.push_back({{"index", index}, {"material", kFillIn}});
    }
  }

  /// Hashes that the file does not name, most pixels first.
  [[nodiscard]] std::vector<std::string> unnamed_mattes() const {
    std::vector<std::pair<std::int64_t, std::string>> by_pixels;
    const auto mattes = inspection_.survey.cryptomattes.find(inspection_.cryptomatte);
    if (mattes == inspection_.survey.cryptomattes.end()) return {};
    for (const auto& [hash, matte] : mattes->second)
      if (hash != 0 && matte.name.empty()) by_pixels.emplace_back(-matte.pixels, fmt::format("{:08x}", hash));
    std::sort(by_pixels.begin(), by_pixels.end());
    std::vector<std::string> hashes;
    for (auto& [less, hash] : by_pixels) hashes.push_back(std::move(hash));
    return hashes;
  }

  /// Hashes cannot be inverted to names.
  void check_names() {
    const std::vector<std::string> unnamed = unnamed_mattes();
    if (unnamed.empty()) return;
    const std::string why =
        inspection_.cryptomatte_faults.empty()
            ? fmt::format("cryptomatte {} has no manifest that names them", inspection_.cryptomatte)
            : fmt::format("{}", fmt::join(inspection_.cryptomatte_faults, "; "));
    if (made_.document["objects"].empty())
      throw DataError(
          fmt::format("{}: {} objects without names; {}; expected their names in it, or in objects of a "
                      "manifest.json of your own",
                      inspection_.file.string(), unnamed.size(), why));
    made_.to_fill_in.push_back(
        fmt::format("objects: add those whose names the file does not tell, by their hashes: {} ({})",
                    list_names(unnamed), why));
  }

  void check_objects() const {
    const auto count = made_.document["objects"].size();
    if (count >= 1 && count <= static_cast<std::size_t>(kLargestIndex)) return;
    if (count > 0) {
      throw DataError(fmt::format("{}: {} objects; expected at most {}; colours may be blended at edges",
                                  inspection_.file.string(), count, kLargestIndex));
    }
    throw DataError(
        fmt::format("{}: no objects, only sky (index 0); expected an index of 1 and more for each object",
                    inspection_.file.string()));
  }

  const Inspection& inspection_;
  const NameGuesser& known_;
  StarterManifest made_;
  int tracks_ = 0;
};

}  // namespace

StarterManifest starter_manifest(const Inspection& inspection, const NameGuesser& known) {
  if (!inspection.obstacle.empty())
    throw DataError(fmt::format("{}: {}{}", inspection.file.string(), inspection.obstacle,
                                inspection.layers.empty() ? "" : ", or --layer"));
  return Writer(inspection, known).write();
}

}  // namespace thermal
