#include "labels/label_parameters.h"

#include <cmath>

#include <fmt/core.h>

#include "base/error.h"

namespace thermal {
namespace {

void check_share(const char* where, double value) {
  if (value >= 0 && value <= 1) return;
  throw ConfigError(fault(where, fmt::format("{}", value), "", "0 to 1"));
}

}  // namespace

void LabelParameters::validate() const {
  check_share("labels.occluded_below_visibility", occluded_below_visibility);
  check_share("labels.ignore_below_visibility", ignore_below_visibility);
  if (ignore_below_area_px >= 0 && std::isfinite(ignore_below_area_px)) return;
  throw ConfigError(
      fault("labels.ignore_below_area_px", fmt::format("{}", ignore_below_area_px), "px", "0 or more"));
}

bool is_ignored(const Instance& instance, const LabelParameters& parameters) noexcept {
  if (instance.visibility && *instance.visibility < parameters.ignore_below_visibility) return true;
  return static_cast<double>(instance.area_px) < parameters.ignore_below_area_px;
}

}  // namespace thermal
