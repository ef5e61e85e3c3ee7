#include <algorithm>
#include <array>

#include "base/error.h"
#include "imaging/frame_converter.h"
#include "sensor/thermal_camera.h"
#include "support/catch.h"
#include "support/message_of.h"

namespace coverage_radiance_test {

using namespace thermal;

namespace {

constexpr int kWidth = 4;
constexpr int kHeight = 3;

MaterialLibrary materials() {
  MaterialLibrary library;
  for (const auto& [name, winter_k] :
       {std::pair("sky", 220.0), {"soil", 280.0}, {"grass", 287.0}, {"human", 305.0}}) {
    Material material;
    material.name = name;
    material.emissivity = 0.9;
    material.winter_k = material.summer_k = winter_k;
    library.add(material);
  }
  return library;
}

Manifest manifest() {
  Manifest result;
  result.camera = {
      .width_px = kWidth, .height_px = kHeight, .fx_px = 4, .fy_px = 4, .cx_px = 2, .cy_px = 1.5};
  result.objects.resize(2);
  result.objects[0].index = 1;
  result.objects[0].name = "ground";
  result.objects[0].material = "soil";
  result.objects[1].index = 7;
  result.objects[1].name = "anna";
  result.objects[1].material = "human";
  result.objects[1].object_class = ObjectClass::actor;
  result.materials = {{4, "grass", ""}};
  result.frames.resize(1);
  result.frames[0].camera_to_world = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 60, 0, 0, 0, 1};  // straight down
  return result;
}

enum class Model { published, physical };

/// Everything that depends on a pixel's position, range and normal.
PhysicsSettings all_terms() {
  PhysicsSettings settings;
  settings.terms = {.variation = true,
                    .parts = true,
                    .sky = true,
                    .angular = true,
                    .mirror = true,
                    .path = true,
                    .falloff = false};
  return settings;
}

FrameConverter converter(Model model, const Manifest& used = manifest(), const LensDistortion& lens = {}) {
  const auto physics = model == Model::physical ? std::optional(all_terms()) : std::nullopt;
  return FrameConverter(used, materials(), Season::winter, SensorParameters(), physics, lens);
}

/// Passes of any size with depths and normals that differ from pixel to pixel, all of one object.
Passes uniform(std::uint16_t index, int width_px = kWidth, int height_px = kHeight) {
  Passes passes;
  passes.object_index = Plane<std::uint16_t>(width_px, height_px, index);
  passes.depth_m = Plane<float>(width_px, height_px);
  for (Plane<float>& axis : passes.normal) axis = Plane<float>(width_px, height_px);
  for (std::size_t i = 0; i < passes.depth_m.size(); ++i) {
    passes.depth_m.pixels()[i] = 60 + static_cast<float>(i);
    passes.normal[0].pixels()[i] = i % 2 == 0 ? 0.6F : 0;
    passes.normal[2].pixels()[i] = i % 2 == 0 ? 0.8F : 1;
  }
  return passes;
}

CoverageRank rank_of(const Passes& passes, const std::vector<std::uint16_t>& indices,
                     const std::vector<float>& coverage) {
  CoverageRank rank = {
      .object_index = Plane<std::uint16_t>(passes.object_index.width_px(), passes.object_index.height_px()),
      .coverage = Plane<float>(passes.object_index.width_px(), passes.object_index.height_px())};
  std::copy(indices.begin(), indices.end(), rank.object_index.pixels().begin());
  std::copy(coverage.begin(), coverage.end(), rank.coverage.pixels().begin());
  return rank;
}

std::vector<float> radiance(const FrameConverter& used, const Passes& passes) {
  const Plane<float> plane = used.convert(passes, manifest().frames[0]).radiance_w_m2_sr;
  return {plane.pixels().begin(), plane.pixels().end()};
}

/// Soil, a person, edges between all, and sky.
const std::vector<std::uint16_t> kFirst = {1, 7, 1, 7, 7, 0, 1, 7, 1, 1, 7, 7};
const std::vector<float> kFirstCoverage = {1, 1, 0.75F, 0.5F, 0.375F, 0, 0.5F, 0.25F, 1, 1, 0.625F, 1};
const std::vector<std::uint16_t> kSecond = {0, 0, 7, 1, 1, 0, 0, 0, 0, 0, 1, 0};
const std::vector<float> kSecondCoverage = {0, 0, 0.25F, 0.5F, 0.125F, 0, 0, 0, 0, 0, 0.25F, 0};

Passes shared() {
  Passes passes = uniform(0);
  passes.ranks = {rank_of(passes, kFirst, kFirstCoverage), rank_of(passes, kSecond, kSecondCoverage)};
  passes.object_index = passes.ranks[0].object_index;
  return passes;
}

/// Ranks equivalent to the index plane.
Passes with_whole_coverage(Passes passes) {
  std::vector<float> coverage;
  for (const std::uint16_t index : passes.object_index.pixels()) coverage.push_back(index == 0 ? 0.0F : 1.0F);
  const std::vector<std::uint16_t> indices(passes.object_index.pixels().begin(),
                                           passes.object_index.pixels().end());
  passes.ranks = {rank_of(passes, indices, coverage)};
  return passes;
}

}  // namespace

