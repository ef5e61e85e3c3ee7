#include <cmath>
#include <limits>

#include "accuracy/physical/chain_scene.h"
#include "imaging/frame_converter.h"
#include "imaging/sampling.h"
#include "support/catch.h"

namespace supersample_test {

using namespace thermal;

namespace {

constexpr float kNaN = std::numeric_limits<float>::quiet_NaN();

template <typename T>
Plane<T> plane_of(int width, const std::vector<T>& pixels) {
  Plane<T> result(width, static_cast<int>(pixels.size()) / width);
  std::copy(pixels.begin(), pixels.end(), result.pixels().begin());
  return result;
}

constexpr std::uint16_t kAnna = 5;
constexpr std::uint16_t kBen = 6;
constexpr std::array kActors = {kAnna, kBen};

Plane<std::uint16_t> labels_of(const Plane<std::uint16_t>& fine, int factor) {
  return block_actors(fine, factor, survey_indices(fine), IndexSet(kActors));
}

/// The label of one block.
std::uint16_t label_of(int factor, const std::vector<std::uint16_t>& block) {
  return labels_of(plane_of(factor, block), factor).at(0, 0);
}

/// A clip whose passes are `supersample` times finer than its camera of 2 x 1 px.
FrameConverter converter(int supersample, const Terms& terms) {
  Manifest manifest = chain_scene::manifest();
  manifest.camera = {2, 1, chain_scene::kFocalPx, chain_scene::kFocalPx, 1, 0.5};
  manifest.supersample = supersample;
  return FrameConverter(manifest, chain_scene::library(), Season::winter, SensorParameters(),
                        chain_scene::settings(terms));
}

SceneFrame convert(int supersample, const Passes& passes, const Terms& terms = {}) {
  return converter(supersample, terms).convert(passes, chain_scene::manifest().frames[0]);
}

/// Two pixels of 8 x 8: the left one's upper rows are a person, everything else is soil.
Passes person_over(int rows) {
  Passes passes = chain_scene::uniform_passes(16, 8, chain_scene::kSoil, 122, {0, 0, 1});
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < 8; ++x) passes.object_index.at(x, y) = chain_scene::kHuman;
  }
  return passes;
}

}  // namespace

TEST_CASE("Means of blocks are exact where their sums are") {
  const Plane<float> fine = plane_of<float>(4, {1, 2, 10, 20,  //
                                                3, 4, 30, 40});
  CHECK(block_means(fine, 2) == plane_of<float>(2, {2.5F, 25}));
  CHECK(block_means(fine, 1) == fine);
}

TEST_CASE("A NaN spreads to its block and no further") {
  const Plane<float> means = block_means(plane_of<float>(4, {1, kNaN, 1, 1,  //
                                                             1, 1, 1, 1}),
                                         2);
  CHECK(std::isnan(means.at(0, 0)));
  CHECK(means.at(1, 0) == 1);
}

TEST_CASE("A pixel's quarters are its mean, give or take its detail") {
  Plane<float> means;
  SubpixelDetail detail;
  mean_quarters(plane_of<float>(4, {1, 1, 2, 2,  //
                                    1, 1, 2, 2,  //
                                    4, 4, 9, 9,  //
                                    4, 4, 9, 13}),
                4, means, detail);
  CHECK(means.at(0, 0) == 4.25F);
  CHECK(detail.across.at(0, 0) == 1.75F);   // 2 and 10 on the right, 1 and 4 on the left
  CHECK(detail.down.at(0, 0) == 2.75F);     // 4 and 10 below, 1 and 2 above
  CHECK(detail.crossed.at(0, 0) == 1.25F);  // 1 and 10, 2 and 4
}

TEST_CASE("A pixel with a NaN has no detail, and its neighbours keep theirs") {
  Plane<float> means;
  SubpixelDetail detail;
  mean_quarters(plane_of<float>(4, {kNaN, 1, 1, 3,  //
                                    1, 1, 1, 3}),
                2, means, detail);
  CHECK(std::isnan(means.at(0, 0)));
  CHECK(detail.across.at(0, 0) == 0);
  CHECK(means.at(1, 0) == 2);
  CHECK(detail.across.at(1, 0) == 1);
}

TEST_CASE("Quarters are known if samples are even and not resampled for the lens") {
  Manifest manifest = chain_scene::manifest();
  const LensDistortion lens = {.k1 = -0.1};
  manifest.supersample = 4;
  CHECK(pixel_sampling(manifest, {}) == PixelSampling{4, true});
  CHECK(pixel_sampling(manifest, lens) == PixelSampling{4, false});
  manifest.lens = lens;  // the rays follow it
  CHECK(pixel_sampling(manifest, lens) == PixelSampling{4, true});
  manifest.supersample = 3;
  CHECK(pixel_sampling(manifest, lens) == PixelSampling{3, false});
  manifest = chain_scene::manifest();
  manifest.cryptomatte = "CryptoObject";
  CHECK_FALSE(pixel_sampling(manifest, {}).quarters);
}

