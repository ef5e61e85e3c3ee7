#pragma once

#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>
#include <vector>

#include "heat/surface/heat_of_day.h"
#include "io/assets.h"
#include "scene/ground_maps.h"
#include "scene/material.h"

namespace thermal {

/// Whether there are maps of the ground beside the folder of a clip's passes.
[[nodiscard]] bool has_ground_beside(const Path& clip_passes);

/// The heat of a library's materials on the days of a dataset, each computed when it is first asked for, the latest few
/// kept, and the maps
/// of the ground beside passes, each read once. Safe to use from several threads.
class HeatDays {
 public:
  /// `materials` must outlive this object.
  explicit HeatDays(const MaterialLibrary& materials, std::optional<Assets> assets = {})
      : materials_(materials), assets_(std::move(assets)) {}

  [[nodiscard]] const MaterialLibrary& materials() const noexcept { return materials_; }

  [[nodiscard]] std::shared_ptr<const HeatOfDay> of(const DayWeather& weather);

  /// The maps beside the folder of a clip's passes, as `generate --keep-passes` leaves them; null without any. Needs
  /// assets.
  [[nodiscard]] std::shared_ptr<const GroundMaps> ground_beside(const Path& clip_passes);

 private:
  const MaterialLibrary& materials_;
  std::optional<Assets> assets_;
  std::mutex mutex_;
  std::map<Path, std::shared_ptr<const GroundMaps>> grounds_;
  std::vector<std::shared_ptr<const HeatOfDay>> days_;
};

}  // namespace thermal
