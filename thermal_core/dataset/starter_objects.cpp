#include "dataset/starter_objects.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <utility>

#include <fmt/format.h>

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
    if (colour == Colour{}) continue;  // the sky's, unless its colour is changed
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

/// Mattes that make one object, by its name.
using Groups = std::map<std::string, std::map<std::string, std::int64_t>>;

/// Groups `mattes` into objects: everything of one kind of ground or plant, otherwise single names unless a name has
/// many copies.
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

/// Most pixels first, numbered from 1.
void number(std::vector<StarterObject>& objects) {
  std::sort(objects.begin(), objects.end(), [](const StarterObject& a, const StarterObject& b) {
    return std::tuple(-a.pixels, a.name) < std::tuple(-b.pixels, b.name);
  });
  for (std::size_t i = 0; i < objects.size(); ++i) objects[i].index = static_cast<int>(i) + 1;
}

/// If none of several things is known as ground, the one that covers most is taken as ground.
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

}  // namespace thermal
