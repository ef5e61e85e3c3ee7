#include <algorithm>
#include <cmath>
#include <limits>

#include "radiometry/band_radiance.h"

// Why relative_error_bound() holds, to first order in u = 2^-53, the most that one rounding changes a value by, relatively.
//
// With x = c2 nu / T, y = x / (1 - e^-x) and f(x) = x^3 / (e^x - 1) is d ln f / d ln x = 3 - y, and |3 - y| <= y + 1.
// kappa = T L'/L is the mean of y over the band, weighted with what each x gives to the radiance L.
//
//   T as written, c2, T / c2: three changes of T                                  3 kappa
//   nu as kept, 1 for a segment's begin and 4 for its width: of f, and of d nu    4 (kappa + 1) + 4
//   x at a point: 6 against its segment's nu                                      6 (kappa + 1)
//   x0 - x                                                                        1 kappa
//   the point's place in its segment, 4: changes response times emissivity, at
//     worst a ramp that f fills where it is next to nothing, by 4 times as much                         16
//   factors of a summand: half 2, weight 2, nu^3 6, products 3, exp 2, expm1 2                          17
//   response and emissivity between their samples: 5 a share, 2 a sum, 1 product                        15
//   samples as written, the peak as written, their quotient                                              3
//   a sample put in between where only the other curve bends: 3 roundings, <= 4 of the mean             12
//   twelve points of a panel added up, panels in a compensated sum                                      13
//   c1, three products with it, e^(-x0/2) twice at 2 and a product each                                 10
//                                                                                ----------------------------
//                                                                                14 kappa + 100
//
// exp and expm1 are taken to be right within one ulp = 2 u (glibc states less). Quadrature and cut-off, 1e-19, are below
// all that.
//
// Wavelengths as written: to move every lambda of L = integral of Q(lambda) B(lambda) d lambda (Q: response times
// emissivity, straight lines) by a part <= u of its own, each by another, changes L by no more than
//   u [integral of lambda |Q'| B d lambda + (lambda Q B at both ends)] = u V L,
// because the weights with which two knots move a point between them add up to 1. V is 2 lambda / width for a narrow flat
// band, 1 nm at 10 um: 20000, and grows with the number of samples where a response is rough.

namespace thermal {

double BandRadiance::wavelength_condition(const ScaledIntegral& sum) const noexcept {
  ScaledIntegral moved = sum;
  moved.value = {};
  const double stop = x_stop(sum);
  for (Segment segment : segments_) {
    if (segment.begin_per_m / sum.nu_per_x >= stop) break;
    const auto& [begin_per_m, width_per_m, response, emissivity] = segment;
    const double change =
        std::abs(response.end - response.begin) * std::max(emissivity.begin, emissivity.end) +
        std::abs(emissivity.end - emissivity.begin) * std::max(response.begin, response.end);
    // lambda / (width in lambda), at the segment's ends; straight in lambda like a response.
    segment.response = {change * ((begin_per_m + width_per_m) / width_per_m),
                        change * (begin_per_m / width_per_m)};
    segment.emissivity = {1, 1};
    add_segment(segment, stop, moved);
  }
  const auto at_end = [&sum](double nu_per_m, double value) {
    const double x = nu_per_m / sum.nu_per_x;
    return value * nu_per_m * nu_per_m * nu_per_m * x * (std::exp(sum.x0 - x) / -std::expm1(-x));
  };
  const Segment& first = segments_.front();
  const Segment& last = segments_.back();
  moved.value.add(at_end(first.begin_per_m, first.response.begin * first.emissivity.begin));
  moved.value.add(at_end(last.begin_per_m + last.width_per_m, last.response.end * last.emissivity.end));
  return moved.value.value() / sum.value.value();
}

double BandRadiance::relative_error_bound(double temperature_k) const noexcept {
  if (std::isnan(temperature_k)) return temperature_k;
  if (temperature_k <= 0 || segments_.empty()) return 0;
  const double radiance_w_m2_sr = radiance(temperature_k);
  if (radiance_w_m2_sr == 0 || std::isinf(radiance_w_m2_sr)) return 1;
  const ScaledIntegral sum = integrate(temperature_k);
  constexpr double kRounding = std::numeric_limits<double>::epsilon() / 2;
  const double rounding = (14 * sum.condition() + 100 + wavelength_condition(sum)) * kRounding;
  // Below the smallest normal double steps are all of one size.
  const bool is_normal = radiance_w_m2_sr >= std::numeric_limits<double>::min();
  return rounding + (is_normal ? 0 : std::numeric_limits<double>::denorm_min() / radiance_w_m2_sr);
}

}  // namespace thermal
