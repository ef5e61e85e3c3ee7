#pragma once

#include <string>

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

}  // namespace thermal
