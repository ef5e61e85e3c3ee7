#pragma once

#include <algorithm>
#include <cmath>

#include "fuzz/target.h"
#include "scene/camera_geometry.h"
#include "scene/manifest.h"
#include "scene/passes.h"

template <typename T>
void demand_size(const thermal::Plane<T>& plane, bool needed, int width_px, int height_px) {
  if (!needed && plane.empty()) return;
  demand(plane.width_px() == width_px && plane.height_px() == height_px,
         "a plane has the size that the manifest says");
}

inline void demand_indices(const thermal::Plane<std::uint16_t>& plane) {
  const auto is_one = [](std::uint16_t index) { return index <= thermal::kLargestIndex; };
  demand(std::ranges::all_of(plane.pixels(), is_one), "an index is 0 to 32767");
}

/// At most the whole of a pixel is covered. Each of the ranks' sums may exceed it by a rounding (6e-8).
inline void demand_coverage(const std::vector<thermal::CoverageRank>& ranks) {
  if (ranks.empty()) return;
  for (std::size_t i = 0; i < ranks.front().coverage.size(); ++i) {
    float sum = 0;
    for (const thermal::CoverageRank& rank : ranks) {
      const float coverage = rank.coverage.pixels()[i];
      demand(coverage >= 0 && coverage <= 1, "a coverage is 0 to 1");
      sum += coverage;
    }
    demand(sum <= 1 + 1e-6F * static_cast<float>(ranks.size()), "a pixel is not covered more than once");
  }
}

/// Assumptions of the frame converter.
inline void demand_whole(const thermal::Passes& passes, const thermal::PassNeeds& needs,
                         const thermal::Manifest& manifest) {
  const int width_px = thermal::passes_camera(manifest).width_px;
  const int height_px = thermal::passes_camera(manifest).height_px;
  demand_size(passes.object_index, true, width_px, height_px);
  demand_size(passes.material_index, false, width_px, height_px);
  demand_size(passes.actor_index, false, width_px, height_px);
  demand_size(passes.depth_m, needs.depth, width_px, height_px);
  for (const auto& component : passes.normal) demand_size(component, needs.normals, width_px, height_px);
  for (const auto* plane : {&passes.object_index, &passes.material_index, &passes.actor_index})
    demand_indices(*plane);
  for (const thermal::CoverageRank& rank : passes.ranks) {
    demand_size(rank.object_index, true, width_px, height_px);
    demand_size(rank.coverage, true, width_px, height_px);
    demand_indices(rank.object_index);
  }
  demand_coverage(passes.ranks);
}
