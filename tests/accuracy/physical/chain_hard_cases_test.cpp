#include <algorithm>
#include <cmath>
#include <limits>

#include "accuracy/physical/chain_scene.h"
#include "base/error.h"
#include "radiometry/spectral_air.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace chain_hard_cases_test {

using namespace thermal;
using chain_scene::kAllTerms;
using chain_scene::uniform_passes;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();
constexpr float kDenormal = std::numeric_limits<float>::denorm_min();
constexpr std::array<float, 3> kUp = {0, 0, 1};
constexpr double kFloatRounding = 6e-8;  // half of a float's eps

/// The same objects, seen from straight above by a camera of any size.
Manifest looking_down(int width, int height) {
  Manifest result = chain_scene::manifest();
  result.camera = {width, height, chain_scene::kFocalPx, chain_scene::kFocalPx, width / 2.0, height / 2.0};
  result.frames[0].camera_to_world = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 61, 0, 0, 0, 1};
  return result;
}

/// The chain for a frame of one pixel that looks straight down.
class OnePixel {
 public:
  explicit OnePixel(const Terms& terms)
      : scene_(manifest_, chain_scene::library(), chain_scene::settings(terms)) {}

  [[nodiscard]] float radiance(std::uint16_t object, float depth_m, std::array<float, 3> normal = kUp) const {
    return scene_.radiance(uniform_passes(1, 1, object, depth_m, normal), manifest_.frames[0]).at(0, 0);
  }

 private:
  Manifest manifest_ = looking_down(1, 1);
  SceneRadiance scene_;
};

bool all_finite(const Plane<float>& plane) {
  return std::all_of(plane.pixels().begin(), plane.pixels().end(),
                     [](float value) { return std::isfinite(value) && value > 0; });
}

const float kBadDepths[] = {0, -0.0F, -5, kDenormal, 1e9F, 1e10F, 3e38F, kInfinity, -kInfinity, kNaN};

const std::array<float, 3> kBadNormals[] = {
    {0, 0, 0},         {kNaN, 0, 1},       {0, 0, kNaN},          {kNaN, kNaN, kNaN},
    {kInfinity, 0, 0}, {0, -kInfinity, 1}, {1e30F, 1e30F, 1e30F}, {5, 5, 5},
    {kDenormal, 0, 0}, {1.5F, 0, 0.1F},    {0.5F, 0, 0.1F}};

}  // namespace

TEST_CASE("Radiance is a positive finite number whatever depth and normal hold") {
  const OnePixel pixel(kAllTerms);
  for (const float depth_m : kBadDepths) {
    for (const auto& normal : kBadNormals) {
      for (std::uint16_t object = chain_scene::kSky; object < chain_scene::kObjects; ++object) {
        const float value = pixel.radiance(object, depth_m, normal);
        CAPTURE(depth_m, normal[0], normal[1], normal[2], object);
        REQUIRE(std::isfinite(value));
        REQUIRE(value > 0);
      }
    }
  }
}

TEST_CASE("Invalid depth leaves ground at its mean temperature") {
  const OnePixel varied({.variation = true});
  // One through the radiance table, the other directly from the reference: both round to a float.
  const auto mean = static_cast<double>(OnePixel({}).radiance(chain_scene::kSoil, 61));
  CHECK_THAT(static_cast<double>(varied.radiance(chain_scene::kSoil, 61)), !WithinRel(mean, 1e-4));
  const RadianceTable table(
      BandRadiance(response("vox_germanium"), EmissivitySpectrum(material("soil").emissivity)));
  for (const float depth_m : {0.0F, -5.0F, 1e9F, 1e10F, kInfinity, -kInfinity, kNaN}) {
    CAPTURE(depth_m);
    CHECK_THAT(static_cast<double>(varied.radiance(chain_scene::kSoil, depth_m)),
               WithinRel(mean, table.worst_relative_error() + kFloatRounding));
  }
}

TEST_CASE("A range beyond the path model counts as 1000 m, zero range as no air") {
  const OnePixel pixel({.path = true});
  const float farthest = pixel.radiance(chain_scene::kHuman, 1000);
  for (const float depth_m : {1001.0F, 1e9F, 1e10F, kInfinity, kNaN}) {
    CHECK(pixel.radiance(chain_scene::kHuman, depth_m) == farthest);
  }
  const float airless = OnePixel({}).radiance(chain_scene::kHuman, 61);
  for (const float depth_m : {0.0F, -0.0F, -5.0F, -kInfinity}) {
    CHECK(pixel.radiance(chain_scene::kHuman, depth_m) == airless);
  }
  CHECK(farthest < airless);
}

TEST_CASE("The sky keeps its radiance whatever the other planes hold") {
  const OnePixel pixel(kAllTerms);
  const float sky = pixel.radiance(chain_scene::kSky, 1e10F);
  for (const float depth_m : kBadDepths) {
    for (const auto& normal : kBadNormals) CHECK(pixel.radiance(chain_scene::kSky, depth_m, normal) == sky);
  }
  const PhysicsSettings settings = chain_scene::settings({});
  // The pixel looks straight down, where no sky is: at its rim.
  const double expected = BandAir(settings.weather.air, settings.response).sky_emissivity(0) *
                          BandRadiance(settings.response).radiance(settings.weather.air.temperature_k);
  CHECK_THAT(static_cast<double>(sky), WithinRel(expected, 3 * kFloatRounding));
}

