#pragma once

#include "heat/body/body_surface.h"
#include "heat/body/tissue.h"

namespace thermal {

inline constexpr double kCloM2KW = 0.155;  ///< insulation of 1 clo [m^2 K W^-1]

/// Area of clothes over that of the skin below (ISO 7730:2005): 1 + 1.29 I up to I = 0.078 m^2 K/W, 1.05 + 0.645 I above.
[[nodiscard]] double clothing_area_factor(double insulation_clo) noexcept;

/// Clothes on a part of a person, or what a person carries. Outdoors the skin below is not in comfort: it has the
/// temperature at which the body's heat passes through tissue and clothes.
struct Clothing {
  DrawnRange cold_clo = {1.2, 2.2};  ///< of the part, as people dress for air of 273 K, 0 to 20
  DrawnRange warm_clo = {0.4, 0.9};  ///< for air of 293 K; a straight line between, and beyond the same
  Tissue tissue = {};
  BodySurface surface = {
      .albedo = 0.35, .emissivity = 0.97, .open_view = 0.72};  ///< area_factor and diameter_m unused

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  /// Insulation that a person wears [clo]. @param uniform  of the person, 0 to 1
  [[nodiscard]] double insulation_clo(double air_k, double uniform) const noexcept;

  [[nodiscard]] bool operator==(const Clothing&) const = default;
};

/// Surface of clothes [K].
[[nodiscard]] double clothing_surface_k(const Clothing& clothing, double insulation_clo, Activity activity,
                                        const Forcing& forcing, const Incoming& incoming) noexcept;

}  // namespace thermal
