#include "heat/surface/conduction.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstdint>
#include <numbers>
#include <vector>

#include "support/catch.h"

namespace conduction_test {

using namespace thermal;
using Complex = std::complex<double>;

namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDayS = 86400;
constexpr double kOmega = 2 * kPi / kDayS;
constexpr Complex kI = {0, 1};

GroundProperties ground(double thickness_m, double conductivity = 0.3, double capacity = 1.28e6) {
  GroundProperties properties;
  properties.conductivity_w_m_k = conductivity;
  properties.heat_capacity_j_m3_k = capacity;
  properties.thickness_m = thickness_m;
  return properties;
}

double diffusivity(const GroundProperties& properties) {
  return properties.conductivity_w_m_k / properties.heat_capacity_j_m3_k;
}

/// Thermal inertia, sqrt(k rho c).
double inertia(const GroundProperties& properties) {
  return std::sqrt(properties.conductivity_w_m_k * properties.heat_capacity_j_m3_k);
}

/// Depth at which a wave of a day is 1/e of that at the surface.
double damping_m(const GroundProperties& properties) {
  return std::sqrt(2 * diffusivity(properties) / kOmega);
}

/// One step in which a flux goes in. Returns the surface's temperature.
double step_with_flux(Conduction& body, double flux_w_m2) {
  const HeatUptake uptake = body.prepare();
  const double surface_k = (flux_w_m2 + uptake.offset_w_m2) / uptake.slope_w_m2_k;
  body.finish(surface_k);
  return surface_k;
}

double step_with_surface(Conduction& body, double surface_k) {
  static_cast<void>(body.prepare());
  return body.finish(surface_k);
}

/// Complex amplitudes, exp(i omega t), of a body under a flux of 100 W m^-2 of a day, after the start has died away.
struct Wave {
  Complex surface_k;
  std::vector<Complex> layers_k;
};
constexpr double kFluxWM2 = 100;

Wave periodic(const GroundProperties& properties, const Layers& layers, int per_day, int days) {
  Conduction body(properties, layers, kDayS / per_day, 300);
  Wave wave;
  wave.layers_k.assign(body.layers_k().size(), 0);
  for (int step = 1; step <= days * per_day; ++step) {
    const double angle = 2 * kPi * (step % per_day) / per_day;
    const double surface_k = step_with_flux(body, kFluxWM2 * std::cos(angle));
    if (step <= (days - 1) * per_day) continue;
    const Complex turned = std::polar(2.0 / per_day, -angle);
    wave.surface_k += turned * (surface_k - 300);
    for (std::size_t i = 0; i < wave.layers_k.size(); ++i)
      wave.layers_k[i] += turned * (body.layers_k()[i] - 300);
  }
  return wave;
}

/// Even layers: they need a ratio of 1 and a thickness of whole layers.
Layers even(double layer_m) { return {.first_m = layer_m, .ratio = 1}; }

/// Each layer of `layers` cut in two that continue the progression.
Layers halved(const Layers& layers) {
  const double ratio = std::sqrt(layers.ratio);
  return {.first_m = layers.first_m / (1 + ratio), .ratio = ratio};
}

/// Eight damping depths, in even layers of a twentieth of one: what comes back from below is exp(-16) = 1e-7, and the
/// start has decayed by exp(-19) after 40 days (the slowest mode of a flux that is given takes L^2 / (pi^2 kappa) = 2
/// days).
struct HalfSpace {
  GroundProperties properties;
  double layer_m = 0;
};
HalfSpace half_space() {
  const double depth_m = damping_m(ground(1));
  return {.properties = ground(8 * depth_m), .layer_m = depth_m / 20};
}

}  // namespace

