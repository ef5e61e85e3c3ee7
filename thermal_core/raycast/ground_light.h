#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "scene/baked_scene.h"
#include "scene/ground_maps.h"

namespace thermal {

class RayCaster;

/// A day whose hours of sunlight are wanted.
struct SunDay {
  SunPath path;
  SunHours sun{};  ///< unit vectors; where `up` is not positive, it is night
};

/// Rays for the sky view of a cell, a number of Fibonacci's (SkyRays). Root-mean-square error: see ACCURACY.md.
inline constexpr std::size_t kSkyRays = 89;

/// Called with parts that are done, of how many; on the calling thread.
using ShowParts = std::function<void(int done, int total)>;

/// Fills in sky_view and sunlit of maps whose place and heights are known, by rays that start 1 cm above the middle of
/// each cell and end at anything they hit: ground, water, crowns. The sun is a point. A cell that is not within 1e9 m
/// of the origin sees all there is. The result depends on nothing else, such as threads or the processor's vectors.
void trace_ground_light(const RayCaster& caster, std::span<const SunDay> days, GroundMaps& maps,
                        std::size_t sky_rays = kSkyRays, const ShowParts& show = {});

/// All maps of a scene, on all cores. Error if there is not enough memory.
[[nodiscard]] GroundMaps make_ground_maps(const BakedScene& scene, std::span<const SunDay> days,
                                          const ShowParts& show = {});

}  // namespace thermal