TEST_CASE("Means of many values are accurate to float rounding") {
  Plane<float> fine(8, 8);
  double sum = 0;
  for (std::size_t i = 0; i < fine.size(); ++i) {
    fine.pixels()[i] = 50 + 0.123F * static_cast<float>(i);
    sum += static_cast<double>(fine.pixels()[i]);
  }
  // 63 additions of positive numbers and a product, half an eps each at most.
  CHECK_THAT(static_cast<double>(block_means(fine, 8).at(0, 0)), WithinRel(sum / 64, 64 * 6e-8));
}

TEST_CASE("A pixel is labelled as the actor that covers at least half of it") {
  CHECK(label_of(2, {kAnna, kAnna, 1, 1}) == kAnna);  // exactly half
  CHECK(label_of(2, {kAnna, 1, 1, 1}) == 0);
  CHECK(label_of(2, {kAnna, kBen, 1, 1}) == 0);  // half covered, but not by one actor
  CHECK(label_of(2, {1, 1, 1, 1}) == 0);         // 1 is not an actor
  CHECK(label_of(3, {kBen, kBen, kBen, kBen, kBen, 1, 1, 1, 1}) == kBen);  // 5 of 9
  CHECK(label_of(3, {kBen, kBen, kBen, kBen, 1, 1, 1, 1, 1}) == 0);        // 4 of 9
  CHECK(label_of(1, {kBen}) == kBen);
}

TEST_CASE("Of two actors with half each, the lower index wins") {
  CHECK(label_of(2, {kBen, kBen, kAnna, kAnna}) == kAnna);
  CHECK(label_of(2, {kAnna, kBen, kBen, kAnna}) == kAnna);
}

TEST_CASE("Labels of blocks are at the right places") {
  const Plane<std::uint16_t> fine = plane_of<std::uint16_t>(4, {1, 1, kBen, kBen,    //
                                                                1, 1, kBen, 1,       //
                                                                kAnna, kAnna, 0, 0,  //
                                                                kAnna, 1, 0, 0});
  CHECK(labels_of(fine, 2) == plane_of<std::uint16_t>(2, {0, kBen, kAnna, 0}));
}

TEST_CASE(
    "A pixel that is half person, half soil has the mean of their radiances, not of their temperatures") {
  const Plane<float> mixed = convert(8, person_over(4)).radiance_w_m2_sr;
  REQUIRE(mixed.width_px() == 2);
  const auto soil = static_cast<double>(mixed.at(1, 0));
  const auto person = static_cast<double>(convert(8, person_over(8)).radiance_w_m2_sr.at(0, 0));
  CHECK_THAT(static_cast<double>(mixed.at(0, 0)), WithinRel((soil + person) / 2, 64 * 6e-8));
  // Radiance is convex in temperature, so the mean temperature would give less.
  const PhysicsSettings settings = chain_scene::settings({});
  const BandRadiance blackbody(settings.response);
  const double of_mean_k =
      blackbody.radiance((blackbody.temperature(soil) + blackbody.temperature(person)) / 2);
  CHECK(static_cast<double>(mixed.at(0, 0)) > of_mean_k * (1 + 1e-4));
}

TEST_CASE("A person covering an eighth of a pixel warms it by an eighth") {
  const Plane<float> mixed = convert(8, person_over(1)).radiance_w_m2_sr;
  const auto soil = static_cast<double>(mixed.at(1, 0));
  const auto person = static_cast<double>(convert(8, person_over(8)).radiance_w_m2_sr.at(0, 0));
  CHECK_THAT(static_cast<double>(mixed.at(0, 0)), WithinRel(soil + (person - soil) / 8, 64 * 6e-8));
}

TEST_CASE("Labels of a supersampled frame are in the camera's pixels, by half") {
  CHECK(convert(8, person_over(3)).instances.empty());
  const SceneFrame frame = convert(8, person_over(4));
  REQUIRE(frame.instances.size() == 1);
  CHECK(frame.instances[0].index == chain_scene::kHuman);
  CHECK(frame.instances[0].area_px == 1);
}

TEST_CASE("Every sub-pixel has its own air and angle before averaging") {
  // Half at 30 m, half at 300 m: the mean of both results, not the result of the mean range.
  const Terms path = {.path = true};
  Passes passes = chain_scene::uniform_passes(16, 8, chain_scene::kHuman, 30, {0, 0, 1});
  const auto near = static_cast<double>(convert(8, passes, path).radiance_w_m2_sr.at(0, 0));
  for (int y = 4; y < 8; ++y) {
    for (float& depth_m : passes.depth_m.row(y)) depth_m = 300;
  }
  const auto mixed = static_cast<double>(convert(8, passes, path).radiance_w_m2_sr.at(0, 0));
  const auto far = static_cast<double>(
      convert(8, chain_scene::uniform_passes(16, 8, chain_scene::kHuman, 300, {0, 0, 1}), path)
          .radiance_w_m2_sr.at(0, 0));
  const auto middle = static_cast<double>(
      convert(8, chain_scene::uniform_passes(16, 8, chain_scene::kHuman, 165, {0, 0, 1}), path)
          .radiance_w_m2_sr.at(0, 0));
  // Rays of the upper half and of the lower are of equal length, by symmetry.
  CHECK_THAT(mixed, WithinRel((near + far) / 2, 64 * 6e-8));
  CHECK(mixed > middle * (1 + 1e-4));
}

}  // namespace supersample_test
