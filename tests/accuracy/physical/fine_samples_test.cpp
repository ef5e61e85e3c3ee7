// Passes that are sampled where it matters give what passes with all samples give.

#include "accuracy/physical/chain_scene.h"
#include "base/error.h"
#include "imaging/frame_converter.h"
#include "imaging/sampling.h"
#include "scene/passes.h"
#include "support/catch.h"

namespace fine_samples_test {

using namespace thermal;

namespace {

constexpr int kSide = 2;

/// The scene's manifest as that of a camera with pixels twice as large.
Manifest coarse_manifest() {
  Manifest manifest = chain_scene::manifest();
  manifest.camera = {.width_px = chain_scene::kWidth / kSide,
                     .height_px = chain_scene::kHeight / kSide,
                     .fx_px = chain_scene::kFocalPx / kSide,
                     .fy_px = chain_scene::kFocalPx / kSide,
                     .cx_px = chain_scene::kWidth / 2.0 / kSide,
                     .cy_px = chain_scene::kHeight / 2.0 / kSide};
  manifest.supersample = kSide;
  return manifest;
}

template <typename T>
Plane<T> every_second(const Plane<T>& plane) {
  Plane<T> out(plane.width_px() / kSide, plane.height_px() / kSide);
  for (int y = 0; y < out.height_px(); ++y)
    for (int x = 0; x < out.width_px(); ++x) out.at(x, y) = plane.at(kSide * x, kSide * y);
  return out;
}

template <typename T>
void add_line(const Plane<T>& plane, int x, int y, std::vector<T>& samples) {
  for (int k = 0; k < kSide; ++k) samples.push_back(plane.at(kSide * x + k, y));
}

/// The samples of those pixels for which `is_chosen(x, y)`; the others have their upper left one.
template <typename Choice>
Passes sampled(const Passes& full, const Choice& is_chosen) {
  Passes passes;
  passes.object_index = every_second(full.object_index);
  passes.material_index = every_second(full.material_index);
  passes.depth_m = every_second(full.depth_m);
  for (std::size_t axis = 0; axis < 3; ++axis) passes.normal[axis] = every_second(full.normal[axis]);
  FineSamples& fine = passes.fine;
  fine.factor = kSide;
  fine.row_begin = {0};
  for (int y = 0; y < passes.object_index.height_px(); ++y) {
    for (int x = 0; x < passes.object_index.width_px(); ++x)
      if (is_chosen(x, y)) fine.x_px.push_back(static_cast<std::uint16_t>(x));
    fine.row_begin.push_back(fine.x_px.size());
    for (int line = kSide * y; line < kSide * (y + 1); ++line) {
      for (int x = 0; x < passes.object_index.width_px(); ++x) {
        if (!is_chosen(x, y)) continue;
        add_line(full.object_index, x, line, fine.object_index);
        add_line(full.material_index, x, line, fine.material_index);
        add_line(full.depth_m, x, line, fine.depth_m);
        for (std::size_t axis = 0; axis < 3; ++axis) add_line(full.normal[axis], x, line, fine.normal[axis]);
      }
    }
  }
  return passes;
}

SceneRadiance scene() {
  return {coarse_manifest(), chain_scene::library(), chain_scene::settings(chain_scene::kAllTerms)};
}

Plane<float> refined(const Passes& passes) {
  const SceneRadiance chain = scene();
  const ManifestFrame frame = coarse_manifest().frames[0];
  Plane<float> radiance = chain.radiance(passes, frame);
  (void)chain.refine(passes.fine, frame, radiance);
  return radiance;
}

bool is_chosen(int x, int y) { return (x * 7 + y * 3) % 5 < 2; }

/// Means and detail as the converter makes them of full passes.
struct Quarters {
  Plane<float> means;
  SubpixelDetail detail;
};

Quarters quarters_of(const Passes& full) {
  Quarters quarters;
  mean_quarters(scene().radiance(full, coarse_manifest().frames[0]), kSide, quarters.means, quarters.detail);
  return quarters;
}

}  // namespace

TEST_CASE("Samples of all pixels give the bits of full passes") {
  const Passes full = chain_scene::passes();
  const Plane<float> expected = quarters_of(full).means;
  const Passes passes = sampled(full, [](int, int) { return true; });
  CHECK(refined(passes) == expected);
  CHECK(filled_in(passes.object_index, passes.fine.object_index, passes.fine) == full.object_index);
  CHECK(filled_in(passes.depth_m, passes.fine.depth_m, passes.fine) == full.depth_m);
}

TEST_CASE("Samples replace the radiance of their pixels and of no others") {
  const Passes full = chain_scene::passes();
  const Plane<float> all = quarters_of(full).means;
  const Passes passes = sampled(full, is_chosen);
  Manifest one_each = coarse_manifest();
  one_each.supersample = 1;
  Passes single = passes;
  single.fine = {};
  const Plane<float> one = chain_scene::radiance(chain_scene::kAllTerms, single, one_each);
  const Plane<float> mixed = refined(passes);
  for (int y = 0; y < mixed.height_px(); ++y) {
    for (int x = 0; x < mixed.width_px(); ++x)
      CHECK(mixed.at(x, y) == (is_chosen(x, y) ? all.at(x, y) : one.at(x, y)));
  }
}

TEST_CASE("Detail is that of full passes in the chosen pixels, and 0 elsewhere") {
  const Passes full = chain_scene::passes();
  const SubpixelDetail all = quarters_of(full).detail;
  const Passes passes = sampled(full, is_chosen);
  const SceneRadiance chain = scene();
  const ManifestFrame frame = coarse_manifest().frames[0];
  Plane<float> radiance = chain.radiance(passes, frame);
  SubpixelDetail detail;
  clear_detail(radiance.width_px(), radiance.height_px(), detail);
  (void)chain.refine(passes.fine, frame, radiance, &detail);
  for (int y = 0; y < radiance.height_px(); ++y) {
    for (int x = 0; x < radiance.width_px(); ++x) {
      CHECK(detail.across.at(x, y) == (is_chosen(x, y) ? all.across.at(x, y) : 0));
      CHECK(detail.down.at(x, y) == (is_chosen(x, y) ? all.down.at(x, y) : 0));
      CHECK(detail.crossed.at(x, y) == (is_chosen(x, y) ? all.crossed.at(x, y) : 0));
    }
  }
}

TEST_CASE("A plane is filled in with the samples of its pixels, and with its own values elsewhere") {
  const Passes full = chain_scene::passes();
  const Passes passes = sampled(full, is_chosen);
  const Plane<std::uint16_t> filled = filled_in(passes.object_index, passes.fine.object_index, passes.fine);
  REQUIRE(filled.size() == full.object_index.size());
  for (int y = 0; y < filled.height_px(); ++y) {
    for (int x = 0; x < filled.width_px(); ++x) {
      const bool own = is_chosen(x / kSide, y / kSide);
      CHECK(filled.at(x, y) ==
            (own ? full.object_index.at(x, y) : passes.object_index.at(x / kSide, y / kSide)));
    }
  }
  CHECK(filled_in(Plane<float>(), {}, passes.fine).empty());
}

TEST_CASE("No pixel may need more than one sample") {
  const Passes passes = sampled(chain_scene::passes(), [](int, int) { return false; });
  CHECK(passes.fine.x_px.empty());
  CHECK(refined(passes) == scene().radiance(passes, coarse_manifest().frames[0]));
}

TEST_CASE("An unknown index among the samples is reported") {
  Passes passes = sampled(chain_scene::passes(), is_chosen);
  passes.fine.object_index[3] = 999;
  const FrameConverter converter(coarse_manifest(), chain_scene::library(),
                                 {.physics = chain_scene::settings(chain_scene::kAllTerms), .lens = {}});
  CHECK_THROWS_AS(converter.convert(passes, coarse_manifest().frames[0]), DataError);
}

}  // namespace fine_samples_test
