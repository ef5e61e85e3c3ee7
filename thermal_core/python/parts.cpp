#include "python/parts.h"

#include <utility>

#include "io/config/config.h"

namespace thermal::python {

SharedSettings settings_of_sections(const std::string& sections, const std::string& name,
                                    const Assets& assets) {
  Json document = parse_json(sections, name);
  document["name"] = "sections";
  document["clips"] = Json::array({{{"id", "clip"},
                                    {"season", "winter"},
                                    {"frames", 1},
                                    {"flight", {{"pattern", "zigzag"}, {"area_m", {0, 0, 9, 9}}}}}});
  return resolve_config(std::move(document), name, assets).spec.settings;
}

}  // namespace thermal::python
