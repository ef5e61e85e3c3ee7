#pragma once

#include <span>
#include <vector>

namespace thermal {

/// Relative response of a camera against wavelength: straight lines between samples, zero outside them.
class SpectralResponse {
 public:
  /// Relative response at one wavelength.
  struct Sample {
    double wavelength_um;
    double response;

    [[nodiscard]] bool operator==(const Sample&) const = default;
  };

  /// Response 1 from begin_um to end_um. Requires 0 < begin_um < end_um, both finite.
  [[nodiscard]] static SpectralResponse flat(double begin_um, double end_um);

  /// At least two samples, wavelengths positive and strictly rising, responses finite, none negative, not all
  /// zero; ConfigError otherwise. Scaled so that the largest response is 1.
  explicit SpectralResponse(std::vector<Sample> samples);

  /// Response at a wavelength [um]; 0 outside the samples.
  [[nodiscard]] double at(double wavelength_um) const noexcept;

  [[nodiscard]] std::span<const Sample> samples() const noexcept { return samples_; }
  [[nodiscard]] double begin_um() const noexcept { return samples_.front().wavelength_um; }
  [[nodiscard]] double end_um() const noexcept { return samples_.back().wavelength_um; }

  [[nodiscard]] bool operator==(const SpectralResponse&) const = default;

 private:
  std::vector<Sample> samples_;
};

}  // namespace thermal
