#include <algorithm>
#include <cmath>
#include <map>

#include "accuracy/physical/chain_scene.h"
#include "base/error.h"
#include "base/parallel.h"
#include "radiometry/spectral_air.h"
#include "scene/variation_field.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace chain_test {

using namespace thermal;

namespace {

constexpr double kFloatRounding = 6e-8;  // half of a float's eps

/// The chain again, pixel by pixel in double precision, from the formulas alone.
class ExactChain {
 public:
  explicit ExactChain(const Terms& terms)
      : terms_(terms),
        settings_(chain_scene::settings(terms)),
        band_air_(settings_.weather.air, settings_.response),
        blackbody_(settings_.response),
        field_(settings_.seed) {
    for (const auto& [name, one] : chain_scene::library().all()) {
      const EmissivitySpectrum emissivity = one.spectrum.value_or(EmissivitySpectrum(one.emissivity));
      bands_.emplace(name, BandRadiance(settings_.response, emissivity));
    }
  }

  [[nodiscard]] double radiance(int x, int y) const {
    const Air& air = settings_.weather.air;
    if (passes_.object_index.at(x, y) == chain_scene::kSky)
      return band_air_.sky_emissivity(std::max(0.0, ray(x, y, 2) / ray_length(x, y))) * air_radiance();
    const Material& surface = material_at(x, y);
    const BandRadiance& band = bands_.at(surface.name);
    const double factor = terms_.angular ? angular_factor(surface.angular, cosine(x, y)) : 1;
    double result = factor * band.radiance(temperature_k(x, y));
    if (terms_.sky) {
      result += (air_radiance() - factor * band.radiance(air.temperature_k)) * surroundings(surface, x, y);
    }
    if (!terms_.path) return result;
    const double through = band_air_.path_transmittance(depth_m(x, y) * ray_length(x, y));
    return through * result + (1 - through) * air_radiance();
  }

  /// A difference of radiances as a difference of temperatures at air temperature [mK].
  [[nodiscard]] double as_mk(double difference) const {
    return 1e3 * difference / blackbody_.evaluate(settings_.weather.air.temperature_k).derivative_w_m2_sr_k;
  }

  /// Largest effect of one rounding to single precision in the picture: nothing is brighter than the hood, 32 K above
  /// the air.
  [[nodiscard]] double rounding_mk() const { return as_mk(kFloatRounding * blackbody_.radiance(315)); }

 private:
  [[nodiscard]] double air_radiance() const {
    return blackbody_.radiance(settings_.weather.air.temperature_k);
  }
  [[nodiscard]] double depth_m(int x, int y) const { return static_cast<double>(passes_.depth_m.at(x, y)); }

  [[nodiscard]] const Material& material_at(int x, int y) const {
    const std::uint16_t index = passes_.object_index.at(x, y);
    return chain_scene::library().find(manifest_.objects.at(index - 1U).material, "test");
  }

  [[nodiscard]] double temperature_k(int x, int y) const {
    const Material& surface = material_at(x, y);
    const std::uint16_t part = passes_.material_index.at(x, y);
    const std::string name = terms_.parts && part != 0 ? manifest_.materials.at(part - 1U).part : "";
    const double mean_k = surface.part_temperature_k(name, settings_.weather);
    if (!terms_.variation || surface.variation.stddev_k == 0) return mean_k;
    const double per_length = 1 / surface.variation.correlation_length_m;
    const auto& pose = *manifest_.frames[0].camera_to_world;
    const auto place = [&](std::size_t axis) {
      return (pose.at(4 * axis + 3) + depth_m(x, y) * ray(x, y, axis)) * per_length;
    };
    const double footprint = depth_m(x, y) / chain_scene::kFocalPx * per_length;
    const float value = field_.sample(static_cast<float>(place(0)), static_cast<float>(place(1)),
                                      static_cast<float>(footprint));
    return mean_k + surface.variation.stddev_k * static_cast<double>(value);
  }

