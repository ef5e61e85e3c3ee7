#pragma once

#include <vector>

namespace thermal {

/// Emissivity of a surface against wavelength: straight lines between samples.
class EmissivitySpectrum {
 public:
  /// Emissivity at one wavelength.
  struct Sample {
    double wavelength_um;
    double emissivity;
  };

  /// The same at all wavelengths. ConfigError unless in [0, 1].
  explicit EmissivitySpectrum(double emissivity);
  /// At least two samples, wavelengths positive and strictly rising, emissivities in [0, 1]; else ConfigError.
  explicit EmissivitySpectrum(std::vector<Sample> samples);

  /// Emissivity at a wavelength. A spectrum of samples must cover it; beyond its ends it is held constant.
  [[nodiscard]] double at(double wavelength_um) const noexcept;

  /// Whether [begin_um, end_um] lies within the samples.
  [[nodiscard]] bool covers(double begin_um, double end_um) const noexcept;

  /// Wavelengths at which the spectrum bends; none for a constant.
  [[nodiscard]] std::vector<double> knots_um() const;

 private:
  std::vector<Sample> samples_;  ///< one for a constant
};

/// How a surface's emissivity falls off with the angle it is seen at.
enum class AngularLaw {
  none,   ///< vegetation, animals: rough at every scale, nearly no fall-off
  water,  ///< smooth dielectric: Fresnel
  soil    ///< 1 to 3 % by 60 deg
};

/// Emissivity at an angle over emissivity at the normal, in [0, 1].
/// water: Fresnel for unpolarised light, averaged over 8-14 um with the complex indices of Hale and Querry
/// (Appl. Opt. 12, 555, 1973); .93 at 65 deg. soil: 1 - 0.02 (1 - cos)^2 / 0.25, an estimate within
/// the 1 to 3 % that Sobrino and Cuenca (Appl. Opt. 38, 3931, 1999) measured at 60 deg.
/// @param cosine  of the angle between normal and line of sight; clamped to [0, 1]; NaN counts as 1
[[nodiscard]] double angular_factor(AngularLaw law, double cosine) noexcept;

}  // namespace thermal
