#include "radiometry/band_radiance.h"

#include <algorithm>
#include <array>
#include <limits>

#include <fmt/core.h>

#include "base/error.h"
#include "radiometry/planck.h"

namespace thermal {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

struct GaussPoint {
  double node;
  double weight;
};

/// Gauss-Legendre on [-1, 1], 12 points. x^3 / (e^x - 1) has its nearest poles at +-2 pi i; on a panel of
/// width 4 that leaves an error of 6.6^-24 = 2e-20.
constexpr std::array<GaussPoint, 12> kGauss = {{{-0.981560634246719251, 0.047175336386511827},
                                                {-0.904117256370474857, 0.106939325995318431},
                                                {-0.769902674194304687, 0.160078328543346226},
                                                {-0.587317954286617447, 0.203167426723065922},
                                                {-0.367831498998180194, 0.233492536538354809},
                                                {-0.125233408511468916, 0.249147045813402785},
                                                {0.125233408511468916, 0.249147045813402785},
                                                {0.367831498998180194, 0.233492536538354809},
                                                {0.587317954286617447, 0.203167426723065922},
                                                {0.769902674194304687, 0.160078328543346226},
                                                {0.904117256370474857, 0.106939325995318431},
                                                {0.981560634246719251, 0.047175336386511827}}};
constexpr double kPanelWidth = 4.0;

/// This many e-folds behind the band's long-wave end, and behind the peak of x^3 / (e^x - 1) near 3, what is
/// left of the integral is below 1e-20 of it.
constexpr double kCutoff = 64.0;
constexpr double kPeak = 3.0;

/// Where response or emissivity bends, inside the response's band, by rising wavelength.
std::vector<double> joined_knots(const SpectralResponse& response, const EmissivitySpectrum& emissivity) {
  std::vector<double> knots;
  for (const auto& sample : response.samples()) knots.push_back(sample.wavelength_um);
  for (const double knot : emissivity.knots_um()) {
    if (knot > response.begin_um() && knot < response.end_um()) knots.push_back(knot);
  }
  std::sort(knots.begin(), knots.end());
  knots.erase(std::unique(knots.begin(), knots.end()), knots.end());
  return knots;
}

}  // namespace

double BandRadiance::ScaledIntegral::ln_radiance() const noexcept {
  return -x0 + std::log(kFirstRadiationConstant * nu_per_x) + std::log(value.value());
}

BandRadiance::BandRadiance(const SpectralResponse& response)
    : BandRadiance(response, EmissivitySpectrum(1)) {}

BandRadiance::BandRadiance(const SpectralResponse& response, const EmissivitySpectrum& emissivity) {
  if (!emissivity.covers(response.begin_um(), response.end_um())) {
    throw ConfigError(fmt::format("the emissivity spectrum does not cover the band; expected {} um to {} um",
                                  response.begin_um(), response.end_um()));
  }
  const std::vector<double> knots = joined_knots(response, emissivity);
  for (std::size_t i = knots.size() - 1; i > 0; --i) {
    const double begin_um = knots[i];  // the long-wave end: the lower wavenumber
    const double end_um = knots[i - 1];
    const Line weight = {response.at(begin_um), response.at(end_um)};
    const Line surface = {emissivity.at(begin_um), emissivity.at(end_um)};
    const auto is_zero = [](const Line& line) { return line.begin == 0 && line.end == 0; };
    if (is_zero(weight) || is_zero(surface)) continue;
    segments_.push_back({.begin_per_m = 1e6 / begin_um,
                         .width_per_m = 1e6 * (begin_um - end_um) / (begin_um * end_um),
                         .response = weight,
                         .emissivity = surface});
  }
}

void BandRadiance::add_segment(const Segment& segment, double x_stop, ScaledIntegral& sum) noexcept {
  const double x_begin = segment.begin_per_m / sum.nu_per_x;
  const double x_width = segment.width_per_m / sum.nu_per_x;
  const double used = std::min(x_width, x_stop - x_begin);
  const double panels = std::ceil(used / kPanelWidth);
  const double half = used / panels / 2;
  for (double panel = 0; panel < panels; ++panel) {
    const double middle = half * (2 * panel + 1);
    double value = 0;
    double x_weighted = 0;
    for (const auto& [node, weight] : kGauss) {
      const double from_begin = middle + half * node;
      const double x = x_begin + from_begin;
      const double nu = x * sum.nu_per_x;
      // Weights linear in wavelength, which is proportional to 1 / x, from one end of the segment to the other.
      const double begin_share = (x_width - from_begin) / x_width * (x_begin / x);
      const double end_share = from_begin / x_width * ((x_begin + x_width) / x);
      const double response =
          segment.response.at(begin_share, end_share) * segment.emissivity.at(begin_share, end_share);
      const double one_less_exp = -std::expm1(-x);
      const double weighted = half * weight * nu * nu * nu * response * std::exp(sum.x0 - x) / one_less_exp;
      value += weighted;
      x_weighted += weighted * x / one_less_exp;
    }
    sum.value.add(value);  // there may be millions of segments
    sum.x_weighted.add(x_weighted);
  }
}