  /// World direction of a pixel's ray along an axis; 1 along the camera's own.
  [[nodiscard]] double ray(int x, int y, std::size_t axis) const {
    const auto& pose = *manifest_.frames[0].camera_to_world;
    return pose.at(4 * axis) * right(x) + pose.at(4 * axis + 1) * down(y) + pose.at(4 * axis + 2);
  }
  [[nodiscard]] static double right(int x) {
    return (x + 0.5 - chain_scene::kWidth / 2.0) / chain_scene::kFocalPx;
  }
  [[nodiscard]] static double down(int y) {
    return (y + 0.5 - chain_scene::kHeight / 2.0) / chain_scene::kFocalPx;
  }
  [[nodiscard]] static double ray_length(int x, int y) { return std::hypot(right(x), down(y), 1); }

  [[nodiscard]] double normal(int x, int y, std::size_t axis) const {
    return static_cast<double>(passes_.normal.at(axis).at(x, y));
  }
  /// Positive where the normal faces away from the camera.
  [[nodiscard]] double along_ray(int x, int y) const {
    double sum = 0;
    for (std::size_t axis = 0; axis < 3; ++axis) sum += normal(x, y, axis) * ray(x, y, axis);
    return sum / ray_length(x, y);
  }
  [[nodiscard]] double cosine(int x, int y) const { return std::abs(along_ray(x, y)); }

  /// Reflected radiance, relative to a blackbody at air temperature.
  [[nodiscard]] double surroundings(const Material& surface, int x, int y) const {
    if (surface.angular == AngularLaw::water) {
      return band_air_.sky_emissivity(cosine(x, y));
    }
    const double up = along_ray(x, y) > 0 ? -normal(x, y, 2) : normal(x, y, 2);
    const double sky_view = (1 + up) / 2;
    return sky_view * band_air_.sky_emissivity() + (1 - sky_view);
  }

  Terms terms_;
  PhysicsSettings settings_;
  BandAir band_air_;
  BandRadiance blackbody_;
  VariationField field_;
  Manifest manifest_ = chain_scene::manifest();
  Passes passes_ = chain_scene::passes();
  std::map<std::string, BandRadiance> bands_;
};

/// Largest error of the chain over the picture [mK].
double worst_mk(const ExactChain& exact, const Plane<float>& plane) {
  double worst = 0;
  for (int y = 0; y < plane.height_px(); ++y) {
    for (int x = 0; x < plane.width_px(); ++x) {
      const double difference = static_cast<double>(plane.at(x, y)) - exact.radiance(x, y);
      worst = std::max(worst, std::abs(exact.as_mk(difference)));
    }
  }
  return worst;
}

/// Terms, and the number of roundings to single precision on a pixel's way through them.
struct Chosen {
  const char* name = "";
  Terms terms;
  int roundings = 0;
};

// One for what a surface emits, two for a product added, and four for what depends on an angle or a range: direction,
// length, the function's table or polynomial, and its evaluation, whose errors are no larger.
constexpr Chosen kChosen[] = {{"emission alone", {}, 1},
                              {"parts", {.parts = true}, 1},
                              {"sky", {.sky = true}, 1 + 2 + 4},
                              {"angular", {.angular = true}, 1 + 2 + 4},
                              {"path", {.path = true}, 1 + 2 + 4},
                              {"sky and angular", {.sky = true, .angular = true}, 1 + 2 * (2 + 4)},
                              {"falloff, which is the sensor's", {.falloff = true}, 1},
                              {"variation", {.variation = true}, 1},
                              {"all", chain_scene::kAllTerms, 1 + 3 * (2 + 4)}};

/// Effect of single precision on the temperature field [mK]: positions are below 35 correlation lengths and rounded
/// three times, the field's slope is at most 15 per length, soil's stddev is 1 K; and the radiance table's own error.
double variation_bound_mk() {
  const RadianceTable table(BandRadiance(response("vox_germanium"), quartz()));
  return 1e3 * (3 * kFloatRounding * 35 * 15 * 1 + table.worst_error_k());
}

using IsTouched = bool (*)(std::uint16_t object, std::uint16_t part);

/// A term, and the pixels it affects.
struct Dropped {
  const char* name;
  bool Terms::*term;
  IsTouched touches;
};

constexpr bool is_ground(std::uint16_t object) {
  return object >= chain_scene::kSoil && object <= chain_scene::kSand;
}

constexpr Dropped kDropped[] = {
    {"variation", &Terms::variation, [](std::uint16_t object, std::uint16_t) { return is_ground(object); }},
    {"parts", &Terms::parts, [](std::uint16_t, std::uint16_t part) { return part != chain_scene::kNoPart; }},
    {"sky", &Terms::sky, [](std::uint16_t object, std::uint16_t) { return object != chain_scene::kSky; }},
    {"angular", &Terms::angular,
     [](std::uint16_t object, std::uint16_t) { return is_ground(object) && object != chain_scene::kGrass; }},
    {"mirror", &Terms::mirror, [](std::uint16_t, std::uint16_t) { return false; }},  // no mirrored planes
    {"path", &Terms::path, [](std::uint16_t object, std::uint16_t) { return object != chain_scene::kSky; }},
    {"falloff", &Terms::falloff, [](std::uint16_t, std::uint16_t) { return false; }}};

PassNeeds needs(const Terms& terms) {
  return SceneRadiance(chain_scene::manifest(), chain_scene::library(), chain_scene::settings(terms)).needs();
}

}  // namespace

