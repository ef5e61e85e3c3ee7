#include "python/parts.h"

namespace thermal::python {

Config config_of_sections(const std::string& sections, const std::string& name, const Assets& assets) {
  Json document = parse_json(sections, name);
  document["name"] = "sections";
  document["clips"] = Json::array({{{"id", "clip"},
                                    {"season", "winter"},
                                    {"frames", 1},
                                    {"flight", {{"pattern", "zigzag"}, {"area_m", {0, 0, 9, 9}}}}}});
  return resolve_config(std::move(document), name, assets);
}

}  // namespace thermal::python