BandRadiance::ScaledIntegral BandRadiance::scaled_at(double temperature_k) const noexcept {
  ScaledIntegral sum;
  sum.nu_per_x = temperature_k / kSecondRadiationConstant;
  if (!segments_.empty()) sum.x0 = segments_.front().begin_per_m / sum.nu_per_x;
  return sum;
}

double BandRadiance::x_stop(const ScaledIntegral& sum) noexcept { return std::max(sum.x0, kPeak) + kCutoff; }

BandRadiance::ScaledIntegral BandRadiance::integrate(double temperature_k) const noexcept {
  ScaledIntegral sum = scaled_at(temperature_k);
  if (std::isinf(sum.x0)) return sum;
  const double stop = x_stop(sum);
  for (const Segment& segment : segments_) {
    if (segment.begin_per_m / sum.nu_per_x >= stop) break;
    add_segment(segment, stop, sum);
  }
  return sum;  // of zeros for a surface that emits nothing in the band
}

BandValue BandRadiance::evaluate(double temperature_k) const noexcept {
  if (std::isnan(temperature_k)) return {temperature_k, temperature_k, temperature_k};
  if (temperature_k <= 0) return {0, 0, -kInfinity};
  if (std::isinf(temperature_k)) {
    constexpr double kRayleighJeansK = 1e30;  // x below 1e-20 in any band: the limit to the last bit
    return {kInfinity, evaluate(kRayleighJeansK).derivative_w_m2_sr_k, kInfinity};
  }
  const ScaledIntegral sum = integrate(temperature_k);
  if (std::isinf(sum.x0)) return {0, 0, -kInfinity};
  const double scale = kFirstRadiationConstant * sum.nu_per_x;
  const double half_exp = std::exp(-sum.x0 / 2);  // in two halves: no denormal factor in a normal result
  return {.radiance_w_m2_sr = half_exp * (scale * sum.value.value()) * half_exp,
          .derivative_w_m2_sr_k = half_exp * (scale * sum.x_weighted.value() / temperature_k) * half_exp,
          .ln_radiance = sum.ln_radiance()};
}

double BandRadiance::temperature(double radiance_w_m2_sr) const noexcept {
  if (std::isnan(radiance_w_m2_sr)) return radiance_w_m2_sr;
  if (radiance_w_m2_sr <= 0) return 0;
  const double from_ln_k = temperature_from_ln(std::log(radiance_w_m2_sr));
  const BandValue value = evaluate(from_ln_k);
  if (!std::isnormal(value.radiance_w_m2_sr) || !std::isnormal(value.derivative_w_m2_sr_k)) return from_ln_k;
  // A last step on the radiance itself: its logarithm, the sum of large terms, has lost some last digits.
  return from_ln_k + (radiance_w_m2_sr - value.radiance_w_m2_sr) / value.derivative_w_m2_sr_k;
}

double BandRadiance::temperature_from_ln(double ln_radiance) const noexcept {
  if (std::isnan(ln_radiance)) return ln_radiance;
  if (std::isinf(ln_radiance)) return ln_radiance > 0 ? kInfinity : 0;
  // Newton in b = 1/T. ln L falls with b and is convex, so steps from below never overshoot; a step from above
  // may pass 0, and then a tenth of b stays below the root's neighbourhood but positive.
  constexpr int kMostSteps = 200;
  constexpr double kRoundingOnly = 1e-13;
  double b = 1 / 280.0;
  double last_change = kInfinity;
  for (int step = 0; step < kMostSteps; ++step) {
    const ScaledIntegral sum = integrate(1 / b);
    const double slope = -sum.condition() / b;
    const double next = b - (sum.ln_radiance() - ln_radiance) / slope;
    const double guarded = next > b / 10 ? next : b / 10;
    const double change = std::abs(guarded - b) / b;
    const bool settled = change <= 4 * std::numeric_limits<double>::epsilon();
    // For hot bodies, rounding of the large logarithm exceeds that tolerance: stop when a step no longer helps.
    const bool only_rounding = change < kRoundingOnly && change >= last_change;
    b = guarded;
    last_change = change;
    if (settled || only_rounding) break;
  }
  return 1 / b;
}

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
