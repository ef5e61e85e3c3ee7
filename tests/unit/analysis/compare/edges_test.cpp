#include "analysis/compare/edges.h"

#include <cmath>
#include <numbers>

#include "support/catch.h"
#include "support/grey_frames.h"

namespace edge_profiles_test {

using namespace thermal;
using grey_frames::frame_of;

namespace {

/// A step from 60 to 160 across a line through the middle, blurred by a Gaussian.
Plane<float> blurred_step(double deviation_px, double angle_deg, double noise = 0) {
  const double angle = angle_deg / 180 * std::numbers::pi;
  Plane<float> frame = frame_of(160, 128, [&](int x, int y) {
    const double across = (x - 80.3) * std::cos(angle) + (y - 64.1) * std::sin(angle);
    return 110 + 50 * std::erf(across / deviation_px / std::numbers::sqrt2);
  });
  const std::vector<float> added = grey_frames::normal(frame.size(), 3);
  for (std::size_t k = 0; k < added.size(); ++k)
    frame.pixels()[k] =
        static_cast<float>(static_cast<double>(frame.pixels()[k]) + noise * static_cast<double>(added[k]));
  return frame;
}

/// Between the 10th and the 90th percentile of the normal distribution.
constexpr double kWidth = 2.5631031310892;

}  // namespace

TEST_CASE("The width of a blurred step is that of its Gaussian, at any angle") {
  // Log-odds of a Gaussian are straight within 2 %, and bins of half a pixel widen a blur of 1 px by 1 %.
  for (const double angle_deg : {0.0, 20.0, 45.0, 90.0, 130.0, 200.0}) {
    for (const double deviation_px : {1.0, 1.5, 2.0}) {
      const std::vector<Edge> edges = straight_edges(blurred_step(deviation_px, angle_deg));
      REQUIRE(edges.size() >= 3);
      for (const Edge& edge : edges) CHECK_THAT(edge.width_px, WithinRel(kWidth * deviation_px, 0.04));
    }
  }
}

TEST_CASE("A wide edge is understated, because its sides are not level yet") {
  for (const Edge& edge : straight_edges(blurred_step(3, 20)))
    CHECK_THAT(edge.width_px, WithinRel(kWidth * 3, 0.08));
  for (const Edge& edge : straight_edges(blurred_step(9, 20))) CHECK(edge.width_px < 0.7 * kWidth * 9);
}

TEST_CASE("Noise widens no edge by much") {
  const std::vector<Edge> edges = straight_edges(blurred_step(1.5, 20, 2));
  REQUIRE(edges.size() >= 3);
  for (const Edge& edge : edges) CHECK_THAT(edge.width_px, WithinRel(kWidth * 1.5, 0.15));
}

TEST_CASE("Halos of an unsharp mask are those of its closed form, and a plain step has none") {
  // A step of blur s becomes (1 + a) Phi(x / s) - a Phi(x / S), S^2 = s^2 + m^2 for a mask of m. It is lowest where
  // both densities, so weighted, are equal: x^2 (1 / s^2 - 1 / S^2) = 2 ln((1 + a) S / (a s)).
  constexpr double kBlur = 1.2;
  constexpr double kAmount = 0.8;
  const double wide = std::hypot(kBlur, 1.8);
  const double place = -std::sqrt(2 * std::log((1 + kAmount) * wide / (kAmount * kBlur)) /
                                  (1 / (kBlur * kBlur) - 1 / (wide * wide)));
  const auto phi = [](double x) { return 0.5 * std::erfc(-x / std::numbers::sqrt2); };
  const double halo = -((1 + kAmount) * phi(place / kBlur) - kAmount * phi(place / wide));
  CHECK_THAT(halo, WithinAbs(0.06596, 1e-5));
  const auto profile = [&](double across) {
    return (1 + kAmount) * phi(across / kBlur) - kAmount * phi(across / wide);
  };
  const auto edges_at = [&](double angle_deg) {
    const double angle = angle_deg / 180 * std::numbers::pi;
    return straight_edges(frame_of(160, 128, [&](int x, int y) {
      return 70 + 100 * profile((x - 80.3) * std::cos(angle) + (y - 64.1) * std::sin(angle));
    }));
  };
  for (const double angle_deg : {33.0, 200.0}) {
    const std::vector<Edge> edges = edges_at(angle_deg);
    REQUIRE(edges.size() >= 3);
    for (const Edge& edge : edges) {  // bins of half a pixel take the mean around the extreme: a few percent
      CHECK_THAT(edge.undershoot, WithinRel(halo, 0.07));
      CHECK_THAT(edge.overshoot, WithinRel(halo, 0.07));
    }
  }
  // Along rows, samples are a pixel apart.
  double sampled = 0;
  for (int k = -6; k <= 0; ++k) sampled = std::min(sampled, profile(k - 0.3));
  const std::vector<Edge> edges = edges_at(0);
  REQUIRE(edges.size() >= 3);
  for (const Edge& edge : edges) CHECK_THAT(edge.undershoot, WithinRel(-sampled, 0.02));
  for (const Edge& edge : straight_edges(blurred_step(kBlur, 33))) {
    CHECK(edge.undershoot < 0.002);
    CHECK(edge.overshoot < 0.002);
  }
}

TEST_CASE("No edges: a level frame, a wave, a frame too small") {
  CHECK(straight_edges(Plane<float>(160, 128, 90.0F)).empty());
  CHECK(straight_edges(frame_of(160, 128, [](int x, int) { return 100 + 50 * std::sin(0.7 * x); })).empty());
  CHECK(straight_edges(frame_of(16, 16, [](int x, int) { return x < 8 ? 0 : 100; })).empty());
}

TEST_CASE("No more edges than the limit") {
  const auto stripes = frame_of(640, 512, [](int x, int) { return x / 40 % 2 == 0 ? 50 : 150; });
  CHECK(straight_edges(stripes).size() == kMostEdges);
}

}  // namespace edge_profiles_test
