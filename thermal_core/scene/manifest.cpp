#include "scene/manifest.h"

#include <map>
#include <set>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

void check_once(std::set<int>& seen, int value, const std::string& where) {
  if (!seen.insert(value).second) {
    throw DataError(fault(where, fmt::format("{}", value), "", "each value once"));
  }
}

void check_actor(const ManifestObject& object, const std::string& where) {
  if (object.category.empty()) throw DataError(where + ".category is missing; expected one for every actor");
  if (object.track_id < 1) throw DataError(where + ".track_id is missing; expected one for every actor");
}

/// A colour must identify one object, and differ from the sky's.
void check_colours(const Manifest& manifest) {
  std::map<Colour, std::string> seen = {{manifest.sky_colour, "sky_colour"}};
  for (std::size_t i = 0; i < manifest.objects.size(); ++i) {
    const auto& colour = manifest.objects[i].colour;
    if (!colour) continue;
    const std::string where = fmt::format("objects[{}].colour", i);
    const auto [first, fresh] = seen.emplace(*colour, where);
    if (fresh) continue;
    const auto [red, green, blue] = *colour;
    const std::string words = fmt::format("#{0:02x}{1:02x}{2:02x} ({0}, {1}, {2})", red, green, blue);
    throw DataError(fault(where, words, "", "a colour other than " + first->second));
  }
}

}  // namespace

void Manifest::validate() const {
  if (!frames.empty() && !sequence.empty()) {
    throw DataError(
        fault("sequence", fmt::format("\"{}\"", sequence), "", "none, because frames lists the files"));
  }
  check_colours(*this);
  std::set<int> object_indices;
  std::set<int> actor_indices;
  std::set<int> tracks;
  for (std::size_t i = 0; i < objects.size(); ++i) {
    const std::string where = fmt::format("objects[{}]", i);
    check_once(object_indices, objects[i].index, where + ".index");
    if (objects[i].object_class != ObjectClass::actor) continue;
    check_actor(objects[i], where);
    check_once(tracks, objects[i].track_id, where + ".track_id");
    actor_indices.insert(objects[i].index);
  }
  std::set<int> material_indices;
  for (std::size_t i = 0; i < materials.size(); ++i) {
    check_once(material_indices, materials[i].index, fmt::format("materials[{}].index", i));
  }
  for (std::size_t i = 0; i < frames.size(); ++i) {
    for (std::size_t k = 0; k < frames[i].actors.size(); ++k) {
      const int index = frames[i].actors[k].index;
      if (actor_indices.contains(index)) continue;
      throw DataError(fault(fmt::format("frames[{}].actors[{}].index", i, k), fmt::format("{}", index), "",
                            "the index of an actor in objects"));
    }
  }
}

}  // namespace thermal
