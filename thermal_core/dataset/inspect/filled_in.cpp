#include "dataset/inspect/filled_in.h"

#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "base/error.h"
#include "base/text.h"

namespace thermal {
namespace {

/// An unknown material, and all manifest entries with it.
using MaterialUses = std::vector<std::pair<std::string, std::vector<std::string>>>;

void add_use(MaterialUses& uses, const std::string& material, std::string where) {
  for (auto& [name, places] : uses) {
    if (name != material) continue;
    places.push_back(std::move(where));
    return;
  }
  uses.push_back({material, {std::move(where)}});
}

MaterialUses uses_of(const Manifest& manifest) {
  MaterialUses uses;
  for (std::size_t i = 0; i < manifest.objects.size(); ++i)
    add_use(uses, manifest.objects[i].material, fmt::format("objects[{}].material", i));
  for (std::size_t i = 0; i < manifest.materials.size(); ++i)
    add_use(uses, manifest.materials[i].material, fmt::format("materials[{}].material", i));
  return uses;
}

std::vector<std::string> unknown_materials(const Manifest& manifest, const MaterialLibrary& materials) {
  std::vector<std::string> faults;
  for (const auto& [material, places] : uses_of(manifest)) {
    try {
      (void)materials.find(material, list_names(places));
    } catch (const ConfigError& error) {
      faults.emplace_back(error.what());
    }
  }
  return faults;
}

std::vector<std::string> categories_to_fill_in(const Manifest& manifest) {
  std::vector<std::string> places;
  for (std::size_t i = 0; i < manifest.objects.size(); ++i)
    if (manifest.objects[i].category == kFillIn) places.push_back(fmt::format("objects[{}].category", i));
  if (places.empty()) return {};
  return {fault(list_names(places), fmt::format("\"{}\"", kFillIn), "",
                "a category such as human or elephant, or a class other than actor")};
}

}  // namespace

void check_filled_in(const Manifest& manifest, const Path& file, const MaterialLibrary& materials) {
  std::vector<std::string> faults = unknown_materials(manifest, materials);
  for (std::string& more : categories_to_fill_in(manifest)) faults.push_back(std::move(more));
  throw_faults<DataError>(faults, file.string());
}

}  // namespace thermal
