#include "io/config/variants.h"

#include <set>
#include <utility>

#include <fmt/format.h>

#include "base/error.h"
#include "io/assets.h"
#include "io/config/config.h"
#include "io/json/schema.h"

namespace thermal {
namespace {

void check_names(const Json& variants, std::vector<std::string>& faults) {
  std::set<std::string> seen;
  for (std::size_t i = 0; i < variants.size(); ++i) {
    const auto name = variants[i].at("name").get<std::string>();
    if (seen.insert(name).second) continue;
    faults.push_back(
        fault(fmt::format("variants[{}].name", i), fmt::format("\"{}\"", name), "", "each name once"));
  }
}

}  // namespace

std::vector<Variant> read_variants(Json document, const std::string& name, const Assets& assets) {
  const Json schema = assets.schema("variants");
  std::vector<std::string> faults = check_and_fill(document, schema);
  throw_faults(faults, name);
  Json& list = document["variants"];
  check_names(list, faults);
  throw_faults(faults, name);
  std::vector<Variant> variants;
  for (std::size_t i = 0; i < list.size(); ++i) {
    const auto id = list[i]["name"].get<std::string>();
    list[i].erase("name");
    variants.push_back({.name = id,
                        .where = fmt::format("{}: variants[{}] ({})", name, i, id),
                        .changes = std::move(list[i])});
  }
  return variants;
}

Json changed_by(const Variant& variant, Json document) {
  Json changes = variant.changes;
  if (const auto season = changes.find("season"); season != changes.end()) {
    set_season(document, *season);
    changes.erase("season");
  }
  document.merge_patch(changes);
  return document;
}

}  // namespace thermal
