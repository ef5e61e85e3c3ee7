#include "scene/manifest.h"

#include <set>

#include <fmt/format.h>

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

}  // namespace

void Manifest::validate() const {
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
