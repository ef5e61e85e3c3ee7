#pragma once

#include <memory>
#include <string>
#include <vector>

#include "analysis/compare/set_figures.h"
#include "dataset/clip/task.h"
#include "dataset/plan/plan_store.h"
#include "dataset/progress.h"
#include "imaging/frame_converter.h"
#include "io/assets.h"
#include "io/config/spec.h"
#include "labels/box_style.h"
#include "radiometry/radiance_table.h"

namespace thermal {

/// Which targets are measured in exposed frames, and the style of their boxes.
struct TargetChoice {
  std::string category = {};  ///< in any case; empty: people
  BoxStyle boxes = BoxStyle::visible;
};

/// ConfigError, starting with `name`, unless a config has the physical model and the engine `embree`.
void check_can_be_exposed(const DatasetSpec& spec, const std::string& name);

/// Radiance of some clips, rendered once, to be exposed repeatedly by other cameras, links and codecs.
class StoredRadiance {
 public:
  /// Renders the frames of clips that are spread evenly over those of a config, `most_clips` at most, with the plan of
  /// `store`. The config must pass check_can_be_exposed(). DataError and IoError as PlanTracer.
  StoredRadiance(const PlannedDataset& planned, const PlanStore& store, std::size_t most_clips,
                 const Assets& assets, const RunHooks& hooks);

  /// The frames exposed with the sensor, link and codec of `spec`'s clips, the same in the same order; everything else is
  /// that of the rendered dataset. A clip is a unit.
  [[nodiscard]] std::vector<FrameFigures> measured(const DatasetSpec& spec,
                                                   const TargetChoice& targets) const;

  [[nodiscard]] std::size_t clips() const noexcept { return clips_.size(); }

 private:
  struct Clip {
    std::size_t place = 0;  ///< among those of the dataset
    Manifest manifest;
    ClipTask task;
    float brightest_w_m2_sr = 0;
    std::shared_ptr<const TemperatureTable> temperatures;
    std::vector<SceneFrame> frames;
  };

  static std::vector<FrameFigures> measured(const Clip& clip, const ClipSettings& settings,
                                            const TargetChoice& targets);

  std::vector<Clip> clips_;
};

}  // namespace thermal