TEST_CASE("Each term alone, and all of them, agree with double precision to float rounding") {
  for (const auto& [name, terms, roundings] : kChosen) {
    const ExactChain exact(terms);
    const double worst = worst_mk(exact, chain_scene::radiance(terms));
    // Of the sky, its emissivity, the air's radiance and their product are rounded.
    const double bound =
        std::max(roundings, 3) * exact.rounding_mk() + (terms.variation ? variation_bound_mk() : 0);
    CAPTURE(name, bound);
    CHECK(worst <= bound);
    CHECK(bound < 40.0 / 100);  // a hundredth of a good camera's NETD
  }
}

TEST_CASE("A dropped term leaves every pixel it does not affect unchanged, to the bit") {
  const Passes passes = chain_scene::passes();
  const Plane<float> all = chain_scene::radiance(chain_scene::kAllTerms);
  for (const auto& [name, term, touches] : kDropped) {
    Terms others = chain_scene::kAllTerms;
    others.*term = false;
    const Plane<float> without = chain_scene::radiance(others);
    int changed = 0;
    CAPTURE(name);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const bool same = all.pixels()[i] == without.pixels()[i];
      const bool touched = touches(passes.object_index.pixels()[i], passes.material_index.pixels()[i]);
      if (!touched) REQUIRE(same);
      changed += same ? 0 : 1;
    }
    CHECK((changed > 100) == (std::string(name) != "falloff" && std::string(name) != "mirror"));
  }
}

TEST_CASE("The chain requests the planes that its terms read, and no others") {
  const auto check = [](const Terms& terms, bool depth, bool normals) {
    CHECK(needs(terms).depth == depth);
    CHECK(needs(terms).normals == normals);
  };
  check({}, false, false);
  check({.parts = true, .falloff = true}, false, false);
  check({.variation = true}, true, false);
  check({.path = true}, true, false);
  check({.sky = true}, false, true);
  check({.angular = true}, false, true);
  check(chain_scene::kAllTerms, true, true);
}

TEST_CASE("Planes that are not requested may be missing") {
  Passes bare;
  bare.object_index = chain_scene::passes().object_index;
  bare.material_index = chain_scene::passes().material_index;
  CHECK(chain_scene::radiance({.parts = true}, bare) == chain_scene::radiance({.parts = true}));
}

TEST_CASE("The number of threads does not change any bit") {
  const auto radiance = [] { return chain_scene::radiance(chain_scene::kAllTerms); };
  const Plane<float> alone = with_threads(1, radiance);
  CHECK(with_threads(2, radiance) == alone);
  CHECK(with_threads(5, radiance) == alone);
}

TEST_CASE("Terms that need a viewpoint need a pose in every frame") {
  Manifest poseless = chain_scene::manifest();
  poseless.frames.push_back({});
  const auto fault_of = [&](const Terms& terms) {
    return message_of<ConfigError>(
        [&] { SceneRadiance(poseless, chain_scene::library(), chain_scene::settings(terms)); });
  };
  for (const Terms& terms : {Terms{.variation = true}, Terms{.sky = true}, Terms{.angular = true}}) {
    CHECK(fault_of(terms) ==
          "frames[1].camera_to_world is missing; expected in every frame by the chosen terms");
  }
  for (const Terms& terms : {Terms{.parts = true}, Terms{.path = true}}) {
    CHECK_NOTHROW(SceneRadiance(poseless, chain_scene::library(), chain_scene::settings(terms)));
  }
}

}  // namespace chain_test
