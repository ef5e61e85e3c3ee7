#pragma once

#include <cmath>
#include <vector>

#include "radiometry/emissivity.h"
#include "radiometry/spectral_response.h"

namespace thermal {

/// Sum of many doubles that keeps what each addition rounds off (Neumaier, ZAMM 54, 39, 1974).
/// Relative error <= 2 u + n^2 u^2 for n terms of one sign, u = 2^-53: 2.2e-16 up to n = 1e7. NaN stays NaN.
class CompensatedSum {
 public:
  void add(double term) noexcept {
    const double sum = sum_ + term;
    const bool term_is_smaller = std::abs(sum_) >= std::abs(term);
    lost_ += term_is_smaller ? (sum_ - sum) + term : (term - sum) + sum_;
    sum_ = sum;
  }

  [[nodiscard]] double value() const noexcept { return sum_ + lost_; }

 private:
  double sum_ = 0;
  double lost_ = 0;
};

/// In-band radiance of a blackbody at one temperature.
struct BandValue {
  double radiance_w_m2_sr = 0;
  double derivative_w_m2_sr_k = 0;  ///< with respect to temperature
  double ln_radiance = 0;           ///< accurate even where the radiance underflows
};

/// In-band radiance of a blackbody, the integral of response * Planck over wavelength: the reference every
/// faster way is measured against.
///
/// Works in x = c2 / (wavelength T), where the integrand is x^3 / (e^x - 1) times the response: Gauss-Legendre, 12 points a panel, panels of at most 4 in x and within one segment of the response.
/// e^-x at the band's long-wave end is taken out as a factor, so nothing underflows before the end and the
/// logarithm is always right. Measured against 60-digit values: see thermal_core/ACCURACY.md.
class BandRadiance {
 public:
  explicit BandRadiance(const SpectralResponse& response);

  /// The same for a surface that is no blackbody: the integral of emissivity * response * Planck.
  /// ConfigError if the spectrum does not cover the band.
  BandRadiance(const SpectralResponse& response, const EmissivitySpectrum& emissivity);

  /// Value, derivative and logarithm at a temperature [K].
  /// <= 0 K: radiance and derivative 0, logarithm -infinity. NaN: all NaN. Infinity: radiance and logarithm
  /// infinity, derivative the Rayleigh-Jeans limit.
  [[nodiscard]] BandValue evaluate(double temperature_k) const noexcept;

  /// Bound of the relative error of evaluate()'s radiance against the true one of the inputs as they were written:
  /// temperature, wavelengths and responses may each be a decimal that was rounded to the nearest double.
  /// <= 0 K and a surface that emits nothing: 0. NaN: NaN. 1 where no double holds the radiance. More than 1 where
  /// the rounding of the wavelengths is larger than the band is wide. Derived in band_radiance.cpp.
  /// Costs about three evaluations.
  [[nodiscard]] double relative_error_bound(double temperature_k) const noexcept;

  /// Radiance alone [W m^-2 sr^-1].
  [[nodiscard]] double radiance(double temperature_k) const noexcept {
    return evaluate(temperature_k).radiance_w_m2_sr;
  }

  /// Temperature [K] of the blackbody with this in-band radiance. <= 0 returns 0; NaN returns NaN; infinity
  /// returns infinity. |result - true| <= 1e-9 of the temperature, 1 K to 1e6 K.
  [[nodiscard]] double temperature(double radiance_w_m2_sr) const noexcept;

  /// The same from the logarithm of the radiance, for radiances below the smallest double.
  [[nodiscard]] double temperature_from_ln(double ln_radiance) const noexcept;

 private:
  /// A quantity that is linear in wavelength across a segment: its values at the ends, interpolated with positive
  /// weights, so that nothing cancels where one value is zero.
  struct Line {
    double begin;
    double end;

    [[nodiscard]] double at(double begin_share, double end_share) const noexcept {
      return begin * begin_share + end * end_share;
    }
  };
  /// A piece of the band in which response and emissivity are linear in wavelength; bounds as wavenumbers [1/m].
  struct Segment {
    double begin_per_m;
    double width_per_m;
    Line response;
    Line emissivity;
  };
  /// Integrals over the band in x = c2 nu / T, with e^-x0 taken out, x0 at the band's long-wave end.
  struct ScaledIntegral {
    double nu_per_x = 0;        ///< T / c2 [1/m]
    double x0 = 0;              ///< x at the long-wave end
    CompensatedSum value;       ///< of nu^3 R e^(x0 - x) / (1 - e^-x) dx
    CompensatedSum x_weighted;  ///< of the same times x / (1 - e^-x), which makes T dL/dT of L

    [[nodiscard]] double ln_radiance() const noexcept;
    /// T L'/L: how much a relative change of T changes L.
    [[nodiscard]] double condition() const noexcept { return x_weighted.value() / value.value(); }
  };

  [[nodiscard]] ScaledIntegral scaled_at(double temperature_k) const noexcept;
  [[nodiscard]] ScaledIntegral integrate(double temperature_k) const noexcept;
  [[nodiscard]] double wavelength_condition(const ScaledIntegral& sum) const noexcept;
  [[nodiscard]] static double x_stop(const ScaledIntegral& sum) noexcept;
  static void add_segment(const Segment& segment, double x_stop, ScaledIntegral& sum) noexcept;

  std::vector<Segment> segments_;  ///< from the long-wave end up
};

}  // namespace thermal
