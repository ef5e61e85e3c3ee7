#include <algorithm>

#include "scene/camera_geometry.h"
#include "support/catch.h"
#include "support/grove.h"
#include "support/traced.h"

namespace refinement_test {

using namespace small_scene;
using thermal::FineSamples;
using thermal::LensDistortion;
using thermal::Passes;
using thermal::Sampling;

namespace {

constexpr int kSide = 4;

const std::vector<LensDistortion> kLenses = {{},
                                             {.k1 = -0.25, .k2 = 0.03, .p1 = 0.003, .p2 = -0.005},
                                             {.k1 = 0.3, .k2 = -0.1, .p1 = 0.002, .p2 = 0.001, .k3 = 0.02}};

Passes sampled(const thermal::RayCaster& caster, std::size_t frame, const Sampling& sampling) {
  Clip clip = grove::clip();
  const thermal::BakedTrack track = clip.baked();
  Passes passes;
  thermal::ClipTracer(caster, track, grove::camera(), sampling).trace(frame, kAllPlanes, passes);
  return passes;
}

bool has_samples(const FineSamples& fine, int x, int y) {
  const auto row = static_cast<std::size_t>(y);
  const auto begin = fine.x_px.begin() + static_cast<std::ptrdiff_t>(fine.row_begin[row]);
  return std::binary_search(begin, begin + static_cast<std::ptrdiff_t>(fine.pixels_in(y)), x);
}

/// How many pixels with a sample of an actor have too few samples.
int missed(const Passes& adaptive, const Passes& full, int side) {
  int missed = 0;
  for (int y = 0; y < full.actor_index.height_px(); ++y) {
    for (int x = 0; x < full.actor_index.width_px(); ++x)
      missed += full.actor_index.at(x, y) != 0 && !has_samples(adaptive.fine, x / side, y / side) ? 1 : 0;
  }
  return missed;
}

/// How many samples of a frame are not those of all samples everywhere.
std::size_t wrong_samples(const FineSamples& fine, const Passes& full) {
  std::size_t wrong = 0;
  for (int y = 0; y + 1 < static_cast<int>(fine.row_begin.size()); ++y) {
    for (int line = 0; line < kSide; ++line) {
      for (std::size_t k = 0; k < fine.pixels_in(y) * kSide; ++k) {
        const std::size_t at = fine.line_begin(y, line) + k;
        const int x = fine.x_px[fine.row_begin[static_cast<std::size_t>(y)] + k / kSide] * kSide +
                      static_cast<int>(k % kSide);
        const int row = y * kSide + line;
        const bool same = fine.object_index[at] == full.object_index.at(x, row) &&
                          fine.material_index[at] == full.material_index.at(x, row) &&
                          fine.depth_m[at] == full.depth_m.at(x, row) &&
                          fine.normal[2][at] == full.normal[2].at(x, row);
        wrong += same ? 0 : 1;
      }
    }
  }
  return wrong;
}

}  // namespace

TEST_CASE("Each pixel that an actor is in has all samples, behind any lens") {
  const Scenery place = grove::place();
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  for (const LensDistortion& lens : kLenses) {
    for (std::size_t frame = 0; frame < 3; ++frame) {
      const Passes full = sampled(caster, frame, {.supersample = kSide, .lens = lens});
      const Passes adaptive = sampled(caster, frame, {.supersample = kSide, .adaptive = true, .lens = lens});
      CHECK(missed(adaptive, full, kSide) == 0);
      CHECK(wrong_samples(adaptive.fine, full) == 0);
    }
  }
}

TEST_CASE("Without edges, a lens refines hardly more than the actors' boxes") {
  Scenery place;
  place.surface(kGround, shapes::level(64, 1, 1));
  place.actor({shapes::box({-1, -1, 0}, {1, 1, 1}, 7)});
  Clip clip = {.camera_to_world = {looking_down(0, 0, 16)}, .poses = {{{posed(-9, -7, 0, 0)}}}};
  const thermal::CameraIntrinsics camera = {
      .width_px = 200, .height_px = 160, .fx_px = 120, .fy_px = 120, .cx_px = 100, .cy_px = 80};
  const thermal::BakedScene scene = place.baked();
  const thermal::RayCaster caster(scene);
  const thermal::BakedTrack track = clip.baked();
  Passes adaptive;
  const Sampling sampling = {.supersample = 2, .adaptive = true, .lens = {.k1 = -0.2, .k2 = 0.03}};
  thermal::ClipTracer(caster, track, camera, sampling).trace(0, kAllPlanes, adaptive);
  Passes full;
  thermal::ClipTracer(caster, track, camera, {.supersample = 2, .lens = sampling.lens})
      .trace(0, kAllPlanes, full);
  CHECK(missed(adaptive, full, 2) == 0);
  std::size_t seen = 0;
  for (const std::uint16_t index : adaptive.object_index.pixels()) seen += index > kGround ? 1 : 0;
  CHECK(seen > 200);
  // A box of 20 x 19 px before the lens shrinks it, 12 % too wide by interval arithmetic, and up to 3 px on every side.
  CHECK(adaptive.fine.x_px.size() < 28 * 27);
  CHECK(adaptive.fine.x_px.size() > seen);
}

}  // namespace refinement_test
