#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

#include "accuracy/physical/assets.h"
#include "imaging/scene_radiance.h"
#include "radiometry/band_radiance.h"
#include "radiometry/spectral_air.h"
#include "support/catch.h"
#include "support/traced.h"

// A warm black post in level water: its image has the water's reflectivity times the difference between its radiance and
// that of the sky behind it, from the ray tracer to radiance.

namespace mirror_test {

using namespace thermal;
using small_scene::looking;

namespace {

constexpr double kPostK = 310;
constexpr double kAirK = 278;
constexpr double kHeightM = 20;
const CameraIntrinsics kCamera = small_scene::pinhole(120, 96, 110);
const std::array<double, 16> kPose = looking({0, -25, kHeightM}, {0, 2, 0});

const MaterialLibrary& library() {
  static const MaterialLibrary kAll = [] {
    MaterialLibrary result;
    for (const auto& [name, one] : materials().all()) {
      if (name != "soot") result.add(one);
    }
    Material soot;
    soot.name = "soot";
    soot.winter_k = soot.summer_k = kPostK;
    result.add(soot);
    return result;
  }();
  return kAll;
}

Manifest manifest() {
  Manifest result;
  result.camera = kCamera;
  const auto add = [&](std::uint16_t index, const std::string& material) {
    ManifestObject object;
    object.index = index;
    object.name = object.material = material;
    result.objects.push_back(object);
  };
  add(small_scene::kWater, "water");
  add(small_scene::kTree, "soot");
  result.frames.resize(1);
  result.frames[0].camera_to_world = kPose;
  return result;
}

Passes passes() {
  small_scene::Scenery place;
  place.surface(small_scene::kWater, shapes::level(400, 4, 0, 0));
  place.plant(small_scene::kTree, shapes::box({-2, 9, -1}, {2, 11, 9}, 0), small_scene::kIdentity);
  BakedScene scene = place.baked();
  scene.objects = manifest().objects;
  scene.mirrors = {"water"};
  const RayCaster caster(scene);
  small_scene::Clip clip = {.camera_to_world = {kPose}, .poses = {}};
  const BakedTrack track = clip.baked();
  Passes result;
  ClipTracer(caster, track, kCamera, {})
      .trace(0, {.depth = true, .normals = true, .actors = false, .mirrored = true}, result);
  return result;
}

Plane<float> radiance(bool mirror, bool path, const Passes& from) {
  const PhysicsSettings settings = {.terms = {.sky = true, .angular = true, .mirror = mirror, .path = path},
                                    .weather = {.air = {kAirK, 0.5, 0}},
                                    .response = SpectralResponse::flat(8, 14)};
  const Manifest described = manifest();
  return SceneRadiance(described, library(), settings).radiance(from, described.frames[0]);
}

/// The ray through a pixel, in world axes, one unit along the camera's axis.
std::array<double, 3> ray_at(int x, int y) {
  const double rx = (x + 0.5 - kCamera.cx_px) / kCamera.fx_px;
  const double ry = (y + 0.5 - kCamera.cy_px) / kCamera.fy_px;
  std::array<double, 3> ray{};
  for (std::size_t row = 0; row < 3; ++row)
    ray.at(row) = kPose.at(4 * row) * rx + kPose.at(4 * row + 1) * ry + kPose.at(4 * row + 2);
  return ray;
}

}  // namespace

TEST_CASE("The image of a warm post in water has the water's reflectivity times its contrast with the sky") {
  const Air air = {kAirK, 0.5, 0};
  const SpectralResponse response = SpectralResponse::flat(8, 14);
  const BandRadiance black(response);
  const Material& water = library().find("water", "test");
  const BandRadiance of_water(response, water.spectrum.value_or(EmissivitySpectrum(water.emissivity)));
  const BandAir band_air(air, response);
  const double air_w = black.radiance(kAirK);
  const Passes from = passes();
  for (const bool path : {false, true}) {
    const Plane<float> without = radiance(false, path, from);
    const Plane<float> with = radiance(true, path, from);
    int images = 0;
    double worst_mk = 0;
    double least_mk = 1e9;
    double most_mk = 0;
    for (int y = 0; y < kCamera.height_px; ++y) {
      for (int x = 0; x < kCamera.width_px; ++x) {
        if (from.mirrored.object_index.at(x, y) == 0) {
          REQUIRE(with.at(x, y) == without.at(x, y));
          continue;
        }
        ++images;
        const std::array<double, 3> ray = ray_at(x, y);
        const double length = std::hypot(ray[0], ray[1], ray[2]);
        const double cosine = -ray[2] / length;
        const double reflectivity =
            1 - angular_factor(AngularLaw::water, cosine) * of_water.radiance(kAirK) / air_w;
        const double to_water_m = kHeightM / cosine;
        const double to_post_m = static_cast<double>(from.mirrored.depth_m.at(x, y)) * length - to_water_m;
        const auto through = [&](double range_m) {
          return path ? band_air.path_transmittance(range_m) : 1.0;
        };
        const double post_w = through(to_post_m) * black.radiance(kPostK) + (1 - through(to_post_m)) * air_w;
        const double sky_w = air_w * band_air.sky_emissivity(cosine);
        const double expected = through(to_water_m) * reflectivity * (post_w - sky_w);
        const auto radiance_w = static_cast<double>(without.at(x, y));
        const double shift_w = static_cast<double>(with.at(x, y)) - radiance_w;
        const auto mk = [&](double shift) {
          return 1e3 * (black.temperature(radiance_w + shift) - black.temperature(radiance_w));
        };
        worst_mk = std::max(worst_mk, std::abs(mk(shift_w) - mk(expected)));
        least_mk = std::min(least_mk, mk(expected));
        most_mk = std::max(most_mk, mk(expected));
      }
    }
    std::printf("mirrored post, path %s: %d pixels, shifts %.0f to %.0f mK, worst error %.4f mK\n",
                path ? "on" : "off", images, least_mk, most_mk, worst_mk);
    CHECK(images > 100);
    CHECK(least_mk > 500);
    // Each rounding of radiance is 2^-24 of it, or 60 K x 6e-8 = .004 mK. The image differs from the sky by ten.
    CHECK(worst_mk < 10 * 0.004);
  }
}

TEST_CASE("The image stands below the post, as far below the water as the post is above") {
  const Passes from = passes();
  const auto pixels_of = [](const Plane<std::uint16_t>& plane) {
    return std::ranges::count(plane.pixels(), small_scene::kTree);
  };
  CHECK(pixels_of(from.object_index) > 0);
  // The top of the post, at its front: 9 m above the water, and its image 9 m below.
  const auto row_of = [](double z_m) {
    const std::array<double, 3> to = {0 - kPose[3], 9 - kPose[7], z_m - kPose[11]};
    const auto along = [&](std::size_t column) {
      return to[0] * kPose.at(column) + to[1] * kPose.at(4 + column) + to[2] * kPose.at(8 + column);
    };
    return kCamera.cy_px + kCamera.fy_px * along(1) / along(2);
  };
  const int middle = kCamera.width_px / 2;
  int first = kCamera.height_px;
  int last = -1;
  for (int y = 0; y < kCamera.height_px; ++y) {
    if (from.mirrored.object_index.at(middle, y) != small_scene::kTree) continue;
    first = std::min(first, y);
    last = std::max(last, y);
  }
  CHECK(std::abs(first + 0.0 - row_of(0)) <= 1);
  CHECK(std::abs(last + 1.0 - std::min(row_of(-9), 1.0 * kCamera.height_px)) <= 1);
}

}  // namespace mirror_test