TEST_CASE(
    "Under a flux of a day, a deep body has the analytic amplitude G / (P sqrt(omega)) and lags by 45 deg") {
  const HalfSpace deep = half_space();
  const double expected_k = kFluxWM2 / (inertia(deep.properties) * std::sqrt(kOmega));
  for (const int per_day : {96, 288, 2880}) {
    CAPTURE(per_day);
    const Wave wave = periodic(deep.properties, even(deep.layer_m), per_day, 40);
    // Backward Euler replaces i omega by s = (1 - exp(-i x)) / step with x = omega * step; even layers of a share y
    // of the damping depth multiply the temperature by sqrt(1 + layer^2 s / (4 kappa)), which is about sqrt(1 + i y^2
    // / 2). So the amplitude changes by x^2 / 48 and y^4 / 16, with y / 2 times x / 2 of the one in the other, and
    // the lag falls short by x / 4 + y^2 / 4.
    const double x = 2 * kPi / per_day;
    const double y = 1.0 / 20;
    const double second =
        x * x / 24 + y * y * y * y / 8 + x * y * y / 8 + 1e-6;  // 1e-6: from below, and the start
    CHECK_THAT(std::abs(wave.surface_k) / expected_k, WithinAbs(1, second));
    CHECK_THAT(-std::arg(wave.surface_k), WithinAbs(kPi / 4 - x / 4 - y * y / 4, second));
  }
}

TEST_CASE("It is the exact solution of the layers and steps, to rounding") {
  const HalfSpace deep = half_space();
  const double kappa = diffusivity(deep.properties);
  const double layer_m = deep.layer_m;
  for (const int per_day : {24, 288}) {
    CAPTURE(per_day);
    const Wave wave = periodic(deep.properties, even(layer_m), per_day, 60);
    const Complex s = (1.0 - std::exp(-kI * (2 * kPi / per_day))) * (per_day / kDayS);
    const Complex surface_k = kFluxWM2 / (inertia(deep.properties) * std::sqrt(s)) *
                              std::sqrt(1.0 + layer_m * layer_m * s / (4 * kappa));
    // What returns from the bottom: 2 exp(-16).
    CHECK(std::abs(wave.surface_k / surface_k - 1.0) < 4e-7);
    // In the middle of layer i the wave is exp(-q z), with 2 sinh(q layer / 2) = layer sqrt(s / kappa).
    const Complex q = 2.0 / layer_m * std::asinh(layer_m / 2 * std::sqrt(s / kappa));
    for (const int i : {0, 10, 40, 80}) {
      const double depth_m = (i + 0.5) * layer_m;
      const Complex there_k = kFluxWM2 / (inertia(deep.properties) * std::sqrt(s)) * std::exp(-q * depth_m);
      // The reflection at depth z is exp(-2 (8 - z / depth)) of the wave there.
      const double reflected = 2 * std::exp(-16 + 2 * depth_m * q.real());
      CHECK(std::abs(wave.layers_k[static_cast<std::size_t>(i)] / there_k - 1.0) < 4e-7 + 2 * reflected);
    }
  }
}

namespace {

/// What of a wave comes back from a body of even layers: steady waves in layers of one temperature are those of a line
/// of resistances and capacities, whose impedance and propagation are known exactly.
struct Line {
  Complex impedance_k_m2_w;  ///< of a deep body
  Complex propagation;       ///< over the whole body

  Line(const GroundProperties& properties, double layer_m, int layers, Complex s)
      : impedance_k_m2_w(std::sqrt(1.0 + layer_m * layer_m * s / (4 * diffusivity(properties))) /
                         (inertia(properties) * std::sqrt(s))),
        propagation(2.0 * layers * std::asinh(layer_m / 2 * std::sqrt(s / diffusivity(properties)))) {}

  [[nodiscard]] Complex closed() const { return impedance_k_m2_w / std::tanh(propagation); }
  [[nodiscard]] Complex above(Complex below) const {
    const Complex turn = std::tanh(propagation);
    return impedance_k_m2_w * (below + impedance_k_m2_w * turn) / (impedance_k_m2_w + below * turn);
  }
};

}  // namespace

