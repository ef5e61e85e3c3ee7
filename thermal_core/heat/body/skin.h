#pragma once

#include <string>

#include "heat/body/body_surface.h"

namespace thermal {

/// What a person or an animal does.
enum class Activity { standing, walking };

/// A range from which each person or vehicle has a value of its own.
struct DrawnRange {
  double low = 0;
  double high = 0;

  /// The value of a uniform number, 0 to 1 (clamped): low at 0, high at 1.
  [[nodiscard]] double at(double uniform) const noexcept;

  /// ConfigError with `where` unless lowest <= low <= high <= highest.
  void validate(const std::string& where, const char* unit, double lowest, double highest) const;

  [[nodiscard]] bool operator==(const DrawnRange&) const = default;
};

/// Metabolic rate [W m^-2 of skin]: standing relaxed 1.2 met, walking at 4.8 km/h 2.6 met (ANSI/ASHRAE 55, as in
/// pythermalcomfort 4.8.1), 1 met = 58.15 W m^-2.
[[nodiscard]] double metabolic_rate_w_m2(Activity activity) noexcept;

/// Speed of the air past a person [m/s]: 0.3 m/s more for each met above 1 (as in pythermalcomfort 4.8.1, v_relative).
[[nodiscard]] double relative_wind_m_s(double wind_m_s, double metabolic_w_m2) noexcept;

/// Thermal resistance from a body's core to its skin. Vessels narrow in the cold: the resistance is linear in the air's
/// temperature from `cold` at 283 K to `warm` at 303 K, and constant beyond. Walking acts as air that is 10 K warmer
/// (estimate, from hands in the JOS-3 model, pythermalcomfort 4.8.1). It depends on the air and not on the skin, so
/// that a balance has one solution.
struct Tissue {
  double core_k = 310;        ///< 270 to 320
  double warm_m2_k_w = 0.04;  ///< 0 to 10
  double cold_m2_k_w = 0.09;  ///< at least warm_m2_k_w, to 10

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] double resistance_m2_k_w(double air_k, Activity activity) const noexcept;

  [[nodiscard]] bool operator==(const Tissue&) const = default;
};

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

/// Bare skin, or a hide or fur above it, of a warm-blooded body.
struct Coat {
  Tissue tissue = {};
  double coat_m2_k_w = 0;      ///< from the skin to the surface that is seen, 0 (bare) to 10
  double wet_when_bathed = 0;  ///< share of what a wet surface evaporates just after a bath, 0 to 1
  double drying_s = 1800;      ///< in which that share falls to 1/e, above 0 to 1e6
  BodySurface surface = {.albedo = 0.3, .emissivity = 0.98, .open_view = 0.9, .diameter_m = 0.5};

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const Coat&) const = default;
};

/// Evaporation as a share of a wet surface's: from the skin itself, and what is left of the bath.
/// @param since_bath_s  at least 0; infinite: never
[[nodiscard]] double wet_share(const Coat& coat, double since_bath_s) noexcept;

/// Additional insulation by the tissue of an animal at rest, against one that forages [m^2 K/W]: 0.1 in air up to 283
/// K, falling linearly to 0 at 293 K. An estimate: an elephant then gives off 1.7 times its basal rate in air of 273 K,
/// not 2.7; adult cattle have 0.12 to 0.25 in all (Nutrient Requirements of Beef Cattle, NRC 1996).
[[nodiscard]] double resting_tissue_m2_k_w(double air_k) noexcept;

/// Surface of a coat or of bare skin [K]. A person's air moves past it as past clothes; an animal that walks is cooled by
/// the wind alone, and one that stands is at rest.
[[nodiscard]] double coat_surface_k(const Coat& coat, Activity activity, double since_bath_s,
                                    const Forcing& forcing, const Incoming& incoming) noexcept;

/// A cold-blooded body, warmed by the water or ground that it rested in.
struct ColdBlooded {
  double above_k = 1;          ///< core above the water or ground that it came from, -20 to 20
  double tissue_m2_k_w = 0.1;  ///< from the core to the surface, above 0 to 10
  BodySurface surface = {.albedo = 0.2, .emissivity = 0.96, .open_view = 0.9, .diameter_m = 0.5};

  /// ConfigError with `where` if a value is outside its domain.
  void validate(const std::string& where) const;

  [[nodiscard]] bool operator==(const ColdBlooded&) const = default;
};

/// @param refuge_k  temperature of the water or ground
[[nodiscard]] double cold_blooded_surface_k(const ColdBlooded& body, double refuge_k, const Forcing& forcing,
                                            const Incoming& incoming) noexcept;

}  // namespace thermal
