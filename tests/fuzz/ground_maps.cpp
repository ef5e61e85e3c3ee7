#include "fuzz/accepted.h"
#include "fuzz/baked_files.h"
#include "fuzz/targets.h"
#include "io/bake/ground_maps_file.h"
#include "support/assets.h"

namespace {

/// The place of all inputs.
thermal::BakedGround place() {
  thermal::BakedGround ground;
  ground.size_m = 40;
  return ground;
}

bool is_finite(const std::vector<float>& heights, float least) {
  return std::ranges::all_of(heights, [least](float one) { return std::isfinite(one) && one >= least; });
}

void demand_sound(const thermal::GroundMaps& maps) {
  const std::size_t cells = maps.cells * maps.cells;
  demand(maps.size_m == 40 && maps.cells > 0, "the place is the scene's");
  demand(maps.sky_view.size() == cells && maps.height_m.size() == cells && maps.crown_top_m.size() == cells &&
             maps.moisture.size() == cells,
         "a cell has all values");
  demand(maps.water_m.empty() || (maps.water_m.size() == cells && is_finite(maps.water_m, 0)), "depths");
  const thermal::GroundCovers& covers = maps.covers;
  const std::size_t fine = covers.cells * covers.cells;
  demand(covers.kind.size() == fine && covers.grass.size() == fine && covers.trodden.size() == fine &&
             covers.ash.size() == fine && covers.border.size() == fine,
         "a fine cell has all shares");
  demand(std::ranges::all_of(covers.kind, [&](auto one) { return one < covers.kinds.size(); }), "kinds");
  demand(is_finite(maps.height_m, std::numeric_limits<float>::lowest()) && is_finite(maps.crown_top_m, 0),
         "heights");
  for (const thermal::SunlitHours& sunlit : maps.sunlit) {
    demand(sunlit.hours.size() == cells, "a cell has hours of each day");
    demand(std::ranges::all_of(sunlit.hours, [](auto one) { return one >> 24U == 0; }), "a day has 24 hours");
    demand(std::abs(sunlit.path.latitude_deg) <= 90, "a latitude");
    demand(sunlit.path.day_of_year >= 1 && sunlit.path.day_of_year <= 366, "a day");
  }
}

}  // namespace

void fuzz::ground_maps(Bytes bytes) {
  const auto folder = as_baked(bytes, "ground");
  tolerate([&folder, bytes] {
    (void)thermal::sun_paths_of_maps(folder, kAssets);
    const thermal::GroundMaps maps = thermal::read_ground_maps(folder, place(), kAssets);
    demand_sound(maps);
    AcceptedInputs::instance().add(bytes);
  });
}