TEST_CASE("A shared pixel's radiance is the mean of its objects' radiances") {
  for (const Model model : {Model::published, Model::physical}) {
    const FrameConverter used = converter(model);
    const std::vector<float> sky = radiance(used, uniform(0));
    const std::vector<float> soil = radiance(used, uniform(1));
    const std::vector<float> human = radiance(used, uniform(7));
    const std::vector<float> found = radiance(used, shared());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const auto alone = [&](std::uint16_t index) {
        return static_cast<double>(index == 7 ? human[i] : index == 1 ? soil[i] : sky[i]);
      };
      const double first = static_cast<double>(kFirstCoverage[i]);
      const double second = static_cast<double>(kSecondCoverage[i]);
      const double mean =
          first * alone(kFirst[i]) + second * alone(kSecond[i]) + (1 - first - second) * alone(0);
      // These coverages are eighths, so the rest is exact. Three products of positive numbers and two sums, each
      // rounded by at most 2^-24.
      CAPTURE(i);
      CHECK_THAT(static_cast<double>(found[i]), WithinRel(mean, 3 * 6e-8));
      if (kSecondCoverage[i] > 0) CHECK(found[i] != soil[i]);
    }
    CHECK(found[0] == soil[0]);
    CHECK(found[1] == human[1]);
    CHECK(found[5] == sky[5]);
  }
}

TEST_CASE("Objects that cover their pixels completely keep every bit of an index plane's radiance") {
  for (const Model model : {Model::published, Model::physical}) {
    Passes passes = uniform(1);
    passes.object_index.at(1, 1) = passes.object_index.at(2, 1) = 7;
    passes.object_index.at(3, 0) = 0;
    passes.material_index = Plane<std::uint16_t>(kWidth, kHeight);
    passes.material_index.at(0, 0) = passes.material_index.at(1, 1) = 4;
    CHECK(radiance(converter(model), with_whole_coverage(passes)) == radiance(converter(model), passes));
  }
}

TEST_CASE("The same holds for finer passes with a lens") {
  const LensDistortion lens = {.k1 = -0.1};
  Manifest finer = manifest();
  finer.supersample = 2;
  finer.overscan_px = 2;
  Passes passes = uniform(1, 2 * (kWidth + 4), 2 * (kHeight + 4));
  for (int i = 0; i < 9; ++i) passes.object_index.at(6 + i % 3, 5 + i / 3) = 7;
  const FrameConverter used = converter(Model::physical, finer, lens);
  const std::vector<float> expected = radiance(used, passes);
  CHECK(expected.size() == kWidth * kHeight);
  CHECK(std::adjacent_find(expected.begin(), expected.end(), std::not_equal_to<>()) != expected.end());
  CHECK(radiance(used, with_whole_coverage(passes)) == expected);
}

