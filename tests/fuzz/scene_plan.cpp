#include <algorithm>
#include <set>

#include "dataset/outline/outline.h"
#include "dataset/plan/plan_store.h"
#include "dataset/run/options.h"
#include "fuzz/accepted.h"
#include "fuzz/targets.h"
#include "imaging/budget.h"
#include "io/config/materials.h"
#include "support/assets.h"

namespace {

using thermal::Json;
using thermal::PlannedDataset;

/// The folder of a plan: {"plan": …, "config": …}, with checksums that are right, as somebody who means harm writes them.
class PlanFolder {
 public:
  [[nodiscard]] thermal::Path write(const Json& input) const {
    for (const char* name : {"plan", "config"})
      (void)folder_.file(std::string(name) + ".json", text_of(input, name));
    thermal::PlanStore(folder_.path(), kAssets).write_checksums();
    return folder_.path();
  }

 private:
  static std::string text_of(const Json& input, const char* name) {
    return input.contains(name) ? input[name].dump(-1, ' ', false, Json::error_handler_t::replace) : "";
  }

  TestFolder folder_;
};

void demand_sound(const PlannedDataset& dataset) {
  const auto& [config, plan] = dataset;
  const thermal::DatasetSpec& spec = config.spec;
  demand(spec.flights.empty(), "flights are cut into clips");
  demand(spec.clips.size() == plan.clips.size(), "the config has the plan's clips");
  std::set<std::string> ids;
  for (std::size_t k = 0; k < plan.clips.size(); ++k) {
    demand(spec.clips[k].id == plan.clips[k].id && spec.clips[k].frames == plan.clips[k].frames,
           "a clip is the same in config and plan");
    demand(spec.clips[k].frames > 0 && plan.clips[k].frames_with_actors >= 0, "a clip has frames");
    demand(ids.insert(plan.clips[k].id).second, "an id stands for one clip");
  }
  demand(config.document.at("clips").size() == spec.clips.size(), "the document has them too");
}

/// Shards and the budget of terms, as a job of a cluster works them out before it renders.
/// The budget takes milliseconds, so not every plan has one.
void use(const PlannedDataset& dataset, bool with_budget) {
  static const thermal::MaterialLibrary kMaterials = thermal::read_materials(kAssets);
  const thermal::DatasetSpec& spec = dataset.config.spec;
  std::size_t chosen = 0;
  int frames = 0;
  for (int shard = 0; shard < 3; ++shard) {
    const auto clips = thermal::choose_clips(spec, {}, {shard, 3});
    chosen += clips.size();
    frames += thermal::frames_of(clips);
  }
  demand(chosen == spec.clips.size() && frames > 0, "a clip belongs to one shard");
  const thermal::SceneOutline outline = thermal::outline_of(spec, dataset.plan, kMaterials);
  if (with_budget) (void)thermal::weigh_terms(outline, spec.settings->terms);
}

}  // namespace

void fuzz::scene_plan(Bytes bytes) {
  static const PlanFolder kFolder;
  const Json input = Json::parse(bytes.begin(), bytes.end(), nullptr, false);
  if (!input.is_object()) return;
  const thermal::Path folder = kFolder.write(input);
  tolerate([&folder, bytes] {
    const PlannedDataset dataset = thermal::PlanStore(folder, kAssets).open();
    demand_sound(dataset);
    AcceptedInputs::instance().add(bytes);
    use(dataset, bytes.size() % 8 == 0);
  });
}
