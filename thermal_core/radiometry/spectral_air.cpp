#include "radiometry/spectral_air.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "radiometry/planck.h"

namespace thermal {
namespace {

/// Absorption beside the continuum of water vapour at one wavelength.
struct Lines {
  double water;  ///< of water vapour [1e-6 m^-1 per g m^-3]
  double gases;  ///< of carbon dioxide, nitrous oxide, methane and ozone near the ground [1e-6 m^-1]
  double
      sky;  ///< of these at the zenith, as the depth of air of the ground's temperature: upper air is colder
};

constexpr double kTableBeginUm = 7;
constexpr double kTableStepUm = 0.1;

/// From 7 to 14.5 um. Fitted to LOWTRAN 7 (Kneizys et al., AFGL-TR-88-0177, 1988) by tests/data/air_spectrum.py:
/// level paths of 200 m for four states of the air and for its subarctic winter; the zenith of its six model
/// atmospheres. LOWTRAN's carbon dioxide is that of 1988, 330 ppm.
constexpr std::array<Lines, 76> kLines = {{
    // clang-format off
    {3.05e+03, 43.3, 0}, {2.32e+03, 33.5, 0}, {1.89e+03, 70.8, 0}, {1.42e+03, 180, 0}, {876, 309, 0},  // 7.0 um
    {638, 262, 0}, {492, 347, 0}, {246, 689, 0.44}, {222, 569, 0.34}, {225, 486, 0.22},  // 7.5 um
    {128, 282, 0.13}, {78.8, 148, 0.059}, {83.3, 78.2, 0}, {60.5, 44.1, 0}, {48.6, 38.6, 0},  // 8.0 um
    {46.6, 35.7, 0}, {33.8, 33, 0.0093}, {25.8, 31.6, 0.023}, {23.6, 19, 0.013}, {20.3, 9.44, 0.0068},  // 8.5 um
    {21, 6.23, 0}, {16.3, 11.8, 0.016}, {10.9, 24.8, 0.047}, {10.8, 36.3, 0.074}, {12.2, 54, 0.17},  // 9.0 um
    {9.69, 78.1, 0.28}, {7.65, 73.6, 0.28}, {8.2, 64.7, 0.27}, {8.72, 52.9, 0.24}, {8.36, 33, 0.16},  // 9.5 um
    {6.35, 17.7, 0.096}, {4.14, 13.8, 0.066}, {6.63, 19.4, 0.055}, {9.76, 24.1, 0.049}, {9.02, 22.6, 0.046},  // 10.0 um
    {7.91, 21.1, 0.048}, {6.05, 21, 0.054}, {5.47, 19.4, 0.053}, {7.27, 15.9, 0.045}, {9.82, 10.1, 0.035},  // 10.5 um
    {8.88, 6.21, 0.034}, {8.06, 4.76, 0.036}, {10.8, 3.53, 0.03}, {13.6, 2.72, 0.025}, {13.2, 2.43, 0.027},  // 11.0 um
    {12.3, 2.55, 0.03}, {14.8, 2.92, 0.027}, {19.8, 3.32, 0.019}, {18.7, 3.57, 0.023}, {16.1, 3.83, 0.03},  // 11.5 um
    {11.9, 9.06, 0.045}, {12.5, 14.3, 0.051}, {14.6, 22.3, 0.058}, {25.3, 33.2, 0.053}, {35.9, 46.4, 0.052},  // 12.0 um
    {47.1, 60.3, 0.051}, {48.1, 72.6, 0.066}, {43.6, 79, 0.083}, {38.8, 90.5, 0.11}, {32.7, 118, 0.15},  // 12.5 um
    {29.8, 177, 0.22}, {28.9, 272, 0.33}, {36.3, 414, 0.47}, {45.2, 597, 0.66}, {53.2, 809, 0.87},  // 13.0 um
    {53, 1.01e+03, 1.1}, {44, 1.2e+03, 1.3}, {40.4, 1.41e+03, 1.5}, {36.9, 1.69e+03, 1.7}, {44.4, 2.12e+03, 2},  // 13.5 um
    {60, 2.61e+03, 2.2}, {81.9, 3.34e+03, 2.2}, {110, 4.39e+03, 2.1}, {124, 5.81e+03, 2.1}, {127, 7.8e+03, 2.1},  // 14.0 um
    {115, 1.01e+04, 2.2},  // 14.5 um
    // clang-format on
}};

constexpr double kTableEndUm = kTableBeginUm + kTableStepUm * (kLines.size() - 1);

Lines lines_at(double wavelength_um) noexcept {
  const double last = static_cast<double>(kLines.size() - 1);
  const double place = std::clamp((wavelength_um - kTableBeginUm) / kTableStepUm, 0.0, last);
  const std::size_t node = std::min(static_cast<std::size_t>(place), kLines.size() - 2);
  const double share = place - static_cast<double>(node);
  const Lines& a = kLines.at(node);
  const Lines& b = kLines.at(node + 1);
  return {.water = a.water + share * (b.water - a.water),
          .gases = a.gases + share * (b.gases - a.gases),
          .sky = a.sky + share * (b.sky - a.sky)};
}

/// Absorption by water vapour [m^-1 per g m^-3]: its lines and its continuum. The latter from Roberts, Selby and
/// Biberman 1976, in g^-1 cm^2 atm^-1 for vapour of one atmosphere; air broadens .002 as much. Its rise towards cold
/// air and the .002 are quoted from memory of that paper: estimates here.
double water_per_g(double wavelength_um, const Air& air) noexcept {
  constexpr double kAtmosphereHpa = 1013.25;
  constexpr double kForeign = 0.002;
  constexpr double kPerG = 1e-4;  // g cm^-2 of a metre at 1 g m^-3
  const double wavenumber = 1e4 / std::clamp(wavelength_um, kTableBeginUm, kTableEndUm);
  const double at_296_k = 4.18 + 5578 * std::exp(-7.87e-3 * wavenumber);
  const double self = at_296_k * std::exp(1800 * (1 / air.temperature_k - 1.0 / 296));
  const double vapour = std::min(vapour_pressure_hpa(air), kAtmosphereHpa) / kAtmosphereHpa;
  return kPerG * self * (vapour + kForeign * (1 - vapour)) + 1e-6 * lines_at(wavelength_um).water;
}

/// Edges of cells: 0.05 um wide within the tables, 5 % wide outside of them, where nothing changes with wavelength.
std::vector<double> cell_edges(double begin_um, double end_um) {
  constexpr double kWidthUm = kTableStepUm / 2;
  std::vector<double> edges = {begin_um};
  const auto next = [](double edge_um) {
    if (edge_um < kTableBeginUm) return std::min(kTableBeginUm, 1.05 * edge_um);
    if (edge_um >= kTableEndUm) return 1.05 * edge_um;
    return kTableBeginUm + kWidthUm * (std::floor((edge_um - kTableBeginUm) / kWidthUm + 1e-6) + 1);
  };
  for (double edge_um = next(begin_um); edge_um < end_um; edge_um = next(edge_um)) edges.push_back(edge_um);
  edges.push_back(end_um);
  return edges;
}

/// Integral over a cell of the response times a law of radiance, and the wavelength about which it is balanced.
struct Weight {
  double sum = 0;
  double moment = 0;