TEST_CASE("Ground of two layers has their analytic impedance, for a thin or thick top, on rock or on peat") {
  // (k, rho c) of the subsoil; the top is dry sand.
  const std::array<std::array<double, 2>, 3> subsoils = {{{2.6, 2.1e6}, {0.06, 0.6e6}, {0.3, 1.28e6}}};
  const double layer_m = damping_m(ground(1)) / 20;
  for (const auto& below : subsoils) {
    for (const int top_layers : {1, 5, 20, 60}) {
      const int layers = top_layers + 40;
      CAPTURE(below[0], top_layers);
      GroundProperties properties = ground(layers * layer_m);
      properties.subsoil = Subsoil{top_layers * layer_m, below[0], below[1]};
      const Wave wave = periodic(properties, even(layer_m), 288, 200);
      const auto surface_k = [&](Complex s, double split) {
        const GroundProperties lower = ground(1, below[0], below[1]);
        const auto times = [split](int count) { return static_cast<int>(count * split); };
        const Line bottom(lower, layer_m / split, times(40), s);
        return kFluxWM2 * Line(ground(1), layer_m / split, times(top_layers), s).above(bottom.closed());
      };
      const Complex s = (1.0 - std::exp(-kI * (2 * kPi / 288))) * (288 / kDayS);
      // The start has died away: the slowest mode of the peat takes 1.6 days.
      CHECK(std::abs(wave.surface_k / surface_k(s, 1) - 1.0) < 1e-9);
      // Layers a thousandth as thick, and no steps: the layers' and the steps' own errors are left, y^2 / 4 and x / 4
      // for a half space with y a layer's share of the damping depth, at most twice that where waves of both meet.
      const double least_damping_m = std::min(damping_m(ground(1)), damping_m(ground(1, below[0], below[1])));
      const double y = layer_m / least_damping_m;
      CHECK(std::abs(wave.surface_k / surface_k(kI * kOmega, 1000) - 1.0) <
            2 * (y * y / 4 + 2 * kPi / 288 / 4));
    }
  }
}

TEST_CASE("One layer ends where the subsoil begins") {
  GroundProperties properties = ground(1.4);
  properties.subsoil = Subsoil{.depth_m = 0.101};
  double depth_m = 0;
  bool found = false;
  const std::vector<double> layers_m = Layers{}.thicknesses_m(properties);
  for (std::size_t i = 0; i < layers_m.size(); ++i) {
    depth_m += layers_m[i];
    found = found || std::abs(depth_m - 0.101) < 1e-12;
    if (i > 0) CHECK(layers_m[i] < 1.81 * layers_m[i - 1]);  // a rest of half a layer joined the one above
  }
  CHECK(found);
  CHECK_THAT(depth_m, WithinAbs(1.4, 1e-12));
}

TEST_CASE("A wave of a day is 1/e at the damping depth, and a radian late") {
  const HalfSpace deep = half_space();
  const int per_day = 2880;
  const Wave wave = periodic(deep.properties, even(deep.layer_m), per_day, 40);
  const double x = 2 * kPi / per_day;
  const double y = 1.0 / 20;
  for (const int layers : {20, 40, 60}) {  // one to three damping depths apart
    CAPTURE(layers);
    const double depths = layers * y;
    const Complex ratio = wave.layers_k[static_cast<std::size_t>(layers)] / wave.layers_k[0];
    // The wave number is off by x / 4 from the steps and y^2 / 12 from the layers, of sqrt(2) per damping depth; the
    // reflection of the bottom is exp(-2 (8 - z)).
    const double tolerance =
        depths * std::numbers::sqrt2 * (x / 4 + y * y / 12) * 1.01 + 3 * std::exp(-2 * (8 - depths - y));
    CHECK_THAT(std::log(std::abs(ratio)), WithinAbs(-depths, tolerance));
    CHECK_THAT(std::arg(ratio * std::polar(1.0, depths)), WithinAbs(0, tolerance));
  }
}

