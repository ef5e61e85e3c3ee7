#pragma once

#include <map>
#include <string>
#include <vector>

#include "scene/season.h"

namespace thermal {

/// What a surface is made of, as far as a thermal camera can tell.
struct Material {
  std::string name;
  double emissivity = 1;    ///< in band, (0, 1]
  double winter_k = 273;    ///< night-time temperature, air at 273 K
  double summer_k = 293;    ///< night-time temperature, air at 293 K
  bool in_table_1 = false;  ///< one of the twelve rows of Table 1 (Bondi et al. 2018)

  /// ConfigError if a value is outside its domain.
  void validate() const;
  [[nodiscard]] double temperature_k(Season season) const noexcept;
};

/// Materials by name.
class MaterialLibrary {
 public:
  /// ConfigError if a material is invalid or a name comes twice.
  void add(Material material);

  /// ConfigError naming `where` and the nearest known name if there is no such material.
  [[nodiscard]] const Material& find(const std::string& name, const std::string& where) const;
  [[nodiscard]] std::vector<std::string> names() const;
  [[nodiscard]] const std::map<std::string, Material>& all() const noexcept { return materials_; }

 private:
  std::map<std::string, Material> materials_;
};

}  // namespace thermal
