#include "io/config/asset_files.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "base/relative_name.h"
#include "io/json/file.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

class AssetFiles {
 public:
  explicit AssetFiles(const Assets& assets) : assets_(assets), schema_(assets.schema("asset")) {}

  /// The content; null if there is no such file, or it was checked before.
  Json checked(const std::string& kind, const std::string& name) {
    const auto relative = RelativeName::part_of(name + ".json");
    if (!relative || !known_.emplace(kind, name).second) return {};
    const Path file = assets_.folder(kind) / relative->text();
    if (!std::filesystem::exists(file)) return {};
    Json document = read_json(file);
    schema_["$ref"] = "#/$defs/" + kind;
    const std::vector<std::string> faults = check_and_fill(document, schema_);
    if (!faults.empty()) throw ConfigError(fmt::format("assets/{}/{}.json: {}", kind, name, faults.front()));
    return document;
  }

  void check_standing(const std::string& name) {
    (void)checked("plants", name);
    (void)checked("structures", name);
  }

  void check_site(const std::string& kind) {
    const Json site = checked("sites", kind);
    if (site.is_null()) return;
    for (const Json& rule : site["objects"])
      for (const Json& name : rule["object"].is_array() ? rule["object"] : Json::array({rule["object"]}))
        check_standing(name);
  }

 private:
  const Assets& assets_;
  Json schema_;
  std::set<std::pair<std::string, std::string>> known_;
};

}  // namespace

void check_asset_files(const Json& scene, const Assets& assets) {
  AssetFiles files(assets);
  for (const Json& group : scene.at("groups")) (void)files.checked("species", group.at("species"));
  for (const auto& [name, planted] : scene.at("plants").items()) files.check_standing(name);
  for (const Json& site : scene.value("sites", Json::array())) files.check_site(site.at("kind"));
}

}  // namespace thermal