TEST_CASE("After a step of the surface's temperature the flux is k dT / sqrt(pi kappa t)") {
  const GroundProperties properties = ground(1);
  const double layer_m = 0.002;
  const double step_s = 30;
  Conduction body(properties, even(layer_m), step_s, 290);
  const double kappa = diffusivity(properties);
  for (int step = 1; step <= 600; ++step) {  // 5 h: sqrt(4 kappa t) is 0.13 m
    const double flux_w_m2 = step_with_surface(body, 300);
    if (step < 20) continue;
    CAPTURE(step);
    const double t_s = step * step_s;
    const double exact_w_m2 = properties.conductivity_w_m_k * 10 / std::sqrt(kPi * kappa * t_s);
    // Steps: the coefficient gamma(m - 1/2) / gamma(m) sqrt(m) is 1 + 3 / (8 m) + 25 / (128 m^2) + ... Layers: the
    // next term of 1 / sqrt(1 + layer^2 s / (4 kappa)) is layer^2 / (16 kappa t). The terms after both are of second
    // order.
    const double from_steps = 3.0 / (8 * step);
    const double from_layers = layer_m * layer_m / (16 * kappa * t_s);
    const double next = 1.0 / (step * step) + 4 * from_layers * (from_layers + 1.0 / step);
    CHECK_THAT(flux_w_m2 / exact_w_m2, WithinAbs(1 + from_steps + from_layers, next));
  }
}

TEST_CASE("A body whose surface stays at a temperature comes to it everywhere and takes up no more heat") {
  Conduction body(ground(0.2), Layers{}, 3600, 270);
  double flux_w_m2 = 0;
  // The slowest mode takes 4 L^2 / (pi^2 kappa) = 0.80 days, so 40 days leave 30 K * exp(-50) = 6e-21 K.
  for (int step = 0; step < 40 * 24; ++step) flux_w_m2 = step_with_surface(body, 300);
  for (const double layer_k : body.layers_k()) CHECK_THAT(layer_k, WithinAbs(300, 1e-11));
  CHECK_THAT(flux_w_m2, WithinAbs(0, 1e-9));  // 150 W m^-2 K^-1 times rounding
}

TEST_CASE(
    "Under an even flux a plate warms everywhere at G / (rho c L), its surface ahead of the mean by G L / (3 "
    "k)") {
  for (const int layers : {1, 2, 5, 40}) {
    CAPTURE(layers);
    const double thickness_m = 0.2;
    const double layer_m = thickness_m / layers;
    const GroundProperties properties = ground(thickness_m);
    Conduction body(properties, even(layer_m), 600, 280);
    double before_k = 0;
    double surface_k = 0;
    for (int step = 0; step < 20 * 144; ++step) {
      before_k = surface_k;
      surface_k = step_with_flux(body, kFluxWM2);
    }
    REQUIRE(body.layers_k().size() == static_cast<std::size_t>(layers));
    double mean_k = 0;
    for (const double layer_k : body.layers_k()) mean_k += layer_k / layers;
    const double per_step_k = kFluxWM2 * 600 / (properties.heat_capacity_j_m3_k * thickness_m);
    // The surface reaches 1000 K and more; a step's error is some roundings of that.
    CHECK_THAT(surface_k - before_k, WithinRel(per_step_k, 1e-9));
    CHECK_THAT(mean_k, WithinAbs(280 + 20 * 144 * per_step_k, 1e-7));
    // Layers store their heat in their middle: half of the square of a layer's share more.
    const double ahead_k = kFluxWM2 * thickness_m / (3 * properties.conductivity_w_m_k);
    CHECK_THAT(surface_k - mean_k, WithinRel(ahead_k * (1 + 0.5 / (layers * layers)), 1e-9));
  }
}