TEST_CASE("A shared pixel counts in finer passes by its coverage") {
  Manifest finer = manifest();
  finer.supersample = 2;
  const FrameConverter used = converter(Model::published, finer);
  Passes passes = uniform(0, 2 * kWidth, 2 * kHeight);
  std::vector<std::uint16_t> indices(passes.object_index.size(), 1);
  std::vector<float> coverage(indices.size(), 1);
  indices[0] = 7;
  coverage[0] = 0.5F;  // an eighth of the camera's first pixel a person, an eighth sky
  passes.ranks = {rank_of(passes, indices, coverage)};
  passes.object_index = passes.ranks[0].object_index;
  const auto at = [](double temperature_k) {
    return static_cast<double>(static_cast<float>(0.9 * radiance_of(SensorParameters())(temperature_k)));
  };
  const double mean = (at(305) + at(220) + 6 * at(280)) / 8;
  // A product and a sum for the coverage, three sums and a product for the mean.
  CHECK_THAT(static_cast<double>(radiance(used, passes)[0]), WithinRel(mean, 6 * 6e-8));
}

TEST_CASE("The material plane applies to rank 0 only") {
  const FrameConverter used = converter(Model::published);
  Passes passes = shared();
  passes.material_index = Plane<std::uint16_t>(kWidth, kHeight, 4);
  const std::vector<float> found = radiance(used, passes);
  const std::vector<float> sky = radiance(used, uniform(0));
  const std::vector<float> soil = radiance(used, uniform(1));
  const std::vector<float> human = radiance(used, uniform(7));
  Passes grass_passes = uniform(1);
  grass_passes.material_index = passes.material_index;
  const std::vector<float> grass = radiance(used, grass_passes);
  CHECK(found[0] == grass[0]);
  CHECK(found[5] == sky[5]);
  CHECK(found[2] == 0.75F * grass[2] + 0.25F * human[2]);
  CHECK(found[6] == 0.5F * grass[6] + 0.5F * sky[6]);
  CHECK(found[2] != 0.75F * soil[2] + 0.25F * human[2]);
}

TEST_CASE("Coverages whose sum is rounded above 1 leave no sky, and no negative amount") {
  Passes passes = uniform(1);
  const std::size_t pixels = passes.object_index.size();
  // 0.7 + 0.3 in single precision is 1 + 2^-25 and more before it is rounded.
  const float most = 0.7F;
  const float rest = 0.3F + 3e-8F;
  REQUIRE(static_cast<double>(most) + static_cast<double>(rest) > 1);
  passes.ranks = {rank_of(passes, std::vector<std::uint16_t>(pixels, 1), std::vector<float>(pixels, most)),
                  rank_of(passes, std::vector<std::uint16_t>(pixels, 7), std::vector<float>(pixels, rest))};
  const FrameConverter used = converter(Model::published);
  CHECK(radiance(used, passes)[0] ==
        most * radiance(used, uniform(1))[0] + rest * radiance(used, uniform(7))[0]);
}

TEST_CASE("Labels use the object index, whatever the ranks are") {
  const SceneFrame frame = converter(Model::published).convert(shared());
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].index == 7);
  CHECK(frame.instances[0].area_px == 6);
}

TEST_CASE("An index missing from the manifest is an error in any rank") {
  Passes passes = shared();
  passes.ranks[1].object_index.at(2, 0) = 5;
  CHECK(message_of<DataError>([&] { (void)converter(Model::published).convert(passes); }) ==
        "object index at pixel (2, 0) = 5 (1 pixels); expected an index of the manifest's objects: 0, 1, 7");
}

TEST_CASE("A frame's memory is reused, whatever it held") {
  const FrameConverter used = converter(Model::published);
  SceneFrame frame;
  used.convert(uniform(7), manifest().frames[0], frame);
  used.convert(shared(), manifest().frames[0], frame);
  const std::vector<float> again = {frame.radiance_w_m2_sr.pixels().begin(),
                                    frame.radiance_w_m2_sr.pixels().end()};
  CHECK(again == radiance(used, shared()));
}

}  // namespace coverage_radiance_test
