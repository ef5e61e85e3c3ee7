#pragma once

#include <string_view>

namespace thermal {

/// The two nights of the published Table 1: air at 273 K in winter, at 293 K in summer.
enum class Season { winter, summer };

/// "summer" is summer; anything else is winter.
[[nodiscard]] constexpr Season season_of(std::string_view name) noexcept {
  return name == "summer" ? Season::summer : Season::winter;
}

/// Its name in configs: "winter" or "summer".
[[nodiscard]] constexpr std::string_view season_name(Season season) noexcept {
  return season == Season::winter ? "winter" : "summer";
}

}  // namespace thermal
