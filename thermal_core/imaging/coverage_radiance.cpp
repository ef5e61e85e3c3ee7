#include "imaging/coverage_radiance.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace thermal {
namespace {

/// Uncovered fractions; empty if all are zero.
Plane<float> uncovered(const std::vector<CoverageRank>& ranks) {
  Plane<float> left(ranks.front().coverage.width_px(), ranks.front().coverage.height_px(), 1.0F);
  const auto pixels = left.pixels();
  for (const CoverageRank& rank : ranks) {
    const auto coverage = rank.coverage.pixels();
    for (std::size_t i = 0; i < pixels.size(); ++i) pixels[i] -= coverage[i];
  }
  const bool any = std::any_of(pixels.begin(), pixels.end(), [](float share) { return share > 0; });
  return any ? std::move(left) : Plane<float>();
}

/// Adds the radiance of a fraction of each pixel. Rounded sums of coverages may exceed 1, so fractions may be
/// negative.
void add_weighted(const Plane<float>& radiance, const Plane<float>& share, Plane<float>& sum) {
  const auto out = sum.pixels();
  const auto from = radiance.pixels();
  const auto weight = share.pixels();
  for (std::size_t i = 0; i < out.size(); ++i) out[i] += std::max(weight[i], 0.0F) * from[i];
}

}  // namespace

PassChecks coverage_radiance(const SceneRadiance& scene, const Passes& passes, const ManifestFrame& frame,
                             Plane<float>& out) {
  assert(!passes.ranks.empty());
  const PassNeeds needs = scene.needs();
  Passes one;
  if (needs.depth) one.depth_m = passes.depth_m;
  if (needs.normals) one.normal = passes.normal;
  one.material_index = passes.material_index;
  out = Plane<float>(passes.object_index.width_px(), passes.object_index.height_px());
  Plane<float> radiance;
  PassChecks checks;
  for (const CoverageRank& rank : passes.ranks) {
    one.object_index = rank.object_index;
    const PassChecks of_rank = scene.radiance(one, frame, radiance);
    if (&rank == &passes.ranks.front()) checks = of_rank;  // depth and normals are those of rank 0
    add_weighted(radiance, rank.coverage, out);
    one.material_index = {};
  }
  const Plane<float> left = uncovered(passes.ranks);
  if (left.empty()) return checks;
  one.object_index = Plane<std::uint16_t>(out.width_px(), out.height_px(), kSkyIndex);
  scene.radiance(one, frame, radiance);
  add_weighted(radiance, left, out);
  return checks;
}

}  // namespace thermal