TEST_CASE("An invalid normal counts as facing sky and camera squarely") {
  const OnePixel pixel({.sky = true, .angular = true});
  for (std::uint16_t object = chain_scene::kSoil; object < chain_scene::kObjects; ++object) {
    const float squarely = pixel.radiance(object, 61);
    for (const auto& normal : kBadNormals) {
      CAPTURE(object, normal[0], normal[1], normal[2]);
      CHECK(pixel.radiance(object, 61, normal) == squarely);
    }
  }
}

TEST_CASE("A normal that faces away from the camera is flipped") {
  const OnePixel pixel(kAllTerms);
  const float s = 0.70710678F;
  for (const auto& normal : {kUp, std::array<float, 3>{s, 0, s}, std::array<float, 3>{0.6F, 0.48F, 0.64F}}) {
    const std::array<float, 3> flipped = {-normal[0], -normal[1], -normal[2]};
    for (const std::uint16_t object : {chain_scene::kSoil, chain_scene::kWater, chain_scene::kTruck}) {
      CHECK(pixel.radiance(object, 61, flipped) == pixel.radiance(object, 61, normal));
    }
  }
}

TEST_CASE("Frames may be a single pixel, row or column, and all sky") {
  for (const auto& [width, height] :
       {std::pair{1, 1}, std::pair{333, 1}, std::pair{1, 333}, std::pair{48, 40}}) {
    const Plane<float> ground = chain_scene::radiance(
        kAllTerms, uniform_passes(width, height, chain_scene::kSoil, 61, kUp), looking_down(width, height));
    CHECK(ground.width_px() == width);
    CHECK(ground.height_px() == height);
    CHECK(all_finite(ground));
    const Plane<float> sky =
        chain_scene::radiance(kAllTerms, uniform_passes(width, height, chain_scene::kSky, 1e10F, {0, 0, 0}),
                              looking_down(width, height));
    CHECK(sky == Plane<float>(width, height, sky.at(0, 0)));
  }
}

TEST_CASE("If everything is black and at air temperature, air and sky change nothing") {
  MaterialLibrary library;
  for (const char* name : {"sky", "soil", "grass", "water", "sand", "human", "truck"}) {
    Material black;
    black.name = name;
    black.emissivity = 1;
    library.add(black);  // 273 K and 293 K in the two nights, like the air
  }
  PhysicsSettings settings = chain_scene::settings(kAllTerms);
  const Manifest manifest = looking_down(48, 40);
  const Plane<float> plane =
      SceneRadiance(manifest, library, settings)
          .radiance(uniform_passes(48, 40, chain_scene::kTruck, 200, kUp), manifest.frames[0]);
  const double air = BandRadiance(settings.response).radiance(settings.weather.air.temperature_k);
  for (const float value : plane.pixels()) {
    // Emitted and of the air: two floats, two roundings apart at most.
    REQUIRE_THAT(static_cast<double>(value), WithinRel(air, 2 * kFloatRounding));
  }
}

TEST_CASE("Ground that could vary beyond its radiance table is an error, not a wrong number") {
  MaterialLibrary library;
  for (const auto& [name, one] : chain_scene::library().all()) {
    Material changed = one;
    if (name == "soil") changed.winter_k = changed.summer_k = 900;  // embers; stddev 1 K
    library.add(changed);
  }
  const auto make = [&](const Terms& terms) {
    return SceneRadiance(looking_down(1, 1), library, chain_scene::settings(terms));
  };
  CHECK(message_of<ConfigError>([&] { (void)make({.variation = true}); }) ==
        "material soil: variation about 900.0 K by up to 6.0 K; expected within 180 K to 436 K");
  CHECK_NOTHROW(make({.sky = true, .path = true}));  // without variation the reference is called, once
}

TEST_CASE("The air is correct at every range and in every weather, to float rounding") {
  constexpr int kPixels = 512;
  Passes passes = uniform_passes(kPixels, 1, chain_scene::kHuman, 0, kUp);
  for (int x = 0; x < kPixels; ++x)
    passes.depth_m.at(x, 0) = static_cast<float>(2.0 * x * x / kPixels);  // past 1000 m
  const Manifest manifest = looking_down(kPixels, 1);
  const CameraRays rays(manifest.camera);
  for (const Air& air :
       {Air{273, 0.6, 0}, Air{293, 0.7, 0}, Air{283, 0, 0}, Air{308, 0.9, 0}, Air{318, 1, 1}}) {
    PhysicsSettings settings = chain_scene::settings({.path = true});
    settings.weather.air = air;
    const Plane<float> plane =
        SceneRadiance(manifest, chain_scene::library(), settings).radiance(passes, manifest.frames[0]);
    const Material& human = material("human");
    const BandAir band_air(air, settings.response);
    const BandRadiance blackbody(settings.response);
    const double emitted = human.emissivity * blackbody.radiance(human.temperature_k(air.temperature_k));
    const double of_air = blackbody.radiance(air.temperature_k);
    for (int x = 0; x < kPixels; ++x) {
      const double range_m = static_cast<double>(passes.depth_m.at(x, 0) * rays.length().at(x, 0));
      const double through = band_air.path_transmittance(range_m);
      CAPTURE(air.temperature_k, air.relative_humidity, range_m);
      // Surface and air differ by less than 30 %: the absorption of the path is accurate to 2e-7, two roundings;
      // result, one.
      REQUIRE_THAT(static_cast<double>(plane.at(x, 0)),
                   WithinRel(through * emitted + (1 - through) * of_air, 4 * kFloatRounding));
    }
  }
}

}  // namespace chain_hard_cases_test
