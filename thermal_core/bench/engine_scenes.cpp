#include "bench/engine_scenes.h"

#include <utility>

#include "dataset/plan/planning.h"
#include "io/json/file.h"

namespace thermal {
namespace {

/// The last clip of a config with few frames, from another height and angle.
Json view(const Json& document, const char* id, double altitude_m, double look_angle_deg) {
  Json clip = document.at("clips").back();
  clip["id"] = id;
  clip["frames"] = kEngineFrames;
  clip["flight"]["altitude_m"] = altitude_m;
  clip["flight"]["look_angle_deg"] = look_angle_deg;
  return clip;
}

void multiply_plants(Json& document, double factor) {
  for (Json& plant : document["scene"]["plants"]) {
    Json& density = plant["per_ha"];
    if (!density.is_array()) density = Json::array({density, density, density});  // open, mid and dense areas
    for (Json& one : density) one = factor * one.get<double>();
  }
}

class Planner {
 public:
  explicit Planner(const EngineScenesTask& task) : task_(task) {}

  [[nodiscard]] Config config(const char* name) const {
    const Path file = task_.assets.config(name);
    return resolve_config(read_json(file), file.string(), task_.assets);
  }

  [[nodiscard]] EngineScene planned(const char* name, Json document, std::vector<EngineClip> clips) const {
    task_.announce(std::string(name) + ", planning");
    const Path plan = task_.folder / name;
    document["scene"]["temperatures"] = "table_1";  // needs no maps of the ground
    (void)plan_into(plan, resolve_config(std::move(document), name, task_.assets), name,
                    {.assets = task_.assets, .threads = task_.threads});
    return {.name = name, .plan = plan, .clips = std::move(clips)};
  }

 private:
  const EngineScenesTask& task_;
};

}  // namespace

std::vector<EngineScene> plan_engine_scenes(const EngineScenesTask& task) {
  const Planner planner(task);
  Json demo = planner.config("demo").resolved;
  demo["clips"] = {demo.at("clips").back()};
  demo["clips"][0]["id"] = "demo";
  demo["clips"][0]["frames"] = kEngineFrames;
  Json savanna = planner.config("savanna").resolved;
  const Json oblique = view(savanna, "oblique", 122, 45);
  savanna["clips"] = {view(savanna, "down", 61, 90), oblique, view(savanna, "horizon", 61, 8)};
  Json dense = savanna;
  multiply_plants(dense, 10);
  dense["clips"] = Json::array({oblique});
  std::vector<EngineScene> scenes;
  scenes.push_back(planner.planned("demo", std::move(demo), {{"demo", "demo"}}));
  scenes.push_back(planner.planned(
      "savanna", std::move(savanna),
      {{"down", "savanna 61 m down"}, {"oblique", "savanna 122 m oblique"}, {"horizon", "savanna horizon"}}));
  scenes.push_back(
      planner.planned("savanna x 10 plants", std::move(dense), {{"oblique", "savanna x 10 plants"}}));
  return scenes;
}

}  // namespace thermal