  /// Adds a piece on which the response is a straight line; three Gauss points.
  template <typename Law>
  void add(double begin_um, double end_um, const SpectralResponse& response, const Law& law) noexcept {
    const double half = (end_um - begin_um) / 2;
    const double middle = begin_um + half;
    const double reach = std::sqrt(0.6) * half;
    for (const auto& [at_um, gauss] : {std::pair(middle - reach, 5.0 / 9), std::pair(middle, 8.0 / 9),
                                       std::pair(middle + reach, 5.0 / 9)}) {
      const double value = half * gauss * response.at(at_um) * law(at_um);
      sum += value;
      moment += value * at_um;
    }
  }
};

/// Planck's law differentiated by the logarithm of temperature.
double planck_contrast(double wavelength_um, double temperature_k) noexcept {
  const double x = 1e6 * kSecondRadiationConstant / (wavelength_um * temperature_k);
  return planck_radiance(wavelength_um, temperature_k) * x / -std::expm1(-x);
}

constexpr double kFarthestM = 1000;  // m
constexpr double kBeerEndM = 30;     // m; Beer's law below

double clamped_range(double range_m) noexcept {
  return range_m < kFarthestM ? std::max(range_m, 0.0) : kFarthestM;  // NaN: the longest
}

/// What clouds leave of the gap to a blackbody.
double cloud_gap(const Air& air) noexcept {
  constexpr double kCloudGain = 0.84;
  return 1 - kCloudGain * air.cloud_fraction;
}

}  // namespace

BandAir::Cells BandAir::cells_of(const SpectralResponse& response, double air_k, Weighting weighting) {
  const auto law = [air_k, weighting](double at_um) {
    return weighting == Weighting::radiance ? planck_radiance(at_um, air_k) : planck_contrast(at_um, air_k);
  };
  const std::vector<double> edges = cell_edges(response.begin_um(), response.end_um());
  std::vector<Weight> weights(edges.size() - 1);
  std::size_t cell = 0;
  double begin_um = response.begin_um();
  for (const auto& sample : response.samples()) {
    while (begin_um < sample.wavelength_um) {
      const double end_um = std::min(sample.wavelength_um, edges[cell + 1]);
      weights[cell].add(begin_um, end_um, response, law);
      begin_um = end_um;
      if (begin_um >= edges[cell + 1] && cell + 1 < weights.size()) ++cell;
    }
  }
  double total = 0;
  for (const Weight& weight : weights) total += weight.sum;
  Cells cells;
  for (const Weight& weight : weights) {
    if (weight.sum > 0) cells.push_back({.share = weight.sum / total, .at_um = weight.moment / weight.sum});
  }
  // A band so far in the ultraviolet that no double holds its radiance.
  if (cells.empty()) cells.push_back({.share = 1, .at_um = response.end_um()});
  return cells;
}

BandAir::Cells BandAir::path_cells(const SpectralResponse& response, const Air& air) {
  Cells cells = cells_of(response, air.temperature_k, Weighting::contrast);
  for (Cell& cell : cells) {
    cell.depth = path_water_g_m3(air) * water_per_g(cell.at_um, air) + 1e-6 * lines_at(cell.at_um).gases;
  }
  return cells;
}

double BandAir::transmitted(const Cells& cells, double factor) noexcept {
  double sum = 0;
  for (const Cell& cell : cells) sum += cell.share * std::exp(-factor * cell.depth);
  return sum;
}

/// The factor of all depths with which the cells transmit `goal`: Newton's method on the logarithm, which is convex,
/// so that no step from 0 is too long. 0 where they transmit less already.
double BandAir::factor_of(const Cells& cells, double goal) noexcept {
  constexpr double kLeast = 1e-9;  // no path and no sky is opaque altogether
  const double ln_goal = std::log(std::max(goal, kLeast));
  double factor = 0;
  for (int step = 0; step < 100; ++step) {
    double sum = 0;
    double weighted = 0;
    for (const Cell& cell : cells) {
      const double through = cell.share * std::exp(-factor * cell.depth);
      sum += through;
      weighted += through * cell.depth;
    }
    const double more = (std::log(sum) - ln_goal) * sum / weighted;
    if (!(more > 0)) break;
    factor += more;
    if (more < 1e-14 * factor) break;
  }
  return factor;
}

BandAir::BandAir(const Air& air, const SpectralResponse& response)
    : air_(air),
      sky_(cells_of(response, air.temperature_k, Weighting::radiance)),
      path_(path_cells(response, air)),
      published_path_(path_cells(SpectralResponse::flat(7.5, 14), air)) {
  Cells published = cells_of(SpectralResponse::flat(8, 14), air.temperature_k, Weighting::radiance);
  Cells water = published;  // scaled last: the other gases are fixed
  for (Cell& cell : water) {
    cell.share *= std::exp(-lines_at(cell.at_um).sky);
    cell.depth = water_per_g(cell.at_um, air);
  }
  const double factor = factor_of(water, 1 - clear_zenith_emissivity(air));
  for (Cells* cells : {&published, &sky_}) {
    for (Cell& cell : *cells) {
      cell.depth = factor * water_per_g(cell.at_um, air) + lines_at(cell.at_um).sky;
    }
  }
  hemisphere_ = factor_of(published, 1 - clear_sky_emissivity(air));
  near_transmittance_ = far_transmittance(kBeerEndM);
}

double BandAir::sky_emissivity() const noexcept {
  return 1 - transmitted(sky_, hemisphere_) * cloud_gap(air_);
}

double BandAir::sky_emissivity(double cosine) const noexcept {
  constexpr double kLowest = 0.05;
  const double secant = cosine > kLowest ? 1 / cosine : 1 / kLowest;
  return 1 - transmitted(sky_, secant) * std::pow(cloud_gap(air_), secant);
}

double BandAir::far_transmittance(double range_m) const noexcept {
  return transmitted(path_, factor_of(published_path_, thermal::path_transmittance(air_, range_m)));
}

double BandAir::path_transmittance(double range_m) const noexcept {
  const double range = clamped_range(range_m);
  if (range < kBeerEndM) return std::pow(near_transmittance_, range / kBeerEndM);
  return far_transmittance(range);
}

double BandAir::mean_path_absorption(double range_m) const noexcept {
  const double range = clamped_range(range_m);
  const double near = std::min(range, kBeerEndM);
  if (!(near > 0)) return 0;
  // Beer's law: the mean of 1 - exp(-x) from 0 to x is 1 + expm1(-x) / x; by its series where that cancels.
  const double depth = -std::log(near_transmittance_) * near / kBeerEndM;
  const double near_mean = depth < 1e-3 ? depth / 2 - depth * depth / 6 + depth * depth * depth / 24
                                        : 1 + std::expm1(-depth) / depth;
  // Simpson's rule in the root of the range, in which the fit is smooth.
  constexpr int kPanels = 64;
  const double first = std::sqrt(kBeerEndM);
  const double step = (std::sqrt(range) - first) / kPanels;
  double far_sum = 0;
  for (int node = 0; range > kBeerEndM && node <= kPanels; ++node) {
    const double root = first + node * step;
    const double weight = node == 0 || node == kPanels ? 1 : (node % 2 == 1 ? 4 : 2);
    far_sum += weight * 2 * root * (1 - far_transmittance(root * root));
  }
  return (near_mean * near + far_sum * step / 3) / range;
}

}  // namespace thermal