TEST_CASE("The heat that goes in is the heat that layers store, to rounding") {
  for (const Layers& layers : {Layers{}, Layers{.first_m = 0.001, .ratio = 2}, even(0.05), even(1)}) {
    for (const double step_s : {1.0, 300.0, 3600.0}) {
      CAPTURE(layers.first_m, layers.ratio, step_s);
      const GroundProperties properties = ground(1.4);
      const std::vector<double> thick_m = layers.thicknesses_m(properties);
      Conduction body(properties, layers, step_s, 285);
      const auto stored_j_m2 = [&] {
        double sum = 0;
        for (std::size_t i = 0; i < thick_m.size(); ++i)
          sum += properties.heat_capacity_j_m3_k * thick_m[i] * (body.layers_k()[i] - 285);
        return sum;
      };
      double in_j_m2 = 0;
      double turned_j_m2 = 0;
      std::uint32_t random = 7;
      for (int step = 0; step < 1000; ++step) {
        random = random * 1664525U + 1013904223U;
        const double heat = step_s * step_with_surface(body, 270 + 40.0 * random / 4294967296.0);
        in_j_m2 += heat;
        turned_j_m2 += std::abs(heat);
      }
      // Each step rounds every layer's 300 K (5.7e-14 K) a few times, and the flux through the surface's conductance.
      const double conductance = 2 * properties.conductivity_w_m_k / thick_m.front();
      const double rounding_k = 4 * 5.7e-14;
      const double tolerance =
          1000 * rounding_k * (1.28e6 * properties.thickness_m + conductance * step_s) + 1e-13 * turned_j_m2;
      CHECK_THAT(in_j_m2, WithinAbs(stored_j_m2(), tolerance));
      CHECK(turned_j_m2 > 1e6 * tolerance);
    }
  }
}

TEST_CASE("Errors fall with the step, to first order") {
  const HalfSpace deep = half_space();
  Complex at[4];
  for (int k = 0; k < 4; ++k) at[k] = periodic(deep.properties, even(deep.layer_m), 96 << k, 40).surface_k;
  // The error is c x + d x^2 with d / c below 1, so the ratio of differences is 2 within 2 * 1.5 x.
  for (int k = 0; k < 2; ++k) {
    const double ratio = std::abs(at[k] - at[k + 1]) / std::abs(at[k + 1] - at[k + 2]);
    CHECK_THAT(ratio, WithinAbs(2, 3 * 2 * kPi / (96 << k)));
  }
}

TEST_CASE("Errors fall with the layers, to second order") {
  const GroundProperties properties = half_space().properties;
  const double depth_m = damping_m(properties);
  for (const Layers& start :
       {even(depth_m / 4), Layers{.first_m = 0.016, .ratio = 1.35}, Layers{.first_m = 0.01, .ratio = 2}}) {
    CAPTURE(start.first_m, start.ratio);
    Layers layers = start;
    Complex at[4];
    for (Complex& surface_k : at) {
      // A whole number of layers, so that the last is like the others.
      GroundProperties whole = properties;
      whole.thickness_m = 0;
      double next_m = start.first_m;
      for (; whole.thickness_m < properties.thickness_m; next_m *= start.ratio) whole.thickness_m += next_m;
      surface_k = periodic(whole, layers, 96, 40).surface_k;
      layers = halved(layers);
    }
    // The next term of an even mesh's error is of fourth order, (y / 4)^2 / 4 of the first for y = 1/4; growing
    // layers have one of third order, as much as the ratio differs from 1, in their largest layer that the wave
    // reaches (0.4).
    const double first = std::abs(at[0] - at[1]) / std::abs(at[1] - at[2]);
    const double second = std::abs(at[1] - at[2]) / std::abs(at[2] - at[3]);
    CAPTURE(first, second);
    CHECK_THAT(second, WithinAbs(4, start.ratio == 1 ? 0.05 : 0.4));
    CHECK_THAT(first, WithinAbs(4, start.ratio == 1 ? 0.1 : 0.8));
  }
}

TEST_CASE(
    "After a step of the surface, every layer follows without overshoot, for any layers, steps and bodies") {
  for (const double first_m : {0.001, 0.004, 0.05, 1.0}) {
    for (const double step_s : {1.0, 60.0, 3600.0}) {
      for (const double thickness_m : {0.001, 0.05, 1.4, 10.0}) {
        for (const double conductivity : {0.01, 0.3, 60.0, 100.0}) {
          for (const double capacity : {1e3, 1.28e6, 1e7}) {
            CAPTURE(first_m, step_s, thickness_m, conductivity, capacity);
            Conduction body(ground(thickness_m, conductivity, capacity), {.first_m = first_m}, step_s, 280);
            std::vector<double> before_k = body.layers_k();
            double before_w_m2 = 1e300;
            bool monotone = true;
            bool inside = true;
            bool deeper = true;
            bool falling = true;
            // Four roundings of temperatures near 300 K (5.7e-14 K) in each of 50 steps, and of the flux through the
            // first half layer.
            const double slack_k = 50 * 4 * 5.7e-14;
            const double slack_w_m2 = slack_k * 2 * conductivity / std::min(first_m, thickness_m) * 2;
            for (int step = 0; step < 50; ++step) {
              const double flux_w_m2 = step_with_surface(body, 310);
              for (std::size_t i = 0; i < before_k.size(); ++i) {
                const double layer_k = body.layers_k()[i];
                monotone = monotone && layer_k >= before_k[i] - slack_k;
                inside = inside && layer_k >= 280 - slack_k && layer_k <= 310 + slack_k;
                deeper = deeper && (i == 0 || layer_k <= body.layers_k()[i - 1] + slack_k);
              }
              falling = falling && flux_w_m2 >= -slack_w_m2 && flux_w_m2 <= before_w_m2 + slack_w_m2;
              before_k = body.layers_k();
              before_w_m2 = flux_w_m2;
            }
            CHECK(monotone);
            CHECK(inside);
            CHECK(deeper);
            CHECK(falling);
          }
        }
      }
    }
  }
}

TEST_CASE("No layer leaves the range of the surface's temperatures and its own start") {
  std::uint32_t random = 3;
  for (const double first_m : {0.001, 0.1, 1.0}) {
    for (const double step_s : {1.0, 300.0, 3600.0}) {
      CAPTURE(first_m, step_s);
      Conduction body(ground(1.4), {.first_m = first_m}, step_s, 290);
      double lowest_k = 290;
      double highest_k = 290;
      constexpr double kSlackK = 500 * 4 * 5.7e-14;  // four roundings a step
      for (int step = 0; step < 500; ++step) {
        random = random * 1664525U + 1013904223U;
        const double surface_k = 200 + 150.0 * random / 4294967296.0;
        lowest_k = std::min(lowest_k, surface_k);
        highest_k = std::max(highest_k, surface_k);
        step_with_surface(body, surface_k);
        for (const double layer_k : body.layers_k()) {
          REQUIRE(layer_k >= lowest_k - kSlackK);
          REQUIRE(layer_k <= highest_k + kSlackK);
        }
      }
    }
  }
}

TEST_CASE(
    "Layers fill the thickness, each as much thicker as the ratio says, and the last at least half of the "
    "one above") {
  for (const double thickness_m : {0.001, 0.004, 0.0059, 0.0061, 0.03, 1.4, 10.0}) {
    for (const Layers& layers : {Layers{}, even(0.01), even(1), Layers{.first_m = 1e-4, .ratio = 3}}) {
      CAPTURE(thickness_m, layers.first_m, layers.ratio);
      const std::vector<double> thick_m = layers.thicknesses_m(ground(thickness_m));
      double sum_m = 0;
      for (std::size_t i = 0; i < thick_m.size(); ++i) {
        sum_m += thick_m[i];
        const double regular_m = layers.first_m * std::pow(layers.ratio, static_cast<double>(i));
        if (i + 1 < thick_m.size()) {
          CHECK_THAT(thick_m[i], WithinRel(regular_m, 1e-13));
        } else if (i > 0) {
          CHECK(thick_m[i] >= thick_m[i - 1] * (0.5 - 1e-9));
          CHECK(thick_m[i] <= regular_m * (1.5 + 1e-9));
        }
      }
      CHECK_THAT(sum_m, WithinRel(thickness_m, 1e-13));
    }
  }
}

}  // namespace conduction_test
